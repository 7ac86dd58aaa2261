"""Gaits for the robot's clock: from document to plan, kept in JSON, adapted until they are solved again."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from app.documents.gait_json import gait_content, gait_from_content, motion_hash
from app.gaits.normalise import normalise
from app.gaits.pose_searches import result_content
from app.plans.make_plan import make_plan
from app.plans.plan import PlanSource, verdict_of
from app.plans.provenance import with_found_poses
from app.plans.sequence_plan import plan_of
from core.errors import InputError, StateError
from core.gait.gait import Gait, heading_step
from core.gait.poses import Poses
from core.library.library import library
from core.pose_gaits.gait_poses import drawn_poses, found_gait, new_pose_gait, pose_problem, with_poses
from core.problem.motion_problem import MotionProblem
from core.robot.model import load_robot
from solver_jobs import MotionResult, SolveStatus, solve_live, solve_poses

MODEL = load_robot("deltawalker")


def never_solve(problem: MotionProblem) -> MotionResult:
    raise AssertionError("The live tier is asked for no poses.")


def asked(step: float | None = 0.010, **changes: object) -> Gait:
    gait = library()["c-gait"].gait.with_options(margin=0.006, stop_bound=1.5)
    if step is not None:
        gait = replace(gait, step=heading_step(gait.orientation, step))
    return new_pose_gait("C-gait, fast", replace(gait, **changes), Poses(free_step=step is None), MODEL)  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def solved() -> Gait:
    document = asked()
    result = solve_poses(pose_problem(document, MODEL))
    assert result.gait is not None
    return with_poses(document, result.gait)


@pytest.mark.heavy
def test_found_poses_are_the_plan_and_pass_every_rule(solved: Gait) -> None:
    plan = make_plan(solved, None, never_solve)
    assert plan.source is PlanSource.POSES
    assert plan.trajectory is not None
    assert plan.waypoints is not None
    assert plan.waypoints.count == solved.timeline.sample_count == plan.trajectory.knot_count
    assert len(set(np.round(np.diff(plan.trajectory.times), 3))) > 1
    verdict = verdict_of(plan, solved)
    assert verdict.passed, verdict.findings
    assert plan.trajectory.body_world[-1, 0] == pytest.approx(0.010)


@pytest.mark.parametrize(("gait_id", "pace"), [("fast-c-gait", "2.27 mm/s"), ("fast-turn", "4.48°/s")])
def test_the_note_says_how_fast_a_gait_goes_or_turns(gait_id: str, pace: str) -> None:
    assert f"on the robot, {pace};" in make_plan(library()[gait_id].gait, None, never_solve).note


@pytest.mark.heavy
def test_json_keeps_them(solved: Gait) -> None:
    content = json.loads(json.dumps(gait_content(solved)))
    again = gait_from_content(content)
    assert again == solved
    assert found_gait(again, MODEL) is not None
    content["poses"]["found"]["feet"][0].pop()
    with pytest.raises(InputError, match="needs 4 feet"):
        gait_from_content(content)


@pytest.mark.heavy
def test_a_change_adapts_the_poses_and_asks_for_new_ones(solved: Gait) -> None:
    longer = replace(solved, step=heading_step(solved.orientation, 0.012))
    changed, notice = normalise(solved, longer)
    assert notice is None
    assert motion_hash(changed) != motion_hash(solved)
    plan = make_plan(changed, None, never_solve)
    assert plan.source is PlanSource.ADAPTED
    assert plan.is_draft
    assert plan.trajectory is not None
    assert plan.trajectory.body_world[-1, 0] == pytest.approx(0.012)
    near = plan.poses
    assert near is not None
    result = solve_poses(pose_problem(changed, MODEL), near=near)
    content = result_content(result)
    assert content is not None
    taken = with_found_poses(changed, motion_hash(changed), content)
    assert make_plan(taken, None, never_solve).source is PlanSource.POSES
    assert make_plan(changed, content, never_solve).source is PlanSource.POSES
    # What was asked before is found again without a search.
    assert with_found_poses(changed, motion_hash(solved), content) == changed


@pytest.mark.parametrize("direction", [2, 3, 4])
def test_another_direction_turns_the_poses(solved: Gait, direction: int) -> None:
    turned, _ = normalise(solved, replace(solved, direction=direction))
    poses = drawn_poses(turned, MODEL)
    angle = (direction - 1) * np.pi / 2
    assert poses.bodies[-1, :2] == pytest.approx(0.010 * np.array([np.cos(angle), np.sin(angle)]), abs=1e-7)
    assert not np.array_equal(turned.timeline.stance, solved.timeline.stance)
    before = found_gait(solved, MODEL)
    assert before is not None
    assert poses.moves == pytest.approx(before.moves, abs=1e-6)


def test_more_cycles_have_more_poses_and_no_sample_can_be_drawn(solved: Gait) -> None:
    twice, _ = normalise(solved, replace(solved, iterations=2))
    assert twice.timeline.sample_count > solved.timeline.sample_count
    assert make_plan(twice, None, never_solve).source is PlanSource.ADAPTED
    stance = solved.timeline.stance.copy()
    stance[0, 0] = False
    with pytest.raises(StateError, match="follows from foot order"):
        normalise(solved, replace(solved, timeline=replace(solved.timeline, stance=stance)))


def test_a_step_that_somebody_sets_is_free_no_longer() -> None:
    free = asked(None)
    assert free.poses is not None
    assert free.poses.free_step
    changed, _ = normalise(free, replace(free, step=heading_step(free.orientation, 0.02)))
    assert changed.poses is not None
    assert not changed.poses.free_step
    assert pose_problem(changed, MODEL).step == pytest.approx(0.02)


def test_the_turn_of_a_fast_turn_is_kept_when_somebody_sets_it() -> None:
    turn = library()["fast-turn"].gait
    again, _ = normalise(turn, replace(turn, iterations=2))
    assert again.poses is not None
    assert again.poses.free_step
    changed, _ = normalise(turn, replace(turn, step=(0.0, 0.0, 0.3)))
    assert changed.poses is not None
    assert not changed.poses.free_step
    with pytest.raises(InputError, match="has to go somewhere or to turn"):
        normalise(turn, replace(turn, step=(0.0, 0.0, 0.0)))


def test_a_gait_that_turns_has_no_pinned_poses_and_says_that_soles_pivot() -> None:
    plan = plan_of(library()["fast-curve-right"].gait, lambda motion: None, lambda gait: solve_live)
    assert plan.poses is not None
    assert not plan.poses.problem.is_pinnable
    assert "Soles pivot" in plan.note
    turn = plan_of(library()["fast-turn"].gait, lambda motion: None, lambda gait: solve_live)
    assert "°/s" in turn.note


@pytest.mark.heavy
def test_a_search_without_an_answer_says_why() -> None:
    document = asked(0.15)
    result = solve_poses(pose_problem(document, MODEL))
    assert result.status is SolveStatus.INFEASIBLE
    plan = make_plan(document, result_content(result), never_solve)
    assert plan.source is PlanSource.DRAFT if plan.trajectory is None else PlanSource.ADAPTED
    assert "too long" in plan.note or plan.refusal is not None


@pytest.mark.parametrize(
    ("change", "words"),
    [({"step": (0.01, 0.0, 2.5)}, "--turn"), ({"step": (0.0, 0.0, 0.0)}, "has to go somewhere")],
)
def test_what_such_a_gait_cannot_have_is_refused(solved: Gait, change: dict[str, object], words: str) -> None:
    with pytest.raises(InputError, match=words):
        normalise(solved, replace(solved, **change))  # type: ignore[arg-type]
