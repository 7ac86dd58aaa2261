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
from app.gaits.service import GaitDesk
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


def make_desk(folder: Path, database: Database) -> GaitDesk:
    return GaitDesk(GaitFiles(folder), database, lambda gait: solve_live)


@pytest.fixture
def desk(tmp_path: Path, database: Database) -> GaitDesk:
    return make_desk(tmp_path, database)


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


def take(desk: GaitDesk, gait_id: str) -> dict[str, Any]:
    gait = desk.open_gait(gait_id).gait
    content = result_for(gait)
    touched = desk.take_result(asked_hash(gait), content)
    assert gait_id in [open_gait.id for open_gait in touched]
    return content


def shown(desk: GaitDesk, gait_id: str) -> tuple[bool, bool] | None:
    """Whether the provenance matches, and whether the result is at hand."""
    view = provenance_view(desk.open_gait(gait_id).gait, desk.plan(gait_id))
    return None if view is None else (view["matches"], view["at_hand"])


def test_a_result_that_is_taken_says_what_was_solved_and_what_came_out(desk: GaitDesk) -> None:
    before = desk.open_gait(WALK)
    content = take(desk, WALK)
    provenance = desk.open_gait(WALK).gait.provenance
    assert provenance is not None
    assert provenance.motion == asked_hash(before.gait)
    assert provenance.trajectory == content_sha256(content["trajectory"])
    assert (provenance.method, provenance.status, provenance.seconds) == ("nlp", "solved", 0.25)
    assert provenance.solver.startswith("IPOPT in CasADi 3.")
    assert provenance.program == VERSION
    assert datetime.fromisoformat(provenance.made).tzinfo is not None
    assert shown(desk, WALK) == (True, True)
    assert desk.plan(WALK).source is PlanSource.OPTIMISED


def test_it_is_no_edit_but_there_is_something_to_save(desk: GaitDesk) -> None:
    before = desk.open_gait(WALK)
    take(desk, WALK)
    after = desk.open_gait(WALK)
    assert (after.revision, after.undo_label(), after.edited) == (before.revision, None, True)
    assert desk.save(WALK).edited is False


def test_an_edit_makes_it_stale_and_undo_makes_it_hold_again(desk: GaitDesk) -> None:
    take(desk, WALK)
    optimised = desk.open_gait(WALK).gait
    desk.edit(WALK, longer(optimised), "Longer", None)
    assert shown(desk, WALK) == (False, False)
    desk.undo(WALK)
    assert (desk.open_gait(WALK).gait, shown(desk, WALK)) == (optimised, (True, True))
    desk.redo(WALK)
    assert shown(desk, WALK) == (False, False)


def test_every_version_keeps_the_result_of_its_own(desk: GaitDesk) -> None:
    first = take(desk, WALK)["provenance"]
    desk.edit(WALK, longer(desk.open_gait(WALK).gait), "Longer", None)
    second = take(desk, WALK)["provenance"]
    for act, expected in ((desk.undo, first), (desk.redo, second), (desk.undo, first)):
        provenance = act(WALK).gait.provenance
        assert provenance is not None
        assert asdict(provenance) == expected
        assert shown(desk, WALK) == (True, True)


def test_a_page_that_has_not_heard_of_a_result_does_not_take_it_away(desk: GaitDesk) -> None:
    unaware = desk.open_gait(WALK).gait
    provenance = take(desk, WALK)["provenance"]
    edited = desk.edit(WALK, replace(unaware, notes="words"), "Notes", desk.open_gait(WALK).revision)
    assert edited.gait.provenance is not None
    assert asdict(edited.gait.provenance) == provenance
    assert shown(desk, WALK) == (True, True)


def test_it_survives_a_restart_saved_or_not(desk: GaitDesk, tmp_path: Path, database: Database) -> None:
    take(desk, WALK)
    assert make_desk(tmp_path, database).open_gait(WALK).gait.provenance is not None
    desk.save(WALK)
    assert GaitFiles(tmp_path).read(WALK).provenance == desk.open_gait(WALK).gait.provenance


