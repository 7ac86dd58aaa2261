"""From trajectories to waypoints, and which of them the path needs.

The firmware moves all motors along a straight line in motor space to each waypoint and stops there.
"""

from __future__ import annotations

import math

import numpy as np

from core.arrays import Floats
from core.errors import InputError
from core.robot import RobotModel
from core.trajectory import Trajectory
from core.waypoints import Waypoints
from core.wire_timing import ARRIVAL_THRESHOLD, LONGEST_SCAN, RAMP_SPEED, ramp_time

TYPICAL_SCAN = 0.27
"""Time of the firmware's error scan in the profile that matches the published 30 s an iteration."""
MESSAGE_SECONDS = 0.03
"""Parsing, printing and telemetry around a scan."""
SHORT_MOVE = 0.006
"""Shorter moves take two ramps (PROTOCOL.md 3, “Fresh boot”), m."""


def waypoints_from_trajectory(model: RobotModel, trajectory: Trajectory) -> Waypoints:
    """One waypoint a knot by inverse kinematics.

    Raises:
        UnreachableError: a foot lies outside the workspace.
    """
    steps = np.diff(trajectory.times)
    return Waypoints(trajectory.strokes(model), np.concatenate([steps[:1], steps]))


def merge_waypoints(waypoints: Waypoints, tolerance: float) -> Waypoints:
    """Leaves out waypoints while the straight path in motor space stays within a tolerance of them.

    Greedy: from each kept waypoint to the farthest that allows it.

    Args:
        waypoints: one a knot.
        tolerance: largest distance of a left-out waypoint from the path, of any motor, m.
    """
    if not (math.isfinite(tolerance) and tolerance >= 0):
        raise InputError(f"The tolerance is {tolerance} m; it must be at least 0.", "--merge")
    kept = [0]
    while kept[-1] < waypoints.count - 1:
        end = kept[-1] + 1
        while end + 1 < waypoints.count and _stays_near(waypoints.strokes, kept[-1], end + 1, tolerance):
            end += 1
        kept.append(end)
    clock = np.cumsum(waypoints.durations)
    durations = np.concatenate([waypoints.durations[:1], np.diff(clock[kept])])
    return Waypoints(waypoints.strokes[kept], durations)


def _stays_near(strokes: Floats, first: int, last: int, tolerance: float) -> bool:
    start = strokes[first].ravel()
    way = strokes[last].ravel() - start
    inner = strokes[first + 1 : last].reshape(last - first - 1, -1) - start
    fractions = np.clip(inner @ way / max(float(way @ way), 1e-18), 0.0, 1.0)
    in_order = bool((np.diff(fractions) >= -1e-9).all())
    return in_order and float(np.abs(inner - fractions[:, None] * way).max()) <= tolerance


def cut_moves(waypoints: Waypoints, bound: float) -> Waypoints:
    """Cuts moves into equal parts so that the robot is never deaf longer than a bound.

    Args:
        waypoints: what to cut.
        bound: longest deafness, s.

    Raises:
        InputError: the bound leaves no move longer than the firmware's 1 mm threshold.
    """
    longest = (bound - LONGEST_SCAN) * RAMP_SPEED / 2 - ARRIVAL_THRESHOLD
    if not (math.isfinite(bound) and longest > ARRIVAL_THRESHOLD):
        least = LONGEST_SCAN + 4 * ARRIVAL_THRESHOLD / RAMP_SPEED
        raise InputError(
            f"The stop bound is {bound} s; it must be longer than {least:.2f} s.", "--stop-bound"
        )
    strokes, durations = [waypoints.strokes[0]], [float(waypoints.durations[0])]
    for start, end, duration in zip(
        waypoints.strokes[:-1], waypoints.strokes[1:], waypoints.durations[1:], strict=True
    ):
        parts = max(1, math.ceil(float(np.abs(end - start).max()) / longest - 1e-9))
        for part in range(1, parts + 1):
            strokes.append(end if part == parts else start + (end - start) * part / parts)
            durations.append(float(duration) / parts)
    return Waypoints(np.array(strokes), np.array(durations))


def estimate_seconds(waypoints: Waypoints) -> float:
    """About how long the robot takes over all waypoints, s.

    A scan a message; where a motor is more than the firmware's threshold away, a ramp and another scan, and
    below SHORT_MOVE a second small ramp with its scan. Within 12 % of the emulated board for merged and
    unmerged gaits.
    """
    here = waypoints.strokes[0]
    total = 0.0
    for there in waypoints.strokes:
        total += TYPICAL_SCAN + MESSAGE_SECONDS
        distance = float(np.abs(there - here).max())
        if distance <= ARRIVAL_THRESHOLD:
            continue
        total += TYPICAL_SCAN + ramp_time(distance)
        if distance < SHORT_MOVE:
            total += TYPICAL_SCAN + ramp_time(ARRIVAL_THRESHOLD)
        here = there
    return total
