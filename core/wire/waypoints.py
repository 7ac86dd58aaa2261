"""Waypoints: the motor strokes that go to the robot, one row a message."""

import hashlib
from dataclasses import dataclass

import numpy as np

from core.arrays import Floats, frozen_floats
from core.errors import InputError

MM_DECIMALS = 4
"""Decimals of a millimetre in files and on the wire (docs/firmware.md)."""


@dataclass(frozen=True, eq=False)
class Waypoints:
    """Strokes to reach one after the other.

    Args:
        strokes: (n, legs, 3) stroke of each motor in m, in wire order.
        durations: (n,) planned time of each waypoint in s; the firmware ignores it.
    """

    strokes: Floats
    durations: Floats

    def __post_init__(self) -> None:
        strokes = frozen_floats(self.strokes, (None, None, 3), "strokes")
        durations = frozen_floats(self.durations, (strokes.shape[0],), "durations")
        if strokes.shape[0] == 0:
            raise InputError("There is no waypoint; a run needs at least one.", "waypoints")
        if (durations < 0).any():
            raise InputError("A duration is negative; durations are at least 0 s.", "duration_s")
        object.__setattr__(self, "strokes", strokes)
        object.__setattr__(self, "durations", durations)

    @property
    def count(self) -> int:
        """Number of waypoints."""
        return int(self.strokes.shape[0])

    @property
    def strokes_mm(self) -> Floats:
        """(n, 3·legs) strokes in mm, rounded to what is written and sent."""
        rows = self.strokes.reshape(self.count, -1) * 1000.0
        return np.round(rows, MM_DECIMALS)

    @property
    def content_hash(self) -> str:
        """SHA-256 of the waypoint file's text: what is approved is exactly what is sent."""
        return hashlib.sha256(format_waypoint_csv(self).encode()).hexdigest()


def format_waypoint_csv(waypoints: Waypoints) -> str:
    """Writes `duration_s,h1,…` with a row a waypoint, mm with 4 decimals, wire order."""
    lines = [_header(waypoints.strokes.shape[1])]
    for duration, row in zip(waypoints.durations, waypoints.strokes_mm, strict=True):
        lines.append(f"{duration:.4f}," + ",".join(f"{h:.{MM_DECIMALS}f}" for h in row))
    return "\n".join(lines) + "\n"


def is_waypoint_text(text: str) -> bool:
    """Whether a text begins as a waypoint file does."""
    return text.removeprefix("\ufeff").startswith("duration_s")


def waypoint_legs(text: str, name: str = "waypoint file") -> int:
    """Number of legs whose strokes a waypoint file holds, by its header.

    Raises:
        InputError: the header is not one of a waypoint file.
    """
    header = _header_of(text)
    motors = header.count(",")
    if motors < 3 or motors % 3 or header != _header(motors // 3):
        raise InputError(
            f"{name}, line 1: the header must read {_header(4)}, with three motors a foot.", f"{name}:1"
        )
    return motors // 3


def _header(legs: int) -> str:
    return "duration_s," + ",".join(f"h{i + 1}" for i in range(3 * legs))


def _header_of(text: str) -> str:
    return text.removeprefix("\ufeff").partition("\n")[0].strip()


def parse_waypoint_csv(text: str, legs: int = 4, name: str = "waypoint file") -> Waypoints:
    """Reads a waypoint file.

    Args:
        text: the file's text.
        legs: number of legs that the file must have.
        name: the file's name, for messages.

    Raises:
        InputError: naming line and column of the first thing that is wrong.
    """
    header = _header(legs)
    lines = text.replace("\r\n", "\n").rstrip("\n").split("\n")
    if _header_of(text) != header:
        raise InputError(f"{name}, line 1: the header must read {header}.", f"{name}:1")
    rows = [_parse_row(line, 3 * legs + 1, f"{name}:{i}") for i, line in enumerate(lines[1:], 2)]
    if not rows:
        raise InputError(f"{name} has a header but no waypoint; add at least one row.", name)
    table = np.array(rows)
    return Waypoints(table[:, 1:].reshape(len(rows), legs, 3) / 1000.0, table[:, 0])


def _parse_row(line: str, columns: int, where: str) -> list[float]:
    fields = line.split(",")
    if len(fields) != columns:
        raise InputError(f"{where}: {len(fields)} numbers; a row has {columns}.", where)
    numbers = []
    for column, field in enumerate(fields, 1):
        try:
            number = float(field)
        except ValueError:
            raise InputError(f"{where}, column {column}: “{field}” is not a number.", where) from None
        if not np.isfinite(number):
            raise InputError(f"{where}, column {column}: {field} is not a finite number.", where)
        numbers.append(number)
    return numbers
