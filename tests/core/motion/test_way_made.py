"""How much of a way and of a turn is made."""

from __future__ import annotations

import numpy as np
import pytest

from core.arrays import Floats
from core.motion.way_made import WayMade, way_made

SAMPLES = 21


def along(length: float, aside: float = 0.0) -> Floats:
    return np.linspace([0.0, 0.0], [length, aside], SAMPLES)


def compared(planned: Floats, real: Floats, turn: float = 0.0, turned: float = 0.0) -> WayMade:
    headings = [np.linspace(0.0, angle, len(places)) for angle, places in ((turn, planned), (turned, real))]
    return way_made((planned, headings[0]), (real, headings[1]))


def test_the_way_is_what_is_made_along_the_plans() -> None:
    way = compared(along(0.010), along(0.008, 0.006))
    assert (way.asked, way.made, way.share) == pytest.approx((0.010, 0.008, 0.8))
    assert way.gap == pytest.approx(np.hypot(0.002, 0.006))
    assert way.turn_share is None


def test_a_robot_that_goes_backwards_has_a_negative_share() -> None:
    assert compared(along(0.010), along(-0.002)).share == pytest.approx(-0.2)
    assert compared(along(0.0), along(0.0), 0.3, -0.1).turn_share == pytest.approx(-1 / 3)
    assert compared(along(0.0), along(0.0), -0.3, -0.15).turn_share == pytest.approx(0.5)


def test_a_plan_that_goes_and_turns_nowhere_asks_for_neither() -> None:
    way = compared(along(0.0009), along(0.005), 0.017, 0.1)
    assert (way.share, way.turn_share) == (None, None)
    assert way.gap == pytest.approx(0.0041)
    assert way.turn_gap == pytest.approx(0.083)


def test_a_plan_that_comes_back_is_judged_where_it_is_furthest() -> None:
    there_and_back = np.concatenate([along(0.020), along(0.020)[::-1]])
    way = compared(there_and_back, 0.4 * there_and_back)
    assert way.share == pytest.approx(0.4)
    assert way.gap == pytest.approx(0.0)
    turns = np.concatenate([np.linspace(0.0, 0.5, SAMPLES), np.linspace(0.5, 0.0, SAMPLES)])
    still = np.zeros((2 * SAMPLES, 2))
    assert way_made((still, turns), (still, 0.7 * turns)).turn_share == pytest.approx(0.7)


def test_feet_that_step_round_the_body_and_come_back_ask_for_no_way() -> None:
    middles = np.concatenate([along(0.006), along(0.006)[::-1]])
    assert compared(middles, 0.5 * middles, 0.3, 0.3).share is None


def test_what_is_missing_of_a_run_that_ended_early_is_not_made() -> None:
    way = compared(along(0.010), along(0.010)[:11])
    assert way.share == pytest.approx(0.5)
