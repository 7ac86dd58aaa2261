"""The trial of a run that a camera saw: its words, its plan and its iterations come from the run's record."""

from dataclasses import dataclass, replace
from datetime import datetime

import numpy as np

from app.runs.record import RunRecord
from app.trials.planned import PlannedFeet, planned_of_run
from app.trials.service import TrialDescription
from app.vision.tracking import VideoTrack
from core.arrays import Floats, interpolated
from core.errors import InputError, StateError
from core.runs.iterations import iteration_arrivals

LEAST_WAY = 5e-4
"""A plan whose feet move less on the mean is no walk, m."""

LATE_SECONDS = 0.5
"""An iteration that ended so long after the last picture was still seen."""


@dataclass(frozen=True, eq=False)
class RunTrial:
    """A trial as it is to be kept.

    Args:
        found: the track from the first waypoint on.
        words: what is said of it.
        planned: where the feet were to be.
        ends: last frame of each iteration; None where the run does not tell.
        remarks: sentences about what is missing.
    """

    found: VideoTrack
    words: TrialDescription
    planned: PlannedFeet
    ends: tuple[int, ...] | None
    remarks: tuple[str, ...]


def run_trial(record: RunRecord, found: VideoTrack) -> RunTrial:
    """Makes a trial of a run and the track that was seen of it.

    The track counts from when the first waypoint was sent: before that the robot goes to the start pose. Of a
    run that was ended early the plan counts as far as the robot came.

    Args:
        record: of the run.
        found: times are those of the run's clock.

    Raises:
        StateError: no waypoint was reached, or the plan leads nowhere.
        InputError: nothing was seen after the first waypoint.
    """
    reached = [command for command in record.series.streamed if command.is_reached]
    if not reached:
        raise StateError("The robot reached no waypoint, so there is no walk to look at.", "run")
    seen = _from(found, record.series.streamed[0].sent)
    planned, remarks = _planned(record)
    expected = float(np.hypot(*(planned.feet[-1] - planned.feet[0]).T).mean())
    if expected < LEAST_WAY:
        raise StateError("The feet are meant to stay in place, so there is no distance to measure.", "run")
    ends = _ends(record, seen.track.times)
    if ends is not None:
        done = iteration_arrivals(record.plan, record.series)
        if done is not None and len(ends) < len(done):
            remarks += (f"{len(ends)} of {len(done)} iterations were seen.",)
    content = record.content
    when = datetime.fromtimestamp(content["started"]).astimezone()
    words = TrialDescription(
        f"{content['gait_name']}, {when:%d %b %H:%M}",
        content["by"],
        expected * 100.0,
        len(ends) if ends else 1,
        gait=content["gait"],
        gait_name=content["gait_name"],
        run=content["id"],
    )
    return RunTrial(seen, words, planned, ends or None, remarks)


def _from(found: VideoTrack, began: float) -> VideoTrack:
    """The part of a track from a time on."""
    first = int(np.searchsorted(found.track.times, began))
    last = found.track.times.size - 1
    if last - first < 1:
        raise InputError("The camera saw nothing of the walk after its first waypoint.", "run")
    return replace(
        found,
        track=found.track.between(first, last),
        unseen=found.unseen[first:],
        false=found.false[first:],
        missing=found.missing[first:],
    )


def _planned(record: RunRecord) -> tuple[PlannedFeet, tuple[str, ...]]:
    """The plan as far as it was done."""
    planned, plan, content = planned_of_run(record), record.plan, record.content
    reached = [command for command in record.series.streamed if command.is_reached]
    begin = float(plan.times[content.get("from", 0)])
    lap = float(plan.trajectory.times[-1] - plan.trajectory.times[0])
    end = reached[-1].lap * lap + float(plan.times[reached[-1].index])
    is_whole = begin <= planned.times[0] + 1e-6 and end >= planned.times[-1] - 1e-6
    if is_whole:
        return planned, ()
    inside = (planned.times > begin) & (planned.times < end)
    times = np.concatenate([[begin], planned.times[inside], [end]])
    cut = replace(planned, times=times, feet=interpolated(times, planned.times, planned.feet), sent=None)
    count = content.get("count", len(reached))
    return cut, (f"The plan counts as far as the robot did it: {len(reached)} of {count} waypoints.",)


def _ends(record: RunRecord, times: Floats) -> tuple[int, ...] | None:
    """Last frame of each iteration that was seen to its end."""
    arrived = iteration_arrivals(record.plan, record.series)
    if arrived is None:
        return None
    seen = arrived[arrived <= times[-1] + LATE_SECONDS]
    frames = np.searchsorted(times, seen, side="right") - 1
    frames = frames[frames > 0]
    return tuple(int(frame) for frame in np.unique(frames))
