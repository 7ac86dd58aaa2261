"""How well a robot kept to its plan: errors of motors and feet, the measured body, and the times.

Definitions. A motor's tracking error is measured minus commanded stroke where the robot says that it has
arrived, a waypoint at a time. The measured body is level; its place and heading are those that bring the
measured feet that stand by the plan closest to where they stand by the plan (least squares). A foot's place
follows from that body by forward kinematics. Its error at an arrival is the distance to where the commanded
strokes put it by the same rule, and so for the body; its path error is the distance at any telemetry to the
plan's own way between the waypoint before and the one under way, which holds what merging left out as well.
What a cable cannot tell stays unknown: slipping, tilting and bending show in none of them.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.arrays import Floats
from core.runs.pose import RanPlan, measured_motion, planned_feet
from core.runs.reading import START, RunSeries, SentWaypoint
from core.wire.robot_time import estimate_seconds
from core.wire.waypoints import Waypoints

PATH_PIECES = 16
"""Straight pieces in which a foot's planned way between two waypoints is compared."""

ROWS_AT_ONCE = 2000
"""Telemetry that is compared with a way at a time; a pause may last for hours."""


@dataclass(frozen=True, eq=False)
class RunErrors:
    """How a run differed from its plan; nan where nothing arrived.

    Args:
        arrived: waypoints that were reached.
        motor_mean: (motors,) mean size of the tracking error, m.
        motor_largest: (motors,) its largest size, m.
        motor_waypoint: (motors,) waypoint at which that was, 0-based; −1 where nothing arrived.
        foot_mean: (legs,) mean distance at arrivals to where the command puts it, m.
        foot_largest: (legs,) largest one, m.
        foot_path: (legs,) largest distance to the planned way at any telemetry, m.
        body_largest: largest distance of the body's frame at arrivals to where the command puts it, m.
        seconds: from the first waypoint's message to the last arrival.
        estimate: what was to be expected of it by the ramp law, s.
        start_seconds: from the first message to the first waypoint's.
    """

    arrived: int
    motor_mean: Floats
    motor_largest: Floats
    motor_waypoint: NDArray[np.int64]
    foot_mean: Floats
    foot_largest: Floats
    foot_path: Floats
    body_largest: float
    seconds: float
    estimate: float
    start_seconds: float


def plan_times(plan: RanPlan, series: RunSeries) -> Floats:
    """(n,) the plan's time at each telemetry, s; nan on the way to the start pose.

    From the waypoint before to the one under way, as the time from sending to arrival goes by; where that
    never arrived, the time of the waypoint before.
    """
    result = np.full(series.times.shape, np.nan)
    for number, command, rows in _moves(series):
        begin = plan.times[_before(series.commands, number)]
        share = np.zeros(len(rows))
        if command.is_reached:
            seconds = max(command.arrived - command.sent, 1e-9)
            share = np.clip((series.times[rows] - command.sent) / seconds, 0.0, 1.0)
        result[rows] = begin + share * (plan.times[command.index] - begin)
    return result


def run_errors(plan: RanPlan, series: RunSeries) -> RunErrors:
    """Compares a run with its plan; see the module's definitions."""
    reached = [(number, command) for number, command in enumerate(series.commands) if command.is_reached]
    motors, legs = plan.waypoints.strokes_mm.shape[1], plan.model.leg_count
    streamed = series.streamed
    seconds = start = estimate = float("nan")
    if reached:
        seconds = reached[-1][1].arrived - streamed[0].sent
        estimate = _estimate([command.target_mm for _, command in reached])
    if streamed:
        start = streamed[0].sent - series.commands[0].sent
    off_mm = np.array([np.subtract(c.measured_mm, c.target_mm) for _, c in reached]).reshape(-1, motors)
    sizes = np.abs(off_mm) / 1000.0
    feet, body = _arrival_distances(plan, series, reached)
    return RunErrors(
        arrived=len(reached),
        motor_mean=_over(sizes, np.mean),
        motor_largest=_over(sizes, np.max),
        motor_waypoint=np.array(
            [reached[row][1].index for row in sizes.argmax(axis=0)] if reached else [START] * motors,
            dtype=np.int64,
        ),
        foot_mean=_over(feet.reshape(-1, legs), np.mean),
        foot_largest=_over(feet.reshape(-1, legs), np.max),
        foot_path=_path_distances(plan, series),
        body_largest=float(body.max()) if body.size else float("nan"),
        seconds=seconds,
        estimate=estimate,
        start_seconds=start,
    )


