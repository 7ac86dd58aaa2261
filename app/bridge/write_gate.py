"""The write gate, the only way to the robot: nothing overtakes a stop, and a stop overtakes everything."""

import threading
from collections.abc import Callable
from enum import Enum
from typing import Protocol

from app.bridge.states import Direction
from core.errors import InputError
from core.wire.messages import encode_flush, encode_stop

Log = Callable[[Direction, bytes, float], None]
"""Receives every byte both ways with the time of the bridge's clock; it must return at once.

The time of a message is that before its first byte goes out, so that no answer to it is earlier.
"""

Clock = Callable[[], float]
"""Seconds that only grow."""


class MessageKind(Enum):
    """The kinds of messages with their first bytes. Only these, stops and flushes go out."""

    WAYPOINT = ("an approved waypoint, or on the slow way to one", (b"<p,1,",))
    JOG = ("a step by hand", (b"<p,1,",))
    TEST = ("a message of the motor test", (b"<p,1,", b"<s,1>", b"<s,0>"))
    RESET = ("a reset", (b"<r>",))
    CLEAR = ("the clearing of a stop", (b"<p,1,", b"<s,0>"))

    def require(self, message: bytes) -> None:
        """Refuses a message that is not of this kind.

        Raises:
            InputError: it begins otherwise.
        """
        title, beginnings = self.value
        if not message.startswith(beginnings):
            raise InputError(f"A message that begins with {message[:5]!r} is not {title}.", "message")


class Outlet(Protocol):
    """Takes the bytes: a transport, or a robot in a test."""

    def write(self, data: bytes) -> None:
        """Sends a whole message.

        Raises:
            RobotError: it could not be sent.
        """


class WriteGate:
    """Writes messages, each with a permit that any stop revokes.

    A stop holds no lock but the one around a single write, so it waits for one message at most.

    A line is unsure as long as half a message may wait at its end, for that would swallow the next one:
    when it is new, until somebody has seen what the robot makes of it (`trust`), and for good after a write
    that failed. Then only a flush and stops go out, and each stop has a flush before it, in one write.

    Args:
        log: told of every message that went out.
        clock: for the log.
    """

    def __init__(self, log: Log, clock: Clock) -> None:
        self._log = log
        self._clock = clock
        self._lock = threading.Lock()
        self._stops = 0
        self._outlet: Outlet | None = None
        self._trusted = False
        self._failed = False

    @property
    def _unsure(self) -> bool:
        return self._failed or not self._trusted

    def attach(self, outlet: Outlet | None) -> None:
        """Opens the gate to an outlet, which is unsure, or closes it with None."""
        with self._lock:
            self._outlet = outlet
            self._trusted = False
            self._failed = False

    def trust(self) -> None:
        """Declares that nothing waits at the end of the line since it is new; a failed write outlasts it."""
        with self._lock:
            self._trusted = True

    def permit(self) -> int:
        """Returns a permit that lasts until the next stop."""
        return self._stops

    def write(self, message: bytes, permit: int, kind: MessageKind = MessageKind.WAYPOINT) -> bool:
        """Sends a message unless a stop came after its permit, or the line is unsure.

        Returns:
            Whether it went out.

        Raises:
            RobotError: the line did not take it.
            InputError: it is not of its kind.
        """
        kind.require(message)
        with self._lock:
            now = self._clock()
            sent = permit == self._stops and not self._unsure and self._put(message)
        return sent and self._note(message, now)

    def flush(self) -> bool:
        """Sends what closes a message that was cut off; the line stays unsure until it is trusted.

        Returns:
            Whether there was a line to send it on.

        Raises:
            RobotError: the line did not take it.
        """
        message = encode_flush()
        with self._lock:
            now = self._clock()
            sent = self._put(message)
        return sent and self._note(message, now)

    def stop(self) -> bool:
        """Revokes every permit and sends the stop, behind a flush if the line is unsure.

        Returns:
            Whether there was a line to send it on.

        Raises:
            RobotError: the line did not take it.
        """
        with self._lock:
            now = self._clock()
            message = self._stop_message()
            sent = self._put(message)
        return sent and self._note(message, now)

    def try_stop(self) -> bool:
        """Does what `stop` does unless a message is just going out, or the last one did not.

        Returns:
            Whether it did; if not, nothing was done.

        Raises:
            RobotError: the line did not take it.
        """
        if self._failed or not self._lock.acquire(blocking=False):
            return False
        try:
            now = self._clock()
            message = self._stop_message()
            sent = self._put(message)
        finally:
            self._lock.release()
        if sent:
            self._note(message, now)
        return True

    def _stop_message(self) -> bytes:
        """Revokes every permit; what a stop is on this line."""
        self._stops += 1
        return encode_flush() + encode_stop() if self._unsure else encode_stop()

    def _put(self, data: bytes) -> bool:
        if self._outlet is None:
            return False
        failed, self._failed = self._failed, True
        self._outlet.write(data)
        self._failed = failed
        return True

    def _note(self, data: bytes, began: float) -> bool:
        self._log(Direction.TO_ROBOT, data, began)
        return True
