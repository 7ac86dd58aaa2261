"""Sequences on the service: made, edited, refreshed, checked and approved."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.documents.gait_json import gait_content, gait_from_content, motion_hash, parse_gait
from app.export.gait_diagram import facts, sample_edges
from app.gaits.approvals import ApprovalRequest
from app.gaits.sequence_documents import (
    PartReference,
    SourceState,
    made_sequence,
    refreshed,
    resampled,
    source_states,
)
from app.gaits.service import GaitService
from app.plans.plan import PlanSource
from app.store.database import Database
from app.store.gait_files import GaitFiles
from app.undo.history import Author
from core.errors import InputError
from core.gait.gait import Gait, SequencePart
from core.library.library import library
from core.library.new_gait import with_robot
from core.library.sequence import derived, sequence_gait
from core.robot.model import load_robot
from solver_jobs import solve_live

NAMES = ["walk", "rotate", "s-gait", "walk-manual-0", "s-gait-manual-2", "textbook-trot"]
TOUR = [PartReference("walk", 3), PartReference("rotate", 3), PartReference("s-gait", 2)]


def gait(name: str) -> Gait:
    return library()[name].gait


@pytest.fixture
def service(tmp_path: Path, database: Database) -> GaitService:
    return GaitService(GaitFiles(tmp_path), database, lambda gait: solve_live)


@pytest.fixture
def tour(service: GaitService) -> str:
    """Id of “walk 3×, turn 45°, S-gait 2×”."""
    return service.create(made_sequence("Tour", TOUR, service.document)).id


def test_the_document_is_complete_and_comes_back_the_same(service: GaitService, tour: str) -> None:
    made = service.document(tour)
    text = json.dumps(gait_content(made))
    assert parse_gait(text) == made
    assert [part["source"] for part in json.loads(text)["sequence"]] == ["walk", "rotate", "s-gait"]


@settings(max_examples=20, deadline=None)
@given(st.lists(st.tuples(st.sampled_from(NAMES), st.integers(1, 3), st.booleans()), min_size=1, max_size=5))
def test_any_sequence_comes_back_the_same_and_says_what_follows_from_it(
    asked: list[tuple[str, int, bool]],
) -> None:
    parts = [SequencePart(gait(name), times, name if known else None) for name, times, known in asked]
    made = sequence_gait("Any", parts)
    assert parse_gait(json.dumps(gait_content(made))) == made
    assert derived(made) == made


def test_a_gait_of_its_own_has_no_field_for_a_sequence() -> None:
    assert "sequence" not in gait_content(gait("walk"))


def test_names_and_notes_of_parts_change_no_motion(service: GaitService, tour: str) -> None:
    made = service.document(tour)
    first = replace(
        made.sequence[0], gait=replace(made.sequence[0].gait, name="Other", notes="!"), source=None
    )
    assert motion_hash(replace(made, sequence=(first, *made.sequence[1:]))) == motion_hash(made)
    twice = replace(made.sequence[0], times=2)
    assert motion_hash(replace(made, sequence=(twice, *made.sequence[1:]))) != motion_hash(made)


def test_a_part_is_migrated_like_a_document_of_its_own(service: GaitService, tour: str) -> None:
    content = gait_content(service.document(tour))
    content["sequence"][1]["gait"]["version"] = 99
    with pytest.raises(InputError, match=r"sequence\.1\.gait has version 99"):
        gait_from_content(content)


def test_one_trajectory_one_verdict_one_approval(service: GaitService, tour: str) -> None:
    plan = service.plan(tour)
    assert plan.source is PlanSource.SEQUENCE
    assert plan.trajectory is not None
    assert np.array_equal(plan.trajectory.contact.T, service.document(tour).timeline.stance)
    assert [(part.name, part.is_transition) for part in plan.parts] == [
        ("Walk 10 mm", False),
        ("Rotate 15°, as in the thesis", False),
        ("S-Gait 10 mm", False),
    ]
    assert plan.parts[1].turn == pytest.approx(np.pi / 4, abs=1e-5)
    assert sum(part.duration or 0.0 for part in plan.parts) == pytest.approx(plan.trajectory.times[-1])
    checked = service.check(tour)
    assert checked.verdict is not None
    assert checked.verdict.passed
    approved = service.approve(tour, ApprovalRequest("Ada", accept_warnings=True))
    assert plan.waypoints is not None
    assert approved.approval is not None
    assert approved.approval.waypoints_hash == plan.waypoints.content_hash


def test_every_part_edit_is_an_undo_step_and_takes_the_approval_away(service: GaitService, tour: str) -> None:
    service.check(tour)
    service.approve(tour, ApprovalRequest("Ada", accept_warnings=True))
    before = service.document(tour)
    turned = replace(before, sequence=before.sequence[::-1])
    changed = service.edit(tour, turned, "Move S-Gait up", None)
    assert changed.approval is None
    assert changed.verdict is None
    assert changed.gait.timeline != before.timeline
    assert service.plan(tour).parts[0].name == "S-Gait 10 mm"
    assert service.undo(tour).gait == before


def test_two_people_change_different_parts_and_each_undoes_their_own(
    tmp_path: Path, database: Database
) -> None:
    pages = frozenset({"ada", "ben"})
    service = GaitService(GaitFiles(tmp_path), database, lambda gait: solve_live, lambda: pages)
    tour = service.create(made_sequence("Tour", TOUR, service.document)).id

    def repeat(index: int, times: int, page: str) -> None:
        parts = list(service.document(tour).sequence)
        parts[index] = replace(parts[index], times=times)
        changed = replace(service.document(tour), sequence=tuple(parts))
        service.edit(tour, changed, "Times", None, Author(page))

    repeat(0, 1, "ada")
    repeat(2, 1, "ben")
    service.undo(tour, Author("ada"))
    assert [part.times for part in service.document(tour).sequence] == [3, 3, 1]
    assert service.document(tour) == derived(service.document(tour))
    service.undo(tour, Author("ben"))
    assert service.document(tour) == made_sequence("Tour", TOUR, service.document)


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"step": (0.01, 0.0, 0.0)}, "step"),
        ({"iterations": 2}, "iterations"),
        ({"direction": 3}, "direction"),
        ({"order": (1, 2, 3, 4)}, "order"),
    ],
)
def test_what_follows_from_the_parts_is_not_edited(
    service: GaitService, tour: str, change: dict[str, Any], field: str
) -> None:
    before = service.document(tour)
    with pytest.raises(InputError, match="follows from its parts") as refused:
        service.edit(tour, replace(before, **change), "Edit", None)
    assert refused.value.where == field
    assert service.document(tour) == before


def test_a_painted_cell_is_refused(service: GaitService, tour: str) -> None:
    before = service.document(tour)
    stance = before.timeline.stance.copy()
    stance[0, 3] = False
    painted = replace(before, timeline=replace(before.timeline, stance=stance))
    with pytest.raises(InputError, match="The timeline of a sequence follows from its parts"):
        service.edit(tour, painted, "Paint", None)


def test_the_last_part_stays(service: GaitService, tour: str) -> None:
    with pytest.raises(InputError, match="at least one part"):
        service.edit(tour, replace(service.document(tour), sequence=()), "Remove", None)


def test_a_sequence_in_a_sequence_stands_for_its_parts(service: GaitService, tour: str) -> None:
    longer = made_sequence("Longer", [PartReference(tour, 2), PartReference("walk", 1)], service.document)
    assert [part.source for part in longer.sequence] == [*["walk", "rotate", "s-gait"] * 2, "walk"]


def test_a_sequence_too_large_for_a_document_is_refused_when_it_is_made(
    service: GaitService, tour: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("app.documents.gait_json.MOST_BYTES", 4000)
    with pytest.raises(InputError, match=r"Tour would make a gait document of \d kB; at most 4 kB"):
        made_sequence("Tour", TOUR, service.document)
    with pytest.raises(InputError, match="at most 4 kB"):
        refreshed(service.document(tour), service.document)


def test_a_changed_source_is_said_and_taken_over(service: GaitService, tour: str) -> None:
    walk = gait("walk")
    service.edit("walk", replace(walk, notes="only words"), "Notes", None)
    assert set(source_states(service.document(tour), service.document)) == {SourceState.SAME}
    service.edit("walk", replace(walk, step=(0.005, 0.005, 0.0)), "Step", None)
    states = source_states(service.document(tour), service.document)
    assert states == (SourceState.CHANGED, SourceState.SAME, SourceState.SAME)
    assert service.document(tour).sequence[0].gait == walk
    only_second = refreshed(service.document(tour), service.document, 1)
    assert only_second == service.document(tour)
    taken = refreshed(service.document(tour), service.document)
    assert taken.sequence[0].gait.step == (0.005, 0.005, 0.0)
    assert set(source_states(taken, service.document)) == {SourceState.SAME}


def test_a_source_that_is_gone_leaves_its_copy(service: GaitService) -> None:
    own = service.create(replace(gait("walk"), name="Mine")).id
    made = made_sequence("x", [PartReference(own, 1)], service.document)
    service.delete(own)
    assert source_states(made, service.document) == (SourceState.GONE,)
    assert refreshed(made, service.document) == made


def slow_s_gait(service: GaitService) -> str:
    """Id of a gait with another sample time than the others."""
    slow = gait("s-gait")
    return service.create(replace(slow, name="Slow", timeline=replace(slow.timeline, sample_time=0.5))).id


def test_a_resampled_part_stands_to_its_source_as_a_copy(service: GaitService) -> None:
    slow = slow_s_gait(service)
    asked = [PartReference("walk", 1), PartReference("rotate", 1), PartReference(slow, 1)]
    with pytest.raises(InputError, match="one sample time"):
        made_sequence("x", asked, service.document)
    made = made_sequence("x", asked, service.document, resample=True)
    assert made.timeline.sample_time == 0.4
    assert set(source_states(made, service.document)) == {SourceState.SAME}
    service.edit(slow, replace(service.document(slow), step=(0.004, 0.0, 0.0)), "Step", None)
    assert source_states(made, service.document)[-1] is SourceState.CHANGED
    with pytest.raises(InputError, match="one sample time"):
        refreshed(made, service.document)
    taken = refreshed(made, service.document, resample=True)
    assert taken.sequence[2].gait.timeline.sample_time == 0.4
    assert set(source_states(taken, service.document)) == {SourceState.SAME}


def test_only_a_sequence_is_resampled() -> None:
    with pytest.raises(InputError, match="is no sequence"):
        resampled(gait("walk"))


def test_the_diagram_names_the_parts_and_how_many_have_no_room() -> None:
    short = sequence_gait("x", [SequencePart(gait("walk"), 3), SequencePart(gait("rotate"))])
    assert (
        facts(short, sample_edges(short, load_robot(short.robot)))
        == "3x Walk 10 mm, 1x Rotate 15°, as in the thesis  ·  30.0 mm, turn 15.0°  ·  169 samples of 0.4 s"
    )
    long = sequence_gait("x", [SequencePart(gait("walk"))] * 9)
    assert facts(long, sample_edges(long, load_robot(long.robot))).startswith(
        ", ".join(["1x Walk 10 mm"] * 5) + " and 4 more  ·  90.0 mm"
    )


@pytest.mark.parametrize("robot", ["deltawalker5", "hexapod"])
def test_a_file_of_a_part_for_another_robot_makes_no_motion(
    service: GaitService, tour: str, robot: str
) -> None:
    content = gait_content(service.document(tour))
    other = with_robot(gait("s-gait"), load_robot(robot))
    content["sequence"][2]["gait"] = gait_content(other)
    plan = service.open_gaits.planned(gait_from_content(content))
    assert plan.trajectory is None
    assert plan.refusal is not None
    assert "Part 3, “S-Gait 10 mm” is for the robot" in plan.refusal.sentence
