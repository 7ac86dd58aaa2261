"""Backups of the database in the data folder: one a day and one before each migration, each checked."""

import os
import re
import shlex
import shutil
import sqlite3
import stat
import time
from contextlib import closing, suppress
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from app.store.plain_file import sweep_partials
from app.store.quick_check import damage_of, reading
from app.store.storage_errors import file_error, storage_error
from core.errors import StorageDamagedError, StorageError, StorageFullError

FOLDER = "backups"
DAILY, MIGRATION, RESCUE = "daily", "before-migration", "rescued"
"""Why a backup was made; part of its file's name."""
MOST = {DAILY: 7, MIGRATION: 3, RESCUE: 3}
"""Backups that are kept of each kind; the oldest go."""
LEAST_FREE = 64_000_000
"""Bytes that a backup leaves free on the disk."""
_OLD_SECONDS = 3600.0
"""A backup that was begun so long ago is not being made any more, s."""


_NUMBER = re.compile("(?<=[a-z])-([0-9]{1,9})$")
"""The number of a backup, behind its kind."""


@dataclass(frozen=True)
class Backup:
    """A copy of the database.

    Args:
        path: its file; its number orders the backups, whatever the clock was set to.
        made: when, s since the epoch.
        size: bytes.
    """

    path: Path
    made: float
    size: int

    @property
    def order(self) -> tuple[int, float, str]:
        """Sorts backups by when they were made; those without a number are older than all others."""
        number = _NUMBER.search(self.path.stem)
        return (int(number.group(1)) if number else 0, self.made, self.path.name)

    def is_of(self, kind: str) -> bool:
        """Whether it was made for a reason."""
        return _NUMBER.sub("", self.path.stem).endswith(f"-{kind}")


def found_backups(data: Path) -> tuple[Backup, ...]:
    """The backups in a data folder, the newest first; links and folders are none."""
    backups = []
    for path in (data / FOLDER).glob("studio-*.sqlite3"):
        with suppress(FileNotFoundError):  # it was taken away meanwhile
            state = path.lstat()
            if stat.S_ISREG(state.st_mode):
                backups.append(Backup(path, state.st_mtime, state.st_size))
    return tuple(sorted(backups, key=lambda backup: backup.order, reverse=True))


def last_good(data: Path) -> Backup | None:
    """The newest backup that is whole; None where there is none."""
    return next((backup for backup in found_backups(data) if _is_good(backup)), None)


def _is_good(backup: Backup) -> bool:
    try:
        return damage_of(backup.path) is None
    except StorageError:
        return False


def damaged_sentence(sentence: str, data: Path) -> str:
    """That the database is damaged, with what follows from it and how a person gets back."""
    return f"{sentence} Nothing can be stored. {way_back(data)}"


def way_back(data: Path) -> str:
    """How a person gets back to the last good backup, in sentences."""
    good = last_good(data)
    command = f"footfall restore --data {shlex.quote(str(data))}"
    if good is None:
        return (
            "There is no good backup. Saved gaits are files of their own and are not touched by this. "
            f"“{command} --empty”, once the studio has ended, sets the damaged file aside and begins anew."
        )
    made = datetime.fromtimestamp(good.made).strftime("%Y-%m-%d %H:%M")
    return (
        f"The last good backup is {good.path.name}, made {made}. “{command}”, once the studio has ended, "
        "lists the backups and goes back to the one that you choose; the damaged file is kept aside."
    )


def make_backup(database: Path, kind: str, source: sqlite3.Connection | None = None) -> Backup:
    """Copies a database, also while programs write to it, checks the copy, and takes the oldest ones away.

    Args:
        database: its file.
        kind: why.
        source: a connection to it, where the file itself may be gone.

    Raises:
        StorageFullError: there is no room for it.
        StorageDamagedError: the database is damaged; no good backup is replaced.
        StorageError: the disk refuses it.
    """
    folder = database.parent / FOLDER
    number = max((backup.order[0] for backup in found_backups(database.parent)), default=0) + 1
    name = f"studio-{time.strftime('%Y-%m-%d-%H%M%S')}-{kind}-{number:04d}.sqlite3"
    partial = folder / f".{name}.{os.getpid()}.partial"
    try:
        folder.mkdir(exist_ok=True)
        sweep_partials(folder, _is_abandoned)
        _require_room(database)
        if source is None:
            with closing(reading(database, is_open=True)) as opened:
                _copy(opened, partial)
        else:
            _copy(source, partial)
        _require_whole(partial, database)
        put_in_place(partial, folder / name)
    except sqlite3.Error as error:
        raise storage_error(error, database) or error from error
    except OSError as error:
        raise file_error(error, folder) from error
    finally:
        partial.unlink(missing_ok=True)
    _rotate(database.parent, kind)
    state = (folder / name).stat()
    return Backup(folder / name, state.st_mtime, state.st_size)


def _copy(source: sqlite3.Connection, partial: Path) -> None:
    with closing(sqlite3.connect(partial)) as target:
        source.backup(target)
        target.execute("PRAGMA journal_mode=DELETE")  # one file, without others beside it


def _require_whole(partial: Path, database: Path) -> None:
    damage = damage_of(partial)
    if damage is not None:
        raise StorageDamagedError(f"The database {database} is damaged ({damage}).", str(database))


def _require_room(database: Path) -> None:
    wal = database.with_name(f"{database.name}-wal")
    size = sum(path.stat().st_size for path in (database, wal) if path.exists())
    free = shutil.disk_usage(database.parent).free
    if free < size + LEAST_FREE:
        raise StorageFullError(
            f"There is no room for a backup of the database: the disk of {database.parent} has "
            f"{free / 1e6:.0f} MB left, and {(size + LEAST_FREE) / 1e6:.0f} MB are needed. Make room on it.",
            str(database),
        )


def put_in_place(partial: Path, path: Path) -> None:
    """Has a file take the place of another one, on the disk when this returns."""
    _sync(partial)
    partial.replace(path)
    _sync(path.parent)


def _sync(path: Path) -> None:
    file = os.open(path, os.O_RDONLY)
    try:
        os.fsync(file)
    finally:
        os.close(file)


def _rotate(data: Path, kind: str) -> None:
    kept = [backup for backup in found_backups(data) if backup.is_of(kind)]
    for backup in kept[MOST[kind] :]:
        backup.path.unlink(missing_ok=True)


def _is_abandoned(partial: Path, state: os.stat_result) -> bool:
    del partial
    return state.st_mtime < time.time() - _OLD_SECONDS
