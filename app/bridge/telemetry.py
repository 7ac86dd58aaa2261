"""What the robot's lines show: strokes, whether it idles or stands still, and how long it may be silent."""

import math
from collections.abc import Iterable

from core.wire.lines import (
    Blank,
    CurrentPoint,
    ErrorScan,
    ErrorsChecked,
    Execute,
    Line,
    NewData,
    OutOfTravel,
    OverlongLine,
    SetupMoving,
    Telemetry,
    UnknownLine,
)
from core.wire.messages import HIGHEST_MM, LOWEST_MM
from core.wire.robot_time import OVERRUN, ramp_time

STILL_MM = 0.05
"""Readings that differ less are of a motor that stands: four counts of the converter."""

STILL_TIME = 0.3
FRESH_TIME = 0.5
"""Standing still is believed after 0.3 s of equal readings, the last at most 0.5 s old."""

STALE_TIME = 1.0
"""A robot that idles tells its strokes every 32 ms at least; older ones are not where it stands, s. The
buffers of a line keep what the robot says in so much time."""

IDLE_LINES = 2
"""Telemetry lines with no movement between them after which a robot idles."""

IDLE_SILENCE = 1.7
"""An idle robot speaks every 32 ms; one that is silent longer than this is lost, so that a restarted board is
named within 2 s, s."""

LATE_BYTES = 0.4
"""How late bytes may be after a ramp, s."""

UNREAD_TIME = 1.0
"""The strokes may come later by this than the first word after a silence: a scan of the errors and what is
late, s."""

SILENCE_LIMIT = 4.0
"""No robot is waited for longer than this, whatever it was told, s."""


class TelemetryMonitor:
    """Follows the lines of one connection.

    Args:
        now: time of the connection, s.

    Attributes:
        strokes_mm: last measured strokes, or None.
        last_byte: time of the last byte, s.
        idle_lines: telemetry lines since the robot last worked at a move.
        unknown_lines: lines of no known kind.
        unread_strokes: last line that begins like telemetry and is none, or empty.
        longest_scan: longest error scan, s, or None.
        last_line: last line that tells more than that the robot is alive.
        last_reading: time of the last telemetry line, s.
        readings: telemetry lines so far.
        talks: whether anything at all has come.
    """

    def __init__(self, now: float) -> None:
        self.strokes_mm: tuple[float, ...] | None = None
        self.last_byte = now
        self.idle_lines = 0
        self.unknown_lines = 0
        self.unread_strokes = ""
        self.longest_scan: float | None = None
        self.last_line: Line | None = None
        self.readings = 0
        self.talks = False
        self._still_from: tuple[float, ...] | None = None
        self._still_since = now
        self.last_reading = now
        self._strokes_awaited = now
        self._scan_began: float | None = None
        self._farthest_mm = HIGHEST_MM - LOWEST_MM

    def heard(self, now: float) -> None:
        """Bytes arrived."""
        self.last_byte = now
        self.talks = True

    def expect(self, distance_mm: float) -> None:
        """A message is sent that moves a motor by so much, mm."""
        self.idle_lines = 0
        self._farthest_mm = distance_mm

    @property
    def longest_silence(self) -> float:
        """How long the robot may be silent now: a pass of its loop, or the ramp that it may have begun, s."""
        if self.idle_lines >= IDLE_LINES:
            return IDLE_SILENCE
        ramp = ramp_time(self._farthest_mm / 1000.0) + OVERRUN + LATE_BYTES
        return min(max(IDLE_SILENCE, ramp), SILENCE_LIMIT)

    @property
    def longest_unread(self) -> float:
        """How long the robot may give no strokes that can be read, s."""
        return self.longest_silence + UNREAD_TIME

    def unread_time(self, now: float) -> float:
        """Time since the last strokes that could be read, s."""
        return now - self._strokes_awaited

    def forget_age(self, now: float) -> None:
        """The readings so far are of a time that nobody can tell; only the next one shows where it stands."""
        self._strokes_awaited = now
        self.last_reading = -math.inf
        self._still_from = None

    def stands_still(self, now: float) -> bool:
        """Whether every motor has been where it is for 0.3 s, by readings that are still coming in."""
        fresh = now - self.last_reading <= FRESH_TIME
        return self._still_from is not None and fresh and self.last_reading - self._still_since >= STILL_TIME

    def see(self, line: Line, now: float) -> None:
        """Takes the next line."""
        match line:
            case Telemetry():
                self._see_strokes(line.strokes_mm, now)
                return
            case Execute() | SetupMoving():
                self.idle_lines = 0
            case CurrentPoint():
                self._scan_began = now
            case ErrorScan():
                self.idle_lines = 0
                self._farthest_mm = max(self._farthest_mm, _largest(line.errors_mm))
            case ErrorsChecked() if self._scan_began is not None:
                self.longest_scan = max(self.longest_scan or 0.0, now - self._scan_began)
            case OutOfTravel():
                self.unknown_lines += 1
            case UnknownLine() | OverlongLine():
                self.unknown_lines += 1
                if line.text.startswith("j,"):
                    self.unread_strokes = line.text
            case _:
                pass
        if not isinstance(line, Blank | NewData):
            self.last_line = line

    def _see_strokes(self, strokes_mm: tuple[float, ...], now: float) -> None:
        self.strokes_mm = strokes_mm
        self.readings += 1
        self.idle_lines += 1
        self.last_reading = self._strokes_awaited = now
        still = self._still_from is not None and all(
            abs(a - b) <= STILL_MM for a, b in zip(self._still_from, strokes_mm, strict=True)
        )
        if not still:
            self._still_from = strokes_mm
            self._still_since = now


def _largest(errors_mm: Iterable[float]) -> float:
    """The largest distance, mm; infinite where one is no number."""
    return max(abs(e) if math.isfinite(e) else math.inf for e in errors_mm)
