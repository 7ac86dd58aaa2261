"""The trial of a run: from its first waypoint on, held to as much of the plan as was done."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from app.runs.record import RunRecord, read_record
from app.store.database import Database
from app.store.tables.run_store import RunStore
from app.trials.run_trial import run_trial
from app.vision.tracking import VideoTrack
from core.errors import InputError, StateError
from core.vision.track import FootTrack
from tests.support.ran_robot import keep_run

RATE = 10.0


@pytest.fixture
def record(database: Database) -> RunRecord:
    return read_record(RunStore(database), keep_run(database))


def seen(seconds: float, begin: float = 0.0) -> VideoTrack:
    """Feet that stand still for a time of the run's clock."""
    times = np.arange(begin, seconds, 1.0 / RATE)
    feet = np.repeat(np.array([[[0.04, 0.0], [0.0, 0.04], [-0.04, 0.0], [0.0, -0.04]]]), len(times), axis=0)
    nothing = np.zeros((len(times), 4), dtype=np.bool_)
    return VideoTrack(FootTrack(times, feet, nothing), nothing, nothing, nothing[:, 0])


def cut_short(record: RunRecord, count: int) -> RunRecord:
    """The run as it was after so many commands."""
    return replace(record, series=replace(record.series, commands=record.series.commands[:count]))


def test_a_whole_run_is_held_to_its_whole_plan(record: RunRecord) -> None:
    streamed = record.series.streamed
    trial = run_trial(record, seen(streamed[-1].arrived + 1.0))
    assert trial.words.run == record.content["id"]
    assert trial.words.expected_cm == pytest.approx(1.0, rel=0.2)
    assert trial.remarks == ()
    assert trial.found.track.times[0] >= streamed[0].sent
    assert trial.ends is not None
    end = trial.found.track.times[trial.ends[0]]
    assert end == pytest.approx(streamed[-1].arrived, abs=1.5 / RATE)


def test_a_run_that_was_ended_early_is_held_to_what_it_did(record: RunRecord) -> None:
    whole = run_trial(record, seen(record.series.streamed[-1].arrived + 1.0))
    half = cut_short(record, len(record.series.commands) * 2 // 3)
    trial = run_trial(half, seen(half.series.streamed[-1].arrived + 1.0))
    assert 0.0 < trial.words.expected_cm < whole.words.expected_cm
    assert "The plan counts as far as the robot did it" in trial.remarks[0]
    assert trial.ends is None


def test_iterations_that_the_camera_did_not_see_are_counted(record: RunRecord) -> None:
    trial = run_trial(record, seen(record.series.streamed[-1].arrived / 2))
    assert trial.ends is None
    assert trial.remarks == ("0 of 1 iterations were seen.",)


def test_a_camera_that_saw_only_the_way_to_the_start_makes_no_trial(record: RunRecord) -> None:
    with pytest.raises(InputError, match="saw nothing of the walk"):
        run_trial(record, seen(record.series.streamed[0].sent / 2))


def test_a_run_that_reached_no_waypoint_makes_no_trial(record: RunRecord) -> None:
    with pytest.raises(StateError, match="reached no waypoint"):
        run_trial(cut_short(record, 1), seen(5.0))
