"""From trajectories to waypoints, and the time that the firmware takes over them.

The firmware moves every motor along a straight line in motor space to each waypoint and stops there, all
motors arriving together, in T = 2d/15 s below 15 mm and 1 s + d/15 above (d the longest way, mm).
"""

from __future__ import annotations

import math

import numpy as np

from core.arrays import Floats
from core.errors import InputError
from core.robot import RobotModel
from core.trajectory import Trajectory
from core.waypoints import Waypoints

SCAN_SECONDS = 0.27
"""Time of the firmware's error scan in the profile that matches the published 30 s an iteration."""


def waypoints_from_trajectory(model: RobotModel, trajectory: Trajectory) -> Waypoints:
    """One waypoint a knot by inverse kinematics.

    Raises:
        UnreachableError: a foot lies outside the workspace.
    """
    steps = np.diff(trajectory.times)
    return Waypoints(trajectory.strokes(model), np.concatenate([steps[:1], steps]))


def ramp_seconds(model: RobotModel, distance: float) -> float:
    """Time of one ramp (PROTOCOL.md 3): 2d/v below v²/a, v/a + d/v above.

    Args:
        model: for the motors' speed v and acceleration a.
        distance: longest way of any motor, m.
    """
    speed, acceleration = model.stroke.speed, model.stroke.acceleration
    if distance < speed * speed / acceleration:
        return 2 * distance / speed
    return speed / acceleration + distance / speed


def move_lengths(waypoints: Waypoints) -> Floats:
    """(n − 1,) longest way of any motor from each waypoint to the next, m."""
    return np.asarray(np.abs(np.diff(waypoints.strokes, axis=0)).max(axis=(1, 2)))


def deaf_seconds(model: RobotModel, waypoints: Waypoints) -> float:
    """How long the robot hears nothing at worst, Stop included: one scan and the longest ramp, s."""
    lengths = move_lengths(waypoints)
    longest = float(lengths.max()) if len(lengths) else 0.0
    return SCAN_SECONDS + ramp_seconds(model, longest)


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


def cut_moves(model: RobotModel, waypoints: Waypoints, bound: float) -> Waypoints:
    """Cuts moves into equal parts so that the robot is never deaf longer than a bound.

    Args:
        model: for the motors' speed and acceleration.
        waypoints: what to cut.
        bound: longest deafness, s.

    Raises:
        InputError: the bound leaves no move longer than the firmware's 1 mm threshold.
    """
    speed = model.stroke.speed
    longest = (bound - SCAN_SECONDS) * speed / 2
    if not (math.isfinite(bound) and longest > 0.001):
        least = SCAN_SECONDS + 2 * 0.001 / speed
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


def estimate_seconds(model: RobotModel, waypoints: Waypoints) -> float:
    """About how long the robot takes over all waypoints: a scan each, a second one after each ramp, s."""
    total = SCAN_SECONDS * waypoints.count
    for length in move_lengths(waypoints):
        if length > 0.001:
            total += SCAN_SECONDS + ramp_seconds(model, float(length))
    return total
