"""The handshake from an open line to a ready robot: one flush, then its effect (docs/firmware.md)."""

from app.bridge.telemetry import IDLE_LINES, TelemetryMonitor
from core.wire.lines import Line, NewData

START_LIMIT = 15.0
"""A board that restarts when its port is opened is up after 8 s; a message that the flush has closed moves
the motors for at most 4 s. Both must be over within this, each for itself, s."""

FLUSH_TIME = 0.3
"""A flush has been read, and what was on its way before it has arrived, this long after it was sent, s."""


class Handshake:
    """Follows a line from its opening to the robot's readiness.

    The flush is due at the first pass of the robot's loop. While the board boots there is none, so the flush
    comes after the boot, when it finds an empty memory and is ignored; during a ramp there is none either,
    and whatever waits there waits for the next pass too.

    Args:
        now: time of the opening, s.

    Attributes:
        began: when the present wait began, s.
        flushed_at: when the flush was sent, s, or None.
    """

    def __init__(self, now: float) -> None:
        self.began = now
        self.flushed_at: float | None = None

    def restart(self, now: float) -> None:
        """The board boots once more; its memory is empty and needs no other flush."""
        self.began = now

    def flush_due(self, line: Line, monitor: TelemetryMonitor) -> bool:
        """Whether this line shows that the robot's loop runs and it is time for the flush."""
        return self.flushed_at is None and isinstance(line, NewData) and monitor.readings > 0

    def flushed(self, now: float, monitor: TelemetryMonitor) -> None:
        """The flush went out."""
        self.began = self.flushed_at = now
        monitor.idle_lines = 0

    def is_ready(self, now: float, monitor: TelemetryMonitor) -> bool:
        """Whether the flush has had its effect and the robot idles."""
        if self.flushed_at is None or now < self.flushed_at + FLUSH_TIME:
            return False
        return monitor.idle_lines >= IDLE_LINES

    def overdue(self, now: float) -> bool:
        """Whether the robot has taken too long."""
        return now > self.began + START_LIMIT
