"""A journal file that holds what passes in a run until the database has it.

A kill of the program takes nothing of it. It is locked as long as the program lives, and the system
unlocks it however that ends; so it also says whether a run is still under way.
"""

import fcntl
import logging
import math
import os
import stat
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from enum import IntEnum
from pathlib import Path
from typing import BinaryIO

logger = logging.getLogger(__name__)

FOLDER = "running"
"""Where the journals are in a data folder."""

MOST_ENTRY = 16_000_000
"""Bytes that an entry may have."""
_HEAD = struct.Struct("<BdI")
"""Kind, time in s, length of what follows in bytes."""


class EntryKind(IntEnum):
    """What an entry holds."""

    TO_ROBOT = 0
    FROM_ROBOT = 1
    STATE = 2
    """Link, robot and cause as JSON."""
    END = 3
    """The run's content as JSON."""

    @property
    def is_bytes(self) -> bool:
        """Whether it is bytes on the line."""
        return self in (EntryKind.TO_ROBOT, EntryKind.FROM_ROBOT)


@dataclass(frozen=True)
class Entry:
    """Something that happened in a run, at a time in s by `boot_seconds`."""

    kind: EntryKind
    time: float
    data: bytes


class RunJournal:
    """The journal of a run that this program sends.

    Args:
        data: the data folder.
        run: the run's id.

    Raises:
        OSError: the folder takes no such file.
    """

    def __init__(self, data: Path, run: str) -> None:
        self._path = _path(data, run)
        self._path.parent.mkdir(exist_ok=True)
        self._file = _new_locked(self._path)
        self._is_full = False

    def add(self, entry: Entry) -> None:
        """Adds an entry; it outlives this program when this returns.

        Where the disk takes no more, the journal ends there, and only the database may have the rest.
        """
        if self._is_full:
            return
        content = _HEAD.pack(entry.kind, entry.time, len(entry.data)) + entry.data
        try:
            self._is_full = os.write(self._file, content) < len(content)
        except OSError:
            self._is_full = True
        if self._is_full:
            logger.warning("%s takes no more of a run; the database may.", self._path)

    def close(self, *, is_in_database: bool) -> None:
        """Unlocks the journal, and takes it away where the database has everything."""
        if is_in_database:
            self._path.unlink(missing_ok=True)
        os.close(self._file)


@contextmanager
def abandoned_journal(data: Path, run: str) -> Iterator[tuple[Entry, ...] | None]:
    """What stands in the journal of a run whose program is gone; None where it lives.

    Nobody else gets it meanwhile, and after that it is gone.
    """
    path = _path(data, run)
    try:
        # Opened without O_NONBLOCK, a pipe would wait for somebody who writes into it.
        file = os.fdopen(os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC), "rb")
    except OSError:  # a folder is none either
        yield ()
        return
    with file:
        if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
            yield ()
            return
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            yield None
            return
        yield tuple(_read(file))
        path.unlink(missing_ok=True)


def has_entries(data: Path, run: str) -> bool:
    """Whether anything stands in the journal of a run, whoever writes it."""
    try:
        return _path(data, run).stat().st_size > 0
    except OSError:
        return False


def journalled_runs(data: Path) -> list[str]:
    """Runs that have a journal, whoever writes it.

    Args:
        data: the data folder.
    """
    return sorted(path.stem for path in (data / FOLDER).glob("*.journal") if path.stem.isascii())


def _new_locked(path: Path) -> int:
    """A new locked file; made again where somebody took it for abandoned before it was locked."""
    while True:
        file = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC | os.O_CLOEXEC, 0o644)
        try:
            fcntl.flock(file, fcntl.LOCK_EX)
            if os.path.exists(path) and os.path.samestat(os.fstat(file), os.stat(path)):
                return file
        except OSError:
            os.close(file)
            raise
        os.close(file)


def _read(file: BinaryIO) -> Iterator[Entry]:
    """The entries up to the first that is none: a loss of power may leave zeros at a file's end."""
    while len(head := file.read(_HEAD.size)) == _HEAD.size:
        kind, time, length = _HEAD.unpack(head)
        if kind > max(EntryKind) or not 0 < length <= MOST_ENTRY or not math.isfinite(time):
            return
        data = file.read(length)
        if len(data) < length:
            return
        yield Entry(EntryKind(kind), time, data)


def _path(data: Path, run: str) -> Path:
    return data / FOLDER / f"{run}.journal"
