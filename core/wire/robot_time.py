"""The robot's time: how long a message, its ramp and a stop take (docs/firmware.md, Times).

The firmware takes one message at a time. It scans the errors of all motors, moves all of them by one ramp of
a common duration, and scans again. If a motor is still more than 1 mm away, a second ramp and a third scan
follow. It hears nothing during a ramp, so the largest ramp of a plan is also the longest time until a stop
is heard.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import overload

import numpy as np

from core.arrays import SAME, Floats
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

ARRIVED = ARRIVAL_THRESHOLD + SAME
"""Planned moves up to here count as arrived, m: moves of just the threshold are common, as in waypoint files
of whole millimetres."""

NEARLY_AS_FAR = 0.7
"""A motor whose move is at least this share of the largest one may miss the threshold as well as that one."""

USUAL_MOTORS = 4.5
"""Mean number of motors that go nearly as far as the farthest one, in random moves of all twelve."""

SECOND_RAMPS_FROM = 0.5 * ARRIVAL_THRESHOLD
"""Share of second ramps is 0 here and rises from here, m."""


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
    return float(_ramp_times(np.asarray(distance), acceleration))


def _ramp_times(distances: Floats, acceleration: float = RAMP_ACCELERATION) -> Floats:
    """The same for an array of distances."""
    until_full = RAMP_SPEED / acceleration
    rises = np.minimum(distances / RAMP_SPEED, until_full)
    return np.asarray(2.0 * rises + np.maximum(0.0, distances / RAMP_SPEED - until_full))


def ramp_distance(seconds: float) -> float:
    """Distance of a ramp of some duration, m (see `ramp_time`).

    Args:
        seconds: at least 0.
    """
    until_full = RAMP_SPEED / RAMP_ACCELERATION
    if seconds <= 2 * until_full:
        return seconds * RAMP_SPEED / 2
    return (seconds - until_full) * RAMP_SPEED


@dataclass(frozen=True)
class TimeLaw:
    """Expected seconds of one message, by the largest motor move d in it.

    T(d) = message + ramp_time(d) + second_ramp · share(d), and T = arrived where d is within the threshold.

    share(d) is the share of moves that take a second ramp. It rises linearly from 0 at half the threshold to
    `often` at `often_from`, holds up to `often_until` and falls linearly to 0 at `never_from`. It belongs to
    moves in which `USUAL_MOTORS` go nearly as far as the farthest. Each motor may miss the threshold by
    itself, so where n motors go so far the share is 1 − (1 − share(d))^(n / USUAL_MOTORS): moves of one leg
    take fewer second ramps than moves of all motors, moves of the body alone a few more.

    `footfall bench law` measures the emulated board and fits the constants anew.

    Args:
        name: of the timing of the board's input and output: published, nominal or slow (docs/firmware.md).
        message: all around the one ramp of a move: parsing, the scans before and after it, telemetry, s.
        second_ramp: a second ramp with its scan, s.
        often: share of short moves that take a second ramp, 0 to 1.
        often_until: that share holds up to here, m.
        never_from: no second ramp from here, m; linear between.
        arrived: a message whose waypoint all motors have reached already, s: one scan and no ramp.
        often_from: the share `often` holds from here, m.
    """

    name: str
    message: float
    second_ramp: float
    often: float
    often_until: float
    never_from: float
    arrived: float
    often_from: float

    @overload
    def move_seconds(self, distance: float, motors: float = USUAL_MOTORS) -> float: ...

    @overload
    def move_seconds(self, distance: Floats, motors: Floats | float = USUAL_MOTORS) -> Floats: ...

    def move_seconds(self, distance: Floats | float, motors: Floats | float = USUAL_MOTORS) -> Floats | float:
        """Expected seconds of messages.

        Args:
            distance: largest distance of any motor, m; one number or an array.
            motors: how many motors go nearly as far (`far_motors`).

        Returns:
            Seconds, in the form of `distance`.
        """
        distances = np.asarray(distance, dtype=np.float64)
        ramps = _ramp_times(distances) + self.second_ramp * self.second_share(distances, motors)
        seconds = np.where(distances <= ARRIVED, self.arrived, self.message + ramps)
        return seconds if isinstance(distance, np.ndarray) else float(seconds)

    def second_share(self, distance: Floats | float, motors: Floats | float = USUAL_MOTORS) -> Floats:
        """Share of moves that take a second ramp, 0 to 1.

        Args:
            distance: largest distance of any motor, m; more than the threshold.
            motors: how many motors go nearly as far (`far_motors`).
        """
        places = (SECOND_RAMPS_FROM, self.often_from, self.often_until, self.never_from)
        usual = np.interp(distance, places, (0.0, self.often, self.often, 0.0))
        return np.asarray(1.0 - (1.0 - usual) ** (np.asarray(motors) / USUAL_MOTORS))


LAWS: Mapping[str, TimeLaw] = MappingProxyType(
    {
        law.name: law
        for law in (
            TimeLaw("published", 0.732, 0.495, 0.84, 0.0053, 0.0070, arrived=0.326, often_from=0.0028),
            TimeLaw("nominal", 0.404, 0.340, 0.999, 0.0054, 0.0079, arrived=0.176, often_from=0.0021),
            TimeLaw("slow", 0.952, 0.629, 0.815, 0.0047, 0.0066, arrived=0.428, often_from=0.0033),
        )
    }
)
"""The laws of the board's three timings, fitted to the emulated board by `footfall bench law`."""

