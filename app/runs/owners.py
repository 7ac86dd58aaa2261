"""Which programs have runs under way: each holds a locked file, which the system unlocks however it ends."""

from __future__ import annotations

import fcntl
import os
import secrets
from contextlib import suppress
from pathlib import Path

from app.store.database import Database
from app.store.run_log import RunLog
from core.errors import InputError

ABANDONED = "The program that sent this run ended while it was on; nothing resumes by itself."


class RunOwner:
    """This program's mark as one that has runs under way.

    Args:
        data: the data folder.

    Attributes:
        name: what stands in the runs that are its own.

    Raises:
        InputError: the folder takes no such file.
    """

    def __init__(self, data: Path) -> None:
        self.name = secrets.token_hex(6)
        self._path = _folder(data) / self.name
        try:
            self._path.parent.mkdir(exist_ok=True)
            self._file = os.open(self._path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC)
            fcntl.flock(self._file, fcntl.LOCK_EX)
        except OSError as error:
            raise InputError(
                f"The data folder {data} cannot be used: {error.strerror}. Give another with --data.",
                "--data",
            ) from error

    def close(self) -> None:
        """Takes the mark away."""
        self._path.unlink(missing_ok=True)
        os.close(self._file)


def end_abandoned(database: Database) -> None:
    """Calls runs interrupted whose program is gone; those of another program that lives go on."""
    log, data = RunLog(database), database.path.parent
    for content in log.running():
        if not _lives(data, content.get("owner")):
            database.put_run(content | {"state": "interrupted", "sentence": ABANDONED})


def _lives(data: Path, name: str | None) -> bool:
    if name is None or not name.isalnum():
        return False
    path = _folder(data) / name
    try:
        file = os.open(path, os.O_RDONLY | os.O_CLOEXEC)
    except FileNotFoundError:
        return False
    try:
        fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    finally:
        os.close(file)
    with suppress(OSError):
        path.unlink(missing_ok=True)
    return False


def _folder(data: Path) -> Path:
    return data / "running"
