"""Plans of sequences: parts with and without a motion, steps between them, and results of the parts."""

from __future__ import annotations

import json
import time
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import pytest

from app.documents.gait_json import gait_content, motion_hash, parse_gait
from app.documents.trajectory_json import trajectory_content
from app.gaits.live_plans import LivePlans, changed_gait
from app.gaits.sequence_documents import (
    PartReference,
    made_sequence,
)
from app.gaits.service import GaitService
from app.plans.plan import PlanSource
from app.plans.provenance import result_provenance
from app.store.database import Database
from app.store.gait_files import GaitFiles
from app.store.tables.result_store import ResultStore
from core.errors import CheckError
from core.gait.gait import Gait, SequencePart, motion_problem
from core.gait.gait_difference import gait_difference
from core.library.library import library
from core.library.sequence import run_of, sequence_gait
from core.problem.motion_problem import MotionProblem
from core.robot.model import load_robot
from solver_jobs import MotionResult, SolveStatus, solve_live
from tests.support.live_tiers import FixedTier


def gait(name: str) -> Gait:
    return library()[name].gait


@pytest.fixture
def service(tmp_path: Path, database: Database) -> GaitService:
    return GaitService(GaitFiles(tmp_path), database, lambda gait: solve_live)


def test_a_part_without_a_motion_is_named(tmp_path: Path, database: Database) -> None:
    tier = LivePlans(FixedTier(SolveStatus.INFEASIBLE))
    service = GaitService(GaitFiles(tmp_path), database, tier.solve_for)
    asked = [PartReference("walk-manual-0", 1), PartReference("rotate", 1)]
    tour = service.create(made_sequence("Tour", asked, service.document)).id
    plan = service.plan(tour)
    assert plan.waypoints is None
    assert plan.source is PlanSource.DRAFT
    assert "Part 2, “Rotate 15°, as in the thesis”, has no motion: There is none." in plan.note
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
    ResultStore(database).put(motion_hash(walk), content)
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
    service.open_gaits.ask_again(tour)
    assert service.plan(tour) is not first


def test_a_parts_exact_result_becomes_part_of_the_plan(service: GaitService) -> None:
    parts = [PartReference("walk", 3), PartReference("rotate", 3), PartReference("s-gait", 2)]
    tour = service.create(made_sequence("Tour", parts, service.document)).id
    run_gait = run_of(service.document(tour).sequence[0]).gait
    solved = solve_live(motion_problem(run_gait, load_robot(run_gait.robot)))
    content = {
        "iterations": 9, "solve_seconds": 0.5, "max_violation": 1e-9, "status": "solved",
        "trajectory": trajectory_content(solved.trajectory),
    }  # fmt: skip
    content["provenance"] = asdict(result_provenance(motion_hash(run_gait), content))
    service.check(tour)
    twin = service.create(replace(service.document(tour), name="Twin")).id
    resulted = service.delivery.on_result(content, tour)
    assert resulted is not None
    assert (resulted.verdict, resulted.undo_label()) == (None, "Optimise")
    assert [part.source for part in service.plan(tour).parts] == ["optimised", "live", "live"]
    assert [part.source for part in service.plan(twin).parts] == ["live", "live", "live"]
    revision = resulted.revision
    other = run_of(resulted.gait.sequence[2]).gait
    motion = solve_live(motion_problem(other, load_robot(other.robot))).trajectory
    second = {**content, "trajectory": trajectory_content(motion)}
    second["provenance"] = asdict(result_provenance(motion_hash(other), second))
    again = service.delivery.on_result(second, tour)
    assert again is not None
    assert again.revision > revision, "an edit of what was seen before does not take the second result away"
    left = service.delivery.runs_without_result(again)
    assert [run.name for run in left] == ["Rotate 15°, as in the thesis"]
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
