"""The exact tier: what converges, what is refused and how, cancel, symmetry."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.gait.options import GaitOptions
from core.motion.contact_timeline import timeline_from_order, timeline_from_rows
from core.motion.support_polygon import centre_of_pressure, stability_margins
from core.motion.trajectory import Trajectory, turn_trajectory
from core.problem.motion_problem import Cost, MotionProblem, RestPose, Workspace, standing_pose
from core.robot.model import load_robot
from solver_jobs import Evidence, Iterate, MotionResult, SolveStatus
from solver_jobs.nlp.motion_nlp import solve_motion
from tests.support.solvers.cases import GAITS, gait_problem


def expect_solved(result: MotionResult) -> Trajectory:
    assert result.status is SolveStatus.SOLVED, result.explanation
    assert result.solver_word == "Solve_Succeeded"
    assert result.explanation == ()
    assert result.evidence is None
    assert result.objective is not None
    return result.trajectory


def pressure_margin(problem: MotionProblem, motion: Trajectory) -> float:
    """Smallest distance of the centre of pressure to the support polygon's edge, m."""
    assert motion.body_velocity is not None
    assert motion.feet_velocity is not None
    interval, masses = problem.timeline.sample_time, problem.model.masses
    pressure = centre_of_pressure(
        motion.body_world[:-1],
        np.diff(motion.body_velocity, axis=0) / interval,
        np.diff(motion.feet_velocity, axis=0) / interval,
        masses.body,
        masses.foot,
    )
    return float(stability_margins(pressure, motion.feet_world[:-1], motion.contact[:-1]).min())


@pytest.mark.parametrize("workspace", list(Workspace))
@pytest.mark.parametrize("step", [0.010, 0.015])
@pytest.mark.parametrize("gait", GAITS)
def test_every_gait_converges(gait: str, step: float, workspace: Workspace) -> None:
    problem = gait_problem(gait, step, workspace)
    result = solve_motion(problem)
    motion = expect_solved(result)
    np.testing.assert_allclose(motion.feet_world[-1], problem.goal.feet_world, atol=1e-12)
    np.testing.assert_allclose(motion.body_world[-1], problem.goal.body_world, atol=1e-12)
    assert result.iteration_count <= 40
    assert [iterate.number for iterate in result.iterations] == list(range(len(result.iterations)))
    assert result.iterations[-1].primal_infeasibility < 1e-8


def test_the_optimum_is_no_worse_in_the_wider_workspace() -> None:
    costs = [solve_motion(gait_problem("walk", 0.020, workspace)).objective for workspace in Workspace]
    cylinder, stroke = costs
    assert cylinder is not None
    assert stroke is not None
    assert stroke < cylinder


def test_an_edited_timeline_is_what_is_solved() -> None:
    rows = [
        "1111111100000001111111111111111111111111111111111111",
        "1111111111111111111111111000000000011111111111111111",
        "1111000111111111111111111111111111111111111111111111",
        "1111111111111111111100001111111111111111111111111111",
    ]
    timeline = timeline_from_rows(rows, 0.4)
    problem = replace(gait_problem("walk", 0.008, Workspace.STROKE), timeline=timeline)
    motion = expect_solved(solve_motion(problem))
    np.testing.assert_array_equal(motion.contact, timeline.contact)
    moving = np.linalg.norm(np.diff(motion.feet_world, axis=0), axis=-1) > 1e-9
    both_down = motion.contact[1:] & motion.contact[:-1]
    assert moving.any(axis=0).all()
    assert not moving[both_down].any()


def test_every_order_of_feet_gets_an_answer() -> None:
    model = load_robot("deltawalker")
    for order in [(1, 3, 2, 4), (2, 4, 1, 3), (4, 3, 2, 1), (2, 1, 3, 4)]:
        timeline = timeline_from_order(model.leg_count, order)
        problem = replace(gait_problem("walk", 0.010, Workspace.STROKE), timeline=timeline)
        expect_solved(solve_motion(problem))


