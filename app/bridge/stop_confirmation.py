"""Confirms one stop: the robot echoed it, and every motor stands still as measured."""

from core.wire.lines import Echo, Line, NewData, Telemetry
from core.wire.messages import encode_stop, payload_of

STOP_LIMIT = 6.0
"""A stop that has not taken effect after this long is shown as NOT STOPPED, s."""

CROSSING = 0.2
"""A line that arrives later than this after a stop was sent was said by a robot that could have read it:
a pass of an idle robot takes 32 ms at most, s."""

OVERDUE_REPEAT = 2.0
"""An overdue stop is sent again this often whatever the robot says, s."""

STOP_PAYLOAD = payload_of(encode_stop())


class StopConfirmation:
    """Follows a stop.

    Args:
        now: when its bytes went out, s.
        text: “stopped at 12.4 s by NAME”, or None if no person asked for it.
        cause: sentence of the fault that asked for it, or empty.

    Attributes:
        confirmed: whether the robot echoed it and stood still.
    """

    def __init__(self, now: float, text: str | None = None, cause: str = "") -> None:
        self.text = text
        self.cause = cause
        self.confirmed = False
        self.restart(now)

    def restart(self, now: float) -> None:
        """Begins anew on a new line: nothing echoed yet, and the full time."""
        self._began = now
        self._echoed = False
        self.sent(now)

    def sent(self, now: float) -> None:
        """The bytes went out (once more)."""
        self._sent_at = now
        self._readings = 0
        self._unheard = False

    def see(self, line: Line, now: float) -> bool:
        """Takes the next line from the robot and tells whether it is the stop's echo.

        A pass of its loop that took no message, or a second telemetry line, shows that the stop is lost: the
        robot reads before each pass.
        """
        echo = isinstance(line, Echo) and line.payload == STOP_PAYLOAD
        self._echoed = self._echoed or echo
        if now < self._sent_at + CROSSING:
            return echo
        self._readings += isinstance(line, Telemetry)
        passed = self._readings > 1 or (isinstance(line, NewData) and not line.taken)
        self._unheard = self._unheard or (passed and not self._echoed)
        return echo

    @property
    def echoed(self) -> bool:
        """Whether the robot has read it."""
        return self._echoed

    def overdue(self, now: float) -> bool:
        """Whether it is not confirmed although its time is over."""
        return not self.confirmed and now > self._began + STOP_LIMIT

    def repeat_due(self, now: float) -> bool:
        """Whether to send it again."""
        return self._unheard or (self.overdue(now) and now > self._sent_at + OVERDUE_REPEAT)
