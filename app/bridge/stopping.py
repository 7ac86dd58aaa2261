"""One stop from its bytes to its confirmation: echoed, and every motor standing as measured."""

from __future__ import annotations

from enum import Enum, auto

from core.wire import encode_stop, payload_of
from core.wire_lines import Echo, Line

STOP_LIMIT = 6.0
"""A stop that has not taken effect after this long is shown as NOT STOPPED, s."""

STOP_REPEAT = 1.0
"""A robot that talks but has not echoed a stop is told again after this long, s."""

STOP_PAYLOAD = payload_of(encode_stop())


class StopOutcome(Enum):
    """What there is to do about a stop."""

    WAIT = auto()
    CONFIRMED = auto()
    REPEAT = auto()
    OVERDUE = auto()


class Stopping:
    """Follows a stop.

    Args:
        text: “stopped at 12.4 s by NAME”.
        now: when its bytes went out, s.
    """

    def __init__(self, text: str, now: float) -> None:
        self.text = text
        self._began = now
        self._sent_at = now
        self._echoed = False

    def sent(self, now: float) -> None:
        """The bytes went out once more."""
        self._sent_at = now

    def see(self, line: Line) -> None:
        """Takes the next line from the robot."""
        self._echoed = self._echoed or (isinstance(line, Echo) and line.payload == STOP_PAYLOAD)

    def judge(self, now: float, *, still: bool) -> StopOutcome:
        """What to do now.

        Args:
            now: time, s.
            still: whether every motor stands, by readings that are still coming in.
        """
        if self._echoed and still:
            return StopOutcome.CONFIRMED
        if not self._echoed and still and now > self._sent_at + STOP_REPEAT:
            return StopOutcome.REPEAT
        return StopOutcome.OVERDUE if now > self._began + STOP_LIMIT else StopOutcome.WAIT
