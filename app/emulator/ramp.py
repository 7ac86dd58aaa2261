"""The emulated firmware's ramp: a trapezoid per motor, followed by a PID controller.

Both are computed anew from the last reading on each turn, so a late motor restarts its ramp where it is;
divisions by zero and comparisons with NaN go the way they go in C, since odd targets end up there.
"""

import math
from collections.abc import Sequence
from functools import reduce

import numpy as np

from app.emulator.motors import FULL_COMMAND
from core.wire.messages import MOTORS

SPEED_MM = 15.0
"""Largest speed of a ramp, mm/s."""

PROPORTIONAL, INTEGRAL, DERIVATIVE = 3.0, 0.5, 0.02
COMMAND_PER_SPEED = 17.0
"""Motor command for 1 mm/s (docs/firmware.md)."""

FEEDBACK_ONLY_MM = 5.0
"""Nearer than this to its target, a motor gets no feed-forward speed."""


class Controller:
    """PID controllers of all motors; the integrals live until the board restarts (firmware.md, hazard 11)."""

    def __init__(self) -> None:
        self._integral = [0.0] * MOTORS
        self._last_error = [0.0] * MOTORS

    def command(self, index: int, error: float, speed: float, elapsed: float) -> int:
        """Motor command −255 to 255 for one motor.

        Args:
            index: 0-based motor.
            error: wanted minus measured stroke, mm.
            speed: feed-forward speed, mm/s.
            elapsed: time since the last reading, s.
        """
        self._integral[index] = single(self._integral[index] + error * elapsed)
        rate = _ratio(error - self._last_error[index], elapsed)
        self._last_error[index] = error
        effort = PROPORTIONAL * error + INTEGRAL * self._integral[index] + DERIVATIVE * rate
        return _clip_command((speed + effort) * COMMAND_PER_SPEED)


def ramp_durations(distances_mm: Sequence[float], acceleration_mm: float) -> list[float]:
    """Duration of each motor's own ramp at full speed, s (see `core.wire.robot_time.ramp_time`)."""
    rise = SPEED_MM / acceleration_mm
    return [2 * _least(abs(d) / SPEED_MM, rise) + _most(0.0, abs(d) / SPEED_MM - rise) for d in distances_mm]


def motor_speeds(durations: Sequence[float]) -> list[float]:
    """Speed of each motor in mm/s, scaled by its duration so that all arrive together."""
    longest = longest_ramp(durations)
    return [_ratio(SPEED_MM * d, longest) for d in durations]


def longest_ramp(durations: Sequence[float]) -> float:
    """Duration of the whole move, s; a NaN before the last motor is forgotten."""
    return reduce(_most, durations, 0.0)


def ramp_reference(distance_mm: float, time: float, speed: float, acceleration: float) -> tuple[float, float]:
    """Where a motor ought to be at `time` of its ramp, and how fast.

    Args:
        distance_mm: target minus last reading, mm.
        time: since the ramp's start, s.
        speed: the motor's speed, mm/s.
        acceleration: mm/s².

    Returns:
        Offset from the last reading in mm, speed in mm/s.
    """
    distance_mm, time = single(distance_mm), single(time)
    speed, acceleration = single(speed), single(acceleration)
    if distance_mm < 0:
        speed, acceleration = -speed, -acceleration
    rise = _least(_ratio(distance_mm, speed), _ratio(speed, acceleration))
    cruise = _most(0.0, _ratio(distance_mm, speed) - _ratio(speed, acceleration))
    offset, rate = _trapezoid(distance_mm, time, rise, cruise, speed, acceleration)
    return single(offset), 0.0 if abs(distance_mm) < FEEDBACK_ONLY_MM else single(rate)


def _trapezoid(
    distance: float, time: float, rise: float, cruise: float, speed: float, acceleration: float
) -> tuple[float, float]:
    if time < rise:
        return 0.5 * acceleration * time**2, acceleration * time
    climbed = 0.5 * acceleration * rise**2
    if rise <= time < rise + cruise:
        return climbed + speed * (time - rise), speed
    if rise + cruise <= time < 2 * rise + cruise:
        fall = time - cruise - rise
        return climbed + speed * (cruise + fall) - 0.5 * acceleration * fall**2, speed - acceleration * fall
    return distance, 0.0


def single(value: float) -> float:
    """Rounds to single precision, in which the robot computes."""
    return float(np.float32(value))


def _clip_command(command: float) -> int:
    if math.isnan(command):
        return 0
    return int(min(max(command, -FULL_COMMAND), FULL_COMMAND))


def _ratio(a: float, b: float) -> float:
    if b != 0.0:
        return a / b
    if a == 0.0 or math.isnan(a):
        return math.nan
    return math.copysign(math.inf, a) * math.copysign(1.0, b)


def _least(a: float, b: float) -> float:
    return a if a < b else b


def _most(a: float, b: float) -> float:
    return a if a > b else b
