"""What comes from the robot: every kind of line of the wire, parsed (docs/firmware.md, Lines).

Parsing never raises: what fits no kind is an `UnknownLine`. The echo of a message has no mark of its own;
it is the line that follows `new data tf 1`, so only `LineReader`, which keeps the order, yields `Echo`.
"""

import re
from dataclasses import dataclass

from core.wire.messages import MOTORS, QUANTUM_MM

HIGHEST_READING_MM = 20.5
READING_NOISE_MM = 1.0
"""A stroke outside 0 to 20.5 mm, give or take 1 mm, is no telemetry (docs/firmware.md)."""

LONGEST_LINE = 32768
"""Bytes after which a line is cut and its rest left out; the echo has at most 20 000."""

KEPT_OF_OVERLONG = 80
"""Bytes that are kept of a line that was cut."""


@dataclass(frozen=True)
class Telemetry:
    """`j,…`: measured strokes of the 12 motors in mm."""

    strokes_mm: tuple[float, ...]


@dataclass(frozen=True)
class OutOfTravel:
    """`j,…` with a stroke in mm that no motor can have, so that it is no telemetry."""

    strokes_mm: tuple[float, ...]


@dataclass(frozen=True)
class NewData:
    """`new data tf 0|1`: a pass of the loop begins; whether it took a message."""

    taken: bool


@dataclass(frozen=True)
class Echo:
    """The payload of the message that was taken, as the robot read it."""

    payload: str


@dataclass(frozen=True)
class Blank:
    """An empty line."""


@dataclass(frozen=True)
class PointDuration:
    """`p durations i1.00` for the first point, `durations i1.00` for others; duration in s."""

    duration: float
    first: bool


@dataclass(frozen=True)
class TrajectoryPoint:
    """`Trajectory Point 0: …`: the numbers the robot will go to, in mm, and the duration in s."""

    index: int
    duration: float
    strokes_mm: tuple[float, ...]


@dataclass(frozen=True)
class PointCount:
    """`Number of trajectory points`; `bare` where `p ` stands before it because no point was read."""

    count: int
    bare: bool


@dataclass(frozen=True)
class Execute:
    """`num pts 1 execute waypoints`: a pass with an active trajectory."""

    count: int


@dataclass(frozen=True)
class CurrentPoint:
    """`Curr point 0 Max pts 1`."""

    index: int
    count: int


@dataclass(frozen=True)
class ErrorScan:
    """`E, …`: measured minus wanted, mm, a motor at a time; `inf` also where the robot prints `ovf`."""

    errors_mm: tuple[float, ...]


@dataclass(frozen=True)
class ErrorsChecked:
    """`Checked errors, reached point 0|1`."""

    reached: bool


@dataclass(frozen=True)
class PointReached:
    """`reached point, onto next trajectory`."""


@dataclass(frozen=True)
class EndOfTrajectories:
    """`end of all available trajectories`: the signal of completion."""


@dataclass(frozen=True)
class SetupMoving:
    """`SETUP MOVING`: the board has restarted and moves every motor to 0.5 mm."""


@dataclass(frozen=True)
class SetupFinished:
    """`SETUP FINISHED`."""


@dataclass(frozen=True)
class UnknownLine:
    """Anything else."""

    text: str


@dataclass(frozen=True)
class OverlongLine:
    """A line of more than `LONGEST_LINE` bytes: its beginning. The rest is left out."""

    text: str


Line = (
    Telemetry | NewData | Echo | Blank | PointDuration | TrajectoryPoint | PointCount | Execute
    | CurrentPoint | ErrorScan | ErrorsChecked | PointReached | EndOfTrajectories | SetupMoving
    | SetupFinished | OutOfTravel | UnknownLine | OverlongLine
)  # fmt: skip

_NUMBER = r"(?: *-?\d{1,20}\.\d+| *-?(?:nan|inf|ovf))"
_TELEMETRY = re.compile(rf"j,((?:-?\d{{1,3}}\.\d{{4}},){{{MOTORS}}})")
_ERRORS = re.compile(rf"E, ((?:{_NUMBER},){{{MOTORS}}})")
_SOME_ERRORS = re.compile(rf"E, (?:{_NUMBER},)*")
_DURATION = re.compile(rf"(p )?durations i({_NUMBER})")
_POINT = re.compile(rf"Trajectory Point (\d{{1,6}}): \tp ({_NUMBER}) ((?:{_NUMBER} ){{{MOTORS}}})")
_COUNT = re.compile(r"(p )?Number of trajectory points \t(-?\d{1,10})")
_EXECUTE = re.compile(r"num pts (-?\d{1,10}) execute waypoints ")
_CURRENT = re.compile(r"Curr point (\d{1,10}) Max pts (-?\d{1,10})")
_FIXED: dict[str, Line] = {
    "": Blank(),
    "new data tf 0": NewData(taken=False),
    "new data tf 1": NewData(taken=True),
    "Checked errors, reached point 0": ErrorsChecked(reached=False),
    "Checked errors, reached point 1": ErrorsChecked(reached=True),
    "reached point, onto next trajectory": PointReached(),
    "end of all available trajectories": EndOfTrajectories(),
    "SETUP MOVING": SetupMoving(),
    "SETUP FINISHED": SetupFinished(),
}


