"""Ends of iterations: where the feet say, near where people clicked, and refused where there are none."""

from __future__ import annotations

import csv

import numpy as np
import pytest

from core.errors import InputError
from core.trials.iterations import find_iterations, iteration_movements, standing_slip
from core.vision.track import FootTrack
from core.vision.track_csv import parse_track_csv
from tests.support.reference import reference_path
from tests.support.trials.tracks import RATE, stepping_track

CLICKED_WITHIN = 3.1
"""Seconds by which an end found from the steps may differ from one that was clicked by eye."""


@pytest.mark.parametrize("count", [1, 2, 3, 5])
def test_iterations_end_between_the_last_step_of_one_and_the_first_of_the_next(count: int) -> None:
    track = stepping_track((0.012, 0.002), count, noise=0.0005)
    found = find_iterations(track, count)
    wanted = [round(32.0 * RATE * (part + 1)) for part in range(count)]
    assert np.abs(np.array(found.ends) - wanted).max() <= RATE
    assert found.is_clear
    parts = iteration_movements(track, found.ends, 0.012)
    assert [part.mean.net_distance for part in parts] == pytest.approx([0.0122] * count, abs=1e-3)


def test_ends_in_the_published_tracks_are_near_those_that_were_clicked() -> None:
    folder = reference_path("robot_trials")
    files = sorted((folder / "steps").glob("*.csv"))
    assert len(files) == 32
    for file in files:
        with file.open(newline="") as text:
            seconds = np.array([float(row[-1]) for row in list(csv.reader(text))[1:4]])
        track = parse_track_csv((folder / "tracks_cm" / file.name.replace("Traj", "traj")).read_text())
        found = find_iterations(track, 3)
        ours = np.array(found.ends) / track.times.size * seconds.sum()
        assert found.is_clear, file.name
        assert np.abs(ours[:2] - np.cumsum(seconds)[:2]).max() <= CLICKED_WITHIN, file.name


def test_slip_of_standing_feet_is_measured_between_their_steps() -> None:
    track = stepping_track((0.012, 0.0), 2)
    found = find_iterations(track, 2)
    assert standing_slip(track, found.steps).max() == pytest.approx(0.0, abs=1e-9)
    slid = np.array(track.feet)
    slid[round(20.0 * RATE) :, 2, 1] += 0.004
    slip = standing_slip(FootTrack(track.times, slid, track.filled), found.steps)
    assert slip[2, 1] == pytest.approx(0.004)
    assert np.delete(slip.ravel(), 2 * 3 + 1).max() == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("count", [0, 200])
def test_a_track_too_short_for_its_iterations_is_refused(count: int) -> None:
    with pytest.raises(InputError, match="too few for"):
        find_iterations(stepping_track((0.01, 0.0), 2), count)


@pytest.mark.parametrize("ends", [(500, 400), (100, 10_000)])
def test_ends_must_be_frames_in_order(ends: tuple[int, ...]) -> None:
    with pytest.raises(InputError, match="one after the other"):
        iteration_movements(stepping_track((0.01, 0.0), 2), ends, 0.01)
