"""A trial as it was kept, read once for everything that is laid over it."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from app.store.tables.shapes import ShapeError
from app.store.tables.table import reading
from app.store.tables.trial_store import TrialRow
from app.trials.figures import ROBOT
from app.trials.planned import PlannedFeet
from core.arrays import interpolated
from core.errors import InputError
from core.robot.model import load_robot
from core.trials.alignment import Alignment, align, align_feet, placed_motion
from core.trials.iterations import find_iterations
from core.vision.frame_times import timed_track
from core.vision.track import FootTrack
from core.vision.track_csv import parse_track_csv

SAME_LAP = 1e-6
"""A part of a lap that is none."""


@dataclass(frozen=True, eq=False)
class TrialRecord:
    """Everything of a trial.

    Args:
        content: what is known of it.
        track: all frames.
        planned: where the feet were to be; None where nothing was planned. What was sent is not read.
    """

    content: dict[str, Any]
    track: FootTrack
    planned: PlannedFeet | None

    @cached_property
    def ends(self) -> tuple[int, ...]:
        """Last frame of each iteration, as set by hand, as the run's log tells, or else as found."""
        told, _ = told_ends(self.content)
        if told is not None:
            return told
        return find_iterations(self.track, self.content["iterations"]).ends

    @property
    def expected(self) -> float:
        """Wanted distance of the whole walk, m."""
        return float(self.content["expected_cm"]) / 100.0

    @cached_property
    def alignment(self) -> Alignment:
        """How the plan's frame lies in the track's; without a plan that of a standing robot."""
        if self.planned is not None:
            return align(self.track, self.planned.feet[0])
        return align(self.track, load_robot(ROBOT).module_centres_robot[:, :2])

    @property
    def lap_seconds(self) -> float:
        """How long the plan takes once, s; 0 where nothing was planned."""
        if self.planned is None:
            return 0.0
        whole = float(self.planned.times[-1] - self.planned.times[0])
        return self.planned.lap_seconds or whole / self.planned.laps

    @property
    def laps(self) -> int:
        """In how many laps the plan is there; a run that was ended early has fewer than it was to do."""
        if self.planned is None:
            return 1
        whole = float(self.planned.times[-1] - self.planned.times[0])
        return max(1, math.ceil(whole / self.lap_seconds - SAME_LAP))

    def alignment_of_lap(self, lap: int) -> Alignment:
        """How the plan's frame lies in the track's where a lap begins, where the lap before was to end.

        Args:
            lap: from 1.

        Raises:
            InputError: there is no such lap.
        """
        if not 1 <= lap <= self.laps:
            raise InputError(f"The walk has {self.laps} laps of its plan; choose one of them.", "lap")
        plan = self.placed_plan
        if lap == 1 or plan is None or self.planned is None:
            return self.alignment
        later = plan.times[0] + (lap - 1) * self.lap_seconds
        (place,) = interpolated(np.array([later]), plan.times, plan.feet)
        return align_feet(place, self.planned.feet[0])

    @property
    def placed_plan(self) -> FootTrack | None:
        """The plan in the track's frame."""
        if self.planned is None:
            return None
        return placed_motion(self.planned.times, self.planned.feet, self.alignment)


def told_ends(content: Mapping[str, Any]) -> tuple[tuple[int, ...] | None, str]:
    """Last frame of each iteration as a hand or the run's log tells, and who does; None for the "tracks"."""
    if content.get("ends") is not None:
        return tuple(content["ends"]), "hand"
    ends = (content.get("sight") or {}).get("run_ends")
    if ends is not None and len(ends) == content["iterations"]:
        return tuple(ends), "run"
    return None, "tracks"


def kept_track(row: TrialRow) -> FootTrack:
    """The track with the times at which it was seen."""
    content = row.content
    track = parse_track_csv(row.track, content["name"], frame_rate=content["frame_rate"])
    track_record = content.get("sight")
    if track_record is None:
        return track
    times = np.array(track_record["times"])
    if times.shape != track.times.shape:
        raise ShapeError("content.sight.times", f"has {times.size} times of {track.times.size} frames")
    return timed_track(track, times)


def trial_record(row: TrialRow) -> TrialRecord:
    """Reads a trial.

    Raises:
        DamagedRowError: something in it is missing or of another kind.
    """
    with reading(f"The trial “{row.content['name']}” cannot be read: "):
        return _trial_record(row)


def _trial_record(row: TrialRow) -> TrialRecord:
    content, track = row.content, kept_track(row)
    plan = content.get("plan")
    planned = None
    if plan is not None:
        times, feet = np.array(plan["times"]), np.array(plan["feet"])
        if times.size < 2 or feet.shape != (times.size, *track.feet.shape[1:]):
            raise ShapeError("content.plan", "has too few times, or other feet than the track")
        planned = PlannedFeet(times, feet, plan.get("laps") or 1, lap_seconds=plan.get("lap_seconds"))
    record = TrialRecord(content, track, planned)
    if not all(0 < end < track.times.size for end in record.ends):
        raise ShapeError("content.ends", "lie outside the track")
    return record
