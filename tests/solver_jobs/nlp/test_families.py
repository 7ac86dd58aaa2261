"""The whole problem family in the exact tier: each demand is kept where it is asked for."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from core.gait.gait import heading_step, motion_problem
from core.gait.options import GaitOptions
from core.library.library import library
from core.motion.contact_timeline import timeline_from_order
from core.motion.heading_profile import HeadingProfile
from core.problem.motion_check import check_motion
from core.problem.motion_problem import Boundary, MotionProblem, Workspace
from core.robot.model import load_robot
from solver_jobs import Evidence, MotionResult, SolveStatus
from solver_jobs.nlp.motion_nlp import solve_motion
from tests.support.solvers.cases import BARE


def asked(
    gait: str = "walk", step: float = 0.010, yaw: float = 0.0, closing_knots: int = 5, **options: Any
) -> MotionProblem:
    """One iteration of a built-in gait with these options."""
    chosen = library()[gait].gait
    timeline = timeline_from_order(4, chosen.order, closing_knots=closing_knots)
    dx, dy, _ = heading_step(chosen.orientation, step)
    changed = replace(chosen, step=(dx, dy, yaw), timeline=timeline, options=GaitOptions(**options))
    return motion_problem(changed, load_robot(chosen.robot))


def confirmed(problem: MotionProblem) -> MotionResult:
    """Solved, and every family confirmed by the checker."""
    result = solve_motion(problem)
    assert result.status is SolveStatus.SOLVED, result.explanation
    check = check_motion(problem, result.trajectory)
    assert check.confirmed, check.violations
    return result


@pytest.mark.parametrize("workspace", list(Workspace))
@pytest.mark.parametrize("yaw_deg", [-15, 20])
def test_the_body_turns_while_it_walks(workspace: Workspace, yaw_deg: float) -> None:
    problem = asked(yaw=np.radians(yaw_deg), workspace=workspace)
    motion = confirmed(problem).trajectory
    np.testing.assert_array_equal(motion.heading, problem.heading)
    assert np.degrees(motion.heading[-1]) == pytest.approx(yaw_deg)


def test_rotation_in_place_returns_within_the_motors_limits() -> None:
    problem = asked(
        step=0.0, yaw=np.radians(15), closing_knots=12, turning=HeadingProfile.RETURN, motor_speed=0.015
    )
    confirmed(problem)


def test_a_heading_is_seen_by_reach() -> None:
    with_turn = asked(step=0.0, yaw=np.radians(25), workspace=Workspace.CYLINDER)
    without = replace(with_turn, heading_profile=None)
    confirmed(with_turn)
    assert solve_motion(without).status is SolveStatus.INFEASIBLE


@pytest.mark.parametrize("gait", ["walk", "c-gait"])
def test_forces_stay_in_the_friction_cone(gait: str) -> None:
    free = asked(gait, step=0.015, margin=0.002)
    problem = replace(free, limits=replace(free.limits, friction=0.003))
    assert check_motion(problem, solve_motion(free).trajectory).violations["friction"] > 5e-4
    confirmed(problem)


@pytest.mark.parametrize("margin", [0.0, 0.003])
def test_a_friction_cone_does_not_slow_the_search(margin: float) -> None:
    assert confirmed(asked(friction=0.3, margin=margin)).iteration_count <= 25


@pytest.mark.parametrize(("limit", "value"), [("motor_speed", 0.007), ("motor_acceleration", 0.008)])
def test_motors_keep_their_limits(limit: str, value: float) -> None:
    options: dict[str, Any] = {limit: value}
    problem = asked(**options)
    assert check_motion(problem, solve_motion(asked()).trajectory).violations[limit] > 1e-4
    confirmed(problem)


def test_motor_limits_hold_while_the_body_turns() -> None:
    confirmed(asked(yaw=0.2, motor_speed=0.015, motor_acceleration=0.025, margin=0.003, friction=0.5))


@pytest.mark.heavy
def test_what_motors_cannot_do_is_named_with_the_foot() -> None:
    result = solve_motion(asked(motor_speed=0.001))
    assert result.status is SolveStatus.INFEASIBLE
    assert result.lacks[0].family == "motor_speed"
    assert result.lacks[0].unit == "mm/s"
    assert len(result.lacks[0].feet) == 1


@pytest.mark.parametrize("gait", ["walk", "s-gait"])
def test_a_cycle_ends_as_it_began(gait: str) -> None:
    problem = asked(gait, boundary=Boundary.PERIODIC)
    result = confirmed(problem)
    motion = result.trajectory
    assert motion.body_velocity is not None
    assert np.linalg.norm(motion.body_velocity[0]) > 1e-3
    rested = confirmed(asked(gait)).objective
    assert result.objective is not None
    assert rested is not None
    assert result.objective < rested


def test_knots_may_lie_unevenly() -> None:
    problem = asked(yaw=0.1, motor_speed=0.015, motor_acceleration=0.03)
    durations = np.linspace(0.3, 0.5, problem.knot_count - 1)
    motion = confirmed(replace(problem, durations=durations)).trajectory
    np.testing.assert_allclose(np.diff(motion.times), durations)


@pytest.mark.parametrize("workspace", list(Workspace))
def test_two_feet_may_be_in_the_air_together(workspace: Workspace) -> None:
    problem = asked(step=0.004, clearance=0.002, workspace=workspace)
    stance = np.ones((4, 34), dtype=np.bool_)
    stance[[0, 2], 8:12] = False
    stance[[1, 3], 20:24] = False
    drawn = replace(problem, timeline=replace(problem.timeline, stance=stance, locked=np.zeros_like(stance)))
    motion = confirmed(drawn).trajectory
    assert (motion.contact.sum(axis=1) == 2).sum() == 8


def test_the_end_may_be_higher_than_the_start() -> None:
    motion = confirmed(asked(end_plane_height=0.056)).trajectory
    assert motion.body_world[-1, 2] - motion.body_world[0, 2] == pytest.approx(0.0025)


@pytest.mark.heavy
def test_a_lack_names_feet_and_knots_of_the_gaits_own_direction() -> None:
    turns = 3
    problem = asked("amble", step=0.025, workspace=Workspace.CYLINDER, margin=0.003)
    first = solve_motion(problem)
    turned = solve_motion(problem.turned(turns))
    assert turned.evidence is Evidence.DIAGNOSED
    assert [lack.family for lack in turned.lacks] == [lack.family for lack in first.lacks]
    for lack, wanted in zip(turned.lacks, first.lacks, strict=True):
        assert lack.feet == tuple((foot + turns) % 4 for foot in wanted.feet)
        assert (lack.first, lack.last) == (wanted.first, wanted.last)
        assert 0 <= lack.first <= lack.last < problem.knot_count
        assert all(f"foot {foot + 1}" in lack.sentence for foot in lack.feet)


def test_a_swing_too_slow_for_its_height_and_way_is_explained() -> None:
    result = solve_motion(replace(asked(step=0.030), model=BARE))
    assert result.status is SolveStatus.INFEASIBLE
    assert result.evidence is Evidence.DIAGNOSED
    assert "foot speed" in result.explanation[0]
    assert result.lacks[0].family == "foot_speed"
