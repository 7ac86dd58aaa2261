"""Looks after the database while a studio has it open: a check at the start, and a backup once a day."""

import logging
import threading
import time
from collections.abc import Callable
from pathlib import Path

from app.common.json import Json
from app.store.backups import DAILY, found_backups, make_backup
from app.store.database import Database
from app.store.quick_check import damage_of
from core.errors import FootfallError, StorageDamagedError, StorageError

logger = logging.getLogger(__name__)

CHECKED_AT_ONCE = 50_000_000
"""Bytes; a larger database is checked in the background, while the studio starts."""
DAY_SECONDS = 86_400.0
LOOK_SECONDS = 600.0
"""How often is looked whether a backup is due, s."""


class DatabaseKeeper:
    """Checks the database of a studio and keeps backups of it; any thread may ask.

    Args:
        database: the database.
        changed: called, from any thread, when `view` is another.
        may_copy: whether a backup may begin now; none does while a robot moves.
    """

    def __init__(
        self, database: Database, changed: Callable[[Json], object], may_copy: Callable[[], bool]
    ) -> None:
        self._database = database
        self._changed = changed
        self._may_copy = may_copy
        self._trouble: str | None = None
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._work, name="database keeper", daemon=True)
        database.damaged = self._tell
        self._is_checked = _size(database.path) <= CHECKED_AT_ONCE
        if self._is_checked:
            self._check()

    def start(self) -> None:
        """Begins with the backups, and with the check where the database is large."""
        self._thread.start()

    def view(self) -> Json:
        """What is wrong as JSON content: whether the file is damaged, and a sentence or None."""
        damage = self._database.damage
        return {"damaged": damage is not None, "sentence": damage or self._trouble}

    def close(self) -> None:
        """Ends; a backup that is being made is made."""
        self._closing.set()
        if self._thread.is_alive():
            self._thread.join()

    def look(self) -> None:
        """Makes a backup where one is due; says why where that fails."""
        if self._database.damage is not None or not self._may_copy():
            return
        failure = "No backup of the database could be made today."
        try:
            if self._is_due():
                make_backup(self._database.path, DAILY)
                self._take_trouble(None)
        except StorageDamagedError as error:
            self._database.take_damage(error.sentence)
        except FootfallError as error:
            self._take_trouble(f"{failure} {error.sentence}")
        except OSError as error:
            self._take_trouble(f"{failure} {self._database.path.parent}: {error.strerror}.")

    def _work(self) -> None:
        if not self._is_checked:
            self._check()
        self.look()
        while not self._closing.wait(LOOK_SECONDS):
            self.look()

    def _check(self) -> None:
        path = self._database.path
        try:
            damage = damage_of(path, is_open=True)
        except StorageError as error:
            self._take_trouble(f"The database could not be checked. {error.sentence}")
            return
        if damage is not None:
            self._database.take_damage(f"The database {path} is damaged ({damage}).")

    def _is_due(self) -> bool:
        """Whether there is something new, and the last backup is a day old."""
        newest = next(iter(found_backups(self._database.path.parent)), None)
        if newest is None:
            return True
        return time.time() >= newest.made + DAY_SECONDS and _changed_at(self._database.path) >= newest.made

    def _take_trouble(self, sentence: str | None) -> None:
        if sentence != self._trouble:
            self._trouble = sentence
            if sentence is not None:
                logger.warning("%s", sentence)
            self._tell()

    def _tell(self) -> None:
        self._changed(self.view())


def _files(database: Path) -> tuple[Path, ...]:
    wal = database.with_name(f"{database.name}-wal")
    return (database, wal) if wal.exists() else (database,)


def _size(database: Path) -> int:
    return sum(path.stat().st_size for path in _files(database))


def _changed_at(database: Path) -> float:
    """When something was written last; an empty file beside the database holds nothing."""
    states = [path.stat() for path in _files(database)]
    return max(state.st_mtime for state in states if state.st_size)
