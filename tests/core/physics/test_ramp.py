"""The firmware's timing of waypoints, and motors that follow it with limited speed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.errors import InputError
from core.physics.motors import motor_force_limits, motor_speeds
from core.physics.parameters import PhysicsSet, physics_set
from core.physics.ramp import TURN, MotorTrajectory, motor_trajectory, ramp_shares
from core.physics.variations import variations
from core.robot.model import load_robot
from core.wire.robot_time import ARRIVED, PUBLISHED, RAMP_SPEED, ramp_time
from core.wire.waypoints import Waypoints

MODEL = load_robot("deltawalker")
SPEEDS = motor_speeds(MODEL, physics_set())


def course(*strokes_mm: float, share: float = 1.0) -> MotorTrajectory:
    """All motors go to these strokes, one after the other."""
    rows = np.repeat(np.array(strokes_mm)[:, None, None] / 1000, 4, 1).repeat(3, 2)
    return motor_trajectory(Waypoints(rows, np.full(len(rows), 0.4)), share * SPEEDS)


def weak(**changes: object) -> PhysicsSet:
    return replace(physics_set(), **changes)  # type: ignore[arg-type]


@pytest.mark.parametrize(("distance_mm", "second"), [(1.05, 0), (3.0, 1), (5.0, 1), (7.0, 0), (14.0, 0)])
def test_a_move_takes_the_time_of_the_law_and_its_second_ramp_as_usual(
    distance_mm: float, second: int
) -> None:
    made = course(1.0, 1.0 + distance_mm)
    expected = PUBLISHED.message + ramp_time(distance_mm / 1000) + second * PUBLISHED.second_ramp
    assert made.duration == pytest.approx(expected, abs=2 * TURN)
    np.testing.assert_allclose(made.strokes[-1], (1.0 + distance_mm) / 1000, atol=1e-12)


def test_a_waypoint_within_the_threshold_moves_nothing_and_is_caught_up_later() -> None:
    made = course(5.0, 5.9, 6.8)
    still = made.strokes[: made.arrivals[1] + 1]
    assert (still == still[0]).all()
    assert made.arrivals[1] * TURN == pytest.approx(PUBLISHED.arrived, abs=TURN)
    np.testing.assert_allclose(made.strokes[-1], 0.0068, atol=1e-12)


@pytest.mark.parametrize("count", [3, 40, 133, 200, 260])
def test_a_ramp_s_speed_rises_and_falls_evenly_and_keeps_the_limit(count: int) -> None:
    shares = np.concatenate([[0.0], ramp_shares(count)])
    speeds = np.diff(shares)
    np.testing.assert_allclose(speeds, speeds[::-1], atol=1e-12)
    assert shares[-1] == 1.0
    assert (speeds >= 0).all()
    duration = count * TURN
    distance = RAMP_SPEED * (duration / 2 if duration <= 2 else duration - 1)
    assert ramp_time(distance) == pytest.approx(duration)
    assert speeds.max() * distance / TURN <= RAMP_SPEED + 1e-12


@given(
    st.lists(st.floats(0.5, 19.5), min_size=2, max_size=6),
    st.floats(0.1, 1.0),
)
def test_motors_keep_their_speed_and_end_within_the_threshold(places: list[float], share: float) -> None:
    made = course(*places, share=share)
    speeds = np.abs(np.diff(made.strokes, axis=0)) / TURN
    assert speeds.max(initial=0.0) <= share * RAMP_SPEED + 1e-9
    wanted = np.array(places)[:, None, None] / 1000
    assert np.abs(made.strokes[made.arrivals] - wanted).max() <= ARRIVED + 1e-9
    assert len(made.targets) == len(made.strokes) == made.arrivals[-1] + 1


def test_a_weak_motor_has_its_share_of_speed_and_force() -> None:
    physics = weak(weak_motor=7, weak_share=0.5, motor_speed=0.8)
    speeds, forces = motor_speeds(MODEL, physics).ravel(), motor_force_limits(MODEL, physics).ravel()
    assert speeds[7] == pytest.approx(0.4 * RAMP_SPEED)
    assert speeds[0] == pytest.approx(0.8 * RAMP_SPEED)
    assert forces[7] == pytest.approx(physics.motor_force / 2)


@pytest.mark.parametrize(
    ("changes", "word"),
    [({"motor_speed": 0.01}, "speed"), ({"weak_motor": 12}, "12 motors"), ({"weak_motor": -1}, "12 motors")],
)
def test_motors_that_cannot_be_are_refused(changes: dict[str, object], word: str) -> None:
    with pytest.raises(InputError, match=word):
        motor_speeds(MODEL, weak(**changes))


def test_motors_without_force_are_refused() -> None:
    with pytest.raises(InputError, match="more than 0"):
        motor_force_limits(MODEL, weak(motor_force=0.0))


def test_variations_repeat_by_their_seed_and_stay_near_their_set() -> None:
    base = physics_set()
    drawn, fewer = variations(base, 64, 3, 12), variations(base, 8, 3, 12)
    assert drawn[:8] == fewer
    assert variations(base, 8, 4, 12) != fewer
    assert {one.physics.weak_motor for one in drawn} == set(range(12))
    for one in drawn:
        assert np.hypot(*one.physics.ground_tilt) <= np.radians(1.0)
        assert 0.45 < one.physics.friction < 1.1
        assert 4000 < one.physics.link_stiffness < 61000
        assert one.physics.name != base.name


@pytest.mark.parametrize("count", [0, -1, 100000])
def test_a_count_of_variations_out_of_bounds_is_refused(count: int) -> None:
    with pytest.raises(InputError, match="variations"):
        variations(physics_set(), count, 0, 12)
