"""A trial as it was kept, read once for everything that is laid over it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from app.store.trial_log import TrialRow
from app.trials.planned import PlannedFeet
from core.errors import InputError
from core.robot import load_robot
from core.trials.alignment import Alignment, align, placed_motion
from core.trials.iterations import find_iterations
from core.trials.track import FootTrack
from core.trials.track_csv import parse_track_csv

ROBOT = "deltawalker"
"""The one robot that stands on a platform (its cable's robot)."""


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
    def laps(self) -> int:
        """How often the plan is walked."""
        return 1 if self.planned is None else self.planned.laps

    def alignment_of_lap(self, lap: int) -> Alignment:
        """How the plan's frame lies in the track's where a lap begins, where the lap before was to end.

        Args:
            lap: from 1.

        Raises:
            InputError: there is no such lap.
        """
        if not 1 <= lap <= self.laps:
            raise InputError(f"The plan was walked {self.laps} times; choose a lap from 1 on.", "lap")
        plan = self.placed_plan
        if lap == 1 or plan is None or self.planned is None:
            return self.alignment
        begin = (lap - 1) * (plan.times.size - 1) // self.laps
        return align(plan.between(begin, plan.times.size - 1), self.planned.feet[0])

    @property
    def placed_plan(self) -> FootTrack | None:
        """The plan in the track's frame."""
        if self.planned is None:
            return None
        return placed_motion(self.planned.times, self.planned.feet, self.alignment)


def told_ends(content: Mapping[str, Any]) -> tuple[tuple[int, ...] | None, str]:
    """Last frame of each iteration as a hand or the run's log tells, and who does; None for the "tracks"."""
    if content["ends"] is not None:
        return tuple(content["ends"]), "hand"
    ends = (content.get("sight") or {}).get("run_ends")
    if ends is not None and len(ends) == content["iterations"]:
        return tuple(ends), "run"
    return None, "tracks"


def kept_track(row: TrialRow) -> FootTrack:
    """The track with the times at which it was seen."""
    content = row.content
    track = parse_track_csv(row.track, content["name"], frame_rate=content["frame_rate"])
    sight = content.get("sight")
    return track if sight is None else replace(track, times=np.array(sight["times"]))


def trial_record(row: TrialRow) -> TrialRecord:
    """Reads a trial."""
    content, track = row.content, kept_track(row)
    plan = content["plan"]
    planned = None
    if plan is not None:
        planned = PlannedFeet(np.array(plan["times"]), np.array(plan["feet"]), plan.get("laps", 1))
    return TrialRecord(content, track, planned)
