"""Gait files in the data folder, written atomically."""

import json
import os
import re
import sys
from collections.abc import Callable, Set
from contextlib import suppress
from itertools import chain, count
from pathlib import Path

from app.documents.gait_json import gait_content, parse_gait
from app.store.storage_errors import file_error
from core.errors import InputError
from core.gait.gait import Gait

_ID = re.compile(r"[a-z0-9][a-z0-9-]{0,79}")


def default_data_folder() -> Path:
    """The user's data directory for this program, by the platform's custom."""
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Application Support" / "Footfall Studio"
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA", Path.home())) / "Footfall Studio"
    return Path(os.environ.get("XDG_DATA_HOME", Path.home() / ".local" / "share")) / "footfall-studio"


def write_atomically(path: Path, content: str | bytes, before: Callable[[], object] = lambda: None) -> None:
    """Writes a file whole or not at all, and on disk when this returns.

    Args:
        path: the file.
        content: what it holds from then on.
        before: called once the new file is on the disk and is about to take its place; what it raises leaves
            the old one.

    Raises:
        StorageError: the disk does not take it; what was there before is as it was.
        InputError: the file cannot be written there.
    """
    partial = path.with_name(f".{path.name}.{os.getpid()}.partial")
    try:
        with partial.open("wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
            file.flush()
            os.fsync(file.fileno())
        before()
        partial.replace(path)
        folder = os.open(path.parent, os.O_RDONLY)
        try:
            os.fsync(folder)
        finally:
            os.close(folder)
    except OSError as error:
        raise file_error(error, path) from error
    finally:
        with suppress(OSError):
            partial.unlink(missing_ok=True)


def _move(source: Path, target: Path) -> None:
    try:
        source.replace(target)
    except OSError as error:
        raise file_error(error, target) from error


def _sweep(folder: Path) -> None:
    """Takes away what a killed program had half written; what counts are the whole files beside it."""
    for partial in folder.glob(".*.partial"):
        writer = partial.name.split(".")[-2]
        if not (writer.isdigit() and _is_running(int(writer))):
            partial.unlink(missing_ok=True)


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
        for folder in (data, self._gaits, self._trash):
            require_folder(folder)
        _sweep(self._gaits)

    def stamps(self) -> dict[str, tuple[int, int]]:
        """Every saved gait's id with what changes whenever its file does: time in ns, and size."""
        stamps = {}
        with os.scandir(self._gaits) as found:
            for entry in found:
                gait_id, _, ending = entry.name.rpartition(".")
                if ending == "json" and self.is_id(gait_id):
                    with suppress(FileNotFoundError):
                        state = entry.stat()
                        stamps[gait_id] = (state.st_mtime_ns, state.st_size)
        return stamps

    def ids(self) -> tuple[str, ...]:
        """Ids of all saved gaits, by name."""
        return tuple(sorted(self.stamps()))

    def deleted_ids(self) -> tuple[str, ...]:
        """Ids of gaits in the trash."""
        return tuple(p.stem for p in self._trash.glob("*.json"))

    def deleted(self, gait_id: str) -> tuple[Gait, float]:
        """A gait in the trash, and when it came there, s since the epoch.

        Raises:
            InputError: it is not there, or its file is damaged.
        """
        path = self._trash / self._path(gait_id).name
        try:
            # Moving a file leaves its time of writing (st_mtime) alone and sets st_ctime.
            return parse_gait(path.read_bytes(), path.name), path.stat().st_ctime
        except OSError as error:
            raise InputError(f"There is no deleted gait “{gait_id}”.", gait_id) from error

    def read(self, gait_id: str) -> Gait:
        """Reads a saved gait.

        Raises:
            InputError: it is not there, or its file is damaged.
        """
        path = self._path(gait_id)
        try:
            return parse_gait(path.read_bytes(), path.name)
        except OSError as error:
            raise InputError(f"There is no saved gait “{gait_id}”.", gait_id) from error

    def saved_at(self, gait_id: str) -> float | None:
        """When the gait was saved, s since the epoch; None where it is not."""
        path = self._path(gait_id)
        return path.stat().st_mtime if path.exists() else None

    def write(self, gait_id: str, gait: Gait, before: Callable[[], object] = lambda: None) -> None:
        """Saves a gait; the file is on disk when this returns (see `write_atomically`)."""
        text = json.dumps(gait_content(gait), indent=2, ensure_ascii=False) + "\n"
        write_atomically(self._path(gait_id), text, before)

    def remove(self, gait_id: str) -> None:
        """Moves a gait's file into the trash, from where it can be restored."""
        _move(self._path(gait_id), self._trash / f"{gait_id}.json")

    def restore(self, gait_id: str) -> None:
        """Brings the last removed file of that id back.

        Raises:
            InputError: there is none, or the id is in use again.
        """
        source = self._trash / self._path(gait_id).name
        if not source.exists():
            raise InputError(f"There is no deleted gait “{gait_id}” to restore.", gait_id)
        if self._path(gait_id).exists():
            raise InputError(f"“{gait_id}” exists again; delete or rename it first.", gait_id)
        _move(source, self._path(gait_id))

    @staticmethod
    def is_id(gait_id: str) -> bool:
        """Whether a text can be a gait's id."""
        return _ID.fullmatch(gait_id) is not None

    def _path(self, gait_id: str) -> Path:
        if not self.is_id(gait_id):
            raise InputError(f"“{gait_id}” is no gait id: lower-case letters, digits and hyphens.", "id")
        return self._gaits / f"{gait_id}.json"
