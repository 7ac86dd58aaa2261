"""Gait files that are damaged, no files at all, or changed by somebody else."""

from __future__ import annotations

import json
import os
import socket
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from app.documents.gait_json import gait_content
from app.gaits.service import GaitService
from app.gaits.summaries import GaitSummaries
from app.store.database import Database
from app.store.gait_files import MOST_FILE_BYTES, GaitFiles
from core.errors import InputError, NotFoundError, StateError
from core.gait.gait import Gait
from core.library.library import library
from tests.app.gaits.test_summaries import line, open_service

WALK = library()["walk"].gait


@pytest.fixture
def data(tmp_path: Path) -> Path:
    return tmp_path


@pytest.fixture
def service(data: Path, database: Database) -> GaitService:
    return open_service(GaitFiles(data), database)


def restarted(data: Path, database: Database) -> GaitService:
    return open_service(GaitFiles(data), database)


def named(name: str) -> Gait:
    return replace(WALK, name=name)


def path_of(data: Path, gait_id: str) -> Path:
    return data / "gaits" / f"{gait_id}.json"


def write_outside(path: Path, gait: Gait) -> None:
    path.write_text(json.dumps(gait_content(gait)))
    os.utime(path, ns=(1, path.stat().st_mtime_ns + 1_000_000))  # a clock of coarse ticks hides nothing


def _pipe(path: Path) -> None:
    os.mkfifo(path)


def _socket(path: Path) -> None:
    here = Path.cwd()
    os.chdir(path.parent)  # a socket's whole path is limited to about 100 characters
    try:
        with socket.socket(socket.AF_UNIX) as bound:
            bound.bind(path.name)
    finally:
        os.chdir(here)


def _link(path: Path) -> None:
    target = path.with_name("elsewhere.txt")
    target.write_text(json.dumps(gait_content(WALK)))
    path.symlink_to(target)


def _huge(path: Path) -> None:
    with path.open("wb") as file:
        file.truncate(MOST_FILE_BYTES + 1)


def _later(path: Path) -> None:
    path.write_text(json.dumps({**gait_content(WALK), "version": 99}))


def _truncated(path: Path) -> None:
    path.write_text(json.dumps(gait_content(WALK))[:300])


KINDS: list[tuple[Callable[[Path], None], str]] = [
    (_pipe, "pipe"),
    (_socket, "socket"),
    (_link, "symbolic link"),
    (Path.mkdir, "folder"),
    (_huge, "16 MB"),
    (_later, "99"),
    (_truncated, "not JSON"),
]


@pytest.mark.parametrize(("make", "word"), KINDS, ids=[word for _, word in KINDS])
def test_what_is_no_gait_is_listed_as_what_it_is_and_can_be_deleted_and_brought_back(
    make: Callable[[Path], None], word: str, service: GaitService, data: Path
) -> None:
    path = path_of(data, "odd")
    make(path)
    gaits = GaitSummaries(service)
    assert len(gaits.lines()) == len(library()) + 1
    shown = line(gaits, "odd")
    assert "odd.json" in shown["problem"]
    assert word in shown["problem"]
    with pytest.raises(InputError):
        service.open_gait("odd")
    service.delete("odd")
    assert not os.path.lexists(path)
    assert [gait.id for gait in service.deleted()] == ["odd"]
    with pytest.raises(InputError):
        service.restore("odd")
    assert os.path.lexists(path)
    assert line(gaits, "odd")["problem"] == shown["problem"]


def test_a_file_whose_name_is_no_id_is_listed_with_the_remedy(service: GaitService, data: Path) -> None:
    (data / "gaits" / "My Walk.json").write_text(json.dumps(gait_content(WALK)))
    assert "My Walk.json" in line(GaitSummaries(service), "My Walk.json")["problem"]
    for act in (service.open_gait, service.delete):
        with pytest.raises(NotFoundError, match=r"remove the file My Walk\.json in the folder gaits"):
            act("My Walk.json")
    with pytest.raises(NotFoundError, match="There is no gait"):
        service.delete("My Other Walk.json")


