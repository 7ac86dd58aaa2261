"""Legs and walker: kinematics undo each other, turn with the robot, and refuse with help."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from core.arrays import Floats
from core.robot.kinematics import (
    BodyPose,
    UnreachableError,
    actuator_plane_pose,
    feet_in_modules,
    walker_feet,
    walker_strokes,
)
from core.robot.leg import foot_from_strokes, foot_jacobian, strokes_from_foot
from core.robot.model import ROBOT_NAMES, load_robot
from core.robot.nearest_reachable import nearest_reachable

WALKER = load_robot("deltawalker")
LEG = WALKER.leg
EDGES = [0.0, 0.0005, 0.0195, 0.02]
stroke = st.one_of(st.sampled_from(EDGES), st.floats(0.0, 0.02))
strokes_of_a_leg = st.tuples(stroke, stroke, stroke).map(np.array)


@given(strokes_of_a_leg)
def test_a_leg_comes_back_to_the_strokes_it_was_given(strokes: Floats) -> None:
    foot = foot_from_strokes(LEG, strokes)
    assert np.abs(strokes_from_foot(LEG, foot) - strokes).max() < 1e-12


@given(strokes_of_a_leg)
def test_every_rod_is_as_long_as_it_is_made(strokes: Floats) -> None:
    foot = foot_from_strokes(LEG, strokes)
    angles = np.radians([-90.0, 30.0, 150.0])
    knees = np.stack([0.020 * np.cos(angles), 0.020 * np.sin(angles), -strokes], axis=-1)
    ends = foot + np.stack([0.006 * np.cos(angles), 0.006 * np.sin(angles), np.zeros(3)], axis=-1)
    assert np.abs(np.linalg.norm(ends - knees, axis=-1) - 0.050).max() < 1e-12


def test_a_centred_foot_hangs_as_low_as_published() -> None:
    heights = foot_from_strokes(LEG, np.array([[0.0] * 3, [0.02] * 3]))[:, 2]
    assert heights == pytest.approx([-0.048, -0.068], abs=1e-12)


@pytest.mark.parametrize(
    ("z", "radius"),
    [(-0.0485, 0.0), (-0.050, 0.0069), (-0.053, 0.0231), (-0.058, 0.0179), (-0.063, 0.0106), (-0.0675, 0.0)],
)
def test_the_workspace_is_as_wide_as_published(z: float, radius: float) -> None:
    angles = np.radians(np.arange(0.0, 360.0, 1.0))

    def reaches(r: float) -> bool:
        ring = np.stack([r * np.cos(angles), r * np.sin(angles), np.full(360, z)], axis=-1)
        h = strokes_from_foot(LEG, ring)
        return bool(((h >= 0.0005 - 1e-12) & (h <= 0.0195 + 1e-12)).all())

    assert reaches(max(0.0, radius - 0.0001))
    assert not reaches(radius + 0.0001)


@given(strokes_of_a_leg)
def test_the_jacobian_is_the_slope_of_forward_kinematics(strokes: Floats) -> None:
    step = 1e-6
    jacobian = foot_jacobian(LEG, strokes)
    for motor in range(3):
        shift = np.zeros(3)
        shift[motor] = step
        slope = (foot_from_strokes(LEG, strokes + shift) - foot_from_strokes(LEG, strokes - shift)) / (
            2 * step
        )
        assert slope == pytest.approx(jacobian[:, motor], abs=1e-6)


@pytest.mark.parametrize("name", ROBOT_NAMES)
def test_a_walker_comes_back_to_its_strokes_anywhere_in_the_world(name: str) -> None:
    model = load_robot(name)
    random = np.random.default_rng(1)
    strokes = random.uniform(0.0005, 0.0195, (40, model.leg_count, 3))
    pose = BodyPose(random.uniform(-1, 1, (40, 3)), random.uniform(-4, 4, 40))
    assert np.abs(walker_strokes(model, walker_feet(model, strokes, pose), pose) - strokes).max() < 1e-12


@given(arrays(np.float64, (4, 3), elements=st.floats(0.0005, 0.0195)), st.integers(0, 3))
def test_a_quarter_turn_hands_strokes_on_to_the_next_legs(strokes: Floats, turns: int) -> None:
    pose = BodyPose(np.zeros(3), np.array(0.0))
    feet = walker_feet(WALKER, strokes, pose)
    angle = turns * np.pi / 2
    rotation = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    turned = np.roll(feet @ rotation.T, turns, axis=0)
    assert np.abs(walker_strokes(WALKER, turned, pose) - np.roll(strokes, turns, axis=0)).max() < 1e-12


def test_the_robots_frame_lies_below_the_centre_of_mass() -> None:
    pose = actuator_plane_pose(WALKER, np.array([0.0, 0.0, 0.0735]), np.array(0.0))
    assert pose.position_world == pytest.approx([0.0, 0.0, 0.0535])
    feet = feet_in_modules(WALKER, WALKER.module_centres_robot, pose)
    assert feet == pytest.approx(np.tile([0.0, 0.0, -0.0535], (4, 1)))


def test_an_unreachable_foot_is_named_with_its_sample_and_the_nearest_point() -> None:
    feet = np.tile(WALKER.module_centres_robot, (3, 1, 1))
    feet[2, 2, 0] -= 0.030
    pose = BodyPose(np.tile([0.0, 0.0, 0.058], (3, 1)), np.zeros(3))
    with pytest.raises(UnreachableError, match=r"Foot 3 cannot reach .* at sample 3") as refused:
        walker_strokes(WALKER, feet, pose)
    refusal = refused.value
    assert (refusal.foot, refusal.sample) == (2, 2)
    h = strokes_from_foot(LEG, refusal.nearest_module)
    assert ((h >= 0.0005 - 1e-9) & (h <= 0.0195 + 1e-9)).all()
    target = feet_in_modules(WALKER, feet, pose)[2, 2]
    assert refusal.distance == pytest.approx(np.linalg.norm(refusal.nearest_module - target))


@given(st.tuples(st.floats(-0.04, 0.04), st.floats(-0.04, 0.04), st.floats(-0.08, -0.03)).map(np.array))
def test_no_sampled_point_of_the_workspace_is_nearer_than_the_nearest(target: Floats) -> None:
    levels = np.linspace(0.0005, 0.0195, 14)
    grid = np.stack(np.meshgrid(levels, levels, levels), axis=-1).reshape(-1, 3)
    sampled = np.linalg.norm(foot_from_strokes(LEG, grid) - target, axis=-1).min()
    assert np.linalg.norm(nearest_reachable(WALKER, target) - target) <= sampled + 1e-9