def test_the_stability_margin_is_kept_where_it_is_asked_for() -> None:
    problem = gait_problem("walk", 0.010, Workspace.STROKE)
    result = solve_motion(replace(problem, limits=replace(problem.limits, margin=0.003)))
    free = solve_motion(problem)
    expect_solved(result)
    assert pressure_margin(problem, result.trajectory) > 0.003 - 1e-9
    assert pressure_margin(problem, free.trajectory) < 0.001


def test_uneven_feet_do_not_carry_the_body_outside_its_support_polygon() -> None:
    problem = gait_problem("walk", 0.010, Workspace.STROKE)
    lifted = RestPose(problem.start.body_world, problem.start.feet_world + [0.0, 0.0, 0.0002])
    problem = replace(problem, start=lifted)
    assert pressure_margin(problem, expect_solved(solve_motion(problem))) > -1e-9


def test_the_effort_cost_of_the_thesis_converges() -> None:
    result = solve_motion(gait_problem("walk", 0.010, Workspace.STROKE, cost=Cost.GOAL_EFFORT))
    expect_solved(result)
    # About half of 44 intervals × 4 feet × (1 N)², (3.3).
    assert result.objective == pytest.approx(105.8, abs=0.5)


def test_six_legs_converge() -> None:
    model = load_robot("hexapod")
    timeline = timeline_from_order(6, (1, 2, 3, 4, 5, 6), phase_knots=3, closing_knots=3)
    start, goal = (standing_pose(model, 0.0535, (x, 0.0)) for x in (0.0, 0.006))
    expect_solved(
        solve_motion(MotionProblem(model, timeline, start, goal, GaitOptions().motion_limits(), Cost.GOAL))
    )


def test_feet_land_flat_between_swings() -> None:
    problem = gait_problem("s-gait", 0.030, Workspace.STROKE)
    timeline = timeline_from_order(4, [1, 2, 4, 3], iterations=2)
    motion = expect_solved(solve_motion(replace(problem, timeline=timeline)))
    assert np.abs(motion.feet_world[motion.contact][:, 2]).max() < 1e-9


@pytest.mark.parametrize("quarter_turns", [1, 2, 3])
def test_a_turned_problem_gets_the_turned_answer(quarter_turns: int) -> None:
    problem = gait_problem("walk", 0.010, Workspace.STROKE)
    turned = expect_solved(solve_motion(problem.turned(quarter_turns)))
    wanted = turn_trajectory(expect_solved(solve_motion(problem)), quarter_turns)
    np.testing.assert_allclose(turned.body_world, wanted.body_world, atol=1e-7)
    np.testing.assert_allclose(turned.feet_world, wanted.feet_world, atol=1e-7)


def test_what_cannot_be_balanced_is_explained_with_the_nearest_motion() -> None:
    result = solve_motion(gait_problem("amble", 0.020, Workspace.CYLINDER))
    assert result.status is SolveStatus.INFEASIBLE
    assert result.evidence is Evidence.DIAGNOSED
    assert "balance" in result.explanation[0]
    assert "mm" in result.explanation[0]
    assert "samples 1" in result.explanation[0]
    assert "not proven" in result.explanation[-1]
    assert result.trajectory.knot_count == 45


def proven(problem: MotionProblem) -> str:
    result = solve_motion(problem)
    assert result.status is SolveStatus.INFEASIBLE
    assert result.evidence is Evidence.PROVEN
    assert result.iterations == ()
    assert "proven" in result.explanation[-1]
    return result.explanation[0]


@pytest.mark.parametrize("turns", [0, 1, 2, 3])
def test_an_explanation_names_the_feet_of_the_gaits_own_direction(turns: int) -> None:
    problem = gait_problem("walk", 0.010, Workspace.STROKE)
    stance = problem.timeline.stance.copy()
    stance[1] = True
    drawn = replace(problem, timeline=replace(problem.timeline, stance=stance)).turned(turns)
    assert f"Foot {(1 + turns) % 4 + 1} has to travel" in proven(drawn)


