"""The first drawing of a motion."""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np
import pytest

from core.gait.options import GaitOptions
from core.motion.contact_timeline import timeline_from_order, timeline_from_rows
from core.motion.support_polygon import GRAVITY, stability_margins
from core.problem.initial_guess import (
    clearance_knot,
    initial_guess,
    next_standing,
    problem_swings,
    standing_forces,
)
from core.problem.motion_problem import Cost, MotionProblem, standing_pose
from core.robot.model import load_robot

ORDERS = [(3, 2, 4, 1), (3, 1, 4, 2), (1, 2, 4, 3), (1, 2, 3, 4)]


def problem_of(order: tuple[int, ...], iterations: int = 1) -> MotionProblem:
    model = load_robot("deltawalker")
    return MotionProblem(
        model,
        timeline_from_order(model.leg_count, order, iterations=iterations),
        standing_pose(model, 0.0535, (0.0, 0.0)),
        standing_pose(model, 0.0535, (0.010, 0.004)),
        GaitOptions().motion_limits(),
        Cost.GOAL,
    )


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("iterations", [1, 3])
def test_it_begins_at_the_start_ends_at_the_goal_and_rests_there(
    order: tuple[int, ...], iterations: int
) -> None:
    problem = problem_of(order, iterations)
    motion = initial_guess(problem)
    assert motion.body_velocity is not None
    assert motion.feet_velocity is not None
    for knot, pose in ((0, problem.start), (-1, problem.goal)):
        np.testing.assert_array_equal(motion.body_world[knot], pose.body_world)
        np.testing.assert_array_equal(motion.feet_world[knot], pose.feet_world)
        assert not motion.body_velocity[knot].any()
        assert not motion.feet_velocity[knot].any()


@pytest.mark.parametrize("order", ORDERS)
def test_feet_obey_the_integrator_and_stand_still_in_stance(order: tuple[int, ...]) -> None:
    problem = problem_of(order, 2)
    motion = initial_guess(problem)
    velocity = motion.feet_velocity
    assert velocity is not None
    step = problem.timeline.sample_time * (velocity[1:] + velocity[:-1]) / 2
    np.testing.assert_allclose(np.diff(motion.feet_world, axis=0), step, atol=1e-15)
    assert not velocity[motion.contact].any()
    assert not motion.feet_world[motion.contact][:, 2].any()


def test_each_swing_rises_to_the_clearance_in_its_middle() -> None:
    problem = problem_of((3, 2, 4, 1))
    motion = initial_guess(problem)
    for swing in problem_swings(problem):
        heights = motion.feet_world[swing.first : swing.last + 1, swing.foot, 2]
        assert heights.max() == pytest.approx(problem.limits.clearance, abs=1e-12)
        assert motion.feet_world[clearance_knot(swing, problem.intervals), swing.foot, 2] == heights.max()


@pytest.mark.parametrize("order", ORDERS)
def test_the_body_is_drawn_over_the_support_polygons(order: tuple[int, ...]) -> None:
    motion = initial_guess(problem_of(order))
    margins = stability_margins(motion.body_world[:, :2], motion.feet_world, motion.contact)
    assert margins.min() > 0.0015


def test_a_swing_up_to_the_last_knot_lands_at_the_goal() -> None:
    problem = problem_of((1, 2, 3, 4))
    rows = ["1" * 20 + "0" * 6, "1" * 5 + "0" * 5 + "1" * 16, "1" * 26, "1" * 26]
    motion = initial_guess(replace(problem, timeline=timeline_from_rows(rows, 0.4)))
    np.testing.assert_array_equal(motion.feet_world[-1], problem.goal.feet_world)
    assert motion.contact[-1].all()


def test_a_swing_from_the_first_knot_starts_at_rest() -> None:
    problem = problem_of((1, 2, 3, 4))
    rows = ["0" * 6 + "1" * 20, "1" * 26, "1" * 26, "1" * 26]
    motion = initial_guess(replace(problem, timeline=timeline_from_rows(rows, 0.4)))
    np.testing.assert_array_equal(motion.feet_world[0], problem.start.feet_world)
    np.testing.assert_allclose(motion.feet_world[6, 0], problem.goal.feet_world[0], atol=1e-15)


def test_standing_forces_carry_the_weight_without_torque() -> None:
    problem = problem_of((3, 2, 4, 1))
    motion = initial_guess(problem)
    forces = standing_forces(problem.model, motion.body_world, motion.feet_world, motion.contact)
    weight = problem.model.total_model_mass * GRAVITY
    np.testing.assert_allclose(forces[..., 2].sum(axis=1), weight, rtol=1e-12)
    lever = motion.feet_world[..., :2] - motion.body_world[:, None, :2]
    np.testing.assert_allclose((forces[..., 2:] * lever).sum(axis=1), 0.0, atol=1e-12)
    assert not forces[~motion.contact].any()
    assert forces[..., 2].min() > -1e-12


def test_the_next_standing_foot_skips_swinging_ones() -> None:
    model = load_robot("hexapod")
    contact = np.array([[1, 0, 1, 0, 0, 1], [1, 1, 1, 1, 1, 1], [0, 0, 1, 0, 0, 0]], dtype=np.bool_)
    following = next_standing(model, contact)
    assert following[0, [0, 2, 5]].tolist() == [2, 5, 0]
    assert following[1].tolist() == [1, 2, 3, 4, 5, 0]
    assert (following != np.arange(6)).all()


def test_it_is_drawn_within_five_milliseconds() -> None:
    problem = problem_of((3, 2, 4, 1))
    initial_guess(problem)
    times = []
    for _ in range(10):
        begin = time.thread_time()
        initial_guess(problem)
        times.append(time.thread_time() - begin)
    assert min(times) < 0.005
