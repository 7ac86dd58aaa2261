"""The law of the robot's time agrees with the emulated board, move by move and for whole gaits."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from app.bench.robot.law import Sample, fitted, gait_sample, gait_waypoints, random_moves
from app.emulator.profiles import ProfileName
from core.wire.robot_time import LAWS, PUBLISHED, TimeLaw, far_motors
from core.wire.waypoints import Waypoints

LENGTHS_MM = (2.5, 4.0, 5.5, 7.0, 10.0, 15.0)
MOVES = 50


def law_seconds(law: TimeLaw, moves: np.ndarray) -> float:
    return float(law.move_seconds(moves.max(axis=1), far_motors(moves)).sum())


@pytest.mark.heavy
@pytest.mark.parametrize("profile", ProfileName)
def test_random_moves_take_the_time_of_the_law(profile: ProfileName) -> None:
    law = LAWS[profile.value]
    made = [random_moves(profile, "all motors", length / 1000, MOVES) for length in LENGTHS_MM]
    errors = [law_seconds(law, timed.moves) / timed.seconds.sum() - 1.0 for timed in made]
    assert np.abs(errors).max() < 0.08
    assert abs(np.mean(errors)) < 0.03
    # Without the number of motors the law is as good for such moves.
    plain = [law.move_seconds(timed.moves.max(axis=1)).sum() / timed.seconds.sum() - 1.0 for timed in made]
    assert np.abs(plain).max() < 0.08


@pytest.mark.parametrize("profile", ProfileName)
@pytest.mark.parametrize("kind", ["one leg", "body"])
def test_a_leg_and_the_body_take_the_time_of_the_law_within_a_tenth(kind: str, profile: ProfileName) -> None:
    made = [random_moves(profile, kind, length / 1000, 20) for length in (3.0, 5.0, 8.0)]
    error = sum(law_seconds(LAWS[profile.value], m.moves) for m in made) / sum(m.seconds.sum() for m in made)
    assert error == pytest.approx(1.0, abs=0.1)


@pytest.mark.parametrize("profile", ProfileName)
def test_a_walk_as_sent_and_a_gait_of_long_moves_take_the_time_of_the_law(profile: ProfileName) -> None:
    walk = gait_sample(profile, "walk", gait_waypoints("walk"))
    assert abs(walk.error(LAWS[profile.value])) < 0.05
    long = random_moves(profile, "all motors", 0.007, 40)
    assert law_seconds(LAWS[profile.value], long.moves) == pytest.approx(long.seconds.sum(), rel=0.05)


@pytest.mark.parametrize("profile", ProfileName)
def test_a_waypoint_that_is_reached_already_costs_one_scan(profile: ProfileName) -> None:
    still = Waypoints(np.full((4, 4, 3), 0.01), np.full(4, 0.4))
    assert abs(gait_sample(profile, "still", still).error(LAWS[profile.value])) < 0.01


def test_a_fit_finds_the_law_that_made_the_times() -> None:
    lengths_mm = (0.5, 2.0, 4.0, 6.0)
    timed = [random_moves(ProfileName.PUBLISHED, "all motors", mm / 1000, 20) for mm in lengths_mm]
    samples = [
        Sample("all motors", "", law_seconds(PUBLISHED, one.moves), partial(law_seconds, moves=one.moves))
        for one in timed[1:]
    ]
    off = replace(PUBLISHED, message=0.5, arrived=0.1, often=0.6, never_from=0.0075)
    law = fitted(off, timed, samples)
    assert law.message == pytest.approx(PUBLISHED.message, rel=0.05)
    assert law.arrived == pytest.approx(PUBLISHED.arrived, rel=0.01)
    assert max(abs(sample.error(law)) for sample in samples) < 0.05
