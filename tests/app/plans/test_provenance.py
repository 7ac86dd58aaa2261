"""Provenance of results: set when one is taken, stale after an edit, kept in the file, known elsewhere."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, replace
from datetime import datetime
from pathlib import Path
from typing import Any

import pytest

from app.common.version import VERSION
from app.documents.gait_json import asked_hash
from app.documents.trajectory_json import content_sha256, trajectory_content
from app.gaits.approvals import ApprovalRequest
from app.gaits.open_gait import OpenGait
from app.gaits.service import GaitService
from app.plans.plan import PlanSource
from app.plans.provenance import provenance_view, result_provenance
from app.store.database import Database
from app.store.gait_files import GaitFiles
from app.store.tables.result_store import ResultStore
from app.undo.history import Author
from core.gait.gait import Gait, motion_problem
from core.gait.provenance import Provenance
from core.gait.recording import Recording, RecordingForm
from core.library.library import library
from core.robot.model import load_robot
from core.wire.trajectory_csv import format_companion, format_trajectory_csv
from solver_jobs import solve_live

WALK = "walk"
SCRIPT = Author()


def make_service(folder: Path, database: Database) -> GaitService:
    return GaitService(GaitFiles(folder), database, lambda gait: solve_live)


@pytest.fixture
def service(tmp_path: Path, database: Database) -> GaitService:
    return make_service(tmp_path, database)


def longer(gait: Gait) -> Gait:
    return replace(gait, step=(0.0075, 0.0075, 0.0))


def result_for(gait: Gait) -> dict[str, Any]:
    """A result as it is kept; the live tier's motion stands for the exact tier's."""
    motion = solve_live(motion_problem(gait, load_robot(gait.robot))).trajectory
    content = {
        "trajectory": trajectory_content(motion),
        "status": "solved",
        "solve_seconds": 0.25,
        "iterations": 12,
        "max_violation": 1e-9,
    }
    return {**content, "provenance": asdict(result_provenance(asked_hash(gait), content))}


def take(service: GaitService, gait_id: str, author: Author = SCRIPT) -> dict[str, Any]:
    gait = service.open_gait(gait_id).gait
    content = result_for(gait)
    resulted = service.delivery.on_result(content, gait_id, author)
    assert resulted is not None
    assert resulted.id == gait_id
    return content


def shown(service: GaitService, gait_id: str) -> tuple[bool, bool] | None:
    """Whether the provenance matches, and whether the result is at hand."""
    view = provenance_view(service.open_gait(gait_id).gait, service.plan(gait_id))
    return None if view is None else (view["matches"], view["at_hand"])


def test_a_result_that_is_taken_says_what_was_solved_and_what_came_out(service: GaitService) -> None:
    before = service.open_gait(WALK)
    content = take(service, WALK)
    provenance = service.open_gait(WALK).gait.provenance
    assert provenance is not None
    assert provenance.motion == asked_hash(before.gait)
    assert provenance.trajectory == content_sha256(content["trajectory"])
    assert (provenance.method, provenance.status, provenance.seconds) == ("nlp", "solved", 0.25)
    assert provenance.solver.startswith("IPOPT in CasADi 3.")
    assert provenance.program == VERSION
    assert datetime.fromisoformat(provenance.made).tzinfo is not None
    assert shown(service, WALK) == (True, True)
    assert service.plan(WALK).source is PlanSource.OPTIMISED


def test_it_is_an_edit_that_can_be_undone_and_done_again(service: GaitService) -> None:
    take(service, WALK)
    after = service.open_gait(WALK)
    assert (after.undo_label(), after.edited) == ("Optimise", True)
    undone = service.undo(WALK)
    assert (undone.gait.provenance, undone.redo_label()) == (None, "Optimise")
    assert service.plan(WALK).source is PlanSource.LIVE
    service.redo(WALK)
    assert service.plan(WALK).source is PlanSource.OPTIMISED
    assert service.save(WALK).edited is False


def test_a_copy_that_is_optimised_leaves_its_source_and_the_approval_of_that(service: GaitService) -> None:
    service.check(WALK)
    service.approve(WALK, ApprovalRequest("Ada", accept_warnings=True))
    gait_id = service.create(replace(service.open_gait(WALK).gait, name="Copy")).id
    take(service, gait_id)
    assert service.plan(gait_id).source is PlanSource.OPTIMISED
    assert service.plan(WALK).source is PlanSource.LIVE
    assert service.confirmed(WALK).approval is not None
    assert shown(service, WALK) is None


def test_the_same_motion_found_once_more_keeps_the_approval(service: GaitService) -> None:
    content = take(service, WALK)
    service.check(WALK)
    approved = service.approve(WALK, ApprovalRequest("Ada", accept_warnings=True))
    assert service.delivery.on_result(content, WALK) is None
    assert service.open_gait(WALK) == approved


def test_a_copy_of_an_optimised_gait_has_its_result_also_where_another_copy_has_a_newer_one(
    service: GaitService,
) -> None:
    take(service, WALK)
    optimised = service.open_gait(WALK).gait
    first, second = (service.create(replace(optimised, name=name)).id for name in ("First", "Second"))
    assert shown(service, first) == (True, True)
    content = result_for(optimised)
    content["trajectory"]["body_world"][20][2] += 1e-9
    content["provenance"] = asdict(result_provenance(asked_hash(optimised), content))
    service.delivery.on_result(content, second)
    hashes = [service.plan(gait_id).result for gait_id in (WALK, first, second)]
    assert hashes[0] == hashes[1] != hashes[2]


def test_a_result_that_comes_after_an_edit_is_there_when_the_edit_is_undone(service: GaitService) -> None:
    drawn = service.open_gait(WALK).gait
    service.edit(WALK, longer(drawn), "Longer", None)
    assert service.delivery.on_result(result_for(drawn), WALK) is None
    assert shown(service, WALK) is None
    for step in (service.undo, service.redo, service.undo):
        step(WALK)
    assert shown(service, WALK) == (True, True)


def test_an_edit_makes_it_stale_and_undo_makes_it_hold_again(service: GaitService) -> None:
    take(service, WALK)
    optimised = service.open_gait(WALK).gait
    service.edit(WALK, longer(optimised), "Longer", None)
    assert shown(service, WALK) == (False, False)
    service.undo(WALK)
    assert (service.open_gait(WALK).gait, shown(service, WALK)) == (optimised, (True, True))
    service.redo(WALK)
    assert shown(service, WALK) == (False, False)


def test_every_version_keeps_the_result_of_its_own(service: GaitService) -> None:
    first = take(service, WALK)["provenance"]
    service.edit(WALK, longer(service.open_gait(WALK).gait), "Longer", None)
    second = take(service, WALK)["provenance"]

    def twice(step: Callable[[str], OpenGait]) -> OpenGait:
        step(WALK)
        return step(WALK)

    for act, expected in ((service.undo, first), (service.redo, second), (service.undo, first)):
        provenance = twice(act).gait.provenance
        assert provenance is not None
        assert asdict(provenance) == expected
        assert shown(service, WALK) == (True, True)


def test_a_page_that_has_not_heard_of_a_result_does_not_take_it_away(service: GaitService) -> None:
    unaware = service.open_gait(WALK).gait
    provenance = take(service, WALK)["provenance"]
    edited = service.edit(WALK, replace(unaware, notes="words"), "Notes", service.open_gait(WALK).revision)
    assert edited.gait.provenance is not None
    assert asdict(edited.gait.provenance) == provenance
    assert shown(service, WALK) == (True, True)


def test_it_survives_a_restart_saved_or_not(service: GaitService, tmp_path: Path, database: Database) -> None:
    take(service, WALK)
    assert make_service(tmp_path, database).open_gait(WALK).gait.provenance is not None
    service.save(WALK)
    assert GaitFiles(tmp_path).read(WALK).provenance == service.open_gait(WALK).gait.provenance


def test_a_file_from_another_machine_says_that_the_result_is_not_here(
    service: GaitService, tmp_path: Path
) -> None:
    take(service, WALK)
    gait = service.save(WALK).gait
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    database = Database(elsewhere / "studio.sqlite3")
    other = make_service(elsewhere, database)
    gait_id = other.create(gait).id
    assert shown(other, gait_id) == (True, False)
    assert other.plan(gait_id).source is PlanSource.LIVE
    take(other, gait_id)
    assert shown(other, gait_id) == (True, True)
    database.close()


def test_a_result_of_this_machine_takes_the_place_of_one_from_elsewhere(service: GaitService) -> None:
    content = result_for(library()[WALK].gait)
    motion = content["provenance"]["motion"]
    theirs = result_provenance(motion, {**content, "trajectory": {}})
    gait_id = service.create(replace(library()[WALK].gait, name="Theirs", provenance=theirs)).id
    assert shown(service, gait_id) == (True, False)
    service.delivery.on_result(content, gait_id)
    assert shown(service, gait_id) == (True, True)


def test_an_older_result_of_which_nothing_is_known_is_not_taken_for_the_one_that_is_named(
    service: GaitService, database: Database
) -> None:
    content = result_for(library()[WALK].gait)
    motion = content.pop("provenance")["motion"]
    theirs = result_provenance(motion, {**content, "trajectory": {}})
    gait_id = service.create(replace(library()[WALK].gait, name="Theirs", provenance=theirs)).id
    ResultStore(database).put(motion, content)
    assert service.plan(gait_id).source is PlanSource.OPTIMISED
    assert shown(service, gait_id) == (True, False)


def test_a_result_that_an_older_program_stored_under_what_was_asked_is_of_the_document_that_names_it(
    service: GaitService, database: Database
) -> None:
    gait = library()[WALK].gait
    content = result_for(gait)
    ResultStore(database).put(asked_hash(gait), content)
    named = replace(gait, name="Named", provenance=Provenance(**content["provenance"]))
    assert shown(service, service.create(named).id) == (True, True)
    assert service.plan(WALK).source is PlanSource.LIVE


def test_a_gait_without_a_result_has_none(service: GaitService) -> None:
    assert shown(service, WALK) is None
    assert service.plan(WALK).result is None


def test_a_result_of_what_an_undo_left_can_be_undone_too(service: GaitService) -> None:
    service.edit(WALK, longer(service.open_gait(WALK).gait), "Longer", None)
    service.undo(WALK)
    take(service, WALK)
    assert shown(service, WALK) == (True, True)
    assert service.undo(WALK).gait == library()[WALK].gait


def test_a_result_of_an_older_version_is_in_no_undos_way_beside_another_tabs_edit(
    tmp_path: Path, database: Database
) -> None:
    pages = frozenset({"one", "two"})
    service = GaitService(GaitFiles(tmp_path), database, lambda gait: solve_live, lambda: pages)
    take(service, WALK)
    service.edit(WALK, longer(service.open_gait(WALK).gait), "Longer", None, Author("one"))
    take(service, WALK)
    service.edit(
        WALK, service.open_gait(WALK).gait.with_options(clearance=0.004), "Clearance", None, Author("two")
    )
    for _ in range(2):
        undone = service.undo(WALK, Author("one")).gait
    assert (undone.step, undone.options.clearance) == (library()[WALK].gait.step, 0.004)
    assert shown(service, WALK) == (False, False)


def test_beside_another_tabs_edit_an_undo_keeps_the_result_of_what_is_left(
    tmp_path: Path, database: Database
) -> None:
    pages = frozenset({"one", "two"})
    service = GaitService(GaitFiles(tmp_path), database, lambda gait: solve_live, lambda: pages)
    one, two = Author("one", "Ada"), Author("two", "Bob")
    service.edit(WALK, longer(service.open_gait(WALK).gait), "Longer", None, one)
    service.edit(WALK, service.open_gait(WALK).gait.with_options(clearance=0.004), "Clearance", None, two)
    provenance = take(service, WALK, two)["provenance"]
    undone = service.undo(WALK, one).gait
    assert (undone.step, undone.options.clearance) == (library()[WALK].gait.step, 0.004)
    assert undone.provenance is not None
    assert asdict(undone.provenance) == provenance
    assert shown(service, WALK) == (False, False)


def two_pages(tmp_path: Path, database: Database) -> GaitService:
    pages = frozenset({"one", "two"})
    return GaitService(GaitFiles(tmp_path), database, lambda gait: solve_live, lambda: pages)


ONE, TWO = Author("one", "Ada"), Author("two", "Bob")


def test_an_undo_of_words_keeps_the_result_that_another_tab_took_since(
    tmp_path: Path, database: Database
) -> None:
    service = two_pages(tmp_path, database)
    renamed = replace(service.open_gait(WALK).gait, notes="words")
    service.edit(WALK, renamed, "Notes", None, ONE)
    take(service, WALK, TWO)
    assert service.undo(WALK, ONE).gait.notes == library()[WALK].gait.notes
    assert shown(service, WALK) == (True, True)


def test_a_result_is_undone_beside_another_tabs_words(tmp_path: Path, database: Database) -> None:
    service = two_pages(tmp_path, database)
    take(service, WALK, TWO)
    service.edit(WALK, replace(service.open_gait(WALK).gait, notes="words"), "Notes", None, ONE)
    undone = service.undo(WALK, TWO).gait
    assert (undone.provenance, undone.notes) == (None, "words")


def test_the_state_before_a_result_can_be_restored(service: GaitService) -> None:
    service.check(WALK)
    service.approve(WALK, ApprovalRequest("Ada", accept_warnings=True))
    number = service.versions.newest_number(WALK)
    assert number is not None
    take(service, WALK)
    service.restore_version(WALK, number)
    assert service.plan(WALK).source is PlanSource.LIVE


def test_a_result_for_a_deleted_gait_is_there_when_it_comes_back(service: GaitService) -> None:
    gait_id = service.create(replace(library()[WALK].gait, name="Gone")).id
    content = result_for(service.open_gait(gait_id).gait)
    service.edit(gait_id, longer(service.open_gait(gait_id).gait), "Longer", None)
    service.delete(gait_id)
    assert service.delivery.on_result(content, gait_id) is None
    service.restore(gait_id)
    service.undo(gait_id)
    assert shown(service, gait_id) == (True, True)


def test_a_result_leaves_a_recorded_motion_and_waits_for_the_gait_without_it(service: GaitService) -> None:
    drawn = service.open_gait(WALK).gait
    motion = solve_live(motion_problem(drawn, load_robot(drawn.robot))).trajectory
    text = format_trajectory_csv(motion)
    recording = Recording("walk.csv", RecordingForm.TRAJECTORY, text, format_companion(motion, text))
    service.edit(WALK, replace(drawn, recorded=recording), "Record", None)
    recorded = service.open_gait(WALK)
    assert service.delivery.on_result(result_for(drawn), WALK) is None
    assert service.open_gait(WALK) == recorded
    assert service.plan(WALK).source is PlanSource.RECORDED
    service.undo(WALK)
    assert shown(service, WALK) == (True, True)
