"""Versions: what makes one, what each says, and that going back is an edit like any other."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from app.gaits.approvals import Word
from app.gaits.live_preview import LiveDesk
from app.gaits.service import GaitDesk
from app.gaits.versions import (
    AUTOMATIC_EDITS,
    AUTOMATIC_SECONDS,
    MOST_NAME,
    VersionKind,
)
from app.store.database import Database
from app.store.gait_files import GaitFiles
from app.store.gait_store import MOST_AUTOMATIC
from app.undo.history import Author
from core.errors import InputError, NotFoundError
from core.library.library import library
from solver_jobs import SolveStatus
from tests.app.gaits.test_service import (
    MANUAL,
    WALK,
    edit,
    toggled,
)
from tests.support.live_tiers import FixedTier
from tests.support.studio_process import StudioProcess, running_studio

ADA = Author("page-a", "Ada")


class Clock:
    """A time that tests set, s."""

    def __init__(self) -> None:
        self.now = 1_000_000.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock() -> Clock:
    return Clock()


def open_desk(folder: Path, database: Database, clock: Clock) -> GaitDesk:
    tier = FixedTier(SolveStatus.INFEASIBLE)
    return GaitDesk(GaitFiles(folder), database, LiveDesk(tier).solve_for, clock=clock)


@pytest.fixture
def desk(tmp_path: Path, database: Database, clock: Clock) -> GaitDesk:
    return open_desk(tmp_path, database, clock)


def kinds(desk: GaitDesk, gait_id: str = WALK) -> list[str]:
    return [version.kind for version in reversed(desk.versions.all(gait_id))]


def test_the_first_edit_keeps_the_gait_as_it_came(desk: GaitDesk) -> None:
    came = desk.open_gait(WALK).gait
    edit(desk, WALK)
    edit(desk, WALK, sample=21)
    assert kinds(desk) == ["automatic"]
    assert desk.restore_version(WALK, 1).gait == came


def test_while_editing_a_version_is_made_after_two_minutes(desk: GaitDesk, clock: Clock) -> None:
    edit(desk, WALK)
    clock.now += AUTOMATIC_SECONDS - 1
    edit(desk, WALK, sample=21)
    assert kinds(desk) == ["automatic"]
    clock.now += 1
    before = desk.open_gait(WALK).gait
    edit(desk, WALK, sample=22)
    assert kinds(desk) == ["automatic", "automatic"]
    assert desk.restore_version(WALK, 2).gait == before


def test_while_editing_a_version_is_made_after_so_many_edits(desk: GaitDesk) -> None:
    for number in range(AUTOMATIC_EDITS):
        edit(desk, WALK, sample=1 + number)
    assert kinds(desk) == ["automatic"]
    edit(desk, WALK, sample=1 + AUTOMATIC_EDITS)
    assert kinds(desk) == ["automatic", "automatic"]


def test_saving_and_approving_make_versions_with_who_did_so(desk: GaitDesk) -> None:
    edit(desk, WALK)
    desk.save(WALK, ADA)
    desk.save(WALK, ADA)
    newest = desk.versions.all(WALK)[0]
    assert (newest.number, newest.kind, newest.by) == (2, "saved", "Ada")
    desk.check(MANUAL)
    desk.approve(MANUAL, Word("Grace", accept_warnings=True))
    approved = desk.versions.all(MANUAL)[0]
    assert (approved.kind, approved.by) == ("approved", "Grace")


def test_a_state_is_named_twice_and_a_name_too_long_is_refused(desk: GaitDesk) -> None:
    opened = desk.open_gait(WALK)
    assert desk.versions.keep(opened, VersionKind.NAMED, ADA, " For the demo ").name == "For the demo"
    assert desk.versions.keep(opened, VersionKind.NAMED, ADA, "Thesis").number == 2
    assert desk.versions.keep(opened, VersionKind.NAMED, ADA, "Thesis").number == 2
    with pytest.raises(InputError, match=f"at most {MOST_NAME}"):
        desk.versions.keep(opened, VersionKind.NAMED, ADA, "a" * (MOST_NAME + 1))


def test_going_back_is_an_edit_that_keeps_what_was_there(desk: GaitDesk) -> None:
    edit(desk, WALK)
    desk.save(WALK)
    edit(desk, WALK, sample=21)
    last = desk.open_gait(WALK).gait
    restored = desk.restore_version(WALK, 1, ADA)
    assert restored.undo_label() == "Restore version 1"
    assert kinds(desk) == ["automatic", "saved", "before restore"]
    assert desk.undo(WALK, ADA).gait == last
    assert desk.redo(WALK, ADA).gait == restored.gait
    assert desk.restore_version(WALK, 1) is desk.open_gait(WALK)
    with pytest.raises(NotFoundError, match="no version 9"):
        desk.restore_version(WALK, 9)


@pytest.mark.parametrize("number", [-1, 0, 2**63, 10**40])
def test_a_number_that_no_version_can_have_is_unknown(desk: GaitDesk, number: int) -> None:
    with pytest.raises(NotFoundError, match=f"no version {number};"):
        desk.versions.get(WALK, number)


def test_locked_cells_do_not_stand_in_the_way_back(desk: GaitDesk) -> None:
    came = desk.open_gait(WALK).gait
    drawn = toggled(came, 1, 20)
    locked = drawn.timeline.locked.copy()
    locked[1, 20] = True
    desk.edit(WALK, replace(drawn, timeline=replace(drawn.timeline, locked=locked)), "Lock", None)
    assert desk.restore_version(WALK, 1).gait == came
    assert desk.undo(WALK).gait.timeline.locked[1, 20]


def test_versions_survive_a_restart_a_deletion_and_are_not_given_to_another_gait(
    desk: GaitDesk, tmp_path: Path, database: Database, clock: Clock
) -> None:
    created = desk.create(replace(library()[WALK].gait, name="Mine"))
    edit(desk, created.id)
    unsaved = desk.open_gait(created.id).gait
    assert desk.delete(created.id) is None
    again = open_desk(tmp_path, database, clock)
    other = again.create(created.gait)
    assert kinds(again, other.id) == ["saved"]
    again.restore(created.id)
    assert kinds(again, created.id) == ["saved", "before delete"]
    assert again.restore_version(created.id, 2).gait == unsaved


def test_a_builtin_gait_that_was_saved_over_keeps_its_versions_when_that_is_deleted(desk: GaitDesk) -> None:
    edit(desk, WALK)
    saved = desk.save(WALK).gait
    assert desk.delete(WALK) is desk.open_gait(WALK)
    assert desk.open_gait(WALK).gait == library()[WALK].gait
    assert kinds(desk) == ["automatic", "saved"]
    edit(desk, WALK, sample=30)
    edited = desk.open_gait(WALK).gait
    assert desk.restore(WALK).gait == saved
    assert kinds(desk) == ["automatic", "saved", "before restore"]
    assert not desk.open_gait(WALK).edited
    assert desk.undo(WALK).gait == edited
    desk.undo(WALK)
    assert desk.undo(WALK).gait == saved
    assert desk.undo(WALK).gait == library()[WALK].gait


def test_of_automatic_versions_the_newest_are_kept_and_of_others_all(desk: GaitDesk, clock: Clock) -> None:
    desk.versions.keep(desk.open_gait(WALK), VersionKind.NAMED, ADA, "First")
    for number in range(MOST_AUTOMATIC + 5):
        clock.now += AUTOMATIC_SECONDS
        edit(desk, WALK, sample=1 + number % 40, foot=number // 40 % 4)
    found = kinds(desk)
    assert found.count("automatic") == MOST_AUTOMATIC
    assert found[0] == "named"


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    with running_studio(tmp_path_factory.mktemp("versions")) as running:
        yield running


def test_versions_over_http(studio: StudioProcess) -> None:
    here = "/api/gaits/amble/versions"
    assert studio.ask("GET", here).content == {"versions": []}
    headers = {"x-footfall-page": "p1", "x-footfall-name": "Ada%20L"}
    made = studio.ask("POST", here, {"name": "Start"}, headers)
    assert (made.status, made.content["number"], made.content["by"]) == (201, 1, "Ada L")
    document = studio.ask("GET", "/api/gaits/amble").content
    document["options"]["margin"] = 0.002
    studio.ask("PUT", "/api/gaits/amble?label=Margin", document)
    told = studio.ask("GET", f"{here}/1/difference").content
    assert told["groups"] == [{"title": "Options", "sentences": ["Stability margin 6.0 mm → 2.0 mm"]}]
    assert studio.ask("GET", f"{here}/1/difference?to=1").content["groups"] == []
    line = studio.ask("GET", f"{here}/1").content
    assert (line["present"], line["same_motion"], line["document"]["options"]["margin"]) == (
        False,
        False,
        0.006,
    )
    restored = studio.ask("POST", f"{here}/1/restore", headers=headers).content
    assert (restored["undo"], restored["document"]["options"]["margin"]) == ("Restore version 1", 0.006)
    lines = studio.ask("GET", here).content["versions"]
    assert [(one["kind"], one["present"]) for one in lines] == [("before restore", False), ("named", True)]


@pytest.mark.parametrize(
    ("method", "path", "content", "status", "words"),
    [
        ("GET", "/api/gaits/walk/versions/7", None, 404, "no version 7"),
        ("POST", "/api/gaits/walk/versions/7/restore", None, 404, "no version 7"),
        ("GET", "/api/gaits/walk/versions/7/difference", None, 404, "no version 7"),
        ("GET", "/api/gaits/nope/versions", None, 404, "There is no gait"),
        ("POST", "/api/gaits/walk/versions", {"name": ""}, 422, "name"),
        ("POST", "/api/gaits/walk/versions", {"name": " \t"}, 422, "name"),
        ("POST", "/api/gaits/walk/versions", {"name": "a" * 81}, 422, "80"),
        ("POST", "/api/gaits/walk/versions", {"title": "a"}, 422, "name"),
    ],
)
def test_refusals_over_http(
    studio: StudioProcess, method: str, path: str, content: object, status: int, words: str
) -> None:
    answer = studio.ask(method, path, content)
    assert answer.status == status
    assert words in answer.content["error"]


def test_a_page_id_that_cannot_be_one_is_refused(studio: StudioProcess) -> None:
    answer = studio.ask("POST", "/api/gaits/walk/undo", headers={"x-footfall-page": "a b"})
    assert (answer.status, answer.content["where"]) == (422, "x-footfall-page")
