"""Tracks over plans: the first frame tells the placement; trials over each other keep their ends."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.errors import InputError
from core.robot.model import load_robot
from core.trials.alignment import align, foot_gaps, placed_motion, repeated_motion, track_of_motion
from core.trials.band import trial_band
from core.vision.track import FootTrack
from core.vision.track_csv import parse_track_csv
from tests.support.reference import reference_path
from tests.support.trials.tracks import STANCE, stepping_track


@given(st.floats(-3.1, 3.1), st.floats(-0.1, 0.1), st.floats(-0.1, 0.1))
def test_a_turned_and_moved_robot_is_found_again(turn: float, x: float, y: float) -> None:
    track = stepping_track((0.01, 0.0), 1)
    back = np.array([[math.cos(turn), math.sin(turn)], [-math.sin(turn), math.cos(turn)]])
    motion = (track.feet[0] - [x, y]) @ back.T
    found = align(track, motion)
    assert found.turn == pytest.approx(turn, abs=1e-9)
    assert found.gaps.max() == pytest.approx(0.0, abs=1e-9)
    np.testing.assert_allclose(found.placed(motion), track.feet[0], atol=1e-9)
    np.testing.assert_allclose(found.taken_back(found.placed(motion)), motion, atol=1e-12)


@pytest.mark.parametrize(("letter", "turn"), [("A", -45.0), ("B", -45.0), ("C", 0.0), ("D", 0.0)])
def test_the_published_robots_stood_as_they_are_said_to(letter: str, turn: float) -> None:
    track = parse_track_csv(reference_path(f"robot_trials/tracks_cm/traj{letter}a_t1_o1_3x.csv").read_text())
    found = align(track, load_robot("deltawalker").module_centres_robot[:, :2])
    assert math.degrees(found.turn) == pytest.approx(turn, abs=3.0)
    assert found.gaps.max() < 0.006


def test_a_placed_motion_moves_along_the_tracks_direction() -> None:
    track = stepping_track((0.01, 0.0), 1)
    feet = np.zeros((2, 4, 3))
    feet[:, :, :2] = STANCE
    feet[1, :, 0] += 0.01
    turned = FootTrack(track.times, track.feet @ np.array([[0.0, 1.0], [-1.0, 0.0]]), track.filled)
    placed = placed_motion(np.array([0.0, 1.0]), feet, align(turned, feet[0, :, :2]))
    np.testing.assert_allclose(placed.feet[1] - placed.feet[0], [[0.0, 0.01]] * 4, atol=1e-9)


def test_a_band_holds_every_trial_and_ends_at_their_iterations() -> None:
    tracks = [stepping_track((step, 0.0), 2) for step in (0.010, 0.014)]
    band = trial_band(tracks, [(415, 831), (415, 831)])
    np.testing.assert_allclose(band.mean[-1, :, 0], 0.024, atol=1e-9)
    np.testing.assert_allclose(band.high[-1, :, 0] - band.low[-1, :, 0], 0.008, atol=1e-9)
    assert (band.low <= band.mean + 1e-12).all()
    assert (band.mean <= band.high + 1e-12).all()


def test_a_bands_ends_lie_apart_by_the_spread_of_the_trials() -> None:
    tracks = [stepping_track((step, 0.0), 2) for step in (0.010, 0.014)]
    band = trial_band(tracks, [(415, 831), (415, 831)])
    np.testing.assert_allclose(band.end_spread, 0.004, atol=1e-9)
    np.testing.assert_allclose(
        band.along(np.array([-2.0, 0.0]))[:, -1], [[-0.020] * 4, [-0.028] * 4], atol=1e-9
    )


def test_trials_of_other_iterations_are_not_laid_over_each_other() -> None:
    track = stepping_track((0.01, 0.0), 2)
    with pytest.raises(InputError, match="as many feet and iterations"):
        trial_band([track, track], [(415, 831), (831,)])


def test_feet_in_one_point_have_no_direction() -> None:
    with pytest.raises(InputError, match="no direction"):
        align(stepping_track((0.01, 0.0), 1), np.zeros((4, 2)))


@pytest.mark.parametrize("turn", [0.0, 0.3])
def test_a_repeated_motion_goes_on_from_where_it_ended(turn: float) -> None:
    turning = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    feet = np.stack([STANCE, STANCE + [0.004, 0.0], STANCE @ turning.T + [0.01, 0.0]])
    times, places = repeated_motion(np.array([0.0, 1.0, 2.0]), feet, 3)
    np.testing.assert_allclose(times, np.arange(7.0))
    whole = STANCE
    for lap in range(3):
        whole = whole @ turning.T + [0.01, 0.0]
        np.testing.assert_allclose(places[2 * (lap + 1)], whole, atol=1e-12)


def test_a_foot_lies_as_far_from_a_motion_as_it_is_moved_aside_at_whatever_pace() -> None:
    track = stepping_track((0.01, 0.0), 2)
    slower = FootTrack(track.times * 1.7 + 3.0, track.feet + [0.003, 0.004], track.filled)
    np.testing.assert_allclose(foot_gaps(track, (415, 831), slower), 0.005, atol=1e-5)


def test_frames_without_sight_of_a_foot_do_not_count() -> None:
    track = stepping_track((0.01, 0.0), 1)
    feet, filled = track.feet.copy(), track.filled.copy()
    feet[:200, 0, 0] += 0.05
    filled[:200, 0] = True
    seen = FootTrack(track.times, feet, filled)
    np.testing.assert_allclose(foot_gaps(seen, (415,), track), 0.0, atol=1e-9)
    hidden = FootTrack(track.times, feet, np.ones_like(filled))
    assert foot_gaps(hidden, (415,), track)[0] == pytest.approx(0.05 * 200 / 416)


def test_a_motion_of_other_feet_is_not_compared() -> None:
    track = stepping_track((0.01, 0.0), 1)
    three = FootTrack(track.times, track.feet[:, :3], track.filled[:, :3])
    with pytest.raises(InputError, match="3 feet, the track 4"):
        foot_gaps(track, (415,), three)


def test_a_track_in_the_motions_frame_begins_where_the_motion_does() -> None:
    track = stepping_track((0.01, 0.0), 1)
    quarter = STANCE @ np.array([[0.0, -1.0], [1.0, 0.0]]) + 0.02
    moved = track_of_motion(track, align(track, quarter))
    np.testing.assert_allclose(moved.feet[0], quarter, atol=1e-9)
    assert np.hypot(*(moved.feet[-1] - moved.feet[0]).T) == pytest.approx([0.01] * 4)