def _estimate(rows_mm: list[tuple[float, ...]]) -> float:
    strokes = np.array(rows_mm).reshape(len(rows_mm), -1, 3) / 1000.0
    return estimate_seconds(Waypoints(strokes, np.zeros(len(rows_mm))))


def move_begins(plan: RanPlan, series: RunSeries) -> Floats:
    """(n,) the plan's time at which the move under way at each telemetry began, s; nan before the first."""
    result = np.full(series.times.shape, np.nan)
    for number, _, rows in _moves(series):
        result[rows] = plan.times[_before(series.commands, number)]
    return result


def _moves(series: RunSeries) -> Iterator[tuple[int, SentWaypoint, NDArray[np.int64]]]:
    """Each command that leads to a waypoint, with the telemetry that came while it was the last."""
    bounds = np.searchsorted(series.aims, np.arange(len(series.commands) + 1))
    for number, command in enumerate(series.commands):
        if command.leads_on:
            yield number, command, np.arange(bounds[number], bounds[number + 1])


def _before(commands: tuple[SentWaypoint, ...], number: int) -> int:
    """The waypoint from which a command leads on; its own where it begins a lap."""
    here, before = commands[number], commands[max(number - 1, 0)]
    follows = before.leads_on and before.lap == here.lap
    return before.index if follows else here.index


def _over(values: Floats, figure: Callable[..., Any]) -> Floats:
    return np.asarray(figure(values, axis=0)) if len(values) else np.full(values.shape[1], np.nan)


def _arrival_distances(
    plan: RanPlan, series: RunSeries, reached: list[tuple[int, SentWaypoint]]
) -> tuple[Floats, Floats]:
    """(arrivals, legs) distance of each foot, and (arrivals,) of the body, from the command, m."""
    if not reached:
        return np.zeros((0, plan.model.leg_count)), np.zeros(0)
    times = plan.times[[c.index for _, c in reached]]
    before = plan.times[[_before(series.commands, number) for number, _ in reached]]
    measured, wanted = (
        measured_motion(plan, np.reshape(rows_mm, (len(reached), -1, 3)) / 1000.0, times, before)
        for rows_mm in ([c.measured_mm for _, c in reached], [c.target_mm for _, c in reached])
    )
    feet = np.linalg.norm(measured.feet_world - wanted.feet_world, axis=-1)
    body = measured.pose.position_world - wanted.pose.position_world
    return feet, np.linalg.norm(body, axis=-1)


def _path_distances(plan: RanPlan, series: RunSeries) -> Floats:
    """(legs,) largest distance of each measured foot from its planned way, m."""
    times, begins = plan_times(plan, series), move_begins(plan, series)
    known = np.flatnonzero(np.isfinite(times))
    legs = plan.model.leg_count
    if not len(known):
        return np.full(legs, np.nan)
    strokes = series.measured_mm[known].reshape(-1, legs, 3) / 1000.0
    feet = np.full((len(times), legs, 3), np.nan)
    feet[known] = measured_motion(plan, strokes, times[known], begins[known]).feet_world
    largest = np.zeros(legs)
    for number, command, rows in _moves(series):
        ends = plan.times[[_before(series.commands, number), command.index]]
        way = planned_feet(plan.trajectory, np.linspace(ends[0], ends[1], PATH_PIECES + 1))
        for first in range(0, len(rows), ROWS_AT_ONCE):
            some = feet[rows[first : first + ROWS_AT_ONCE]]
            largest = np.maximum(largest, _distances(some, way).max(axis=0))
    return largest


def _distances(points: Floats, way: Floats) -> Floats:
    """(k, legs) distance of (k, legs, 3) points from ways of straight pieces through (m, legs, 3), m."""
    begins, pieces = way[:-1], np.diff(way, axis=0)
    lengths = np.maximum((pieces**2).sum(axis=-1), 1e-18)
    from_begin = points[:, None] - begins
    share = np.clip((from_begin * pieces).sum(axis=-1) / lengths, 0.0, 1.0)
    return np.asarray(np.linalg.norm(from_begin - share[..., None] * pieces, axis=-1).min(axis=1))
