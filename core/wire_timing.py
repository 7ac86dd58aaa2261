"""How long the robot takes: the ramp law, and what follows from it for deadlines and for stopping.

The firmware moves every motor by one ramp of a common duration and hears nothing while it lasts
(PROTOCOL 3); so the largest ramp of a plan is also the longest time until a stop is heard.
"""

from __future__ import annotations

import numpy as np

from core.arrays import Floats
from core.waypoints import Waypoints
from core.wire import THRESHOLD_MM

RAMP_SPEED = 0.015
"""Largest speed of a ramp in m/s."""

RAMP_ACCELERATION = 0.015
"""Acceleration of a ramp in m/s²; the move at the board's start uses `SETUP_ACCELERATION`."""

SETUP_ACCELERATION = 0.0125

LONGEST_SCAN = 0.37
"""Longest error scan that was seen in s, with slow input and output (PROTOCOL 3)."""

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


def largest_moves(waypoints: Waypoints) -> Floats:
    """Largest distance of any motor from each waypoint to the next, (count − 1,) in m."""
    rows = waypoints.strokes.reshape(waypoints.count, -1)
    moves: Floats = np.abs(np.diff(rows, axis=0)).max(axis=1)
    return moves


def stop_delay(waypoints: Waypoints, scan: float = LONGEST_SCAN, *, start_move: float = 0.0) -> float:
    """Longest time from a stop's arrival at the robot until its motors are released.

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
