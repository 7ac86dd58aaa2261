"""Going back to a backup of the database; what was there before is kept aside."""

import os
import shutil
import sqlite3
import time
from contextlib import closing, suppress
from pathlib import Path

from app.store.backups import FOLDER, put_in_place
from app.store.database import DATABASE
from app.store.folder_lock import DatabaseUse, StudioLock
from app.store.quick_check import damage_of, reading
from app.store.schema import version
from app.store.storage_errors import file_error, storage_error
from core.errors import InputError, NotFoundError

ASIDE = "damaged"
"""Folder in the data folder for databases that somebody went back from."""

_COUNTED = {"edited gaits": "open_gait", "versions": "version", "runs": "run", "trials": "trial"}


def contents_of(backup: Path) -> dict[str, int]:
    """How many of what a backup holds; what cannot be counted is left out."""
    counts = {}
    with suppress(sqlite3.Error), closing(reading(backup)) as connection:
        for name, table in _COUNTED.items():
            with suppress(sqlite3.Error):
                counts[name] = int(connection.execute(f"SELECT COUNT(*) FROM {table}").fetchone()[0])
    return counts


def restore(data: Path, backup: Path | None) -> Path | None:
    """Puts a backup in the place of the database.

    Args:
        data: the data folder.
        backup: its file, or the name of one of the folder's backups; None for an empty database.

    Returns:
        The folder with what was there before; None where nothing was.

    Raises:
        InputError: a program has the folder or its database open, or the backup is of a newer program.
        NotFoundError: there is no such backup.
        StorageError: the disk does not take it; the database is as it was.
    """
    with closing(StudioLock(data, "`footfall restore`")), closing(DatabaseUse(data, alone=True)):
        database = data / DATABASE
        partial = data / f".{DATABASE}.{os.getpid()}.partial"
        try:
            if backup is None:
                partial.touch()  # an empty file is an empty database
            else:
                shutil.copyfile(_usable(data, backup), partial)
            aside = _set_aside(database)
            put_in_place(partial, database)
        except OSError as error:
            raise file_error(error, database) from error
        finally:
            partial.unlink(missing_ok=True)
    return aside


def _usable(data: Path, backup: Path) -> Path:
    found = next((path for path in (backup, data / FOLDER / backup) if path.is_file()), None)
    if found is None:
        raise NotFoundError(
            f"There is no backup {backup}. Without --backup, `footfall restore` lists those that there are.",
            "--backup",
        )
    damage = damage_of(found)
    if damage is not None:
        raise InputError(f"The backup {found} is damaged ({damage}). Choose another one.", "--backup")
    try:
        with closing(reading(found)) as connection:
            version(connection)
    except sqlite3.Error as error:
        raise storage_error(error, found) or error from error
    return found


def _set_aside(database: Path) -> Path | None:
    """Keeps the database and what lies beside it; the database itself stays until another takes its place."""
    aside = database.parent / ASIDE / time.strftime("%Y-%m-%d-%H%M%S")
    beside = [database.with_name(f"{database.name}{ending}") for ending in ("-wal", "-shm")]
    present = [path for path in beside if path.exists()]
    if not database.exists() and not present:
        return None
    aside.mkdir(parents=True)
    if database.exists():
        try:
            os.link(database, aside / database.name)
        except OSError:  # a file system without hard links
            shutil.copyfile(database, aside / database.name)
    for path in present:
        path.replace(aside / path.name)
    return aside
