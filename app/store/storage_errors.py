"""What SQLite and the disk refuse, as sentences."""

import errno
import logging
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from core.errors import InputError, StorageDamagedError, StorageError, StorageFullError

logger = logging.getLogger(__name__)

FULL = frozenset({errno.ENOSPC, errno.EDQUOT, errno.EFBIG})
_WRONG_PATH = frozenset({errno.ENOENT, errno.ENOTDIR, errno.EISDIR, errno.ENAMETOOLONG, errno.ELOOP})
_NO_RIGHT = frozenset({errno.EACCES, errno.EPERM, errno.EROFS})

_RIGHT = "Give yourself the right to write to it and to its folder"
_DAMAGED = frozenset({sqlite3.SQLITE_CORRUPT, sqlite3.SQLITE_NOTADB})
_FULL = {
    sqlite3.SQLITE_FULL: ("its disk is full", "Free space on the disk, then try again."),
    sqlite3.SQLITE_TOOBIG: ("one entry cannot hold so much", "Store something smaller."),
    sqlite3.SQLITE_NOMEM: ("this computer's memory is full", "End other programs, then try again."),
}
_OTHER = {
    sqlite3.SQLITE_IOERR: (
        "the disk reports an error or takes no more",
        "Check the disk and its free space, then try again.",
    ),
    sqlite3.SQLITE_READONLY: ("it may only be read", f"{_RIGHT}, or give another folder with --data."),
    sqlite3.SQLITE_PERM: ("the rights to it are missing", f"{_RIGHT}."),
    sqlite3.SQLITE_AUTH: ("the rights to it are missing", f"{_RIGHT}."),
    sqlite3.SQLITE_BUSY: ("another program is writing to it", "Try again when that program has ended."),
    sqlite3.SQLITE_LOCKED: ("something else is writing to it", "Try again in a moment."),
    sqlite3.SQLITE_PROTOCOL: ("its locks fail", "Keep the data folder on a disk of this computer."),
    sqlite3.SQLITE_NOLFS: (
        "its disk takes no file as large as this",
        "Keep the data folder on another disk.",
    ),
    sqlite3.SQLITE_CANTOPEN: (
        "it, or a file beside it, cannot be opened",
        "Look whether its folder is there, may be written to and has room.",
    ),
    sqlite3.SQLITE_SCHEMA: ("another program changed its tables", "Start this one again."),
    sqlite3.SQLITE_INTERRUPT: ("it was interrupted", "Try again."),
}
_UNKNOWN = ("it is not as this program expects it", "Start the program again.")
"""Reason and remedy, by SQLite's code."""


def storage_error(error: sqlite3.Error, path: Path) -> StorageError | None:
    """What a database refused; None for a defect of the program, which stays what it is.

    Args:
        error: what SQLite said.
        path: the database.
    """
    if isinstance(error, sqlite3.IntegrityError | sqlite3.ProgrammingError | sqlite3.InterfaceError):
        return None
    code = getattr(error, "sqlite_errorcode", None)
    primary = None if code is None else code & 0xFF
    if primary in _DAMAGED or (primary is None and "decode" in str(error)):
        return StorageDamagedError(f"The database {path} is damaged ({error}).", str(path))
    reason, remedy = (_FULL | _OTHER).get(primary or 0, _UNKNOWN)
    kind = StorageFullError if primary in _FULL else StorageError
    sentence = f"The database {path} cannot do this: {reason} ({error}). Nothing was stored. {remedy}"
    return kind(sentence, str(path))


def file_error(error: OSError, path: Path) -> StorageError | InputError:
    """Why a file cannot be written; the file that was there before is as it was."""
    reason = f"{path} cannot be written: {error.strerror}."
    if error.errno in FULL:
        return StorageFullError(f"{reason} Free space on its disk, then try again.", str(path))
    if error.errno in _NO_RIGHT:
        reason += f" {_RIGHT}."
    return InputError(reason, str(path)) if error.errno in _WRONG_PATH else StorageError(reason, str(path))


@contextmanager
def left_undone(what: str) -> Iterator[None]:
    """Goes on without something that the disk or the database refuses, and logs that.

    Args:
        what: is not done, as the beginning of a sentence.
    """
    try:
        yield
    except StorageDamagedError:  # what is damaged was logged when it was found
        logger.warning("%s, since the database is damaged.", what)
    except (StorageError, InputError) as error:
        logger.warning("%s. %s", what, error.sentence)