def parse_line(line: bytes) -> Line:
    """Parses one line, without its LF; never raises.

    Args:
        line: the bytes between two LFs; one CR at the end is taken off.

    Returns:
        The line's kind with its numbers, or `UnknownLine`. Never `Echo` (see `LineReader`).
    """
    text = _text_of(line)
    fixed = _FIXED.get(text)
    if fixed is not None:
        return fixed
    return _parse_telemetry(text) or _parse_move(text) or UnknownLine(text)


class LineReader:
    """Cuts a stream of bytes at LF and gives each line its kind, the echo included.

    Args:
        drop_first: leave out what comes before the first LF, which may be a fragment.
    """

    def __init__(self, *, drop_first: bool = True) -> None:
        self._pending = bytearray()
        self._length = 0
        self._skips = drop_first
        self._echo_next = False

    def feed(self, data: bytes) -> list[Line]:
        """Takes the next bytes of the stream and returns the lines that they complete.

        A line that is too long yields an `OverlongLine` as soon as it is.
        """
        lines: list[Line] = []
        *complete, rest = data.split(b"\n")
        for part in complete:
            lines += self._extend(part)
            lines += self._end_line()
        return lines + self._extend(rest)

    def cut(self) -> None:
        """Bytes may be missing from here on: leaves out what comes before the next LF."""
        self._pending.clear()
        self._length = 0
        self._skips, self._echo_next = True, False

    def _extend(self, part: bytes) -> list[Line]:
        before, self._length = self._length, self._length + len(part)
        if not self._skips:
            self._pending += part[: LONGEST_LINE + 1]
        if not before <= LONGEST_LINE < self._length:
            return []
        text = _text_of(bytes(self._pending[:KEPT_OF_OVERLONG]))
        self._pending.clear()
        self._skips, self._echo_next = True, False
        return [OverlongLine(text)]

    def _end_line(self) -> list[Line]:
        raw, skipped = bytes(self._pending), self._skips
        self._pending.clear()
        self._length, self._skips = 0, False
        return [] if skipped else [self._classify(raw)]

    def _classify(self, raw: bytes) -> Line:
        if self._echo_next:
            self._echo_next = False
            return Echo(_text_of(raw))
        line = parse_line(raw)
        self._echo_next = isinstance(line, NewData) and line.taken
        return line


def is_out_of_travel(stroke_mm: float) -> bool:
    """Whether no motor can have this stroke."""
    return not -READING_NOISE_MM <= stroke_mm <= HIGHEST_READING_MM + READING_NOISE_MM


def is_miscounted(text: str) -> bool:
    """Whether an unknown line is one of errors, each in order, but of more or fewer motors than there are."""
    return _SOME_ERRORS.fullmatch(text) is not None


def numbers_equal(sent_mm: tuple[float, ...], read_mm: tuple[float, ...]) -> bool:
    """Whether the robot read the numbers that were sent (to half a unit of the fourth decimal)."""
    pairs = zip(sent_mm, read_mm, strict=False)
    return len(sent_mm) == len(read_mm) and all(abs(s - r) < QUANTUM_MM / 100 for s, r in pairs)


def _text_of(raw: bytes) -> str:
    return raw.removesuffix(b"\r").decode("latin-1")


def _parse_telemetry(text: str) -> Line | None:
    if match := _TELEMETRY.fullmatch(text):
        numbers = _numbers(match[1].rstrip(","), ",")
        return OutOfTravel(numbers) if any(map(is_out_of_travel, numbers)) else Telemetry(numbers)
    if match := _ERRORS.fullmatch(text):
        return ErrorScan(_numbers(match[1].rstrip(","), ","))
    return None


def _parse_move(text: str) -> Line | None:
    if match := _EXECUTE.fullmatch(text):
        return Execute(int(match[1]))
    if match := _CURRENT.fullmatch(text):
        return CurrentPoint(int(match[1]), int(match[2]))
    if match := _DURATION.fullmatch(text):
        return PointDuration(_number(match[2]), match[1] is not None)
    if match := _POINT.fullmatch(text):
        return TrajectoryPoint(int(match[1]), _number(match[2]), _numbers(match[3]))
    if match := _COUNT.fullmatch(text):
        return PointCount(int(match[2]), match[1] is not None)
    return None


def _numbers(text: str, separator: str | None = None) -> tuple[float, ...]:
    return tuple(_number(field) for field in text.split(separator))


def _number(text: str) -> float:
    return float(text.replace("ovf", "inf"))
