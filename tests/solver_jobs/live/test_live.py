"""The live tier: motions that the checker confirms, proofs, and words for what is missing."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from core.gait.gait import drawn_timeline, heading_step, motion_problem
from core.gait.options import GaitOptions
from core.library.library import library
from core.motion.contact_timeline import ContactTimeline, timeline_from_order
from core.motion.heading_profile import HeadingProfile
from core.motion.trajectory import turn_trajectory
from core.problem.motion_check import check_motion
from core.problem.motion_problem import Boundary, MotionProblem, Workspace
from core.robot.model import load_robot
from solver_jobs.live.solve import quick_motion, solve_live
from solver_jobs.nlp.motion_nlp import solve_motion
from solver_jobs.results.motion import Evidence, MotionResult, SolveStatus
from tests.support.solvers.cases import BARE, GAITS, gait_problem

MODEL = load_robot("deltawalker")
STEPPERS = tuple(name for name in GAITS if library()[name].gait.step[2] == 0.0)


def asked(gait: str, step: float, **options: Any) -> MotionProblem:
    """A built-in gait drawn anew with a step and options."""
    chosen = library()[gait].gait
    gait_options = replace(GaitOptions(), **options)
    wanted = replace(chosen, step=heading_step(chosen.orientation, step), options=gait_options)
    return motion_problem(replace(wanted, timeline=drawn_timeline(wanted)), MODEL)


def expect_solved(problem: MotionProblem) -> MotionResult:
    result = solve_live(problem)
    assert result.status is SolveStatus.SOLVED, result.explanation
    check = check_motion(problem, result.trajectory)
    assert check.confirmed, check.violations
    assert check.min_cop_margin > problem.limits.margin - 1e-9
    return result


@pytest.mark.parametrize("gait", STEPPERS)
@pytest.mark.parametrize("workspace", list(Workspace))
def test_every_built_in_gait_is_solved_and_confirmed(gait: str, workspace: Workspace) -> None:
    expect_solved(gait_problem(gait, 0.015, workspace))


@pytest.mark.parametrize("gait", STEPPERS)
def test_it_agrees_with_the_exact_tier_and_costs_little_more(gait: str) -> None:
    problem = gait_problem(gait, 0.015, Workspace.STROKE)
    live, exact = expect_solved(problem), solve_motion(problem)
    assert exact.status is SolveStatus.SOLVED
    assert live.objective is not None
    assert exact.objective is not None
    assert exact.objective - 1e-9 <= live.objective <= 1.1 * exact.objective


def test_more_is_confirmed_when_it_is_asked_for() -> None:
    expect_solved(asked("walk", 0.010, margin=0.003, boundary=Boundary.PERIODIC))
    expect_solved(asked("walk", 0.010, friction=0.05))
    expect_solved(asked("walk", 0.010, margin=0.003, motor_speed=0.015, motor_acceleration=0.015))
    expect_solved(asked("walk", 0.010, plane_height=0.0535, end_plane_height=0.058))
    expect_solved(asked("walk", 0.010, clearance=0.005, workspace=Workspace.CYLINDER))
    expect_solved(asked("walk", 0.010, closing_knots=0))


def test_three_iterations_and_a_turn_are_one_problem() -> None:
    walk = replace(library()["walk"].gait, options=GaitOptions(margin=0.003))
    thrice = replace(walk, step=heading_step(walk.orientation, 0.020), iterations=3)
    expect_solved(motion_problem(replace(thrice, timeline=drawn_timeline(thrice)), MODEL))
    expect_solved(motion_problem(replace(walk, step=(0.006, 0.004, 0.1)), MODEL))


@pytest.mark.parametrize("degrees", [15, 20, -15])
def test_rotation_in_place_ends_turned(degrees: float) -> None:
    options = GaitOptions(turning=HeadingProfile.RETURN, motor_speed=MODEL.stroke.speed, margin=0.003)
    gait = replace(library()["c-gait"].gait, step=(0.0, 0.0, float(np.radians(degrees))), options=options)
    motion = expect_solved(motion_problem(gait, MODEL)).trajectory
    assert motion.heading[-1] == pytest.approx(np.radians(degrees))
    assert not motion.heading[:-5].any()


def test_two_feet_may_be_in_the_air_where_a_line_carries_the_robot() -> None:
    stance = np.ones((4, 30), dtype=np.bool_)
    stance[[0, 2], 5:9] = False
    stance[[1, 3], 18:22] = False
    walk = replace(library()["walk"].gait, step=heading_step(library()["walk"].gait.orientation, 0.004))
    trot = replace(walk, options=GaitOptions(), timeline=ContactTimeline(stance, np.zeros_like(stance), 0.4))
    expect_solved(motion_problem(trot, MODEL))


@pytest.mark.parametrize(("robot", "legs"), [("hexapod", 6), ("dodecapod", 12)])
def test_more_legs_walk_too(robot: str, legs: int) -> None:
    order = tuple(range(1, legs + 1))
    timeline = timeline_from_order(legs, order, phase_knots=4)
    gait = replace(library()["s-gait"].gait, robot=robot, order=order, timeline=timeline)
    expect_solved(motion_problem(gait, load_robot(robot)))


@pytest.mark.parametrize("quarter_turns", [1, 2, 3])
def test_directions_give_the_same_answer(quarter_turns: int) -> None:
    problem = gait_problem("amble", 0.015, Workspace.CYLINDER)
    turned = expect_solved(problem.turned(quarter_turns)).trajectory
    wanted = turn_trajectory(expect_solved(problem).trajectory, quarter_turns)
    np.testing.assert_allclose(turned.body_world, wanted.body_world, atol=1e-9)
    np.testing.assert_allclose(turned.feet_world, wanted.feet_world, atol=1e-9)


def test_a_step_that_feet_are_too_slow_for_lacks_exactly_that_speed() -> None:
    # Five knots of 0.4 s: 30 mm need 75 mm/s in all. Rising 3 mm takes 3.75 mm/s up and down at four of them,
    # which leaves √(15² − 3.75²) each, and 15 at the fifth.
    problem = gait_problem("walk", 0.030, Workspace.STROKE)
    result = solve_live(replace(problem, model=BARE))
    assert result.status is SolveStatus.INFEASIBLE
    assert result.evidence is Evidence.PROVEN
    lacking = 75.0 - 4 * np.sqrt(15.0**2 - 3.75**2) - 15.0
    for lack in result.lacks:
        assert lack.family == "foot_speed"
        assert lack.amount == pytest.approx(lacking, abs=0.01)
    assert {(lack.feet, lack.first, lack.last) for lack in result.lacks} == {
        ((2,), 5, 9),
        ((1,), 15, 19),
        ((3,), 25, 29),
        ((0,), 35, 39),
    }
    assert "foot 3" in " ".join(lack.sentence for lack in result.lacks)


def test_feet_are_named_in_the_gaits_own_direction() -> None:
    problem = gait_problem("s-gait", 0.020, Workspace.CYLINDER)
    straight, turned = solve_live(problem), solve_live(problem.turned(1))
    for lack, other in zip(straight.lacks, turned.lacks, strict=True):
        assert other.feet == tuple((foot + 1) % 4 for foot in lack.feet)
        assert other.amount == pytest.approx(lack.amount, rel=1e-6)
    assert "with foot 1 in the air" in " ".join(straight.explanation)
    assert "with foot 2 in the air" in " ".join(turned.explanation)


@pytest.mark.heavy
@pytest.mark.parametrize("gait", ["amble", "s-gait", "c-gait"])
def test_what_it_proves_infeasible_the_exact_tier_cannot_solve(gait: str) -> None:
    problem = gait_problem(gait, 0.020, Workspace.CYLINDER)
    live = solve_live(problem)
    assert live.evidence is Evidence.PROVEN
    assert live.explanation[-1] == "This is proven: no motion of the model can do it."
    assert solve_motion(problem).status is SolveStatus.INFEASIBLE


def test_what_bounds_rule_out_needs_no_search() -> None:
    result = solve_live(asked("walk", 0.025, closing_knots=0))
    assert (result.status, result.evidence) == (SolveStatus.INFEASIBLE, Evidence.PROVEN)
    assert "Foot 1 has to travel 25.0 mm" in result.explanation[0]
    assert (result.lacks[0].family, result.lacks[0].feet, result.lacks[0].first) == ("foot_speed", (0,), 35)


def test_where_no_foot_stands_there_is_no_nearest_motion() -> None:
    problem = gait_problem("walk", 0.010, Workspace.STROKE)
    stance = np.array(problem.timeline.stance)
    stance[:, 12] = False
    falling = replace(problem, timeline=ContactTimeline(stance, np.zeros_like(stance), 0.4))
    result = solve_live(falling)
    assert result.evidence is Evidence.PROVEN
    assert "No foot stands at sample 13" in result.explanation[0]


def test_a_start_out_of_reach_is_said_and_not_solved() -> None:
    result = solve_live(asked("walk", 0.010, plane_height=0.0605, workspace=Workspace.CYLINDER))
    assert result.status is SolveStatus.SOLVED
    problem = asked("walk", 0.010)
    far = replace(problem.start, feet_world=problem.start.feet_world + np.array([0.030, 0.0, 0.0]))
    result = solve_live(replace(problem, start=far))
    assert result.status is SolveStatus.INFEASIBLE
    assert result.lacks[0].family == "workspace"


def test_the_quick_answer_is_a_motion_or_none() -> None:
    problem = gait_problem("walk", 0.010, Workspace.STROKE).turned(1)
    motion = quick_motion(problem)
    assert motion is not None
    assert check_motion(problem, motion).confirmed
    assert quick_motion(gait_problem("walk", 0.030, Workspace.STROKE)) is None
    assert quick_motion(asked("walk", 0.025, closing_knots=0)) is None


@pytest.mark.parametrize("direction", [1, 2, 3, 4])
def test_six_legs_walk_in_every_direction(direction: int) -> None:
    order = (1, 2, 3, 4, 5, 6)
    timeline = timeline_from_order(6, order, phase_knots=4)
    gait = replace(library()["s-gait"].gait, robot="hexapod", order=order, timeline=timeline)
    problem = motion_problem(replace(gait, direction=direction), load_robot("hexapod"))
    motion = expect_solved(problem).trajectory
    np.testing.assert_allclose(motion.body_world[-1, :2], problem.goal.body_world[:2], atol=1e-12)


@pytest.mark.parametrize("clearance", [0.003, 0.004])
def test_a_swing_from_the_first_knot_has_its_own_middle(clearance: float) -> None:
    problem = asked("walk", 0.0, clearance=clearance)
    stance = np.ones((4, 12), dtype=np.bool_)
    stance[0, 0:4] = False
    swinging = replace(problem, timeline=ContactTimeline(stance, np.zeros_like(stance), 0.4))
    expect_solved(swinging)
    assert solve_motion(swinging).status is SolveStatus.SOLVED


def test_one_foot_carries_nothing_but_itself() -> None:
    problem = asked("walk", 0.004)
    stance = np.array(problem.timeline.stance)
    stance[1:, 10:13] = False
    balancing = replace(problem, timeline=ContactTimeline(stance, np.zeros_like(stance), 0.4))
    result = solve_live(balancing)
    assert result.status is SolveStatus.INFEASIBLE
    assert any(lack.family == "body_torque" and lack.feet == (0, 0) for lack in result.lacks)


@pytest.mark.heavy
@pytest.mark.parametrize("gait", STEPPERS)
def test_every_answer_up_to_the_edge_is_a_motion_or_a_sentence(gait: str) -> None:
    low, high = 0.010, 0.035
    for _ in range(14):
        middle = (low + high) / 2
        problem = gait_problem(gait, middle, Workspace.STROKE)
        result = solve_live(problem)
        solved = result.status is SolveStatus.SOLVED
        assert solved or result.explanation
        assert not solved or check_motion(problem, result.trajectory).confirmed
        low, high = (middle, high) if solved else (low, middle)
    assert 0.020 < low < 0.030


@pytest.mark.parametrize("acceleration", [0.006, 0.010, 0.015])
def test_motor_limits_are_kept_or_explained(acceleration: float) -> None:
    for step in (0.008, 0.014):
        problem = asked("walk", step, motor_speed=0.012, motor_acceleration=acceleration, margin=0.002)
        result = solve_live(problem)
        assert result.status is not SolveStatus.FAILED
        assert result.explanation or check_motion(problem, result.trajectory).confirmed
