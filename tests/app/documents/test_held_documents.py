"""Feet held up in documents: on the service, in files, over edits, undo, versions, export and import."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from app.documents.gait_json import (
    asked_hash,
    gait_content,
    gait_from_content,
    gait_schema,
    motion_hash,
    parse_gait,
)
from app.gaits.approvals import ApprovalRequest
from app.gaits.normalise import normalise, normalise_imported
from app.gaits.service import GaitService
from app.plans.plan import PlanSource
from app.store.database import Database
from app.store.gait_files import GaitFiles
from app.undo.history import Author
from app.undo.merge import merge, place_words
from core.errors import CheckError, InputError
from core.gait.gait import Gait, drawn_timeline
from core.gait.gait_difference import gait_difference
from core.gait.held_feet import HeldFeet
from core.library.library import library
from core.recorded.recorded_gait import gait_of_motion
from core.wire.trajectory_csv import format_companion, format_trajectory_csv, parse_trajectory_csv
from solver_jobs import solve_live
from tests.support.held_gaits import lifting, wave

FOUR = wave("hexapod", (1, 4), phase_knots=3, closing_knots=3)
PAGE = Author()


@pytest.fixture
def service(tmp_path: Path, database: Database) -> GaitService:
    return GaitService(GaitFiles(tmp_path), database, lambda gait: solve_live)


def painted(gait: Gait, foot: int, first: int, last: int, *, stance: bool) -> Gait:
    cells = gait.timeline.stance.copy()
    cells[foot - 1, first : last + 1] = stance
    return replace(gait, timeline=replace(gait.timeline, stance=cells))


def test_the_document_says_which_feet_are_held_and_reads_them_back() -> None:
    content = gait_content(FOUR)
    assert content["held"] == {"start": [1, 4], "end": [1, 4]}
    assert parse_gait(json.dumps(content)) == FOUR


def test_older_documents_hold_none_and_new_ones_without_leave_it_out() -> None:
    walk = library()["walk"].gait
    assert "held" not in gait_content(walk)
    assert gait_from_content(gait_content(walk)).held == HeldFeet()
    assert gait_from_content(gait_content(walk) | {"held": {}}).held == HeldFeet()


def test_the_schema_publishes_it() -> None:
    schema = gait_schema()
    assert schema["$defs"]["HeldModel"]["properties"].keys() == {"start", "end"}
    assert "every other foot stands there" in schema["properties"]["held"]["description"]


@pytest.mark.parametrize(
    ("held", "message"),
    [
        ({"start": [9]}, "held.start names foot 9; the gait has feet 1 to 6"),
        ({"end": [2, 2]}, "held.end is .2, 2.; it must name each foot once"),
        ({"end": [1, 2, 3, 4, 5, 6]}, "held.end names every foot"),
        ({"end": ["front"]}, "field held.end.0"),
        ({"middle": [1]}, "field held.middle"),
        ([1], "field held"),
    ],
)
def test_a_document_that_cannot_be_says_which_field_is_wrong(held: object, message: str) -> None:
    with pytest.raises(InputError, match=message):
        gait_from_content(gait_content(FOUR) | {"held": held})


def test_results_belong_to_the_feet_that_are_held() -> None:
    lifted = lifting("hexapod", (1, 4))
    others = replace(lifted, held=HeldFeet(end=(1,)))
    assert len({motion_hash(gait) for gait in (lifted, others, replace(lifted, held=HeldFeet()))}) == 3
    assert asked_hash(lifted) == motion_hash(lifted)


@pytest.mark.parametrize("direction", [2, 3, 4])
def test_another_direction_holds_the_feet_that_take_their_place(direction: int) -> None:
    turned, _ = normalise(FOUR, replace(FOUR, direction=direction))
    assert turned.held.start == turned.held.end
    assert not turned.timeline.stance[[foot - 1 for foot in turned.held.both]].any()
    assert (turned.timeline.stance == drawn_timeline(turned).stance).all()
    assert normalise(turned, replace(turned, direction=1))[0] == FOUR


def test_painting_a_held_foot_down_takes_it_back_with_a_word() -> None:
    last = FOUR.timeline.sample_count - 1
    changed, notice = normalise(FOUR, painted(FOUR, 4, last, last, stance=True))
    assert changed.held == HeldFeet(start=(1, 4), end=(1,))
    assert notice == "Foot 4 stands at the last sample now, so it is no longer held up there."


def test_an_edit_that_says_that_a_standing_foot_is_held_is_refused() -> None:
    with pytest.raises(
        InputError, match=r"Foot 2 is to be held up at the last sample but stands there.*swing, or"
    ):
        normalise(FOUR, replace(FOUR, held=HeldFeet((1, 4), (1, 2, 4))))
    with pytest.raises(InputError, match="Foot 2 is to be held up at the first sample but stands there"):
        normalise_imported(replace(FOUR, held=HeldFeet((2,), ())))


def test_the_service_solves_checks_and_keeps_it(service: GaitService, tmp_path: Path) -> None:
    made = service.create(FOUR)
    plan = service.plan(made.id)
    assert plan.source is PlanSource.LIVE
    assert plan.note.endswith("Feet 1 and 4 are held up throughout.")
    verdict = service.check(made.id).verdict
    assert verdict is not None
    assert verdict.passed
    assert not {finding.rule for finding in verdict.findings} & {"slip", "contact", "clearance", "travel"}
    assert service.approve(made.id, ApprovalRequest("Ada", accept_warnings=True)).approval is not None
    (saved,) = tmp_path.rglob(f"{made.id}.json")
    assert parse_gait(saved.read_text()).held == FOUR.held


def test_a_body_that_rests_aside_is_told_and_travels_as_it_should(service: GaitService) -> None:
    made = service.create(lifting("hexapod", (1, 2)))
    assert "At the end the body rests 4.0 mm aside, over the feet that stand." in service.plan(made.id).note
    verdict = service.check(made.id).verdict
    assert verdict is not None
    assert verdict.passed


def test_a_foot_that_ends_in_the_air_unheld_is_refused_and_holding_it_up_is_the_way_out(
    service: GaitService,
) -> None:
    lifted = lifting("hexapod", (1, 4))
    made = service.create(replace(lifted, held=HeldFeet()))
    with pytest.raises(CheckError, match=r"Foot 1, 4 is in the air at the last sample.*or hold it up"):
        service.check(made.id)
    service.edit(made.id, lifted, "Hold up", None)
    assert service.plan(made.id).source is PlanSource.LIVE


def test_undo_and_versions_bring_held_feet_back(service: GaitService) -> None:
    lifted = lifting("hexapod", (1, 4))
    made = service.create(replace(lifted, held=HeldFeet()))
    service.edit(made.id, lifted, "Hold up", None)
    service.edit(made.id, replace(lifted, held=HeldFeet(end=(4,)), notes="one"), "Hold one", None)
    assert service.undo(made.id).gait.held == HeldFeet(end=(1, 4))
    assert service.undo(made.id).gait.held == HeldFeet()
    assert service.redo(made.id).gait.held == HeldFeet(end=(1, 4))
    assert service.restore_version(made.id, 1).gait.held == HeldFeet()


def test_edits_of_others_are_merged_beside_held_feet_which_are_a_whole() -> None:
    base = gait_content(FOUR)
    want = base | {"held": {"start": [1, 4], "end": [2, 4]}}
    present = base | {"name": "Mine"}
    merged = merge(base, want, present)
    assert (merged.content["name"], merged.content["held"]["end"]) == ("Mine", [2, 4])
    other = base | {"held": {"start": [1, 4], "end": [1, 3]}}
    clash = merge(base, want, other)
    assert clash.conflicts == (("held", "end"),)
    assert place_words(clash.conflicts) == "the feet held at the end"
    without = {key: value for key, value in base.items() if key != "held"}
    assert place_words(merge(without, want, other).conflicts) == "the held feet"


def test_an_exported_motion_comes_back_with_the_same_feet_held(service: GaitService) -> None:
    trajectory = service.plan(service.create(lifting("hexapod", (1, 4))).id).trajectory
    assert trajectory is not None
    text = format_trajectory_csv(trajectory)
    read = parse_trajectory_csv(text, "lifted.csv", format_companion(trajectory, text))
    assert gait_of_motion(read.trajectory, "again", "hexapod").gait.held == HeldFeet(end=(1, 4))


def test_versions_are_told_apart_by_the_feet_they_hold() -> None:
    (group,) = gait_difference(FOUR, replace(FOUR, held=HeldFeet(end=(1, 4))))
    assert group.sentences == ("Held up at the start: feet 1 and 4 → none",)
