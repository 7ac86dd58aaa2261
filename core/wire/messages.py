"""What goes to the robot: every message of the wire, checked and encoded.

Grammar: `<` payload `>`, fields separated by commas, strokes in mm with 4 decimals, one
waypoint a message, because the firmware's memory holds one (firmware.md, hazards 7 and 8).
"""

import math

import numpy as np
from numpy.typing import ArrayLike

from core.arrays import Floats
from core.errors import InputError
from core.wire.waypoints import MM_DECIMALS

MOTORS = 12
"""Motors on the wire: four legs, three a leg (docs/firmware.md, Messages)."""

LOWEST_MM = 0.5
HIGHEST_MM = 19.5
"""Strokes in mm that may be asked for; the firmware itself checks nothing (docs/firmware.md, Messages)."""

QUANTUM_MM = 0.012
"""Stroke of one count of the robot's converter in mm (docs/firmware.md, Times)."""

THRESHOLD_MM = 1.0
"""Distance in mm within which the firmware calls a motor arrived (docs/firmware.md, Times)."""

RESET_MM = 0.5
"""Stroke in mm to which `<r>` and the start of the board send every motor (docs/firmware.md, Messages)."""

SHORTEST_DURATION, LONGEST_DURATION = 0.01, 999.0
"""Planned time of a waypoint that may be approved, s: a message has two decimals and three digits before the
point for it, so a shorter one goes out as 0.00, and a longer one does not fit."""

LONGEST_MESSAGE = 110
"""Bytes of the longest message that is ever sent (docs/firmware.md)."""


def encode_waypoint(strokes: ArrayLike, duration: float) -> bytes:
    """Encodes one waypoint as `<p,1,d,h1,…,h12>`.

    Args:
        strokes: (4, 3) stroke of each motor in m, leg by leg.
        duration: planned time in s; the firmware prints it and does nothing with it.

    Returns:
        The message, at most `LONGEST_MESSAGE` bytes.

    Raises:
        InputError: wrong number of strokes, a number that is not finite, or a stroke out of range; the
            sentence names motor, value and limit.
    """
    numbers = strokes_to_mm(strokes)
    if not (math.isfinite(duration) and 0.0 <= duration <= LONGEST_DURATION):
        raise InputError(
            f"A duration of {duration} s cannot be sent; it must lie in 0 to {LONGEST_DURATION:g} s.",
            "duration",
        )
    fields = ",".join(f"{h:.{MM_DECIMALS}f}" for h in numbers)
    return f"<p,1,{duration:.2f},{fields}>".encode("ascii")


def encode_reset() -> bytes:
    """Encodes the message that sends every motor to `RESET_MM`."""
    return b"<r>"


def encode_stop() -> bytes:
    """Encodes the stop; it takes effect when the running ramp is over and stays until released."""
    return b"<s,1>"


def encode_release() -> bytes:
    """Encodes the end of a stop; the robot's last target goes on at once (firmware.md, hazard 2)."""
    return b"<s,0>"


def encode_flush() -> bytes:
    """Encodes what closes a message that was cut off on its way: fourteen fields `1` and the end marker.

    A robot that holds nothing back ignores it and echoes nothing. A waypoint that was cut off becomes one
    within the range, with 1 mm where strokes are missing, and is executed (firmware.md, hazard 9).
    """
    return b",1" * (MOTORS + 2) + b">"


def payload_of(message: bytes) -> str:
    """Returns what the robot echoes for a message: the text between `<` and `>`."""
    return message[1:-1].decode("ascii")


def strokes_to_mm(strokes: ArrayLike) -> tuple[float, ...]:
    """Turns (4, 3) or (12,) strokes in m into the 12 numbers in mm that are sent.

    Raises:
        InputError: see `encode_waypoint`.
    """
    array: Floats = np.asarray(strokes, dtype=np.float64)
    if array.shape not in ((MOTORS // 3, 3), (MOTORS,)):
        raise InputError(
            f"Strokes of shape {array.shape} cannot be sent; the robot on the wire has 4 legs of 3 motors.",
            "strokes",
        )
    with np.errstate(over="ignore"):
        numbers = tuple(float(h) for h in np.round(array.reshape(-1) * 1000.0, MM_DECIMALS))
    for index, number in enumerate(numbers):
        _require_sendable(index, number)
    return numbers


def name_motor(index: int) -> str:
    """Names a motor for a person: `motor 5 (foot 2, motor 2 of 3)`, from its 0-based index."""
    return f"motor {index + 1} (foot {index // 3 + 1}, motor {index % 3 + 1} of 3)"


def _require_sendable(index: int, number: float) -> None:
    if not math.isfinite(number):
        raise InputError(
            f"The stroke of {name_motor(index)} is {number}; it must be a finite number.", "strokes"
        )
    if not LOWEST_MM <= number <= HIGHEST_MM:
        raise InputError(
            f"The stroke of {name_motor(index)} is {number:.4f} mm; it must lie in {LOWEST_MM} to "
            f"{HIGHEST_MM} mm. Shorten the step or change the body's height.",
            "strokes",
        )
