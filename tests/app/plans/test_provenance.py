"""Provenance of results: set when one is taken, stale after an edit, kept in the file, known elsewhere."""

from __future__ import annotations

from dataclasses import asdict, replace
from datetime import datetime
from pathlib import Path
from typing import Any

import pytest

from app.common.version import VERSION
from app.documents.gait_json import asked_hash
from app.documents.trajectory_json import content_sha256, trajectory_content
from app.gaits.service import GaitService
from app.plans.plan import PlanSource
from app.plans.provenance import provenance_view, result_provenance
from app.store.database import Database
from app.store.gait_files import GaitFiles
from app.undo.history import Author
from core.gait.gait import Gait, motion_problem
from core.library.library import library
from core.robot.model import load_robot
from solver_jobs import solve_live

WALK = "walk"


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


def take(service: GaitService, gait_id: str) -> dict[str, Any]:
    gait = service.open_gait(gait_id).gait
    content = result_for(gait)
    touched = service.on_result(asked_hash(gait), content)
    assert gait_id in [open_gait.id for open_gait in touched]
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


def test_it_is_no_edit_but_there_is_something_to_save(service: GaitService) -> None:
    before = service.open_gait(WALK)
    take(service, WALK)
    after = service.open_gait(WALK)
    assert (after.revision, after.undo_label(), after.edited) == (before.revision, None, True)
    assert service.save(WALK).edited is False


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
    for act, expected in ((service.undo, first), (service.redo, second), (service.undo, first)):
        provenance = act(WALK).gait.provenance
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
    service.on_result(motion, content)
    assert shown(service, gait_id) == (True, True)


def test_an_older_result_of_which_nothing_is_known_is_not_taken_for_the_one_that_is_named(
    service: GaitService,
) -> None:
    content = result_for(library()[WALK].gait)
    motion = content.pop("provenance")["motion"]
    theirs = result_provenance(motion, {**content, "trajectory": {}})
    gait_id = service.create(replace(library()[WALK].gait, name="Theirs", provenance=theirs)).id
    service.on_result(motion, content)
    assert service.plan(gait_id).source is PlanSource.OPTIMISED
    assert shown(service, gait_id) == (True, False)


def test_a_result_that_was_found_for_another_gait_is_named_and_saved_too(service: GaitService) -> None:
    take(service, WALK)
    gait_id = service.create(replace(library()[WALK].gait, name="Twin")).id
    assert service.open_gait(gait_id).gait.provenance is None
    assert shown(service, gait_id) == (True, True)
    assert service.save(gait_id).gait.provenance == service.open_gait(WALK).gait.provenance


def test_a_gait_without_a_result_has_none(service: GaitService) -> None:
    assert shown(service, WALK) is None
    assert service.plan(WALK).result is None


def test_a_result_of_what_an_undo_left_is_in_no_redos_way(service: GaitService) -> None:
    service.edit(WALK, longer(service.open_gait(WALK).gait), "Longer", None)
    service.undo(WALK)
    take(service, WALK)
    redone = service.redo(WALK)
    assert redone.gait.step == (0.0075, 0.0075, 0.0)
    assert shown(service, WALK) in (None, (False, False))
    service.undo(WALK)
    assert shown(service, WALK) == (True, True)


def test_a_result_of_an_older_version_is_in_no_undos_way_beside_another_tabs_edit(
    tmp_path: Path, database: Database
) -> None:
    pages = frozenset({"one", "two"})
    service = GaitService(GaitFiles(tmp_path), database, lambda gait: solve_live, lambda: pages)
    take(service, WALK)
    service.edit(WALK, longer(service.open_gait(WALK).gait), "Longer", None, Author("one"))
    newer = take(service, WALK)["provenance"]
    service.edit(
        WALK, service.open_gait(WALK).gait.with_options(clearance=0.004), "Clearance", None, Author("two")
    )
    undone = service.undo(WALK, Author("one")).gait
    assert (undone.step, undone.options.clearance) == (library()[WALK].gait.step, 0.004)
    assert undone.provenance is not None
    assert asdict(undone.provenance) == newer


def test_beside_another_tabs_edit_an_undo_keeps_the_result_of_what_is_left(
    tmp_path: Path, database: Database
) -> None:
    pages = frozenset({"one", "two"})
    service = GaitService(GaitFiles(tmp_path), database, lambda gait: solve_live, lambda: pages)
    one, two = Author("one", "Ada"), Author("two", "Bob")
    service.edit(WALK, longer(service.open_gait(WALK).gait), "Longer", None, one)
    service.edit(WALK, service.open_gait(WALK).gait.with_options(clearance=0.004), "Clearance", None, two)
    provenance = take(service, WALK)["provenance"]
    undone = service.undo(WALK, one).gait
    assert (undone.step, undone.options.clearance) == (library()[WALK].gait.step, 0.004)
    assert undone.provenance is not None
    assert asdict(undone.provenance) == provenance
    assert shown(service, WALK) == (False, False)
