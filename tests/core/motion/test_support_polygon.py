"""Support polygons and margins on hand-made feet."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from core.arrays import Floats
from core.motion.support_polygon import (
    GRAVITY,
    centre_of_pressure,
    polygon_margin,
    stability_margins,
    support_polygon,
)

SQUARE = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])


def test_the_margin_in_a_square_is_the_distance_to_its_side() -> None:
    polygon = support_polygon(SQUARE)
    assert polygon_margin(polygon, np.zeros(2)) == pytest.approx(np.sqrt(0.5))
    assert polygon_margin(polygon, np.array([2.0, 0.0])) == pytest.approx(-1.0)


def test_a_point_inside_the_polygon_is_no_vertex() -> None:
    assert len(support_polygon(np.vstack([SQUARE, [[0.1, 0.1]]]))) == 4


@pytest.mark.parametrize(
    ("points", "margin"), [([[0.0, 0.0], [2.0, 0.0]], -1.0), ([[0.0, 0.0]], -np.sqrt(2))]
)
def test_without_an_area_the_margin_is_minus_the_distance(points: list[list[float]], margin: float) -> None:
    assert polygon_margin(support_polygon(np.array(points)), np.array([1.0, 1.0])) == pytest.approx(margin)


def test_without_feet_there_is_no_margin() -> None:
    assert polygon_margin(support_polygon(np.zeros((0, 2))), np.zeros(2)) == -np.inf


@given(arrays(np.float64, (5, 2), elements=st.floats(-1, 1)), st.floats(-3, 3))
def test_margins_turn_with_the_feet(points: Floats, angle: float) -> None:
    rotation = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    here = polygon_margin(support_polygon(points), np.array([0.1, 0.2]))
    there = polygon_margin(support_polygon(points @ rotation.T), rotation @ np.array([0.1, 0.2]))
    assert there == pytest.approx(here, abs=1e-6)


def test_at_rest_the_centre_of_pressure_is_below_the_body() -> None:
    body = np.array([[0.01, -0.02, 0.0735]])
    pressure = centre_of_pressure(body, np.zeros((1, 3)), np.zeros((1, 4, 3)), 0.4, 0.025)
    assert pressure == pytest.approx(body[:, :2])


def test_a_body_that_speeds_up_presses_behind_itself() -> None:
    pressure = centre_of_pressure(
        np.array([[0.0, 0.0, 0.0735]]), np.array([[GRAVITY / 10, 0.0, 0.0]]), np.zeros((1, 4, 3)), 0.4, 0.025
    )
    assert pressure[0] == pytest.approx([-0.0735 * 0.4 / 0.5 / 10, 0.0])


def test_a_lifted_foot_takes_its_corner_away() -> None:
    feet = np.zeros((2, 4, 3))
    feet[:, :, :2] = SQUARE
    contact = np.array([[True] * 4, [False, True, True, True]])
    margins = stability_margins(np.zeros((2, 2)), feet, contact)
    assert margins == pytest.approx([np.sqrt(0.5), 0.0], abs=1e-12)
