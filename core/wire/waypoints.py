"""Waypoints: the motor strokes that go to the robot, one row a message."""

import hashlib
import re
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from core.arrays import Floats, frozen_floats
from core.errors import InputError
from core.text.decoding import without_mark
from core.text.tables import Table, read_table

_BEGINNING = re.compile(
    r'\s*(?:"?sep=.[^\r\n]*[\r\n]+)?(?:[^,;\t\r\n]*[,;\t])?\s*"?duration_s\b', re.IGNORECASE
)
"""How a waypoint file begins; a column that counts the rows may stand first."""
MOST_WAYPOINTS = 20_000
"""Waypoints of the longest run, which takes the robot hours."""
MOST_STROKE = 0.2
"""Longer strokes than any motor here makes, m; a guard against a slip of the pen in a file."""
MOST_SECONDS = 1e12
"""A longer duration is no time, s; the check says which of the others no message can carry."""
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
        durations = frozen_floats(self.durations, (strokes.shape[0],), "durations", MOST_SECONDS)
        if strokes.shape[0] == 0:
            raise InputError("There is no waypoint; a run needs at least one.", "waypoints")
        if strokes.shape[0] > MOST_WAYPOINTS:
            raise InputError(
                f"There are {strokes.shape[0]} waypoints; at most {MOST_WAYPOINTS} are read. Cut them into "
                "several files.",
                "waypoints",
            )
        if (durations < 0).any():
            raise InputError("A duration is negative; durations are at least 0 s.", "duration_s")
        _require_strokes(strokes)
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

    @cached_property
    def content_hash(self) -> str:
        """SHA-256 of the waypoint file's text: what is approved is exactly what is sent."""
        return hashlib.sha256(format_waypoint_csv(self).encode()).hexdigest()


def _require_strokes(strokes: Floats) -> None:
    beyond = np.argwhere(np.abs(strokes) > MOST_STROKE)
    if beyond.size:
        row, foot, motor = (int(i) for i in beyond[0])
        value_mm = float(strokes[row, foot, motor]) * 1000
        raise InputError(
            f"Waypoint {row + 1}, motor {motor + 1} of foot {foot + 1}: {value_mm:g} mm "
            f"is no stroke; it must lie within ±{MOST_STROKE * 1000:g} mm.",
            f"waypoint {row + 1}",
        )


def format_waypoint_csv(waypoints: Waypoints) -> str:
    """Writes `duration_s,h1,…` with a row a waypoint, mm with 4 decimals, wire order."""
    lines = [_header(waypoints.strokes.shape[1])]
    for duration, row in zip(waypoints.durations, waypoints.strokes_mm, strict=True):
        lines.append(f"{duration:.4f}," + ",".join(f"{h:.{MM_DECIMALS}f}" for h in row))
    return "\n".join(lines) + "\n"


def is_waypoint_text(text: str) -> bool:
    """Whether a text begins as a waypoint file does."""
    return _BEGINNING.match(without_mark(text)) is not None


@dataclass(frozen=True, eq=False)
class WaypointFile:
    """A waypoint file as read.

    Args:
        waypoints: the file's.
        notes: sentences on what was unusual in the file's form.
    """

    waypoints: Waypoints
    notes: tuple[str, ...]


def read_waypoint_csv(text: str, name: str = "waypoint file", legs: int | None = None) -> WaypointFile:
    """Reads a waypoint file.

    Args:
        text: the file's text.
        name: the file's name, for messages.
        legs: number of legs that the file must have; None where its header says.

    Raises:
        InputError: naming line and column of the first thing that is wrong.
    """
    table = read_table(text, name)
    legs = _legs_of_header(table, legs)
    if len(table.rows) == 1:
        raise InputError(f"{name} has a header but no waypoint; add at least one row.", name)
    numbers = table.numbers(1, 3 * legs + 1)
    waypoints = Waypoints(numbers[:, 1:].reshape(-1, legs, 3) / 1000.0, numbers[:, 0])
    return WaypointFile(waypoints, table.notes)


def parse_waypoint_csv(text: str, legs: int = 4, name: str = "waypoint file") -> Waypoints:
    """The waypoints of a file that must have a number of legs (see `read_waypoint_csv`)."""
    return read_waypoint_csv(text, name, legs).waypoints


def _legs_of_header(table: Table, legs: int | None) -> int:
    """The number of legs, which the header confirms."""
    head = [cell.lower() for cell in table.head]
    found = (len(head) - 1) // 3
    if found < 1 or found != (legs or found) or head != _header(found).split(","):
        wanted = _header(legs or 4)
        more = "" if legs else ", with three motors a foot"
        raise table.header_refusal(wanted + more, _header(legs or max(found, 4)).split(","))
    return found


def _header(legs: int) -> str:
    return "duration_s," + ",".join(f"h{i + 1}" for i in range(3 * legs))
