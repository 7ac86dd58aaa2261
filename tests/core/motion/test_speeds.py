from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.arrays import Floats
from core.errors import InputError
from core.motion.speeds import foot_speeds, motor_speeds
from core.motion.trajectory import Trajectory
from core.robot.kinematics import feet_in_modules
from core.robot.leg import strokes_from_foot
from core.robot.model import load_robot

ROBOT = load_robot("deltawalker")
COM = 0.056 + ROBOT.com_height


def steady(velocity: float, turn: float = 0.0, step: float = 1e-4, known: bool = True) -> Trajectory:
    """Body and feet glide along x, and the body turns."""
    times = np.asarray(step * np.arange(3), dtype=np.float64)
    drift: Floats = np.outer(times, np.array([velocity, 0.0, 0.0]))
    body = np.asarray(np.array([0.0, 0.0, COM]) + 0.5 * drift)
    feet = np.asarray(ROBOT.module_centres_robot + drift[:, None, :])
    moving = np.array([velocity, 0.0, 0.0])
    return Trajectory(
        times,
        body,
        turn * times,
        feet,
        np.zeros((3, 4), dtype=bool),
        np.tile(0.5 * moving, (3, 1)) if known else None,
        np.tile(moving, (3, 4, 1)) if known else None,
    )


def strokes(trajectory: Trajectory) -> np.ndarray:
    pose = trajectory.pose(ROBOT)
    return strokes_from_foot(ROBOT.leg, feet_in_modules(ROBOT, trajectory.feet_world, pose))


@given(velocity=st.floats(-0.05, 0.05), turn=st.floats(-0.5, 0.5))
def test_motor_speeds_are_the_slopes_of_the_strokes(velocity: float, turn: float) -> None:
    trajectory = steady(velocity, turn)
    slope = (strokes(trajectory)[2] - strokes(trajectory)[0]) / (2 * 1e-4)
    assert motor_speeds(ROBOT, trajectory)[1] == pytest.approx(np.abs(slope), abs=1e-6)


def test_a_foot_is_as_fast_as_its_velocity_is_long() -> None:
    assert foot_speeds(steady(-0.02)) == pytest.approx(np.full((3, 4), 0.02))


def test_without_velocities_a_speed_is_that_of_the_move_to_the_sample() -> None:
    trajectory = steady(0.02, step=0.4, known=False)
    assert foot_speeds(trajectory)[:, 0] == pytest.approx([0.0, 0.02, 0.02])
    moved = np.abs(np.diff(strokes(trajectory), axis=0)) / 0.4
    assert motor_speeds(ROBOT, trajectory)[1:] == pytest.approx(moved)
    assert (motor_speeds(ROBOT, trajectory)[0] == 0).all()


def test_a_motor_whose_rod_is_too_short_has_no_speed() -> None:
    trajectory = steady(2000.0, step=0.1, known=False)
    assert np.isnan(motor_speeds(ROBOT, trajectory)[-1]).any()


def test_a_search_that_finds_no_motion_may_end_with_forces_of_no_robot() -> None:
    still = np.zeros((2, 3))
    feet = np.zeros((2, 4, 3))
    forces = np.full((2, 4, 3), 79_303.0)
    motion = Trajectory(
        np.array([0.0, 0.4]), still, np.zeros(2), feet, np.ones((2, 4), bool), contact_forces=forces
    )
    assert motion.contact_forces is not None
    with pytest.raises(InputError, match="contact_forces holds 1e\\+300"):
        replace(motion, contact_forces=np.full((2, 4, 3), 1e300))
