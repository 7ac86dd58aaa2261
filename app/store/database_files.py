"""The files of an open database: whether they are still those that were opened."""

import os
from dataclasses import dataclass
from pathlib import Path

from app.store.quick_check import damage_of

_BESIDE = ("", "-wal", "-shm")
_WAL_MAGIC = (b"\x37\x7f\x06\x82", b"\x37\x7f\x06\x83")
"""First bytes of a write-ahead log (SQLite, “Database File Format”, section 4.1)."""


_FATES = {True: "deleted", False: "replaced by another file"}
"""By whether nothing has its name any more."""


@dataclass(frozen=True)
class _Identity:
    """A file, whatever its name is by now."""

    device: int
    inode: int


class DatabaseFiles:
    """A database, its write-ahead log and the log's index as they were when they were opened.

    SQLite goes on without a word where one of them is deleted, replaced or emptied: later writes are in a
    file that has no name, and gone once the program ends.

    Args:
        path: the database, which is open, in WAL mode, and was written to.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._opened = {name: _identity(self._named(name)) for name in _BESIDE}
        self._size = 0
        self.fault()

    def fault(self) -> str | None:
        """A sentence about files that are no longer those that were opened; None where all are."""
        for name, opened in self._opened.items():
            path = self._named(name)
            now = _identity(path)
            if now != opened:
                return f"{path} was {_FATES[now is None]} while it was in use."
        return self._cut_off() or self._emptied()

    def _cut_off(self) -> str | None:
        before, size = self._size, _size(self._path)
        if size < before and damage_of(self._path, is_open=True) is not None:  # else it was vacuumed
            return f"{self._path} was cut off from {before} to {size} bytes while it was in use."
        self._size = size
        return None

    def _emptied(self) -> str | None:
        """Behind an emptied log SQLite goes on where it was, so that the beginning is missing."""
        log = self._named("-wal")
        begin = _first_bytes(log)
        return f"{log} was emptied while it was in use." if begin and begin not in _WAL_MAGIC else None

    def _named(self, beside: str) -> Path:
        return self._path.with_name(self._path.name + beside)


def _identity(path: Path) -> _Identity | None:
    try:
        status = os.stat(path)
    except OSError:
        return None
    return _Identity(status.st_dev, status.st_ino)


def _size(path: Path) -> int:
    try:
        return os.stat(path).st_size
    except OSError:
        return 0


def _first_bytes(path: Path) -> bytes:
    try:
        with path.open("rb") as file:
            return file.read(4)
    except OSError:
        return b""
