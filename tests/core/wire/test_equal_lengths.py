"""Lengths that are equal except for rounding lead to one choice of waypoints."""

from __future__ import annotations

import numpy as np
import pytest

from core.arrays import SAME
from core.robot.model import load_robot
from core.wire.robot_time import ARRIVAL_THRESHOLD, estimate_seconds, longest_move
from core.wire.waypoint_merging import needed_knots
from core.wire.waypoint_path import cut_parts, stays_near
from core.wire.waypoints import Waypoints

MODEL = load_robot("deltawalker")
NOISES = (-1e-9, 0.0, 1e-9)


def swinging(heights: list[float], first: int = 3) -> tuple[np.ndarray, np.ndarray]:
    """Feet and contact of nine knots in which foot 2 swings."""
    contact = np.ones((9, 4), dtype=np.bool_)
    contact[first : first + len(heights), 1] = False
    feet = np.tile(MODEL.module_centres_robot, (9, 1, 1))
    feet[first : first + len(heights), 1, 2] = heights
    return feet, contact


@pytest.mark.parametrize("seed", range(20))
def test_a_foot_that_is_held_up_needs_no_knot_of_its_own(seed: int) -> None:
    noise = np.random.default_rng(seed).normal(0.0, 1e-16, 9)
    assert needed_knots(*swinging((0.003 + noise).tolist(), 0)) == (0, 8)


@pytest.mark.parametrize("noise", NOISES)
def test_of_two_knots_as_high_the_first_is_needed(noise: float) -> None:
    assert needed_knots(*swinging([0.001, 0.003, 0.003 + noise, 0.001])) == (0, 2, 4, 7, 8)


def test_a_knot_that_is_notably_higher_is_needed() -> None:
    assert needed_knots(*swinging([0.001, 0.003, 0.003 + 3 * SAME, 0.001])) == (0, 2, 5, 7, 8)


@pytest.mark.parametrize("noise", NOISES)
def test_a_way_back_to_where_it_began_has_no_direction(noise: float) -> None:
    rows = np.zeros((4, 12))
    rows[1:3] = 0.0005
    assert stays_near(rows + np.array([0.0, 0.0, 0.0, noise])[:, None], 0, 3, 0.001)


@pytest.mark.parametrize("noise", NOISES)
def test_a_move_of_just_the_longest_length_stays_whole(noise: float) -> None:
    strokes = np.full((2, 4, 3), 0.005)
    strokes[1] += longest_move(1.5) + noise
    assert cut_parts(Waypoints(strokes, np.ones(2)), 1.5).tolist() == [1, 1]


@pytest.mark.parametrize("noise", NOISES)
def test_a_move_of_just_the_threshold_counts_as_arrived(noise: float) -> None:
    strokes = np.full((2, 4, 3), 0.005)
    strokes[1] += ARRIVAL_THRESHOLD + noise
    still = Waypoints(np.full((2, 4, 3), 0.005), np.ones(2))
    assert estimate_seconds(Waypoints(strokes, np.ones(2))) == estimate_seconds(still)