@pytest.mark.parametrize("is_running", [True, False])
def test_a_file_that_somebody_else_changed_is_marked_and_never_overwritten(
    is_running: bool, service: GaitService, data: Path, database: Database
) -> None:
    made = service.create(named("Mine"))
    theirs = replace(made.gait, notes="written by git")
    write_outside(path_of(data, made.id), theirs)
    if not is_running:
        service = restarted(data, database)
    gaits = GaitSummaries(service)
    assert f"{made.id}.json" in line(gaits, made.id)["outside"]
    assert service.open_gait(made.id).gait == made.gait
    with pytest.raises(StateError):
        service.save(made.id)
    assert json.loads(path_of(data, made.id).read_text())["notes"] == "written by git"


def test_a_file_that_was_only_laid_out_anew_is_not_changed(service: GaitService, data: Path) -> None:
    made = service.create(named("Mine"))
    write_outside(path_of(data, made.id), made.gait)
    assert service.open_gaits.outside(made.id) is None
    service.save(made.id)


def test_taking_the_file_over_is_an_edit_that_can_be_undone(service: GaitService, data: Path) -> None:
    made = service.create(named("Mine"))
    write_outside(path_of(data, made.id), replace(made.gait, notes="theirs"))
    taken = service.take_file(made.id)
    assert (taken.gait.notes, taken.edited, service.open_gaits.outside(made.id)) == ("theirs", False, None)
    assert taken.revision > made.revision
    assert service.undo(made.id).gait == made.gait
    service.save(made.id)
    assert json.loads(path_of(data, made.id).read_text())["notes"] == ""


def test_keeping_mine_sets_the_other_file_aside(service: GaitService, data: Path, database: Database) -> None:
    made = service.create(named("Mine"))
    write_outside(path_of(data, made.id), replace(made.gait, notes="theirs"))
    kept = service.keep_mine(made.id)
    assert (kept.gait, kept.edited, service.open_gaits.outside(made.id)) == (made.gait, False, None)
    (aside,) = (data / "set-aside").iterdir()
    assert json.loads(aside.read_text())["notes"] == "theirs"
    assert restarted(data, database).open_gaits.outside(made.id) is None
    with pytest.raises(StateError):
        service.keep_mine(made.id)


@pytest.mark.parametrize("is_running", [True, False])
def test_a_saved_gait_whose_file_was_truncated_opens_as_it_was_saved(
    is_running: bool, service: GaitService, data: Path, database: Database
) -> None:
    made = service.create(named("Mine"))
    path = path_of(data, made.id)
    path.write_text(path.read_text()[:200])
    if not is_running:
        service = restarted(data, database)
    shown = line(GaitSummaries(service), made.id)
    assert (shown["problem"], shown["name"]) == (None, "Mine")
    assert "not JSON" in shown["outside"]
    assert service.open_gait(made.id).gait == made.gait
    with pytest.raises(InputError):
        service.take_file(made.id)
    service.keep_mine(made.id)
    assert service.open_gaits.outside(made.id) is None
    assert GaitFiles(data).read(made.id) == made.gait


def test_a_file_over_a_gait_of_the_program_is_not_overwritten_unseen(
    service: GaitService, data: Path
) -> None:
    service.open_gait("walk")
    write_outside(path_of(data, "walk"), replace(WALK, notes="theirs"))
    assert service.open_gaits.outside("walk") is not None
    with pytest.raises(StateError):
        service.save("walk")
    assert service.take_file("walk").gait.notes == "theirs"
    assert service.open_gaits.outside("walk") is None


@pytest.mark.parametrize("times", [1, 3])
def test_a_save_that_was_broken_off_before_its_file_was_written_is_no_change_of_others(
    times: int, service: GaitService, data: Path, database: Database
) -> None:
    made = service.create(named("Mine"))
    path = path_of(data, made.id)
    before = path.read_bytes(), path.stat().st_mtime_ns
    again = service
    for notes in ("new", "more", "newer")[-times:]:
        again.edit(made.id, replace(made.gait, notes=notes), "Notes", None)
        again.save(made.id)
        path.write_bytes(before[0])
        os.utime(path, ns=(before[1], before[1]))
        again = restarted(data, database)
    assert again.open_gaits.outside(made.id) is None
    assert again.open_gait(made.id).gait.notes == "newer"
    again.save(made.id)
    assert json.loads(path.read_text())["notes"] == "newer"
