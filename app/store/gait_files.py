"""Gait files in the data folder, written atomically."""

import json
import os
import re
import sys
import time
from collections.abc import Callable, Set
from itertools import chain, count
from pathlib import Path

from app.documents.gait_json import gait_content
from app.documents.stored_gait import StoredGait, stored_gait
from app.store.backups import FOLDER as BACKUPS
from app.store.plain_file import read_plain_file, sweep_partials, write_atomically
from app.store.run_journal import FOLDER as RUNNING
from app.store.storage_errors import file_error, left_undone
from core.errors import InputError, StorageError
from core.gait.gait import Gait

MOST_FILE_BYTES = 16_000_000
"""A gait's file of more bytes is not read; indented, the largest document has fewer."""

_ORDER = ".order"
"""File in the trash: ids of the gaits in it, the last deleted last."""

_WRITER = re.compile(r"\.([0-9]{1,9})\.partial$")
"""The process that writes a file, in its name."""
_ID = re.compile(r"[a-z0-9][a-z0-9-]{0,79}")

SET_ASIDE, PHOTOS, ATLASES = "set-aside", "trial-photos", "atlases"
_MADE_LATER = (SET_ASIDE, PHOTOS, RUNNING, ATLASES, BACKUPS)
"""Folders of the data folder that a start does not make."""


def default_data_folder() -> Path:
    """The user's data directory for this program, by the platform's custom."""
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Application Support" / "Footfall Studio"
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA", Path.home())) / "Footfall Studio"
    return Path(os.environ.get("XDG_DATA_HOME", Path.home() / ".local" / "share")) / "footfall-studio"


def _move(source: Path, target: Path, after: Callable[[], object] = lambda: None) -> None:
    """Moves a file. What `after` raises moves it back."""
    try:
        source.replace(target)
    except OSError as error:
        raise file_error(error, target) from error
    try:
        after()
    except BaseException:
        _move(target, source)
        raise


def _is_json(name: str) -> bool:
    return name.endswith(".json") and not name.startswith(".")


def _stamp(entry: Path | os.DirEntry[str]) -> tuple[int, int] | None:
    """Time in ns and size of a file, of a link those of the link; None where there is none."""
    try:
        state = entry.lstat() if isinstance(entry, Path) else entry.stat(follow_symlinks=False)
    except FileNotFoundError:
        return None
    return state.st_mtime_ns, state.st_size


def _is_abandoned(partial: Path, state: os.stat_result) -> bool:
    """Whether the program that wrote a file, whose number its name has, is gone."""
    del state
    writer = _WRITER.search(partial.name)
    return writer is None or not _is_running(int(writer[1]))


def _is_running(process: int) -> bool:
    if process == os.getpid() or sys.platform == "win32":  # there, asking would end it
        return True
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except OSError:
        return True
    return True


def free_id(name: str, taken: Set[str]) -> str:
    """An id from a name, lower-case letters, digits and hyphens, with a number where it is taken."""
    base = re.sub(r"[^a-z0-9]+", "-", name.lower()).strip("-")[:60] or "gait"
    ids = chain((base,), (f"{base}-{number}" for number in count(2)))
    return next(candidate for candidate in ids if candidate not in taken)


def require_places(data: Path) -> None:
    """Makes sure that no file stands where a folder is made once something is kept in it.

    Raises:
        InputError: one does.
    """
    for path in (data / name for name in _MADE_LATER):
        if os.path.lexists(path) and not path.is_dir():
            raise InputError(
                f"{path} is a file, and the studio needs a folder of that name. Move it elsewhere, or give "
                "another data folder with --data.",
                "--data",
            )


def require_folder(data: Path) -> None:
    """Makes the data folder where it does not exist.

    Raises:
        InputError: it cannot be made.
    """
    try:
        data.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(
            f"The data folder {data} cannot be made: {error.strerror}. Give another with --data.", "--data"
        ) from error


