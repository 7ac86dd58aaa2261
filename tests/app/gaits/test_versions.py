"""Versions: what makes one, what each says, and that going back is an edit like any other."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from app.gaits.approvals import ApprovalRequest
from app.gaits.live_plans import LivePlans
from app.gaits.service import GaitService
from app.gaits.versions import AUTOMATIC_EDITS, AUTOMATIC_SECONDS, MOST_NAME, VersionKind
from app.store.database import Database
from app.store.gait_files import GaitFiles
from app.store.tables.edit_history_store import MOST_AUTOMATIC
from app.undo.history import Author
from core.errors import InputError, NotFoundError
from core.library.library import library
from solver_jobs import SolveStatus
from tests.app.gaits.test_service import MANUAL, WALK, edit, toggled
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


def open_service(folder: Path, database: Database, clock: Clock) -> GaitService:
    tier = FixedTier(SolveStatus.INFEASIBLE)
    return GaitService(GaitFiles(folder), database, LivePlans(tier).solve_for, clock=clock)


@pytest.fixture
def service(tmp_path: Path, database: Database, clock: Clock) -> GaitService:
    return open_service(tmp_path, database, clock)


def kinds(service: GaitService, gait_id: str = WALK) -> list[str]:
    return [version.kind for version in reversed(service.versions.all(gait_id).rows)]


def test_the_first_edit_keeps_the_gait_as_it_came(service: GaitService) -> None:
    came = service.open_gait(WALK).gait
    edit(service, WALK)
    edit(service, WALK, sample=21)
    assert kinds(service) == ["automatic"]
    assert service.restore_version(WALK, 1).gait == came


def test_while_editing_a_version_is_made_after_two_minutes(service: GaitService, clock: Clock) -> None:
    edit(service, WALK)
    clock.now += AUTOMATIC_SECONDS - 1
    edit(service, WALK, sample=21)
    assert kinds(service) == ["automatic"]
    clock.now += 1
    before = service.open_gait(WALK).gait
    edit(service, WALK, sample=22)
    assert kinds(service) == ["automatic", "automatic"]
    assert service.restore_version(WALK, 2).gait == before


@pytest.mark.parametrize("step", [-7200.0, 7200.0, -999_000.0, 3e9, -AUTOMATIC_SECONDS - 1])
def test_a_clock_that_is_set_holds_up_no_version(step: float, service: GaitService, clock: Clock) -> None:
    edit(service, WALK)
    clock.now += step
    edit(service, WALK, sample=21)
    edit(service, WALK, sample=22)
    assert kinds(service) == ["automatic", "automatic"]


def test_while_editing_a_version_is_made_after_so_many_edits(service: GaitService) -> None:
    for number in range(AUTOMATIC_EDITS):
        edit(service, WALK, sample=1 + number)
    assert kinds(service) == ["automatic"]
    edit(service, WALK, sample=1 + AUTOMATIC_EDITS)
    assert kinds(service) == ["automatic", "automatic"]


def test_saving_and_approving_make_versions_with_who_did_so(service: GaitService) -> None:
    edit(service, WALK)
    service.save(WALK, ADA)
    service.save(WALK, ADA)
    newest = service.versions.all(WALK).rows[0]
    assert (newest.number, newest.kind, newest.by) == (2, "saved", "Ada")
    service.check(MANUAL)
    service.approve(MANUAL, ApprovalRequest("Grace", accept_warnings=True))
    approved = service.versions.all(MANUAL).rows[0]
    assert (approved.kind, approved.by) == ("approved", "Grace")


def test_a_state_is_named_twice_and_a_name_too_long_is_refused(service: GaitService) -> None:
    opened = service.open_gait(WALK)
    assert service.versions.keep(opened, VersionKind.NAMED, ADA, " For the demo ").name == "For the demo"
    assert service.versions.keep(opened, VersionKind.NAMED, ADA, "Thesis").number == 2
    assert service.versions.keep(opened, VersionKind.NAMED, ADA, "Thesis").number == 2
    with pytest.raises(InputError, match=f"at most {MOST_NAME}"):
        service.versions.keep(opened, VersionKind.NAMED, ADA, "a" * (MOST_NAME + 1))


def test_going_back_is_an_edit_that_keeps_what_was_there(service: GaitService) -> None:
    edit(service, WALK)
    service.save(WALK)
    edit(service, WALK, sample=21)
    last = service.open_gait(WALK).gait
    restored = service.restore_version(WALK, 1, ADA)
    assert restored.undo_label() == "Restore version 1"
    assert kinds(service) == ["automatic", "saved", "before restore"]
    assert service.undo(WALK, ADA).gait == last
    assert service.redo(WALK, ADA).gait == restored.gait
    assert service.restore_version(WALK, 1) is service.open_gait(WALK)
    with pytest.raises(NotFoundError, match="no version 9"):
        service.restore_version(WALK, 9)


@pytest.mark.parametrize("number", [-1, 0, 2**63, 10**40])
def test_a_number_that_no_version_can_have_is_unknown(service: GaitService, number: int) -> None:
    with pytest.raises(NotFoundError, match=f"no version {number};"):
        service.versions.get(WALK, number)


def test_locked_cells_do_not_stand_in_the_way_back(service: GaitService) -> None:
    came = service.open_gait(WALK).gait
    drawn = toggled(came, 1, 20)
    locked = drawn.timeline.locked.copy()
    locked[1, 20] = True
    service.edit(WALK, replace(drawn, timeline=replace(drawn.timeline, locked=locked)), "Lock", None)
    assert service.restore_version(WALK, 1).gait == came
    assert service.undo(WALK).gait.timeline.locked[1, 20]


def test_versions_survive_a_restart_a_deletion_and_are_not_given_to_another_gait(
    service: GaitService, tmp_path: Path, database: Database, clock: Clock
) -> None:
    created = service.create(replace(library()[WALK].gait, name="Mine"))
    edit(service, created.id)
    unsaved = service.open_gait(created.id).gait
    assert service.delete(created.id) is None
    again = open_service(tmp_path, database, clock)
    other = again.create(created.gait)
    assert kinds(again, other.id) == ["saved"]
    again.restore(created.id)
    assert kinds(again, created.id) == ["saved", "before delete"]
    assert again.restore_version(created.id, 2).gait == unsaved


def test_a_builtin_gait_that_was_saved_over_keeps_its_versions_when_that_is_deleted(
    service: GaitService,
) -> None:
    edit(service, WALK)
    saved = service.save(WALK).gait
    assert service.delete(WALK) is service.open_gait(WALK)
    assert service.open_gait(WALK).gait == library()[WALK].gait
    assert kinds(service) == ["automatic", "saved"]
    edit(service, WALK, sample=30)
    edited = service.open_gait(WALK).gait
    assert service.restore(WALK).gait == saved
    assert kinds(service) == ["automatic", "saved", "before restore"]
    assert not service.open_gait(WALK).edited
    assert service.undo(WALK).gait == edited
    service.undo(WALK)
    assert service.undo(WALK).gait == saved
    assert service.undo(WALK).gait == library()[WALK].gait


def test_of_automatic_versions_the_newest_are_kept_and_of_others_all(
    service: GaitService, clock: Clock
) -> None:
    service.versions.keep(service.open_gait(WALK), VersionKind.NAMED, ADA, "First")
    for number in range(MOST_AUTOMATIC + 5):
        clock.now += AUTOMATIC_SECONDS
        edit(service, WALK, sample=1 + number % 40, foot=number // 40 % 4)
    found = kinds(service)
    assert found.count("automatic") == MOST_AUTOMATIC
    assert found[0] == "named"


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    with running_studio(tmp_path_factory.mktemp("versions")) as running:
        yield running


@pytest.mark.heavy
def test_versions_over_http(studio: StudioProcess) -> None:
    here = "/api/gaits/amble/versions"
    assert studio.ask("GET", here).content == {"versions": [], "unreadable": []}
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