def test_two_feet_in_the_air_leave_no_area_for_a_margin() -> None:
    problem = gait_problem("walk", 0.010, Workspace.STROKE)
    stance = problem.timeline.stance.copy()
    stance[0, 15:20] = False
    drawn = replace(problem, timeline=replace(problem.timeline, stance=stance))
    with_margin = replace(drawn, limits=replace(drawn.limits, margin=0.003))
    sentence = proven(with_margin)
    assert "Feet 1, 2 are in the air together at samples 16 to 20" in sentence


def test_a_foot_that_must_move_but_never_swings_is_named() -> None:
    problem = gait_problem("walk", 0.010, Workspace.STROKE)
    stance = problem.timeline.stance.copy()
    stance[1] = True
    sentence = proven(replace(problem, timeline=replace(problem.timeline, stance=stance)))
    assert sentence.startswith("Foot 2 has to travel 10.0 mm but never swings")


def test_a_step_beyond_foot_speed_is_named() -> None:
    assert "allow 30.0 mm at 15 mm/s" in proven(gait_problem("walk", 0.040, Workspace.STROKE))


def test_a_swing_too_short_for_its_clearance_is_named() -> None:
    problem = gait_problem("walk", 0.002, Workspace.STROKE)
    stance = problem.timeline.stance.copy()
    stance[2, 6:10] = True
    sentence = proven(replace(problem, timeline=replace(problem.timeline, stance=stance)))
    assert sentence.startswith("Foot 3 is in the air at sample 6: too short to rise 3.0 mm")


def test_a_knot_with_no_foot_down_is_named() -> None:
    problem = gait_problem("walk", 0.010, Workspace.STROKE)
    stance = problem.timeline.stance.copy()
    stance[:, 6:8] = False
    sentence = proven(replace(problem, timeline=replace(problem.timeline, stance=stance)))
    assert sentence.startswith("No foot stands at samples 7–8")


def test_a_start_outside_the_bodys_heights_is_named() -> None:
    problem = gait_problem("walk", 0.010, Workspace.STROKE)
    low = standing_pose(problem.model, 0.0500, (0.0, 0.0))
    assert (
        "The actuator plane is 3.00 mm outside its bounds at the start. Choose a height from 53 to 60.5 mm."
        in proven(replace(problem, start=low))
    )


def test_a_start_out_of_reach_is_named() -> None:
    problem = gait_problem("walk", 0.010, Workspace.CYLINDER)
    feet = problem.start.feet_world + [[0.020, 0.0, 0.0], [0, 0, 0], [0, 0, 0], [0, 0, 0]]
    sentence = proven(replace(problem, start=RestPose(problem.start.body_world, feet)))
    assert "6.5 mm in reach of foot 1 at sample 1" in sentence


def test_progress_that_says_no_ends_the_solve_at_that_iteration() -> None:
    seen: list[Iterate] = []

    def progress(iterate: Iterate) -> bool:
        seen.append(iterate)
        return len(seen) < 3

    result = solve_motion(gait_problem("walk", 0.010, Workspace.STROKE), progress)
    assert result.status is SolveStatus.CANCELLED
    assert result.iterations == tuple(seen)
    assert len(seen) == 3
    assert result.explanation == ("Cancelled after 2 iterations.",)


def test_an_error_in_progress_reaches_the_caller_and_the_next_solve_is_sound() -> None:
    def progress(iterate: Iterate) -> bool:
        raise KeyError("listener")

    problem = gait_problem("walk", 0.010, Workspace.STROKE)
    with pytest.raises(KeyError, match="listener"):
        solve_motion(problem, progress)
    expect_solved(solve_motion(problem))
