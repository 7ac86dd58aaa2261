"""How long the robot takes: the ramp law, and what follows from it for deadlines and for stopping.

The firmware moves every motor by one ramp of a common duration and hears nothing while it lasts
(docs/firmware.md, Times); so the largest ramp of a plan is also the longest time until a stop is heard.
"""

import numpy as np

from core.arrays import Floats
from core.wire.messages import THRESHOLD_MM
from core.wire.waypoints import Waypoints

RAMP_SPEED = 0.015
"""Largest speed of a ramp in m/s."""

RAMP_ACCELERATION = 0.015
"""Acceleration of a ramp in m/s²; the move at the board's start uses `SETUP_ACCELERATION`."""

SETUP_ACCELERATION = 0.0125

LONGEST_SCAN = 0.37
"""Longest error scan that was seen in s, with slow input and output (docs/firmware.md, Times)."""

OVERRUN = 0.18
"""What a ramp lasts beyond its law, with the pass of the loop around it, at most, s: 2.42 s of silence for
the 2.27 s of a 19 mm move and a pass of 0.03 s, with slow input and output (docs/firmware.md, Times)."""

START_MOVE = 0.003
"""Largest distance of a motor in one message on the way to the start pose, m."""

ARRIVAL_THRESHOLD = THRESHOLD_MM / 1000.0
"""Distance in m within which the firmware calls a motor arrived."""


def ramp_time(distance: float, acceleration: float = RAMP_ACCELERATION) -> float:
    """Duration of one ramp.

    T = 2 d / v below d = v² / a, else v / a + d / v; with v = a = 15 mm/s(²): 2 d / 15 mm/s below 15 mm,
    1 s + d / 15 mm/s above.

    Args:
        distance: largest distance of any motor in m; the firmware does not limit it.
        acceleration: of the ramp in m/s².

    Returns:
        Seconds.
    """
    ramp = min(distance / RAMP_SPEED, RAMP_SPEED / acceleration)
    return 2.0 * ramp + max(0.0, distance / RAMP_SPEED - RAMP_SPEED / acceleration)


def ramp_distance(seconds: float) -> float:
    """Distance of a ramp of some duration, m (see `ramp_time`).

    Args:
        seconds: at least 0.
    """
    until_full = RAMP_SPEED / RAMP_ACCELERATION
    if seconds <= 2 * until_full:
        return seconds * RAMP_SPEED / 2
    return (seconds - until_full) * RAMP_SPEED


def largest_moves(waypoints: Waypoints) -> Floats:
    """Largest distance of any motor from each waypoint to the next, (count − 1,) in m."""
    rows = waypoints.strokes.reshape(waypoints.count, -1)
    moves: Floats = np.abs(np.diff(rows, axis=0)).max(axis=1)
    return moves


def longest_start_move(waypoints: Waypoints) -> float:
    """Largest distance of any motor in one message on the way to a plan's start pose, m.

    No longer than the plan's own largest move, so that its stop bound holds on the way too, and no shorter
    than twice the firmware's threshold, below which parts of a move would not move.
    """
    largest = float(largest_moves(waypoints).max(initial=0.0))
    return min(START_MOVE, max(largest, 2 * ARRIVAL_THRESHOLD))


def stop_time(waypoints: Waypoints, scan: float = LONGEST_SCAN, approved: Waypoints | None = None) -> float:
    """Longest time until a stop takes effect in a run of these waypoints, its start pose included.

    Args:
        waypoints: those that are sent.
        scan: time of the robot's error scan in s, measured or of its profile.
        approved: all of the plan, by which the way to the start pose is cut; None where all are sent.

    Returns:
        Seconds: the deafness, and what ramps last beyond their law.
    """
    start_move = longest_start_move(waypoints if approved is None else approved)
    return deafness(waypoints, scan, start_move=start_move) + OVERRUN


def deafness(waypoints: Waypoints, scan: float = LONGEST_SCAN, *, start_move: float = 0.0) -> float:
    """Longest time for which the robot hears nothing, by the ramp's law; a stop bound is a bound of this.

    Each ramp may start up to the firmware's threshold away from the waypoint before it.

    Args:
        waypoints: the plan.
        scan: time of the robot's error scan in s, measured or of its profile.
        start_move: largest distance of one move on the way to the start pose, m.

    Returns:
        Seconds: the scan and the largest ramp.
    """
    moves = largest_moves(waypoints)
    farthest = max(float(moves.max()) if moves.size else 0.0, start_move)
    return scan + ramp_time(farthest + ARRIVAL_THRESHOLD)
