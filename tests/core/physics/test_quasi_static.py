"""A robot that moves slowly: how it rests, what holds its feet, and where it goes."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.arrays import Floats
from core.gait.gait import motion_problem
from core.library.library import optimised_entry
from core.physics.quasi_static import QuasiStaticMotion, quasi_static_motion
from core.robot.kinematics import BodyPose, walker_strokes
from core.robot.model import load_robot
from core.wire.waypoint_path import waypoints_from_trajectory
from core.wire.waypoints import Waypoints
from solver_jobs import solve_live

MODEL = load_robot("deltawalker")
HEIGHT = 0.0535
BENDS = 0.0012
"""A leg bends less under friction, m: 20 kN/m a motor give about 2.5 kN/m sideways, 0.8 · 5.6 N / 4 hold."""


def moved(feet: Floats) -> QuasiStaticMotion:
    """The run of waypoints (n, 4, 3) of the feet under a body that stays, m."""
    still = BodyPose(np.tile([0.0, 0.0, HEIGHT], (len(feet), 1)), np.zeros(len(feet)))
    strokes = walker_strokes(MODEL, feet, still)
    return quasi_static_motion(MODEL, Waypoints(strokes, np.full(len(feet), 0.4)))


def standing_feet(count: int) -> Floats:
    return np.tile(MODEL.module_centres_robot * [1.0, 1.0, 0.0], (count, 1, 1))


def test_a_robot_that_stands_evenly_stands_on_all_feet_and_is_level() -> None:
    motion = moved(standing_feet(2))
    assert motion.standing.all()
    assert motion.lean.max() < 1e-9
    assert motion.slides.max() == 0.0
    assert np.abs(motion.heights).max() < 1e-4


@pytest.mark.parametrize("foot", range(4))
def test_a_foot_that_is_short_is_in_the_air_and_the_robot_leans_on_three(foot: int) -> None:
    feet = standing_feet(2)
    feet[1, foot, 2] += 0.004
    # The body goes over the other three feet.
    feet[1, :, :2] += 0.2 * feet[1, foot, :2]
    motion = moved(feet)
    assert motion.standing[-1].tolist() == [other != foot for other in range(4)]
    assert motion.heights[-1, foot] == pytest.approx(0.004, abs=1e-4)
    assert motion.margins[-1] > 0.005


def test_a_foot_under_a_body_that_is_not_over_the_others_stays_down() -> None:
    feet = standing_feet(2)
    feet[1, 0, 2] += 0.003
    feet[1, :, :2] -= 0.1 * feet[1, 0, :2]
    motion = moved(feet)
    assert motion.standing[-1, 0]
    assert motion.lean[-1] > np.radians(1.0)


@given(st.floats(-0.004, 0.004), st.floats(-0.004, 0.004))
def test_feet_that_move_alike_move_the_body_and_slide_nowhere(dx: float, dy: float) -> None:
    feet = standing_feet(3)
    feet[1:, :, :2] -= [dx, dy]
    feet[2] = feet[0]
    motion = moved(feet)
    assert motion.slides.max() < 1e-6
    assert np.abs(motion.middles[-1]).max() < 1e-6
    assert np.abs(motion.headings).max() < 1e-6


def test_feet_that_move_apart_bend_their_legs_and_then_slide() -> None:
    near, far = standing_feet(2), standing_feet(2)
    near[1, :, :2] *= 1.0 + 0.0003 / np.linalg.norm(near[1, 0, :2])
    far[1, :, :2] *= 1.0 + 0.006 / np.linalg.norm(far[1, 0, :2])
    assert moved(near).slides.sum() == 0.0
    slid = moved(far).slides.sum(axis=0)
    assert slid == pytest.approx(np.full(4, slid[0]), abs=1e-5)
    assert 0.006 - BENDS < slid[0] < 0.006


@pytest.mark.parametrize("gait", ["walk", "amble", "s-gait", "c-gait"])
def test_a_robot_with_a_motor_for_every_stroke_goes_as_planned(gait: str) -> None:
    plan = solve_live(motion_problem(optimised_entry(gait).gait, MODEL)).trajectory
    motion = quasi_static_motion(MODEL, waypoints_from_trajectory(MODEL, plan))
    planned = plan.feet_world[-1, :, :2].mean(axis=0) - plan.feet_world[0, :, :2].mean(axis=0)
    assert motion.middles[-1] == pytest.approx(planned, abs=0.0008)
    assert abs(motion.headings[-1]) < np.radians(1.0)
    assert motion.margins.min() > 0.0
    assert motion.lean.max() < np.radians(1.0)
