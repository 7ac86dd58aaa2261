"""Looks after the database while a studio has it open: a check at the start, and a backup once a day."""

import logging
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

from app.common.json import Json
from app.store.backups import DAILY, found_backups, make_backup, way_back
from app.store.database import Database
from app.store.quick_check import damage_of
from app.store.storage_errors import left_undone
from app.store.tables.unreadable import Unreadable
from core.errors import FootfallError, StorageDamagedError, StorageError

logger = logging.getLogger(__name__)

CHECKED_AT_ONCE = 50_000_000
"""Bytes; a larger database is checked in the background, while the studio starts."""
DAY_SECONDS = 86_400.0
FILES_SECONDS = 5.0
"""How often is looked whether the files of the database are still there, s."""
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
        self._time = database.folder_time
        self._trouble: str | None = None
        self._missing = _missing_sentence(database)
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._work, name="database keeper", daemon=True)
        database.damaged = self._tell
        self.unreadable = Unreadable(database)
        self._is_checked = _size(database.path) <= CHECKED_AT_ONCE
        if self._is_checked:
            self._check()

    def start(self) -> None:
        """Begins with the backups, and with the check where the database is large."""
        self._thread.start()

    def view(self) -> Json:
        """Everything that is wrong, as JSON content.

        Returns:
            Whether the file is damaged, and a sentence or None; where rows cannot be read, these as well.
        """
        damage, unreadable = self._database.damage, self.unreadable.view()
        sentence = damage or self._missing or self._trouble or _row_sentence(unreadable["count"])
        view = {"damaged": damage is not None, "sentence": sentence}
        return {**view, "unreadable": unreadable} if unreadable["count"] else view

    def close(self) -> None:
        """Ends; a backup that is being made is made."""
        self._closing.set()
        if self._thread.is_alive():
            self._thread.join()
            self._keep_time()

    def look(self) -> None:
        """Makes a backup where one is due; says why where that fails."""
        if self._database.damage is not None or not self._may_copy():
            return
        failure = "No backup of the database could be made today."
        try:
            if self._is_due():
                state = _state_of(self._database.path)
                make_backup(self._database.path, DAILY)
                self._time.backed_up(state)
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
        with left_undone("The entries of the database are not looked through"):
            self.unreadable.look(lambda: not self._closing.is_set() and self._database.damage is None)
        self.look()
        next_look = LOOK_SECONDS
        while not self._closing.wait(FILES_SECONDS):
            self._database.look_at_files()
            self._forget_replaced_rows()
            next_look -= FILES_SECONDS
            if next_look <= 0:
                next_look = LOOK_SECONDS
                self.look()
                self._keep_time()
        self._database.look_at_files()

    def _forget_replaced_rows(self) -> None:
        with left_undone("Whether entries can still not be read is not looked at"):
            if self.unreadable.forget_replaced():
                self._tell()

    def _keep_time(self) -> None:
        with left_undone("How late it is in the data folder is not kept"):
            self._time.keep()

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
        last = self._time.last_backup
        if not found_backups(self._database.path.parent) or last is None:
            return True
        return self._time.now >= last.time + DAY_SECONDS and _state_of(self._database.path) != last.state

    def _take_trouble(self, sentence: str | None) -> None:
        if sentence != self._trouble:
            self._trouble = sentence
            if sentence is not None:
                logger.warning("%s", sentence)
            self._tell()

    def _tell(self) -> None:
        self._changed(self.view())


def _missing_sentence(database: Database) -> str | None:
    """A new database beside backups of another one: that one was taken away."""
    folder = database.path.parent
    if not database.is_new or not found_backups(folder):
        return None
    sentence = f"The database {database.path} was not there when the studio started, and a new one was made."
    logger.warning("%s", f"{sentence} {way_back(folder)}")
    return f"{sentence} {way_back(folder)}"


def _row_sentence(count: int) -> str | None:
    if not count:
        return None
    entries = "1 entry" if count == 1 else f"{count} entries"
    return f"{entries} of the database cannot be read. Everything else is as it was."


def _files(database: Path) -> tuple[Path, ...]:
    wal = database.with_name(f"{database.name}-wal")
    return (database, wal) if wal.exists() else (database,)


def _size(database: Path) -> int:
    return sum(path.stat().st_size for path in _files(database))


def _state_of(database: Path) -> list[Any]:
    """Name, size and time of writing of each file; an empty file beside the database holds nothing."""
    states = [(path.name, path.stat()) for path in _files(database)]
    return [[name, state.st_size, state.st_mtime_ns] for name, state in states if state.st_size]