def test_a_file_from_another_machine_says_that_the_result_is_not_here(desk: GaitDesk, tmp_path: Path) -> None:
    take(desk, WALK)
    gait = desk.save(WALK).gait
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    database = Database(elsewhere / "studio.sqlite3")
    other = make_desk(elsewhere, database)
    gait_id = other.create(gait).id
    assert shown(other, gait_id) == (True, False)
    assert other.plan(gait_id).source is PlanSource.LIVE
    take(other, gait_id)
    assert shown(other, gait_id) == (True, True)
    database.close()


def test_a_result_of_this_machine_takes_the_place_of_one_from_elsewhere(desk: GaitDesk) -> None:
    content = result_for(library()[WALK].gait)
    motion = content["provenance"]["motion"]
    theirs = result_provenance(motion, {**content, "trajectory": {}})
    gait_id = desk.create(replace(library()[WALK].gait, name="Theirs", provenance=theirs)).id
    assert shown(desk, gait_id) == (True, False)
    desk.take_result(motion, content)
    assert shown(desk, gait_id) == (True, True)


def test_an_older_result_of_which_nothing_is_known_is_not_taken_for_the_one_that_is_named(
    desk: GaitDesk,
) -> None:
    content = result_for(library()[WALK].gait)
    motion = content.pop("provenance")["motion"]
    theirs = result_provenance(motion, {**content, "trajectory": {}})
    gait_id = desk.create(replace(library()[WALK].gait, name="Theirs", provenance=theirs)).id
    desk.take_result(motion, content)
    assert desk.plan(gait_id).source is PlanSource.OPTIMISED
    assert shown(desk, gait_id) == (True, False)


def test_a_result_that_was_found_for_another_gait_is_named_and_saved_too(desk: GaitDesk) -> None:
    take(desk, WALK)
    gait_id = desk.create(replace(library()[WALK].gait, name="Twin")).id
    assert desk.open_gait(gait_id).gait.provenance is None
    assert shown(desk, gait_id) == (True, True)
    assert desk.save(gait_id).gait.provenance == desk.open_gait(WALK).gait.provenance


def test_a_gait_without_a_result_has_none(desk: GaitDesk) -> None:
    assert shown(desk, WALK) is None
    assert desk.plan(WALK).result is None


def test_a_result_of_what_an_undo_left_is_in_no_redos_way(desk: GaitDesk) -> None:
    desk.edit(WALK, longer(desk.open_gait(WALK).gait), "Longer", None)
    desk.undo(WALK)
    take(desk, WALK)
    redone = desk.redo(WALK)
    assert redone.gait.step == (0.0075, 0.0075, 0.0)
    assert shown(desk, WALK) in (None, (False, False))
    desk.undo(WALK)
    assert shown(desk, WALK) == (True, True)


def test_a_result_of_an_older_version_is_in_no_undos_way_beside_another_tabs_edit(
    tmp_path: Path, database: Database
) -> None:
    pages = frozenset({"one", "two"})
    desk = GaitDesk(GaitFiles(tmp_path), database, lambda gait: solve_live, lambda: pages)
    take(desk, WALK)
    desk.edit(WALK, longer(desk.open_gait(WALK).gait), "Longer", None, Author("one"))
    newer = take(desk, WALK)["provenance"]
    desk.edit(WALK, desk.open_gait(WALK).gait.with_options(clearance=0.004), "Clearance", None, Author("two"))
    undone = desk.undo(WALK, Author("one")).gait
    assert (undone.step, undone.options.clearance) == (library()[WALK].gait.step, 0.004)
    assert undone.provenance is not None
    assert asdict(undone.provenance) == newer


def test_beside_another_tabs_edit_an_undo_keeps_the_result_of_what_is_left(
    tmp_path: Path, database: Database
) -> None:
    pages = frozenset({"one", "two"})
    desk = GaitDesk(GaitFiles(tmp_path), database, lambda gait: solve_live, lambda: pages)
    one, two = Author("one", "Ada"), Author("two", "Bob")
    desk.edit(WALK, longer(desk.open_gait(WALK).gait), "Longer", None, one)
    desk.edit(WALK, desk.open_gait(WALK).gait.with_options(clearance=0.004), "Clearance", None, two)
    provenance = take(desk, WALK)["provenance"]
    undone = desk.undo(WALK, one).gait
    assert (undone.step, undone.options.clearance) == (library()[WALK].gait.step, 0.004)
    assert undone.provenance is not None
    assert asdict(undone.provenance) == provenance
    assert shown(desk, WALK) == (False, False)
