"""Where the exact tier starts: a given motion, the last solution, the drawing; and its course."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.errors import InputError
from core.motion.trajectory import Trajectory
from core.problem.motion_problem import MotionProblem, RestPose, Workspace
from solver_jobs import SolveStatus
from solver_jobs.nlp.motion_nlp import solve_motion
from solver_jobs.nlp.warm_starts import differ_little
from tests.support.solvers.cases import gait_problem

WALK = gait_problem("walk", 0.010, Workspace.STROKE)


def edited(problem: MotionProblem, way: float = 0.0005) -> MotionProblem:
    """One cell of swing more, and the goal moved."""
    stance = problem.timeline.stance.copy()
    foot, knot = np.argwhere(~stance)[0]
    stance[foot, knot - 1] = False
    moved = np.array([way, 0.0, 0.0])
    goal = RestPose(problem.goal.body_world + moved, problem.goal.feet_world + moved)
    return replace(problem, timeline=replace(problem.timeline, stance=stance), goal=goal)


def expect_same(one: Trajectory, other: Trajectory) -> None:
    np.testing.assert_allclose(one.body_world, other.body_world, atol=1e-6)
    np.testing.assert_allclose(one.feet_world, other.feet_world, atol=1e-6)


def test_an_edit_goes_on_from_the_last_solution_to_the_same_motion() -> None:
    solve_motion(WALK, resume=True)
    warm = solve_motion(edited(WALK), resume=True)
    cold = solve_motion(edited(WALK))
    assert warm.status is SolveStatus.SOLVED
    assert warm.iteration_count < cold.iteration_count
    expect_same(warm.trajectory, cold.trajectory)
    back = solve_motion(WALK, resume=True)
    expect_same(back.trajectory, solve_motion(WALK).trajectory)


def test_a_chain_of_edits_ends_where_each_would_have_ended_alone() -> None:
    problem = replace(WALK, limits=replace(WALK.limits, margin=0.002))
    for clearance in (0.0030, 0.0035, 0.0040, 0.0030):
        problem = replace(problem, limits=replace(problem.limits, clearance=clearance))
        expect_same(solve_motion(problem, resume=True).trajectory, solve_motion(problem).trajectory)


def test_after_an_infeasible_edit_the_next_one_is_solved() -> None:
    narrow = gait_problem("amble", 0.015, Workspace.CYLINDER)
    assert solve_motion(narrow, resume=True).status is SolveStatus.SOLVED
    far = replace(narrow, limits=replace(narrow.limits, margin=0.012))
    assert solve_motion(far, resume=True).status is SolveStatus.INFEASIBLE
    assert solve_motion(narrow, resume=True).status is SolveStatus.SOLVED


def test_only_small_edits_go_on() -> None:
    assert differ_little(WALK, edited(WALK))
    assert not differ_little(WALK, edited(WALK, way=0.010))
    assert not differ_little(WALK, gait_problem("s-gait", 0.010, Workspace.STROKE))
    assert not differ_little(WALK, replace(WALK, heading_profile=np.linspace(0.0, 0.2, WALK.knot_count)))
    assert not differ_little(WALK, replace(WALK, durations=WALK.intervals * 1.5))


def test_a_given_motion_is_where_the_search_starts() -> None:
    known = solve_motion(WALK).trajectory
    result = solve_motion(edited(WALK), start=known)
    assert result.status is SolveStatus.SOLVED
    # All but what the edit fixes is as given.
    np.testing.assert_allclose(result.initial.body_world[:-1], known.body_world[:-1], atol=1e-12)
    expect_same(result.trajectory, solve_motion(edited(WALK)).trajectory)


@pytest.mark.parametrize("turns", [1, 3])
def test_a_given_motion_is_turned_with_its_problem(turns: int) -> None:
    problem = WALK.turned(turns)
    known = solve_motion(problem).trajectory
    result = solve_motion(problem, start=known)
    np.testing.assert_allclose(result.initial.body_world, known.body_world, atol=1e-12)
    assert result.status is SolveStatus.SOLVED


def test_from_a_useless_motion_the_drawing_helps() -> None:
    known = solve_motion(WALK).trajectory
    rng = np.random.default_rng(11)
    wild = replace(known, body_world=known.body_world + rng.normal(0.0, 0.5, known.body_world.shape))
    result = solve_motion(WALK, start=wild)
    assert result.status is SolveStatus.SOLVED
    expect_same(result.trajectory, known)


def test_a_motion_that_does_not_fit_is_refused() -> None:
    known = solve_motion(WALK).trajectory
    longer = gait_problem("walk", 0.010, Workspace.STROKE)
    stance = np.concatenate([longer.timeline.stance, np.ones((4, 2), dtype=np.bool_)], axis=1)
    timeline = replace(longer.timeline, stance=stance, locked=np.zeros_like(stance))
    with pytest.raises(InputError, match="other samples"):
        solve_motion(replace(longer, timeline=timeline), start=known)
    with pytest.raises(InputError, match="lacks velocities"):
        solve_motion(WALK, start=replace(known, contact_forces=None))


def test_the_motion_of_every_iteration_is_kept() -> None:
    problem = WALK.turned(1)
    result = solve_motion(problem)
    assert len(result.iterate_motions) == len(result.iterations)
    np.testing.assert_allclose(result.iterate_motions[0].body_world, result.initial.body_world, atol=1e-4)
    np.testing.assert_allclose(result.iterate_motions[-1].feet_world, result.trajectory.feet_world, atol=1e-9)
    np.testing.assert_allclose(result.iterate_motions[3].feet_world[-1], problem.goal.feet_world, atol=1e-12)


def test_the_course_of_an_infeasible_problem_includes_the_search_for_the_nearest_motion() -> None:
    result = solve_motion(gait_problem("amble", 0.020, Workspace.CYLINDER))
    assert result.status is SolveStatus.INFEASIBLE
    assert len(result.iterate_motions) == len(result.iterations) > 30
