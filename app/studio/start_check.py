"""Trying what the studio does with its data folder when it starts, without leaving anything there."""

import os
import shutil
import sqlite3
from collections.abc import Iterator, Sequence
from contextlib import closing, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import quote

from app.atlas.library import AtlasLibrary
from app.store.backups import damaged_sentence
from app.store.database import DATABASE, Database
from app.store.folder_lock import DATABASE_USERS, STUDIO, DatabaseUse, StudioLock
from app.store.gait_files import ATLASES, GaitFiles, require_folder, require_places
from app.store.quick_check import damage_of
from app.store.schema import is_outdated, try_write
from app.store.storage_errors import storage_error
from app.videos.files import VideoFiles
from core.errors import InputError, StorageDamagedError

_FOLDERS = ("gaits", "trash", "videos")
_DATABASE = (DATABASE, f"{DATABASE}-wal", f"{DATABASE}-shm", DATABASE_USERS)
"""What a start makes in a data folder, beside the lock of the studio."""


@dataclass(frozen=True)
class StartCheck:
    """A data folder in which the studio can start.

    Args:
        is_new: whether the folder does not exist yet.
        gaits: number of saved gaits.
        free: space on its disk, bytes.
        is_outdated: whether the next start changes the database of an older version.
    """

    is_new: bool
    gaits: int
    free: int
    is_outdated: bool


def check_start(data: Path) -> StartCheck:
    """Makes, locks and opens a data folder as the studio does, and takes away what was not there before.

    The database of an older version is opened but not changed.

    Raises:
        FootfallError: the studio could not start there, or could store nothing; the sentence is its own.
    """
    missing = [folder for folder in (data, *data.parents) if not os.path.exists(folder)]
    try:
        require_folder(data)
        made = [data / name for name in (*_DATABASE, STUDIO, *_FOLDERS) if not (data / name).exists()]
        with closing(StudioLock(data, "doctor")):
            try:
                return _opened(data, is_new=data in missing)
            finally:
                _remove(data, made)
    finally:
        _remove_empty(missing)


def _opened(data: Path, *, is_new: bool) -> StartCheck:
    require_places(data)
    files = GaitFiles(data)
    VideoFiles(data)
    AtlasLibrary(data / ATLASES)
    outdated = _try_database(data / DATABASE)
    return StartCheck(is_new, len(files.ids()), shutil.disk_usage(data).free, outdated)


def _try_database(path: Path) -> bool:
    """Opens the database for writing; whether it is one of an older version."""
    if path.exists():
        with _sentences(path), closing(sqlite3.connect(_address(path), uri=True)) as connection:
            outdated = is_outdated(connection)
            try_write(connection)
            damage = damage_of(path, is_open=True)
            if damage is not None:
                raise StorageDamagedError(f"The database {path} is damaged ({damage}).", str(path))
        if outdated:
            return True
    Database(path).close()
    return False


def _address(path: Path) -> str:
    return f"file:{quote(str(path.absolute()))}?mode=rw"


@contextmanager
def _sentences(path: Path) -> Iterator[None]:
    try:
        yield
    except (sqlite3.Error, StorageDamagedError) as error:
        refusal = storage_error(error, path) if isinstance(error, sqlite3.Error) else error
        if refusal is None:
            raise
        if isinstance(refusal, StorageDamagedError):
            refusal = StorageDamagedError(damaged_sentence(refusal.sentence, path.parent), refusal.where)
        raise refusal from error


def _remove(data: Path, made: Sequence[Path]) -> None:
    """Takes files and folders away that a start makes; a database only where no other program has it open."""
    with suppress(InputError), closing(DatabaseUse(data, alone=True)):
        for path in made:
            if path.name in _DATABASE:
                path.unlink(missing_ok=True)
    if data / STUDIO in made:
        (data / STUDIO).unlink()
    _remove_empty([path for path in made if path.name in _FOLDERS])


def _remove_empty(folders: Sequence[Path]) -> None:
    for folder in folders:
        with suppress(OSError):  # something is in it, or it was not made
            folder.rmdir()
