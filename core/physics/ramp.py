"""The firmware's ramps: every motor's stroke over the robot's own time (docs/firmware.md, Times)."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from core.arrays import Floats
from core.wire.robot_time import ARRIVAL_THRESHOLD, ARRIVED, PUBLISHED, far_motors, ramp_time
from core.wire.waypoints import Waypoints

TURN = 0.01
"""The firmware's loop gives its motors a new command this often during a ramp, s; phases last whole turns."""


@dataclass(frozen=True, eq=False)
class MotorTrajectory:
    """What the motors are told and what they do without load, a row a turn of the firmware's loop.

    Args:
        targets: (n, legs, 3) where the ramp wants the motors, m.
        strokes: (n, legs, 3) where motors of limited speed are, m.
        arrivals: (count,) row at which the firmware calls each waypoint reached.
    """

    targets: Floats
    strokes: Floats
    arrivals: NDArray[np.int64]

    @property
    def duration(self) -> float:
        """Time of the last row, s."""
        return (len(self.targets) - 1) * TURN


def motor_trajectory(waypoints: Waypoints, speeds: Floats) -> MotorTrajectory:
    """The motors' way over all waypoints, from the first one, where they stand.

    The robot's published law of time (`core.wire.robot_time`), without its chance. Each waypoint costs a
    message and an error scan. Where a motor is further than the firmware's threshold away, a ramp and another
    scan follow, again until all are within it. The law's shares of second ramps add up along the way, and a
    move takes one where their sum rises above another half. Nearer waypoints are called reached without
    motion.

    Args:
        waypoints: exactly what is sent.
        speeds: (legs, 3) largest speed of each motor, m/s.
    """
    rows = waypoints.strokes.reshape(waypoints.count, -1)
    builder = _Builder(rows[0], speeds.ravel())
    arrivals = [0]
    for row in rows[1:]:
        builder.move_to(row)
        arrivals.append(builder.last_row)
    shape = (-1, *speeds.shape)
    return MotorTrajectory(
        np.concatenate(builder.targets).reshape(shape),
        np.concatenate(builder.strokes).reshape(shape),
        np.array(arrivals, dtype=np.int64),
    )


class _Builder:
    """Appends phases, one after the other; motors are one axis."""

    def __init__(self, start: Floats, speeds: Floats) -> None:
        self.targets, self.strokes = [start[None]], [start[None]]
        self.last_row = 0
        self._second_ramps_due = 0.0
        self._speeds = speeds

    def move_to(self, waypoint: Floats) -> None:
        """What the firmware does about one message."""
        self._hold(PUBLISHED.arrived)
        moves = np.abs(waypoint - self.strokes[-1][-1])
        distance = float(moves.max())
        if distance <= ARRIVED:
            return
        self._ramp(waypoint, ramp_time(distance))
        self._hold(PUBLISHED.message - PUBLISHED.arrived)
        self._second_ramps_due += float(PUBLISHED.second_share(distance, far_motors(moves)))
        if self._second_ramps_due > 0.5:
            self._second_ramps_due -= 1.0
            self._ramp_again(waypoint)
        while self._distance(waypoint) > ARRIVAL_THRESHOLD:
            self._ramp_again(waypoint)

    def _distance(self, waypoint: Floats) -> float:
        return float(np.abs(waypoint - self.strokes[-1][-1]).max())

    def _hold(self, seconds: float) -> None:
        count = round(seconds / TURN)
        self._append(np.repeat(self.targets[-1][-1:], count, 0), np.repeat(self.strokes[-1][-1:], count, 0))

    def _ramp_again(self, waypoint: Floats) -> None:
        """A small ramp, which the firmware begins just outside the threshold at least, and its scan."""
        self._ramp(waypoint, ramp_time(max(self._distance(waypoint), ARRIVAL_THRESHOLD)))
        self._hold(PUBLISHED.second_ramp - ramp_time(ARRIVAL_THRESHOLD))

    def _ramp(self, waypoint: Floats, seconds: float) -> None:
        """All motors along a straight line in motor space, each as fast as it can."""
        count = math.ceil(seconds / TURN - 1e-9)
        start = self.strokes[-1][-1]
        way = waypoint - start
        targets = start + ramp_shares(count)[:, None] * way
        # The furthest that a motor can be which has followed its ramp since the start with limited speed.
        reach = (np.arange(1, count + 1) * TURN)[:, None] * self._speeds
        behind = np.minimum(np.minimum.accumulate(np.abs(targets - start) - reach, axis=0), 0.0)
        self._append(targets, start + np.sign(way) * np.minimum(reach + behind, np.abs(way)))

    def _append(self, targets: Floats, strokes: Floats) -> None:
        self.targets.append(targets)
        self.strokes.append(strokes)
        self.last_row += len(targets)


def ramp_shares(count: int) -> Floats:
    """(count,) share of a ramp's way after each turn of it.

    The speed rises and falls evenly, for 1 s each or for half of a shorter ramp: the largest motor just
    reaches 15 mm/s, which is what `ramp_time` says.
    """
    times = np.arange(1, count + 1) * TURN
    total = count * TURN
    rise = min(total / 2, 1.0)
    speed = 1.0 / (total - rise)
    climbing = speed * times**2 / (2 * rise)
    falling = 1.0 - speed * (total - times) ** 2 / (2 * rise)
    cruising = speed * (times - rise / 2)
    return np.asarray(np.where(times < rise, climbing, np.where(times > total - rise, falling, cruising)))
