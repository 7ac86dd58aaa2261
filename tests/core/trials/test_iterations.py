"""Ends of iterations: where the feet say, near where people clicked, and refused where there are none."""

from __future__ import annotations

import csv
from dataclasses import replace

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
WANTED_CM = {"a": 1.0, "b": 1.5, "c": 2.0, "d": 2.5}
"""Steps of the published trials by the second letter of their names."""


@pytest.mark.parametrize("count", [1, 2, 3, 5])
def test_iterations_end_between_the_last_step_of_one_and_the_first_of_the_next(count: int) -> None:
    track = stepping_track((0.012, 0.002), count, noise=0.0005)
    found = find_iterations(track, count)
    wanted = [round(32.0 * RATE * (part + 1)) for part in range(count)]
    assert np.abs(np.array(found.ends) - wanted).max() <= RATE
    assert found.is_clear
    parts = iteration_movements(track, found.ends, 0.012)
    assert [part.mean.net_distance for part in parts] == pytest.approx([0.0122] * count, abs=1e-3)


def test_ends_and_step_means_of_the_published_tracks_are_near_those_of_clicked_ends() -> None:
    folder = reference_path("robot_trials")
    files = sorted((folder / "steps").glob("*.csv"))
    assert len(files) == 32
    apart, printed, rates, shifted = [], [], [], 0
    for file in files:
        with file.open(newline="") as text:
            rows = np.array(list(csv.reader(text))[1:], dtype=np.float64)
        table, (*_, step, turn, _, pace) = rows[:3], rows[3]
        seconds, wanted = table[:, -1], WANTED_CM[file.name[5]]
        track = parse_track_csv((folder / "tracks_cm" / file.name.replace("Traj", "traj")).read_text())
        found = find_iterations(track, 3)
        ours = np.array(found.ends) / track.times.size * seconds.sum()
        assert found.is_clear, file.name
        assert np.abs(ours[:2] - np.cumsum(seconds)[:2]).max() <= CLICKED_WITHIN, file.name
        feet = table[:, 1:21].reshape(3, 4, 5)
        dx, dy, distance, angle, error = np.moveaxis(feet, -1, 0)
        assert np.hypot(dx, dy) == pytest.approx(wanted * (1.0 + error / 100.0), abs=0.0005 * wanted + 1e-9)
        assert np.degrees(np.arctan2(dy, dx)) == pytest.approx(angle, abs=0.0501)
        assert np.hypot(dx, dy) == pytest.approx(distance, abs=0.0501)
        parts = [part.mean for part in iteration_movements(track, found.ends, wanted / 100.0)]
        mean = np.mean([part.net_distance for part in parts]) * 100.0
        turned = np.degrees(np.mean([part.net_angle for part in parts]))
        apart.append([mean - np.hypot(dx, dy).mean(), turned - np.degrees(np.arctan2(dy, dx)).mean()])
        rate = (track.times.size - 1) / seconds.sum()
        late = track.seconds / 3.0 - pace
        printed.append([mean - step, turned - turn, late, late + (RATE / rate - 1.0) * track.seconds / 3.0])
        rates.append(rate)
        moved = feet[..., :2].sum(axis=0) - (track.feet[-1] - track.feet[0]) * 100.0
        assert np.abs(moved[:, 1]).max() < 0.05, file.name
        shifted += int((np.abs(moved[:, 0]) > 0.05).sum())
    assert shifted == 54
    assert [round(min(rates), 1), round(max(rates), 1)] == [12.2, 13.6]
    sizes = np.abs(apart)
    assert sizes.mean(axis=0) == pytest.approx([0.009, 0.14], abs=0.005)
    assert sizes.max(axis=0) == pytest.approx([0.025, 0.54], abs=0.005)
    sizes = np.abs(printed)
    assert sizes.mean(axis=0) == pytest.approx([0.026, 0.146, 0.76, 0.025], abs=0.005)
    assert sizes.max(axis=0) == pytest.approx([0.06, 0.49, 2.32, 0.033], abs=0.005)


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


def test_ends_in_a_gap_without_frames_are_refused() -> None:
    track = stepping_track((0.012, 0.002), 3)
    late = replace(track, times=np.append(track.times[:-1], track.times[-1] + 900.0))
    with pytest.raises(InputError, match="the track has no frame for 900"):
        find_iterations(late, 3)
