"""Feet and their counterparts on the other side of the heading."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.gait.gait import Gait, Orientation
from core.gait.mirroring import mirror_of, mirrored_feet
from core.library.library import library
from core.robot.model import ROBOT_NAMES, load_robot


def walk(orientation: Orientation, direction: int) -> Gait:
    return replace(library()["walk"].gait, orientation=orientation, direction=direction)


@pytest.mark.parametrize("direction", [1, 2, 3, 4])
@pytest.mark.parametrize("orientation", tuple(Orientation))
def test_left_and_right_change_places_by_their_roles(orientation: Orientation, direction: int) -> None:
    gait = walk(orientation, direction)
    counterparts = mirror_of(gait, load_robot("deltawalker"))
    assert counterparts is not None
    swapped = {"FR": "FL", "FL": "FR", "BR": "BL", "BL": "BR", "F": "F", "B": "B", "L": "R", "R": "L"}
    roles = gait.roles
    assert [roles[foot] for foot in counterparts] == [swapped[role] for role in roles]


@pytest.mark.parametrize("name", ROBOT_NAMES)
def test_mirroring_twice_is_the_identity(name: str) -> None:
    azimuths = load_robot(name).azimuths
    counterparts = mirrored_feet(azimuths, 0.0)
    assert counterparts is not None
    assert [counterparts[foot] for foot in counterparts] == list(range(len(azimuths)))


@given(st.integers(3, 12), st.floats(-10, 10))
def test_a_ring_has_a_mirror_image_exactly_where_the_heading_is_an_axis_of_it(
    legs: int, heading: float
) -> None:
    azimuths = np.arange(legs) * 2 * np.pi / legs
    off_axis = abs(np.mod(heading * legs / np.pi + 0.5, 1.0) - 0.5)
    counterparts = mirrored_feet(azimuths, heading)
    if off_axis > 1e-4:
        assert counterparts is None
    on_axis = round(heading * legs / np.pi) * np.pi / legs
    assert mirrored_feet(azimuths, on_axis) is not None


def test_six_feet_have_no_mirror_image_about_a_heading_beside_their_axes() -> None:
    assert mirrored_feet(load_robot("hexapod").azimuths, np.pi / 4) is None
