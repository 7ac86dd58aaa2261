"""Movements by the published definitions: every published table, and made tracks with known answers."""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from pathlib import Path
from random import Random

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.errors import InputError
from core.trials.movement import Movement, foot_movements, mean_movement, spread
from core.vision.track import FootTrack
from core.vision.track_csv import parse_track_csv
from tests.support.reference import reference_path
from tests.support.trials.tracks import stepping_track

EXPECTED_CM = {"a": 3.0, "b": 4.5, "c": 6.0, "d": 7.5}
ROUNDING = 0.005 + 1e-9
"""Published movements have two decimals."""


def as_published(movement: Movement) -> list[float]:
    lengths = (movement.plus_x, movement.minus_x, movement.dx, movement.plus_y, movement.minus_y, movement.dy)
    last = [movement.distance * 100, math.degrees(movement.angle), movement.error * 100]
    return [*(length * 100 for length in lengths), *last]


def published(path: Path) -> list[list[float]]:
    with path.open(newline="") as file:
        return [[float(field) for field in row] for row in list(csv.reader(file))[1:]]


def rows_of(track: Path) -> Sequence[Movement]:
    feet = foot_movements(parse_track_csv(track.read_text(), track.name), EXPECTED_CM[track.name[5]] / 100)
    return [*feet, mean_movement(feet)]


def test_every_published_track_gives_the_published_movements_to_their_rounding() -> None:
    folder = reference_path("robot_trials")
    files = sorted((folder / "movements").glob("*.csv"))
    assert len(files) == 32
    for file in files:
        ours = rows_of(folder / "tracks_cm" / file.name.replace("Traj", "traj"))
        difference = np.abs(np.array([as_published(row) for row in ours]) - published(file))
        assert difference.max() <= ROUNDING, file.name


def test_a_straight_walk_is_as_long_as_its_steps() -> None:
    mean = mean_movement(foot_movements(stepping_track((0.01, 0.0), 3), 0.03))
    assert mean.distance == pytest.approx(0.03)
    assert mean.error == pytest.approx(0.0, abs=1e-9)
    assert (mean.angle, mean.minus_x) == (0.0, 0.0)


def test_going_back_shows_in_the_net_figures_only() -> None:
    there = stepping_track((0.01, 0.0), 2)
    back = np.concatenate([there.feet, there.feet[::-1]])
    track = FootTrack(np.arange(len(back)) / 13.0, back, np.zeros(back.shape[:2], dtype=np.bool_))
    movement = foot_movements(track, 0.02)[0]
    assert movement.distance == pytest.approx(0.02)
    assert movement.net_distance == pytest.approx(0.0)


MADE_TRACKS = {
    "straight": ([(0, 0), (3, 0)], 3.0),
    "backwards": ([(0, 0), (-3, -4)], 5.0),
    "there and back": ([(0, 0), (-3, 0), (0, -4), (0, 0)], 5.0),
    "a loop around its beginning": ([(0, 0), (5, 1), (1, 12), (0, -3), (-3, 0), (0, 0)], 17.0),
    "far from the origin": ([(1001, -7), (1004, -11)], 5.0),
    "at rest": ([(2, 2), (2, 2)], 0.0),
}
"""Places of a foot, and the extent distance of them, cm."""


@pytest.mark.parametrize(("places", "extent"), MADE_TRACKS.values(), ids=MADE_TRACKS)
def test_the_extent_distance_spans_the_least_box_around_a_track(
    places: list[tuple[float, float]], extent: float
) -> None:
    feet = np.repeat(np.array(places)[:, None] / 100, 4, axis=1)
    feet[:, 1] = 0.0
    track = FootTrack(np.arange(len(feet)) / 13.0, feet, np.zeros(feet.shape[:2], dtype=np.bool_))
    movements = foot_movements(track, 0.03)
    expected = [extent, 0.0, extent, extent]
    assert [foot.extent_distance * 100 for foot in movements] == pytest.approx(expected, abs=1e-9)
    assert mean_movement(movements).extent_distance * 100 == pytest.approx(extent * 0.75, abs=1e-9)


def test_gaps_leave_the_extent_distance_of_what_was_seen() -> None:
    text = "X_D1,Y_D1\n1,1\n,\n4,5\n,\n,\n2,-7\n"
    movement = foot_movements(parse_track_csv(text, "made.csv"), 0.03)[0]
    assert movement.extent_distance * 100 == pytest.approx(math.hypot(3, 12), abs=1e-9)


@given(st.lists(st.tuples(st.floats(-1, 1), st.floats(-1, 1)), min_size=2, max_size=9), st.randoms())
def test_the_extent_distance_needs_no_first_or_last_frame(
    places: list[tuple[float, float]], random: Random
) -> None:
    def movement(feet: list[tuple[float, float]]) -> Movement:
        track = FootTrack(
            np.arange(len(feet)) / 13.0, np.array(feet)[:, None], np.zeros((len(feet), 1), dtype=np.bool_)
        )
        return foot_movements(track, 0.03)[0]

    one, other = movement(places), movement(random.sample(places, len(places)))
    assert one.extent_distance == other.extent_distance
    assert one.extent_distance >= max(one.distance, one.net_distance) - 1e-12


def test_published_tracks_have_the_extents_of_their_columns() -> None:
    files = sorted((reference_path("robot_trials") / "tracks_cm").glob("*.csv"))
    assert len(files) == 32
    for file in files:
        columns = np.loadtxt(file, delimiter=",", skiprows=1)
        extents = columns.max(axis=0) - columns.min(axis=0)
        expected = np.hypot(extents[0::2], extents[1::2])
        ours = rows_of(file)
        assert [foot.extent_distance * 100 for foot in ours[:-1]] == pytest.approx(expected, abs=1e-9)
        assert ours[-1].extent_distance * 100 == pytest.approx(expected.mean(), abs=1e-9)


@given(
    st.floats(-math.pi, math.pi),
    st.tuples(st.floats(-0.1, 0.1), st.floats(-0.1, 0.1)),
)
def test_turning_and_moving_a_track_leaves_net_distances(angle: float, shift: tuple[float, float]) -> None:
    track = stepping_track((0.01, 0.003), 1, noise=0.0005)
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    turned = FootTrack(track.times, track.feet @ turn.T + np.array(shift), track.filled)
    before, after = foot_movements(track, 0.01), foot_movements(turned, 0.01)
    for one, other in zip(before, after, strict=True):
        assert other.net_distance == pytest.approx(one.net_distance)
        assert math.cos(other.net_angle - one.net_angle - angle) == pytest.approx(1.0)


def test_means_and_spread_are_by_column() -> None:
    short, long = (foot_movements(stepping_track((step, 0.0), 1), 0.01)[0] for step in (0.01, 0.012))
    assert mean_movement([short, long]).distance == pytest.approx(0.011)
    assert spread([short, long]).distance == pytest.approx(0.001 * math.sqrt(2))


@pytest.mark.parametrize("expected", [0.0, -0.03, math.nan])
def test_a_movement_needs_a_wanted_distance(expected: float) -> None:
    with pytest.raises(InputError, match="must be more than 0"):
        foot_movements(stepping_track((0.01, 0.0), 1), expected)
