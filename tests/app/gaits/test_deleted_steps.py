"""Deleting and bringing back is refused, or the program ends, at each step: nothing is lost or mixed."""

from __future__ import annotations

import errno
import shutil
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, closing, contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import pytest

from app.gaits.service import GaitService
from app.store.database import Database
from app.store.gait_files import GaitFiles
from core.errors import FootfallError, StorageFullError
from core.library.library import library
from tests.support.simulated_walk import no_solver

WALK = library()["walk"].gait
MINE = "mine"


class KilledError(BaseException):
    """The program ends; nothing handles it."""


@dataclass
class Steps:
    """Counts what is written to the disk.

    Args:
        at: the step that is refused; 0 for none.
        is_lasting: whether every later one is refused too.
        is_kill: whether the program ends there.
    """

    at: int = 0
    is_lasting: bool = False
    is_kill: bool = False
    done: int = 0

    @property
    def is_over(self) -> bool:
        return self.done < self.at

    def take(self, refusal: Exception) -> None:
        self.done += 1
        if self.at and (self.done == self.at or (self.done > self.at and (self.is_lasting or self.is_kill))):
            raise KilledError if self.is_kill else refusal


@contextmanager
def steps(at: int, *, is_lasting: bool = False, is_kill: bool = False) -> Iterator[Steps]:
    """Each move of a file, and each transaction, is a step."""
    counted = Steps(at, is_lasting, is_kill)
    move: Callable[[Path, Path], Path] = Path.replace
    writing: Callable[[Database], AbstractContextManager[Any]] = Database.writing

    def moved(path: Path, target: Path) -> Path:
        counted.take(OSError(errno.EIO, "Input/output error"))
        return move(path, target)

    def written(database: Database) -> AbstractContextManager[Any]:
        counted.take(StorageFullError("The disk is full.", "studio.sqlite3"))
        return writing(database)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Path, "replace", moved)
        patch.setattr(Database, "writing", written)
        yield counted


@contextmanager
def service_of(data: Path) -> Iterator[GaitService]:
    with closing(Database(data / "studio.sqlite3")) as database:
        yield GaitService(GaitFiles(data), database, lambda gait: no_solver)


def make(service: GaitService, name: str) -> str:
    """A gait that was edited under its name and not saved."""
    gait_id = service.create(replace(WALK, name="Mine")).id
    service.edit(gait_id, replace(service.document(gait_id), name=name), "Name", None)
    return gait_id


def appear(service: GaitService, data: Path, name: str) -> None:
    """A file under the id of a deleted gait."""
    GaitFiles(data).write(MINE, replace(WALK, name="Theirs"))
    assert service.document(MINE).name == "Theirs"
    if name:
        service.edit(MINE, replace(service.document(MINE), name=name), "Name", None)


def delete_first(service: GaitService, data: Path) -> set[str]:
    assert make(service, "One") == MINE
    return {"One"}


def delete_second(service: GaitService, data: Path) -> set[str]:
    service.delete(make(service, "One"))
    appear(service, data, "Two")
    return {"One", "Two"}


def restore_own(service: GaitService, data: Path) -> set[str]:
    service.delete(make(service, "One"))
    return {"One"}


def restore_beside(service: GaitService, data: Path) -> set[str]:
    service.delete(make(service, "One"))
    appear(service, data, "")
    return {"One", "Theirs"}


CASES = [
    (delete_first, GaitService.delete),
    (delete_second, GaitService.delete),
    (restore_own, GaitService.restore),
    (restore_beside, GaitService.restore),
]
every_case = pytest.mark.parametrize(("prepare", "act"), CASES, ids=[case[0].__name__ for case in CASES])
Prepare = Callable[[GaitService, Path], set[str]]
Act = Callable[[GaitService, str], object]


def prepared(data: Path, prepare: Prepare) -> set[str]:
    data.mkdir()
    with service_of(data) as service:
        return prepare(service, data)


def copies(data: Path) -> Iterator[tuple[int, Path]]:
    for at in range(1, 30):
        copied = data.with_name(f"{data.name}-{at}")
        shutil.copytree(data, copied)
        yield at, copied


def state(service: GaitService) -> tuple[dict[str, str], set[tuple[str, str]]]:
    """Names of the gaits and of the deleted ones, by id."""
    ids = service.open_gaits.marks().keys() - library().keys()
    return {one: service.document(one).name for one in ids}, {(one.id, one.name) for one in service.deleted()}


def require_whole(service: GaitService, names: set[str]) -> None:
    """Every gait is there or can be brought back, with its edits, and a new file has no others' edits."""
    for one in service.deleted():
        assert service.restore(one.id).gait.name == one.name
    ids = service.open_gaits.marks().keys() - library().keys()
    assert sorted(service.document(one).name for one in ids) == sorted(names)
    for gait_id in ids:
        gait = service.open_gait(gait_id)
        assert len(gait.history.entries) == (1 if gait.gait.name == "Theirs" else 2)
        assert service.open_gaits.outside(gait_id) is None


@every_case
def test_a_program_that_ends_between_two_steps_leaves_every_gait_whole(
    prepare: Prepare, act: Act, tmp_path: Path
) -> None:
    names, ended = prepared(tmp_path / "data", prepare), 0
    for at, data in copies(tmp_path / "data"):
        with service_of(data) as service, steps(at, is_kill=True) as counted:
            try:
                act(service, MINE)
            except KilledError:
                ended += 1
        with service_of(data) as service:
            require_whole(service, names)
        if counted.is_over:
            break
    assert counted.is_over
    assert ended >= 3


@every_case
@pytest.mark.parametrize("is_lasting", [False, True])
def test_a_step_that_the_disk_refuses_leaves_every_gait_whole(
    prepare: Prepare, act: Act, is_lasting: bool, tmp_path: Path
) -> None:
    names, refused = prepared(tmp_path / "data", prepare), 0
    for at, data in copies(tmp_path / "data"):
        with service_of(data) as service:
            before = state(service)
            with steps(at, is_lasting=is_lasting) as counted:
                try:
                    act(service, MINE)
                    is_refused = False
                except FootfallError:
                    is_refused = True
                    refused += 1
            if is_refused and not is_lasting:
                assert {name for _, name in state(service)[1]} == {name for _, name in before[1]}
                assert state(service)[0] == before[0]
                act(service, MINE)
            require_whole(service, names)
        if counted.is_over:
            break
    assert counted.is_over
    assert refused >= 3


def test_a_file_that_appears_after_a_restore_was_killed_is_a_new_gait(tmp_path: Path) -> None:
    data = tmp_path / "data"
    prepared(data, restore_own)
    # The first step marks what is kept, the second moves the file.
    with service_of(data) as service, steps(2, is_kill=True), pytest.raises(KilledError):
        service.restore(MINE)
    GaitFiles(data).write(MINE, replace(WALK, name="Theirs"))
    with service_of(data) as service:
        fresh = service.open_gait(MINE)
        assert (fresh.gait.name, len(fresh.history.entries)) == ("Theirs", 1)
        assert service.restore(MINE).id == f"{MINE}-2"
        require_whole(service, {"One", "Theirs"})
