"""The law of a message, its ramp, and the longest time until a stop takes effect."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.wire.robot_time import (
    ARRIVAL_THRESHOLD,
    LAWS,
    PUBLISHED,
    SETUP_ACCELERATION,
    TimeLaw,
    deaf_seconds,
    deafness,
    estimate_seconds,
    far_motors,
    least_stop_bound,
    longest_move,
    ramp_distance,
    ramp_time,
    stop_seconds,
)
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


@given(st.floats(0, 0.2))
def test_a_ramp_of_a_time_has_the_distance_of_that_time(distance: float) -> None:
    assert ramp_distance(ramp_time(distance)) == pytest.approx(distance, abs=1e-12)


@given(st.floats(least_stop_bound(), 4.0))
def test_the_longest_move_keeps_its_stop_bound_and_no_longer_one_does(bound: float) -> None:
    longest = longest_move(bound)
    assert deaf_seconds(longest) == pytest.approx(bound)
    assert deaf_seconds(longest + 1e-5) > bound
    assert stop_seconds(longest) > bound


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_a_move_costs_its_message_its_ramp_and_its_share_of_a_second_ramp(law: TimeLaw) -> None:
    assert law.move_seconds(ARRIVAL_THRESHOLD) == law.move_seconds(0.0) == law.arrived
    assert law.move_seconds(0.018) == pytest.approx(law.message + 2.2)
    short = law.often_until
    assert law.move_seconds(short) == pytest.approx(
        law.message + ramp_time(short) + law.often * law.second_ramp
    )
    assert law.second_share(law.never_from) == 0.0


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_seconds_of_many_moves_are_those_of_each(law: TimeLaw) -> None:
    distances = np.linspace(0.0, 0.02, 41)
    np.testing.assert_allclose(law.move_seconds(distances), [law.move_seconds(float(d)) for d in distances])


def test_the_fewer_motors_go_far_the_fewer_second_ramps() -> None:
    shares = [float(PUBLISHED.second_share(0.004, motors)) for motors in (1, 2, 4.5, 12)]
    assert shares == sorted(shares)
    assert shares[2] == pytest.approx(PUBLISHED.often)
    assert shares[0] < 0.5 < shares[2] < shares[3] < 1.0
    assert far_motors(np.array([[0.004, 0.003, 0.002], [0.0, 0.0, 0.005]])).tolist() == [2, 1]


def test_a_waypoint_within_the_threshold_is_made_up_for_by_a_later_move() -> None:
    heights = np.array([5.0, 5.9, 6.8, 6.8]) / 1000
    waypoints = Waypoints(np.repeat(heights, 12).reshape(4, 4, 3), np.ones(4))
    expected = 3 * PUBLISHED.arrived + PUBLISHED.move_seconds(0.0018, 12)
    assert estimate_seconds(waypoints) == pytest.approx(expected)
