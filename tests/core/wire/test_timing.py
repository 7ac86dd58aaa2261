"""The ramp law, and the longest time until a stop takes effect."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.wire.timing import SETUP_ACCELERATION, deafness, ramp_time
from core.wire.waypoints import Waypoints


@pytest.mark.parametrize(("distance_mm", "seconds"), [(0, 0), (3, 0.4), (15, 2.0), (18, 2.2), (195, 14.0)])
def test_a_ramp_lasts_as_the_protocol_says(distance_mm: float, seconds: float) -> None:
    assert ramp_time(distance_mm / 1000) == pytest.approx(seconds)


def test_the_ramp_of_the_setup_is_gentler() -> None:
    assert ramp_time(0.018, SETUP_ACCELERATION) == pytest.approx(2.4)
    assert ramp_time(0.0195, SETUP_ACCELERATION) == pytest.approx(1.2 + 1.3)


@given(st.floats(0, 1), st.floats(0, 1))
def test_a_longer_way_never_takes_less_time(a: float, b: float) -> None:
    assert ramp_time(max(a, b)) >= ramp_time(min(a, b))


def test_a_stop_takes_effect_after_the_scan_and_the_largest_ramp() -> None:
    strokes = np.full((3, 4, 3), 0.005)
    strokes[2, 1, 1] = 0.009
    assert deafness(Waypoints(strokes, np.ones(3)), scan=0.3) == pytest.approx(0.3 + 2 * 5 / 15)


def test_a_single_waypoint_is_reached_by_the_moves_to_the_start_pose() -> None:
    plan = Waypoints(np.full((1, 4, 3), 0.005), np.ones(1))
    assert deafness(plan, scan=0.3, start_move=0.003) == pytest.approx(0.3 + 2 * 4 / 15)
