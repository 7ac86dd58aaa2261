"""Which foot has which role: thesis Table 3.1 as it is printed, and as the robot stands."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.gait.foot_roles import ring_roles
from core.gait.gait import Gait, Orientation
from core.library.library import library, optimised_entry
from core.library.new_gait import with_robot
from core.robot.model import load_robot

MODEL = load_robot("deltawalker")

TABLE_3_1 = {
    ("FB", 1): {1: "FR", 2: "FL", 3: "BL", 4: "BR"},
    ("FB", 2): {1: "BR", 2: "FR", 3: "FL", 4: "BL"},
    ("FB", 3): {1: "BL", 2: "BR", 3: "FR", 4: "FL"},
    ("FB", 4): {1: "FL", 2: "BL", 3: "BR", 4: "FR"},
    ("FBS", 1): {1: "F", 2: "L", 3: "B", 4: "R"},
    ("FBS", 2): {1: "R", 2: "F", 3: "L", 4: "B"},
    ("FBS", 3): {1: "B", 2: "R", 3: "F", 4: "L"},
    ("FBS", 4): {1: "L", 2: "B", 3: "R", 4: "F"},
}
"""Role of each foot by orientation and direction (quadrants 1 to 4; +x, +y, −x, −y)."""

HEADINGS = {
    Orientation.FB: [(1, 1), (-1, 1), (-1, -1), (1, -1)],
    Orientation.FBS: [(1, 0), (0, 1), (-1, 0), (0, -1)],
}


def gait_of(orientation: str, direction: int) -> Gait:
    return replace(library()["walk" if orientation == "FB" else "s-gait"].gait, direction=direction)


@pytest.mark.parametrize(("orientation", "direction"), TABLE_3_1)
def test_feet_have_the_roles_of_table_3_1(orientation: str, direction: int) -> None:
    roles = gait_of(orientation, direction).roles
    assert dict(enumerate(roles, 1)) == TABLE_3_1[orientation, direction]


@pytest.mark.parametrize(("orientation", "direction"), TABLE_3_1)
def test_roles_say_where_feet_are_along_the_way(orientation: str, direction: int) -> None:
    gait = gait_of(orientation, direction)
    heading = np.array(HEADINGS[gait.orientation][direction - 1])
    assert gait.step_world / np.linalg.norm(gait.step_world) == pytest.approx(
        heading / np.linalg.norm(heading)
    )
    centres = MODEL.module_centres_robot[:, :2]
    ahead = centres @ heading
    left = centres @ np.array([-heading[1], heading[0]])
    for foot, role in enumerate(gait.roles):
        assert ("F" in role, "B" in role) == (ahead[foot] > 1e-9, ahead[foot] < -1e-9)
        assert ("L" in role, "R" in role) == (left[foot] > 1e-9, left[foot] < -1e-9)


@pytest.mark.parametrize(
    ("legs", "degrees", "roles"),
    [
        (6, 0, "F L1 L2 B R2 R1"),
        (6, 45, "R1 L1 L2 L3 R3 R2"),
        (6, 90, "R2 R1 L1 L2 L3 R3"),
        (12, 0, "F L1 L2 L3 L4 L5 B R5 R4 R3 R2 R1"),
        (12, 180, "B R5 R4 R3 R2 R1 F L1 L2 L3 L4 L5"),
    ],
)
def test_feet_of_larger_rings_are_counted_from_the_front_on_either_side(
    legs: int, degrees: float, roles: str
) -> None:
    assert ring_roles(legs, np.radians(degrees)) == tuple(roles.split())


def test_a_gait_with_six_legs_names_its_feet_along_its_way() -> None:
    gait = with_robot(optimised_entry("s-gait").gait, load_robot("hexapod"))
    assert gait.roles == ring_roles(6, 0.0)
    assert replace(gait, direction=3).roles == ring_roles(6, np.pi)
