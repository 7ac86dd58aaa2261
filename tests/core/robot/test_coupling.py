"""Motors that share actuators: least squares, and what feet then do."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from core.arrays import Floats
from core.errors import InputError
from core.gait.manual_motion import manual_motion
from core.library.library import manual_entry
from core.motion.speeds import motor_speeds
from core.motion.trajectory import Trajectory
from core.robot.coupled_strokes import heights_over_standing, real_feet, real_strokes
from core.robot.coupling import actuator_positions, coupling_matrix, motor_strokes
from core.robot.kinematics import BodyPose, walker_feet
from core.robot.model import load_robot
from core.wire.waypoint_path import waypoints_from_trajectory

ROBOTS = {12: load_robot("deltawalker"), 9: load_robot("deltawalker9"), 5: load_robot("deltawalker5")}
COUPLED = pytest.mark.parametrize("motors", [9, 5])
unhurried = settings(deadline=None)
"""A busy machine takes its time over linear algebra; what is tried here is not how fast it is."""
strokes_mm = arrays(np.float64, (4, 3), elements=st.floats(0.5, 19.5))


@pytest.mark.parametrize(("motors", "rank"), [(12, 12), (9, 9), (5, 5)])
def test_a_robot_has_as_many_actuators_as_its_name_says_and_each_motor_has_one(
    motors: int, rank: int
) -> None:
    coupling = ROBOTS[motors].coupling
    assert coupling.shape == (12, motors)
    assert np.linalg.matrix_rank(coupling) == rank
    assert (coupling.sum(axis=1) == 1).all()
    assert ROBOTS[motors].is_coupled == (motors < 12)


@COUPLED
def test_motors_that_share_an_actuator_are_neighbours(motors: int) -> None:
    model = ROBOTS[motors]
    inner = model.coupling[::3]
    assert (inner == inner[0]).all()
    outer = [np.nonzero(column)[0] for column in model.coupling.T if column.sum() == 2]
    assert len(outer) == (0 if motors == 9 else 4)
    for one, other in outer:
        assert (one // 3 - other // 3) % 4 in (1, 3)


@pytest.mark.parametrize(
    ("shared", "word"),
    [([[1, 13]], "no motor 13"), ([[1, 2], [2, 3]], "motor 2 is named twice"), ([[4]], "name two motors")],
)
def test_a_coupling_that_cannot_be_is_refused(shared: list[list[int]], word: str) -> None:
    with pytest.raises(InputError, match=word):
        coupling_matrix(shared, 12)


@unhurried
@given(strokes_mm)
def test_a_motor_each_changes_nothing(strokes: Floats) -> None:
    assert real_strokes(ROBOTS[12], strokes) is strokes
    flat = strokes.ravel()
    assert actuator_positions(ROBOTS[12].coupling, flat) == pytest.approx(flat, abs=1e-12)


@COUPLED
@unhurried
@given(positions=arrays(np.float64, 12, elements=st.floats(0.5, 19.5)))
def test_strokes_that_actuators_can_make_are_made_without_residual(motors: int, positions: Floats) -> None:
    coupling = ROBOTS[motors].coupling
    strokes = motor_strokes(coupling, positions[:motors])
    assert actuator_positions(coupling, strokes) == pytest.approx(positions[:motors], abs=1e-9)
    assert real_strokes(ROBOTS[motors], strokes.reshape(4, 3)).ravel() == pytest.approx(strokes, abs=1e-9)


@COUPLED
@unhurried
@given(strokes=strokes_mm, other=arrays(np.float64, 12, elements=st.floats(-5, 5)))
def test_the_residual_stands_upright_on_what_actuators_can_make(
    motors: int, strokes: Floats, other: Floats
) -> None:
    model = ROBOTS[motors]
    residual = (strokes - real_strokes(model, strokes)).ravel()
    assert np.abs(model.coupling.T @ residual).max() < 1e-9
    elsewhere = actuator_positions(model.coupling, strokes.ravel()) + other[:motors]
    worse = strokes.ravel() - motor_strokes(model.coupling, elsewhere)
    assert np.linalg.norm(worse) >= np.linalg.norm(residual) - 1e-9


@pytest.mark.parametrize("seed", range(5))
def test_any_coupling_of_full_rank_has_a_residual_upright_on_what_it_makes(seed: int) -> None:
    random = np.random.default_rng(seed)
    coupling, strokes = random.normal(size=(12, 7)), random.uniform(0.0005, 0.0195, (6, 12))
    positions = actuator_positions(coupling, strokes)
    assert positions.shape == (6, 7)
    assert np.abs((strokes - motor_strokes(coupling, positions)) @ coupling).max() < 1e-12
    made = motor_strokes(coupling, positions)
    assert actuator_positions(coupling, made) == pytest.approx(positions, abs=1e-12)


@COUPLED
@unhurried
@given(strokes=strokes_mm)
def test_made_strokes_stay_within_the_motors_range_and_are_made_again(motors: int, strokes: Floats) -> None:
    model = ROBOTS[motors]
    made = real_strokes(model, strokes)
    assert made.min() >= 0.5 - 1e-9
    assert made.max() <= 19.5 + 1e-9
    assert real_strokes(model, made) == pytest.approx(made, abs=1e-9)


@COUPLED
@unhurried
@given(strokes=strokes_mm)
def test_real_feet_are_where_the_made_strokes_put_them(motors: int, strokes: Floats) -> None:
    model, pose = ROBOTS[motors], BodyPose(np.array([0.1, -0.2, 0.06]), np.array(0.3))
    wanted = walker_feet(model, strokes / 1000, pose)
    expected = walker_feet(model, real_strokes(model, strokes / 1000), pose)
    assert np.abs(real_feet(model, wanted, pose) - expected).max() < 1e-9


@unhurried
@given(arrays(np.float64, 5, elements=st.floats(0.5, 19.5)))
def test_five_motors_keep_the_four_feet_in_one_plane(positions: Floats) -> None:
    """To first order z = −(sum of a foot's strokes)/3, so that both diagonals' feet have the same sum."""
    sums = motor_strokes(ROBOTS[5].coupling, positions).reshape(4, 3).sum(axis=1)
    assert sums[0] + sums[2] == pytest.approx(sums[1] + sums[3], abs=1e-9)


def test_heights_are_measured_from_the_plane_that_the_standing_feet_lean_to() -> None:
    feet = np.array([[[1, 0, 0.3], [0, 1, 0.1], [-1, 0, 0.0], [0, -1, 0.1]]])
    level = feet[..., 0] * 0.05 + 0.05
    contact = np.array([[False, True, True, True]])
    heights = heights_over_standing(feet, contact)
    assert heights[0] == pytest.approx([0.1, 0.0, 0.0, 0.0], abs=1e-12)
    leaning = heights_over_standing(np.dstack([feet[..., :2], feet[..., 2] + level]), contact)
    assert leaning == pytest.approx(heights, abs=1e-12)
    assert np.isnan(heights_over_standing(feet, np.array([[False, True, False, True]]))).all()
    in_line = np.array([[[0, 0, 1], [1, 0, 0], [2, 0, 0], [3, 0, 0]]], dtype=np.float64)
    assert np.isnan(heights_over_standing(in_line, contact)).all()


def manual_walk(motors: int) -> Trajectory:
    return manual_motion(manual_entry("walk", 0).gait, ROBOTS[motors]).trajectory


@COUPLED
def test_waypoints_are_what_the_actuators_make(motors: int) -> None:
    model, walk = ROBOTS[motors], manual_walk(motors)
    strokes = waypoints_from_trajectory(model, walk).strokes.reshape(walk.knot_count, 12)
    assert np.abs(strokes - strokes @ np.linalg.pinv(model.coupling).T @ model.coupling.T).max() < 1e-12
    assert np.abs(strokes - walk.strokes(model).reshape(strokes.shape)).max() > 0.003


@COUPLED
def test_motors_that_share_an_actuator_go_at_one_speed(motors: int) -> None:
    model, walk = ROBOTS[motors], manual_walk(motors)
    for motion in (walk, replace(walk, body_velocity=None, feet_velocity=None)):
        inner = motor_speeds(model, motion)[..., 0]
        assert np.abs(inner - inner[:, :1]).max() < 1e-12
        assert inner.max() > 0.0005
