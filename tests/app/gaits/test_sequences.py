"""Sequences on the service: made, edited, refreshed, checked and approved."""

from __future__ import annotations

import json
import time
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.documents.gait_json import gait_content, gait_from_content, motion_hash, parse_gait
from app.documents.trajectory_json import trajectory_content
from app.export.gait_diagram import facts, sample_edges
from app.gaits.approvals import ApprovalRequest
from app.gaits.live_plans import LivePlans, changed_gait
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
from app.plans.provenance import result_provenance
from app.store.database import Database
from app.store.gait_files import GaitFiles
from app.undo.history import Author
from core.errors import CheckError, InputError
from core.gait.gait import Gait, SequencePart, motion_problem
from core.gait.gait_difference import gait_difference
from core.library.library import library
from core.library.new_gait import with_robot
from core.library.sequence import derived, run_of, sequence_gait
from core.problem.motion_problem import MotionProblem
from core.robot.model import load_robot
from solver_jobs import MotionResult, SolveStatus, solve_live
from tests.support.live_tiers import FixedTier

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
        ("Rotate 15°", False),
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


def test_a_part_without_a_motion_is_named(tmp_path: Path, database: Database) -> None:
    tier = LivePlans(FixedTier(SolveStatus.INFEASIBLE))
    service = GaitService(GaitFiles(tmp_path), database, tier.solve_for)
    asked = [PartReference("walk-manual-0", 1), PartReference("rotate", 1)]
    tour = service.create(made_sequence("Tour", asked, service.document)).id
    plan = service.plan(tour)
    assert plan.waypoints is None
    assert plan.source is PlanSource.DRAFT
    assert "Part 2, “Rotate 15°”, has no motion: There is none." in plan.note
    assert [part.source for part in plan.parts] == ["manual", "move", "draft"]
    assert plan.trajectory is not None
    assert np.array_equal(plan.trajectory.contact.T, service.document(tour).timeline.stance)
    with pytest.raises(CheckError, match="Part 2"):
        service.check(tour)


def test_a_gait_that_walks_once_repeats_with_its_own_motion(tmp_path: Path, database: Database) -> None:
    tier = LivePlans(FixedTier(SolveStatus.INFEASIBLE))
    service = GaitService(GaitFiles(tmp_path), database, tier.solve_for)
    walk = gait("walk")
    solved = solve_live(motion_problem(walk, load_robot(walk.robot)))
    content = {
        "iterations": 9, "solve_seconds": 0.5, "max_violation": 1e-9,
        "trajectory": trajectory_content(solved.trajectory),
    }  # fmt: skip
    database.put_result(motion_hash(walk), content)
    once = service.create(made_sequence("Once", [PartReference("walk", 1)], service.document)).id
    assert [part.source for part in service.plan(once).parts] == ["optimised"]
    tour = service.create(made_sequence("Twice", [PartReference("walk", 2)], service.document)).id
    plan = service.plan(tour)
    assert plan.note.endswith("Run once, the gait has a motion: let each repetition start from rest.")
    assert [part.has_own_motion for part in plan.parts] == [True]
    before = service.document(tour)
    from_rest = replace(before, sequence=(replace(before.sequence[0], restarts=True),))
    changed = service.edit(tour, from_rest, "Start from rest", None)
    assert changed.gait.timeline.sample_count == 2 * walk.timeline.sample_count - 1
    plan = service.plan(tour)
    assert [(part.source, part.has_own_motion) for part in plan.parts] == [("optimised", False)]
    assert plan.trajectory is not None
    assert plan.trajectory.body_world[-1, :2] - plan.trajectory.body_world[0, :2] == pytest.approx(
        2 * walk.step_world, abs=1e-6
    )
    assert parse_gait(json.dumps(gait_content(changed.gait))) == changed.gait
    assert motion_hash(changed.gait) != motion_hash(before)
    (parts,) = [group for group in gait_difference(before, changed.gait) if group.title == "Parts"]
    assert "from rest" in parts.sentences[0]


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


def odd_amble() -> Gait:
    """The amble by hand up to where its first foot has stepped and is not home again."""
    made = gait("amble-manual-0")
    table = made.segment_table
    assert table is not None
    rows = tuple(row[:4] for row in table.rows)
    table = replace(table, rows=rows, repeat_to=None, repeat_from=1, link=())
    return replace(made, name="Odd", segment_table=table, timeline=table.timeline(0.4))


def test_feet_step_between_parts_where_they_have_to(service: GaitService) -> None:
    odd = service.create(odd_amble()).id
    tour = service.create(
        made_sequence("x", [PartReference(odd, 1), PartReference("walk", 1)], service.document)
    ).id
    plan = service.plan(tour)
    assert plan.trajectory is not None
    assert np.array_equal(plan.trajectory.contact.T, service.document(tour).timeline.stance)
    assert [(part.is_transition, part.source, part.feet) for part in plan.parts] == [
        (False, "manual", ()),
        (True, "steps", (0,)),
        (False, "live", ()),
    ]
    checked = service.check(tour)
    assert checked.verdict is not None
    assert checked.verdict.passed


