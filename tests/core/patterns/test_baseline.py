"""Strokes blended from gait to gait, and what a robot at rest makes of them."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.arrays import Floats
from core.errors import InputError
from core.motion.support_polygon import polygon_margin, support_polygon
from core.patterns.baseline import blended_strokes, body_way, figures, figures_of_strokes, level_feet, resting
from core.robot.kinematics import BodyPose, free_strokes
from core.robot.model import load_robot

MODEL = load_robot("hexapod")


def strokes_of(feet_robot: Floats) -> Floats:
    """Strokes that put the feet of a robot at its origin somewhere."""
    pose = BodyPose(np.zeros((len(feet_robot), 3)), np.zeros(len(feet_robot)))
    return free_strokes(MODEL, feet_robot, pose)


def standing(samples: int, lifted: tuple[int, ...] = (), height: float = 0.003) -> Floats:
    """Feet under their modules, some of them up."""
    feet = np.repeat(MODEL.module_centres_robot[None], samples, axis=0)
    feet[..., 2] = -0.055
    feet[:, list(lifted), 2] += height
    return feet


def support_margin(points: Floats) -> float:
    """How far inside the polygon of some points the origin is."""
    return polygon_margin(support_polygon(points), np.zeros(2))


@given(st.integers(0, 19), st.integers(0, 29), st.integers(2, 40))
def test_a_blend_begins_in_one_gait_and_ends_in_the_other_at_their_cursors(
    at: int, to: int, samples: int
) -> None:
    random = np.random.default_rng(1)
    first, second = random.random((20, 6, 3)), random.random((30, 6, 3))
    blend = blended_strokes(first, at, second, to, samples)
    assert blend.shape == (samples, 6, 3)
    assert blend[0] == pytest.approx(first[at])
    assert blend[-1] == pytest.approx(second[to])
    middle = samples // 2
    share = middle / (samples - 1)
    ends = first[(at + middle) % 20], second[(to - samples + 1 + middle) % 30]
    assert blend[middle] == pytest.approx((1 - share) * ends[0] + share * ends[1])


def test_a_transition_without_time_is_refused() -> None:
    with pytest.raises(InputError, match="1 samples has no time"):
        blended_strokes(np.zeros((4, 6, 3)), 0, np.zeros((4, 6, 3)), 0, 1)


def test_a_body_goes_forward_as_far_as_its_standing_feet_go_back() -> None:
    feet = standing(5, lifted=(1, 3))
    feet[..., 0] -= np.arange(5)[:, None] * 0.002
    feet[:, [1, 3], 0] += 0.01 * np.arange(5)[:, None]
    found = figures_of_strokes(MODEL, strokes_of(feet), 0.4, 0.0)
    assert found.speed == pytest.approx(0.002 / 0.4)
    assert figures_of_strokes(MODEL, strokes_of(feet), 0.4, np.pi).speed == pytest.approx(-0.002 / 0.4)
    assert found.falls == 0
    assert found.margin > 0


def test_feet_that_pull_against_each_other_leave_the_body_between() -> None:
    feet = standing(2)
    feet[1, :3, 0] -= 0.004
    assert body_way(feet, np.ones((2, 6), dtype=np.bool_))[0] == pytest.approx([0.002, 0.0])


def test_a_body_without_a_foot_that_stays_down_stays() -> None:
    assert (body_way(standing(2), np.array([[True] * 3 + [False] * 3, [False] * 3 + [True] * 3])) == 0).all()


def test_only_the_lowest_feet_stand() -> None:
    feet = standing(1, lifted=(0,))
    feet[0, 1, 2] += 0.0004
    assert level_feet(feet)[0].tolist() == [False, True, True, True, True, True]


def test_a_robot_tips_once_for_each_time_that_it_leaves_its_feet() -> None:
    front, none = (0, 1, 2), ()
    way = [none, front, front, none, front, none]
    feet = np.concatenate([standing(1, lifted) for lifted in way])
    found = figures_of_strokes(MODEL, strokes_of(feet), 0.4, 0.0)
    assert found.falls == 2
    # Feet 4, 5 and 6 stand, at 180°, 240° and 300°: the edge from 4 to 6 passes half a radius off the middle.
    assert found.margin == pytest.approx(-MODEL.radius / 2)


def test_figures_are_means_over_the_time_between_the_samples() -> None:
    tilt = np.array([0.05, 0.04, 0.0])
    found = figures(np.array([0.03, 0.04]), np.array([0.01, -0.002, 0.003]), tilt, 0.5, np.arctan2(4, 3))
    assert found.speed == pytest.approx(0.05)
    assert (found.margin, found.falls) == (-0.002, 1)
    assert found.tilt == 0.05


def test_hardly_tipping_is_no_fall() -> None:
    feet = standing(3)
    feet[1, :3, 2] += 0.0009
    found = figures_of_strokes(MODEL, strokes_of(feet), 0.4, 0.0)
    assert found.margin < 0
    assert 0 < found.tilt < np.radians(1)
    assert found.falls == 0


@given(st.integers(0, 2**32 - 1))
def test_a_body_rests_on_feet_round_its_middle_and_no_foot_is_below_them(seed: int) -> None:
    feet = standing(4)
    feet[..., 2] += np.random.default_rng(seed).uniform(0, 0.003, feet.shape[:2])
    found = resting(feet)
    assert (found.standing.sum(axis=1) >= 3).all()
    for sample, flags in zip(feet, found.standing, strict=True):
        corners = sample[flags]
        assert support_margin(corners[:, :2]) >= -1e-9
        rows = np.column_stack([corners[:, :2], np.ones(len(corners))])
        plane = np.linalg.lstsq(rows, corners[:, 2], rcond=None)[0]
        below = (
            sample[~flags][:, 2] - np.column_stack([sample[~flags][:, :2], np.ones((~flags).sum())]) @ plane
        )
        assert (below > 0).all()


def test_a_level_body_has_no_tilt_and_one_without_feet_round_it_falls_over() -> None:
    assert resting(standing(2, lifted=(0, 2, 4))).tilt == pytest.approx([0.0, 0.0], abs=1e-12)
    beside = standing(1) + np.array([0.2, 0.0, 0.0])
    assert resting(beside).tilt == pytest.approx([np.pi / 2])
