"""The files of an open database: whether they are still those that were opened."""

import os
from dataclasses import dataclass
from pathlib import Path

from app.store.quick_check import damage_of

_BESIDE = ("", "-wal", "-shm")
_WAL_MAGIC = (b"\x37\x7f\x06\x82", b"\x37\x7f\x06\x83")
"""First bytes of a write-ahead log (SQLite, “Database File Format”, section 4.1)."""


@dataclass(frozen=True)
class _Identity:
    """A file, whatever its name is by now."""

    device: int
    inode: int


class DatabaseFiles:
    """A database, its write-ahead log and the log's index as they were when they were opened.

    SQLite goes on without a word where one of them is deleted, replaced or emptied: what it writes then is
    in a file that has no name, and gone once the program ends.

    Args:
        path: the database, which is open, in WAL mode, and was written to.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._opened = {name: _identity(self._named(name)) for name in _BESIDE}
        self._size = 0
        self.fault()

    def fault(self) -> str | None:
        """What happened to the files, as a sentence; None where they are as they were."""
        for name, opened in self._opened.items():
            path = self._named(name)
            now = _identity(path)
            if now != opened:
                what = "deleted" if now is None else "replaced by another file"
                return f"{path} was {what} while it was in use."
        size = self._path.stat().st_size
        if size < self._size and damage_of(self._path, is_open=True) is not None:  # else it was vacuumed
            return f"{self._path} was cut off from {self._size} to {size} bytes while it was in use."
        self._size = size
        return None

    def fault_after_write(self) -> str | None:
        """The same after a transaction, whose pages the log must have."""
        fault = self.fault()
        if fault is None and _first_bytes(self._named("-wal")) not in _WAL_MAGIC:
            fault = f"{self._named('-wal')} was emptied while it was in use."
        return fault

    def _named(self, beside: str) -> Path:
        return self._path.with_name(self._path.name + beside)


def _identity(path: Path) -> _Identity | None:
    try:
        status = os.stat(path)
    except OSError:
        return None
    return _Identity(status.st_dev, status.st_ino)


def _first_bytes(path: Path) -> bytes:
    try:
        with path.open("rb") as file:
            return file.read(4)
    except OSError:
        return b""