def test_steps_that_cannot_be_made_are_named(tmp_path: Path, database: Database) -> None:
    live = LivePlans(FixedTier(SolveStatus.INFEASIBLE))
    service = GaitService(GaitFiles(tmp_path), database, live.solve_for)
    odd = service.create(odd_amble()).id
    asked = [PartReference(odd, 1), PartReference("walk-manual-0", 1)]
    tour = service.create(made_sequence("x", asked, service.document)).id
    note = service.plan(tour).note
    assert "Between Part 1, “Odd” and Part 2, “Manual walk, v0” feet have to step: foot 1 by 10.0 mm" in note
    assert service.plan(tour).waypoints is None
    assert not service.plan(tour).broke_off


def test_a_solver_that_broke_off_is_asked_again(tmp_path: Path, database: Database) -> None:
    tier = FixedTier(SolveStatus.FAILED)
    service = GaitService(
        GaitFiles(tmp_path), database, lambda gait: lambda problem: tier.solve(problem, 1.0)
    )
    tour = service.create(made_sequence("Tour", [PartReference("rotate", 1)], service.document)).id
    assert service.plan(tour).broke_off
    first = service.plan(tour)
    service.ask_again(tour)
    assert service.plan(tour) is not first


def test_a_parts_exact_result_becomes_part_of_the_plan(service: GaitService, tour: str) -> None:
    run_gait = run_of(service.document(tour).sequence[0]).gait
    solved = solve_live(motion_problem(run_gait, load_robot(run_gait.robot)))
    content = {
        "iterations": 9, "solve_seconds": 0.5, "max_violation": 1e-9, "status": "solved",
        "trajectory": trajectory_content(solved.trajectory),
    }  # fmt: skip
    content["provenance"] = asdict(result_provenance(motion_hash(run_gait), content))
    service.check(tour)
    twin = service.create(replace(service.document(tour), name="Twin")).id
    resulted = service.on_result(content, tour)
    assert resulted is not None
    assert (resulted.verdict, resulted.undo_label()) == (None, "Optimise")
    assert [part.source for part in service.plan(tour).parts] == ["optimised", "live", "live"]
    assert [part.source for part in service.plan(twin).parts] == ["live", "live", "live"]
    revision = resulted.revision
    other = run_of(resulted.gait.sequence[2]).gait
    motion = solve_live(motion_problem(other, load_robot(other.robot))).trajectory
    second = {**content, "trajectory": trajectory_content(motion)}
    second["provenance"] = asdict(result_provenance(motion_hash(other), second))
    again = service.on_result(second, tour)
    assert again is not None
    assert again.revision > revision, "an edit of what was seen before does not take the second result away"
    left = service.runs_without_result(again)
    assert [run.name for run in left] == ["Rotate 15°"]
    service.undo(tour)
    assert [part.source for part in service.plan(tour).parts] == ["live", "live", "live"]


def test_five_parts_answer_well_under_a_second() -> None:
    tier = LivePlans(_Here())
    names = ["walk", "rotate", "walk-manual-0", "s-gait", "amble"]
    before = sequence_gait("x", [SequencePart(gait(name), 2, name) for name in names])
    tier.answer(before)
    moved = replace(before, sequence=before.sequence[1:] + before.sequence[:1])
    seconds = []
    for _ in range(3):
        start = time.thread_time()
        answer = tier.answer(changed_gait(before, gait_content(moved)))
        seconds.append(time.thread_time() - start)
    assert min(seconds) < 0.5
    assert len([part for part in answer["plan"]["parts"] if not part["is_transition"]]) == 5


class _Here(FixedTier):
    """The live tier in this process."""

    def __init__(self) -> None:
        super().__init__(SolveStatus.SOLVED)

    def solve(self, problem: MotionProblem, timeout: float) -> MotionResult:
        del timeout
        return solve_live(problem)


def test_the_diagram_names_the_parts_and_how_many_have_no_room() -> None:
    short = sequence_gait("x", [SequencePart(gait("walk"), 3), SequencePart(gait("rotate"))])
    assert (
        facts(short, sample_edges(short, load_robot(short.robot)))
        == "3x Walk 10 mm, 1x Rotate 15°  ·  30.0 mm, turn 15.0°  ·  169 samples of 0.4 s"
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
    plan = service.planned(gait_from_content(content))
    assert plan.trajectory is None
    assert plan.refusal is not None
    assert "Part 3, “S-Gait 10 mm” is for the robot" in plan.refusal.sentence
