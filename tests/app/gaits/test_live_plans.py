"""The live service: documents in, checked answers out, and nothing on the service changed."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from app.documents.gait_json import gait_content
from app.gaits.live_plans import (
    FAILED_SECONDS,
    FIRST_SECONDS,
    MOST_PLANS,
    NEXT_SECONDS,
    LivePlans,
    changed_gait,
)
from app.gaits.normalise import normalise
from app.gaits.views import plan_view
from app.jobs.timing_view import timing_content
from app.plans.make_plan import make_plan
from app.plans.reach_outline_view import CORNERS, reach_rings
from core.errors import InputError, StateError
from core.gait.gait import Gait, heading_step, motion_problem
from core.library.library import library
from core.problem.initial_guess import initial_guess
from core.problem.motion_problem import MotionProblem, Workspace
from core.robot.kinematics import BodyPose, feet_in_modules
from core.robot.leg import strokes_from_foot
from core.robot.model import load_robot
from solver_jobs import MotionResult, SolveStatus, TimingResult, solve_live
from tests.support.live_tiers import LACK, FixedTier, result_of

WALK = library()["walk"].gait


class RealTier(FixedTier):
    """The live tier itself."""

    def solve(self, problem: MotionProblem, timeout: float) -> MotionResult:
        """Solves in this process."""
        assert timeout > 0
        self.asked += 1
        return solve_live(problem)


def tiers() -> tuple[RealTier, LivePlans]:
    tier = RealTier(SolveStatus.SOLVED)
    return tier, LivePlans(tier)


def toggled(gait: Gait, foot: int, sample: int) -> Gait:
    stance = gait.timeline.stance.copy()
    stance[foot, sample] = not stance[foot, sample]
    return replace(gait, timeline=replace(gait.timeline, stance=stance))


def document(gait: Gait, **changes: Any) -> dict[str, Any]:
    return gait_content(gait) | changes


def test_a_feasible_document_is_answered_with_a_checked_plan() -> None:
    _, service = tiers()
    answer = service.answer(changed_gait(WALK, document(WALK, step=[0.011, 0.011, 0.0])))
    assert (answer["status"], answer["method"]) == ("solved", "live")
    assert answer["check"]["max_violation"] <= 1e-6
    assert answer["plan"]["source"] == "live"
    assert len(answer["plan"]["margin"]) == WALK.timeline.sample_count
    json.dumps(answer, allow_nan=False)


def test_an_infeasible_document_says_what_is_missing() -> None:
    service = LivePlans(FixedTier(SolveStatus.INFEASIBLE))
    answer = service.answer(WALK)
    assert (answer["status"], answer["evidence"]) == ("infeasible", "proven")
    lack = answer["lacks"][0]
    assert (lack["family"], lack["first"], lack["last"], lack["feet"]) == ("workspace", 5, 9, [2])
    assert answer["plan"]["source"] == "draft"
    json.dumps(answer, allow_nan=False)


def test_only_the_first_answer_of_a_process_may_take_long() -> None:
    tier = FixedTier(SolveStatus.INFEASIBLE)
    service = LivePlans(tier)
    for name, process in ((1, 7), (2, 7), (3, 8), (4, 8), (5, None)):
        tier.process_id = process
        service.answer(changed_gait(WALK, document(WALK, step=[0.001 * name, 0.0, 0.0])))
    assert tier.waits == [FIRST_SECONDS, NEXT_SECONDS, FIRST_SECONDS, NEXT_SECONDS, FIRST_SECONDS]


def test_a_process_that_gave_no_answer_is_still_waited_for() -> None:
    tier = FixedTier(SolveStatus.FAILED)
    service = LivePlans(tier)
    for step in (0.001, 0.002):
        service.answer(changed_gait(WALK, document(WALK, step=[step, 0.0, 0.0])))
    assert tier.waits == [FIRST_SECONDS, FIRST_SECONDS]


def test_a_solver_that_broke_off_is_left_alone_for_a_moment() -> None:
    tier, now = FixedTier(SolveStatus.FAILED), [100.0]
    service = LivePlans(tier, lambda: now[0])
    assert service.answer(WALK)["status"] == "failed"
    tier.status = SolveStatus.INFEASIBLE
    now[0] += FAILED_SECONDS - 0.1
    assert service.answer(WALK)["status"] == "failed"
    assert tier.asked == 1
    now[0] += 0.2
    assert service.answer(WALK)["status"] == "infeasible"
    assert tier.asked == 2


@pytest.mark.parametrize("direction", [1, 2, 3, 4])
def test_a_drawn_gait_turns_with_its_direction_and_its_answer_with_it(direction: int) -> None:
    _, service = tiers()
    swing = WALK.timeline.swings()[1]
    drawn = toggled(WALK, swing.foot, swing.last)
    straight = service.answer(drawn)
    turned = service.answer(changed_gait(drawn, document(drawn, direction=direction)))
    assert turned["status"] == straight["status"] == "solved"
    one, other = (np.array(answer["plan"]["contact"]) for answer in (straight, turned))
    assert (np.roll(one, direction - 1, axis=1) == other).all()
    assert turned["plan"]["margin"] == pytest.approx(straight["plan"]["margin"], abs=1e-6)
    body = np.array(straight["plan"]["body"])[-1, :2]
    for _ in range(direction - 1):
        body = np.array([-body[1], body[0]])
    assert np.array(turned["plan"]["body"])[-1, :2] == pytest.approx(body, abs=1e-6)


def test_locks_turn_with_the_direction_and_it_can_be_turned_back() -> None:
    locked = WALK.timeline.locked.copy()
    locked[1, 20] = True
    before = replace(WALK, timeline=replace(WALK.timeline, locked=locked))
    turned, _ = normalise(before, replace(before, direction=3))
    assert np.argwhere(turned.timeline.locked).tolist() == [[3, 20]]
    back, _ = normalise(turned, replace(turned, direction=1))
    assert back == before


def test_a_plan_that_differs_in_its_heading_alone_has_another_hash() -> None:
    plan = make_plan(WALK, None, lambda problem: result_of(problem, SolveStatus.INFEASIBLE))
    assert plan.trajectory is not None
    turned = replace(plan.trajectory, heading=plan.trajectory.heading + 0.1)
    assert replace(plan, trajectory=turned).session_hash != plan.session_hash


@pytest.mark.parametrize(("status", "is_known"), [(SolveStatus.SOLVED, True), (SolveStatus.FAILED, False)])
def test_only_a_timing_that_was_found_has_a_violation(status: SolveStatus, is_known: bool) -> None:
    problem = motion_problem(WALK, load_robot(WALK.robot))
    trajectory = initial_guess(problem)
    timing = TimingResult(status, (), 16.0, 16.0, 0.1, 3, problem, trajectory, ())
    content = timing_content(WALK, timing)
    assert (content["max_violation"] is not None) is is_known
    assert (content["min_cop_margin"] is not None) is is_known


def test_a_motion_that_was_found_already_is_not_asked_for_again() -> None:
    tier, service = tiers()
    plan = service.plan_with(WALK, solve_live(motion_problem(WALK, load_robot(WALK.robot))))
    assert tier.asked == 0
    assert service.plan(WALK).session_hash == plan.session_hash
    assert tier.asked == 0


def test_a_gait_made_by_hand_is_planned_without_the_live_tier() -> None:
    tier, service = tiers()
    answer = service.answer(library()["walk-manual-0"].gait)
    assert (answer["method"], answer["status"]) == ("table", "manual")
    assert tier.asked == 0


def test_the_same_motion_is_asked_for_once() -> None:
    tier, service = tiers()
    first = service.answer(WALK)
    again = service.answer(changed_gait(WALK, document(WALK, name="Another name")))
    assert tier.asked == 1
    assert first["plan"]["hash"] == again["plan"]["hash"]


def test_bad_documents_are_refused_with_a_sentence() -> None:
    _, service = tiers()
    with pytest.raises(InputError, match="not a gait document"):
        service.answer(changed_gait(WALK, {"step": [1, 2, 3]}))
    with pytest.raises(InputError, match="at most 200 mm"):
        service.answer(changed_gait(WALK, document(WALK, step=[10.0, 0.0, 0.0])))
    rows = document(WALK)["timeline"]["feet"]
    floating = {"sample_time": 0.4, "feet": [rows[0][:-1] + "0", *rows[1:]]}
    with pytest.raises(InputError, match="Foot 1 is in the air at the last sample"):
        service.answer(changed_gait(WALK, document(WALK, timeline=floating)))


def test_a_locked_cell_holds_in_a_live_document_too() -> None:
    _, service = tiers()
    locked = WALK.timeline.locked.copy()
    locked[1, 20] = True
    before = replace(WALK, timeline=replace(WALK.timeline, locked=locked))
    changed = gait_content(before)
    changed["timeline"]["feet"][1] = changed["timeline"]["feet"][1][:20] + "0" + "1" * 24
    with pytest.raises(StateError, match="Foot 2, sample 21 is locked"):
        service.answer(changed_gait(before, changed))


def test_more_iterations_are_drawn_as_an_edit_would() -> None:
    service = LivePlans(FixedTier(SolveStatus.INFEASIBLE))
    answer = service.answer(changed_gait(WALK, document(WALK, iterations=2)))
    assert len(answer["plan"]["times"]) == 85


def test_the_newest_plans_are_kept_by_hash_and_older_ones_make_room() -> None:
    service = LivePlans(FixedTier(SolveStatus.INFEASIBLE))
    hashes = [
        service.answer(replace(WALK, step=heading_step(WALK.orientation, step)))["plan"]["hash"]
        for step in np.linspace(0.001, 0.02, MOST_PLANS + 1)
    ]
    assert service.kept(hashes[-1]).session_hash == hashes[-1]
    assert service.kept(hashes[1]).trajectory is not None
    with pytest.raises(StateError, match="changed meanwhile"):
        service.kept(hashes[0])


def test_a_plan_beyond_the_strokes_still_shows_what_strokes_it_needs() -> None:
    far = replace(WALK, step=heading_step(WALK.orientation, 0.06))
    plan = make_plan(far, None, lambda problem: result_of(problem, SolveStatus.INFEASIBLE))
    assert plan.waypoints is None
    strokes = [value for row in plan_view(plan)["strokes_mm"] for value in row if value is not None]
    assert max(strokes) > 19.5 or min(strokes) < 0.5


@pytest.mark.parametrize("workspace", list(Workspace))
def test_the_outline_of_reach_is_drawn_round_the_module_and_a_foot_within_reaches(
    workspace: Workspace,
) -> None:
    gait = replace(WALK, options=replace(WALK.options, workspace=workspace))
    model = load_robot(gait.robot)
    problem = motion_problem(gait, model)
    trajectory = result_of(problem, SolveStatus.INFEASIBLE).trajectory
    rings = reach_rings(problem, trajectory, replace(LACK, first=0, last=1))
    assert rings is not None
    assert np.shape(rings) == (2, CORNERS, 2)
    if workspace is Workspace.CYLINDER:
        radii = np.linalg.norm(np.array(rings[0]) - problem.start.feet_world[2, :2], axis=1)
        assert radii == pytest.approx(0.0135, abs=2e-5)
        return
    feet = np.repeat(trajectory.feet_world[:1], CORNERS, axis=0)
    feet[:, 2, :2] = np.array(rings[0])
    pose = BodyPose(np.repeat(trajectory.pose(model).position_world[:1], CORNERS, axis=0), np.zeros(CORNERS))
    strokes = strokes_from_foot(model.leg, feet_in_modules(model, feet, pose))[:, 2]
    assert strokes.max(axis=1) == pytest.approx(model.stroke.upper, abs=3e-5)


def test_a_lack_of_the_body_has_no_outline() -> None:
    problem = motion_problem(WALK, load_robot(WALK.robot))
    trajectory = result_of(problem, SolveStatus.INFEASIBLE).trajectory
    assert reach_rings(problem, trajectory, replace(LACK, family="body_torque", feet=())) is None