PUBLISHED = LAWS["published"]
"""Law of the timing that matches the published time of an iteration; estimates and physics use it."""


def far_motors(moves: Floats) -> Floats:
    """How many motors go nearly as far as the farthest one, in each move; at least 1.

    Args:
        moves: (…, motors) distances, m.
    """
    farthest = moves.max(axis=-1, keepdims=True)
    return np.asarray((moves >= NEARLY_AS_FAR * farthest).sum(axis=-1), dtype=np.float64)


def move_estimates(waypoints: Waypoints, law: TimeLaw = PUBLISHED) -> Floats:
    """(count,) expected seconds of each waypoint, from where the robot stands at the first.

    A waypoint within the threshold leaves the motors where they are.
    """
    rows = waypoints.strokes.reshape(waypoints.count, -1)
    here, moves = rows[0], np.zeros_like(rows)
    for number, there in enumerate(rows):
        moves[number] = np.abs(there - here)
        if moves[number].max() > ARRIVED:
            here = there
    return law.move_seconds(moves.max(axis=1), far_motors(moves))


def estimate_seconds(waypoints: Waypoints, law: TimeLaw = PUBLISHED) -> float:
    """Expected seconds of all waypoints, from where the robot stands at the first.

    Library gaits as they are sent: within 7 % of the emulated board. Gaits with every sample sent: up to 15 %
    less than the board takes, since short moves one way leave the motors behind.
    """
    return float(move_estimates(waypoints, law).sum())


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


def deaf_seconds(distance: float, scan: float = LONGEST_SCAN, *, off: float = ARRIVAL_THRESHOLD) -> float:
    """Longest time for which the robot hears nothing in moves of one length, by the ramp's law, s.

    A stop bound is a bound of this time.

    Args:
        distance: largest distance of any motor, m.
        scan: time of the robot's error scan in s, measured or of its profile.
        off: how far a motor may be from where the move begins, m; the firmware's threshold after a waypoint.
    """
    return scan + ramp_time(distance + off)


def stop_seconds(distance: float, scan: float = LONGEST_SCAN, *, off: float = ARRIVAL_THRESHOLD) -> float:
    """Longest time until a stop takes effect in moves of one length, s.

    Args:
        distance: largest distance of any motor, m.
        scan: time of the robot's error scan in s, measured or of its profile.
        off: how far a motor may be from where the move begins, m.
    """
    return deaf_seconds(distance, scan, off=off) + OVERRUN


def longest_move(stop_bound: float) -> float:
    """Largest motor move that keeps a stop bound, m: the inverse of `deaf_seconds` with the longest scan.

    Args:
        stop_bound: longest time for which the robot may hear nothing, s; at least `least_stop_bound`.
    """
    return ramp_distance(stop_bound - LONGEST_SCAN) - ARRIVAL_THRESHOLD


def least_stop_bound() -> float:
    """Shortest stop bound that can be kept, s: below it part of a cut move would be within the threshold."""
    return deaf_seconds(2 * ARRIVAL_THRESHOLD)


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
    """Longest time for which the robot hears nothing in a run of waypoints, s (see `deaf_seconds`).

    Args:
        waypoints: the plan.
        scan: time of the robot's error scan in s, measured or of its profile.
        start_move: largest distance of one move on the way to the start pose, m.
    """
    farthest = float(largest_moves(waypoints).max(initial=0.0))
    return deaf_seconds(max(farthest, start_move), scan)
