"""Two runs side by side, waypoint by waypoint."""

from collections.abc import Collection
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from core.arrays import Floats
from core.runs.reading import START, RunSeries, SentWaypoint

Place = tuple[int, int]
"""Lap and index of a waypoint, both 0-based."""


@dataclass(frozen=True, eq=False)
class AlignedRun:
    """One of two runs at the waypoints that both reached.

    Args:
        seconds: (n,) from sending the first of these waypoints to arriving at each, s.
        move_seconds: (n,) from sending each to arriving there, s.
        error_mm: (n,) largest distance of any motor from its command at the arrival.
        measured_mm: (n, motors) strokes at the arrivals.
        target_mm: (n, motors) strokes that were commanded.
        series: the run as if it had led to these waypoints alone.
    """

    seconds: Floats
    move_seconds: Floats
    error_mm: Floats
    measured_mm: Floats
    target_mm: Floats
    series: RunSeries


@dataclass(frozen=True, eq=False)
class RunComparison:
    """Two runs aligned by waypoint.

    Args:
        laps: (n,) how often the waypoints were gone through before, 0-based.
        indices: (n,) of the waypoints that both reached, 0-based.
        one: the first run at these.
        other: the second run at these.
    """

    laps: NDArray[np.int64]
    indices: NDArray[np.int64]
    one: AlignedRun
    other: AlignedRun


def compare_runs(one: RunSeries, other: RunSeries) -> RunComparison:
    """Aligns two runs by lap and number of their waypoints; n is 0 where they reached none in common.

    A run that was stopped is so compared as far as it came, and one that began later from there.
    """
    reached = [_reached(series) for series in (one, other)]
    common = sorted(reached[0].keys() & reached[1].keys())
    places = np.array(common, dtype=np.int64).reshape(-1, 2)
    return RunComparison(
        places[:, 0],
        places[:, 1],
        *(
            _aligned(series, [known[place] for place in common], common)
            for series, known in zip((one, other), reached, strict=True)
        ),
    )


def _reached(series: RunSeries) -> dict[Place, SentWaypoint]:
    return {(command.lap, command.index): command for command in series.commands if command.is_reached}


def _aligned(series: RunSeries, commands: list[SentWaypoint], common: Collection[Place]) -> AlignedRun:
    motors = series.measured_mm.shape[1]
    sent, arrived = (
        np.array([getattr(c, name) for c in commands], dtype=float) for name in ("sent", "arrived")
    )
    measured, target = (
        np.array([getattr(c, name) for c in commands], dtype=float).reshape(-1, motors)
        for name in ("measured_mm", "target_mm")
    )
    return AlignedRun(
        seconds=arrived - (sent[0] if commands else 0.0),
        move_seconds=arrived - sent,
        error_mm=np.abs(measured - target).max(axis=1, initial=0.0),
        measured_mm=measured,
        target_mm=target,
        series=_only(series, frozenset(common)),
    )


def _only(series: RunSeries, places: frozenset[Place]) -> RunSeries:
    """The series whose other waypoints count as parts of the way to the start pose."""
    commands = (
        command if (command.lap, command.index) in places else replace(command, index=START, measured_mm=())
        for command in series.commands
    )
    return replace(series, commands=tuple(commands))
