"""The atlases of a data folder, by name, and those that come with the program."""

import os
import re
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from pathlib import Path

from app.atlas.atlas_file import AtlasFile
from app.atlas.included import INCLUDED
from app.atlas.summaries import AtlasSummaries
from app.common.json import Json
from app.store.storage_errors import file_error
from core.atlas.space import AtlasSpace, default_space
from core.errors import InputError, NotFoundError, StateError

SUFFIX, DELETED = ".sqlite", ".deleted"
MOST_NAME = 60
_NAME = re.compile(rf"[A-Za-z0-9][A-Za-z0-9 _.-]{{0,{MOST_NAME - 1}}}")


class AtlasLibrary:
    """Atlases as files of a folder; any thread may use it.

    A deleted one can be brought back until the studio starts again.

    Args:
        folder: where they are; made when the first one is.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder.absolute()
        self._summaries = AtlasSummaries()
        for path in folder.glob(f"*{SUFFIX}{DELETED}"):
            with suppress(OSError):
                path.unlink()

    def contents(self) -> list[Json]:
        """A summary of each atlas, included ones last; of one that cannot be read, why not.

        Only files that changed since the last look are read, and not for long: the others of them say that
        they are not looked at yet.
        """
        found = {path.stem: path for path in sorted(self._folder.glob(f"*{SUFFIX}"), key=lambda it: it.stem)}
        own = {name: path for name, path in found.items() if name not in INCLUDED and _NAME.fullmatch(name)}
        return [*self._summaries.summaries(own), *map(self.content, INCLUDED)]

    def content(self, name: str) -> Json:
        """The summary of an atlas, m/s.

        Raises:
            NotFoundError: there is none of that name.
        """
        return self._summaries.summary(name, self._path(name))

    @contextmanager
    def opened(self, name: str) -> Iterator[AtlasFile]:
        """An atlas for a while.

        Raises:
            NotFoundError: there is none of that name.
            InputError: the file is no atlas that this program can read, or a symbolic link in the folder.
        """
        with closing(AtlasFile(self._path(name), follows_link=name in INCLUDED)) as atlas:
            yield atlas

    def started(self, name: str, space: AtlasSpace | None) -> AtlasFile:
        """A new atlas, or one that is gone on with.

        Args:
            name: of the atlas.
            space: what its gaits are drawn from; None for the space of the one that is there, or else the
                default space of the DeltaWalker.

        Raises:
            InputError: it cannot have that name, or is of another space, robot or version.
            StorageError: the disk does not take it.
        """
        require_name(name)
        path = self._folder / f"{name}{SUFFIX}"
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise file_error(error, self._folder) from error
        if space is None and os.path.lexists(path):
            with closing(AtlasFile(path, follows_link=False)) as known:
                space = known.space
        return AtlasFile(path, space or default_space("deltawalker"), follows_link=False)

    def delete(self, name: str) -> None:
        """Takes an atlas out of the list.

        Raises:
            NotFoundError: there is none of that name.
            InputError: it comes with the program.
        """
        _require_own(name)
        path = self._path(name)
        _move(path, path.with_name(path.name + DELETED))

    def restore(self, name: str) -> None:
        """Brings back the atlas of that name that was deleted last.

        Raises:
            NotFoundError: none was deleted since the studio started.
            StateError: there is another one of that name by now.
        """
        path = self._folder / f"{name}{SUFFIX}"
        deleted = path.with_name(path.name + DELETED)
        if _NAME.fullmatch(name) is None or not os.path.lexists(deleted):
            raise NotFoundError(f"No atlas “{name}” was deleted since the studio started.", "name")
        if os.path.lexists(path):
            raise StateError(f"There is another atlas “{name}” by now. Delete it first.", "name")
        _move(deleted, path)

    def _path(self, name: str) -> Path:
        if name in INCLUDED:
            return INCLUDED[name]
        path = self._folder / f"{name}{SUFFIX}"
        if _NAME.fullmatch(name) is None or not os.path.lexists(path):
            raise NotFoundError(f"There is no atlas “{name}” (see GET /api/atlases).", "name")
        return path


def require_name(name: str) -> None:
    """A run may make an atlas of that name.

    Raises:
        InputError: none can have it, or it comes with the program.
    """
    if _NAME.fullmatch(name) is None or name.endswith((" ", ".")):
        raise InputError(
            f"The name of an atlas has 1 to {MOST_NAME} letters, digits, spaces, hyphens, dots and "
            "underscores, and begins with a letter or a digit. Change it.",
            "name",
        )
    _require_own(name)


def _move(path: Path, to: Path) -> None:
    try:
        path.replace(to)
    except OSError as error:
        raise file_error(error, to) from error


def _require_own(name: str) -> None:
    if name in INCLUDED:
        raise InputError(f"The atlas {name} comes with the program and stays as it is.", "name")