class GaitFiles:
    """The folder `gaits` and its `trash`.

    Args:
        data: the data folder; made where it does not exist.
    """

    def __init__(self, data: Path) -> None:
        self._gaits = data / "gaits"
        self._trash = data / "trash"
        self._aside = data / SET_ASIDE
        for folder in (data, self._gaits, self._trash):
            require_folder(folder)
        sweep_partials(self._gaits, _is_abandoned)

    def stamps(self) -> dict[str, tuple[int, int]]:
        """Every saved gait's id with what changes whenever its file does: time in ns, and size."""
        entries = [(entry.name.removesuffix(".json"), entry) for entry in self._entries()]
        stamps = ((name, _stamp(entry)) for name, entry in entries if self.is_id(name))
        return {name: stamp for name, stamp in stamps if stamp is not None}

    def stamp(self, gait_id: str) -> tuple[int, int] | None:
        """The same of one gait; None where it has no file."""
        return _stamp(self._path(gait_id))

    def misnamed(self) -> tuple[str, ...]:
        """JSON files whose names are no ids, so that no gait can be opened from them."""
        names = (entry.name for entry in self._entries())
        misnamed = sorted(name for name in names if not self.is_id(name.removesuffix(".json")))
        return tuple(os.fsencode(name).decode(errors="backslashreplace") for name in misnamed)

    def _entries(self) -> list[os.DirEntry[str]]:
        """The JSON files in the folder of gaits.

        Raises:
            StorageError: the folder cannot be read.
        """
        try:
            with os.scandir(self._gaits) as found:
                return [entry for entry in found if _is_json(entry.name)]
        except OSError as error:
            raise StorageError(
                f"The folder of the gaits {self._gaits} cannot be read: {error.strerror}. Look whether its "
                "disk is there and whether you may read it.",
                str(self._gaits),
            ) from error

    def ids(self) -> tuple[str, ...]:
        """Ids of all saved gaits, by name."""
        return tuple(sorted(self.stamps()))

    def deleted_ids(self) -> tuple[str, ...]:
        """Ids of gaits in the trash, the last deleted first."""
        order = {gait_id: place for place, gait_id in enumerate(self._deleted_order())}
        ids = (path.stem for path in self._trash.glob("*.json") if self.is_id(path.stem))
        return tuple(sorted(ids, key=lambda one: (order.get(one, -1), self.deleted_at(one)), reverse=True))

    def _deleted_order(self) -> list[str]:
        """Ids in the order in which they were deleted; the time of a file is of a clock that may be set."""
        try:
            return read_plain_file(self._trash / _ORDER, MOST_FILE_BYTES).decode().split()
        except (FileNotFoundError, UnicodeDecodeError, InputError):
            return []

    def deleted(self, gait_id: str) -> Gait:
        """A gait in the trash.

        Raises:
            InputError: it is not there, or its file is damaged.
        """
        path = self._trash / self._path(gait_id).name
        try:
            return stored_gait(read_plain_file(path, MOST_FILE_BYTES), path.name).gait
        except FileNotFoundError as error:
            raise InputError(f"There is no deleted gait “{gait_id}”.", gait_id) from error

    def deleted_at(self, gait_id: str) -> float:
        """When a gait came into the trash, s since the epoch; 0 where it is not there."""
        try:
            # Moving a file leaves its time of writing (st_mtime) alone and sets st_ctime.
            return (self._trash / self._path(gait_id).name).lstat().st_ctime
        except FileNotFoundError:
            return 0.0

    def read(self, gait_id: str) -> Gait:
        """Reads a saved gait (see `stored`)."""
        return self.stored(gait_id).gait

    def stored(self, gait_id: str) -> StoredGait:
        """Reads a saved gait.

        Raises:
            InputError: it is not there, or its file is damaged.
        """
        path = self._path(gait_id)
        try:
            return stored_gait(read_plain_file(path, MOST_FILE_BYTES), path.name)
        except FileNotFoundError as error:
            raise InputError(f"There is no saved gait “{gait_id}”.", gait_id) from error

    def saved_at(self, gait_id: str) -> float | None:
        """When the gait was saved, s since the epoch; None where it is not."""
        stamp = self.stamp(gait_id)
        return None if stamp is None else stamp[0] / 1e9

    def write(self, gait_id: str, gait: Gait, before: Callable[[], object] = lambda: None) -> None:
        """Saves a gait; the file is on disk when this returns (see `write_atomically`)."""
        text = json.dumps(gait_content(gait), indent=2, ensure_ascii=False) + "\n"
        write_atomically(self._path(gait_id), text, before)

    def remove(self, gait_id: str, after: Callable[[], object] = lambda: None) -> None:
        """Moves a gait's file into the trash, from where it can be restored; see `rename_deleted`.

        Args:
            gait_id: whose file.
            after: what it raises moves the file back.
        """
        _move(self._path(gait_id), self._trash / f"{gait_id}.json", after)
        self._write_order([*(one for one in self._deleted_order() if one != gait_id), gait_id])

    def rename_deleted(self, gait_id: str, to: str, after: Callable[[], object] = lambda: None) -> None:
        """Gives a gait in the trash another id, so that another may have its own; `after` as in `remove`."""
        _move(self._trash / self._path(gait_id).name, self._trash / self._path(to).name, after)
        self._write_order([to if one == gait_id else one for one in self._deleted_order()])

    def _write_order(self, ids: list[str]) -> None:
        there = [one for one in ids if (self._trash / f"{one}.json").exists()]
        with left_undone("The order of the deleted gaits is not kept"):
            try:
                write_atomically(self._trash / _ORDER, "\n".join(there))
            except InputError as error:  # a folder stands there
                raise StorageError(error.sentence, error.where) from error

    def set_aside(self, gait_id: str, write: Callable[[], None]) -> Path:
        """Has another file take a gait's place; what was there is kept, whatever it is.

        Args:
            gait_id: whose file.
            write: writes the other file; where that fails, everything is as before.

        Returns:
            Where it is kept.

        Raises:
            StorageError: the disk does not take it.
        """
        require_folder(self._aside)
        name = f"{gait_id}-{time.strftime('%Y-%m-%d-%H%M%S')}"
        paths = (self._aside / f"{name}-{number:03}.json" for number in count(1))
        kept = next(path for path in paths if not path.exists())
        _move(self._path(gait_id), kept, write)
        return kept

    def restore(self, gait_id: str, to: str, after: Callable[[], object] = lambda: None) -> None:
        """Brings a removed file back, under an id that has no file; `after` as in `remove`.

        Raises:
            InputError: it is not in the trash.
        """
        self.require_deleted(gait_id)
        _move(self._trash / self._path(gait_id).name, self._path(to), after)

    def require_deleted(self, gait_id: str) -> None:
        """Makes sure that a gait is in the trash.

        Raises:
            InputError: it is not.
        """
        if _stamp(self._trash / self._path(gait_id).name) is None:
            raise InputError(f"There is no deleted gait “{gait_id}” to restore.", gait_id)

    @staticmethod
    def is_id(gait_id: str) -> bool:
        """Whether a text can be a gait's id."""
        return _ID.fullmatch(gait_id) is not None

    def _path(self, gait_id: str) -> Path:
        if not self.is_id(gait_id):
            raise InputError(f"“{gait_id}” is no gait id: lower-case letters, digits and hyphens.", "id")
        return self._gaits / f"{gait_id}.json"
