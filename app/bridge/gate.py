"""The one way out to the robot: nothing overtakes a stop, and a stop overtakes everything."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Protocol

from app.bridge.states import Direction
from core.wire import encode_stop

Log = Callable[[Direction, bytes, float], None]
"""Receives every byte both ways with the time of the bridge's clock; it must return at once."""

Clock = Callable[[], float]
"""Seconds that only grow."""


class Outlet(Protocol):
    """What takes bytes: a transport, or a test's robot."""

    def write(self, data: bytes) -> None:
        """Sends a whole message.

        Raises:
            RobotError: it could not be sent.
        """


class Gate:
    """Writes messages, each with a permit that any stop revokes.

    A stop holds no lock but the one around a single write, so it waits for one message at most.

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

    def attach(self, outlet: Outlet | None) -> None:
        """Opens the gate to an outlet, or closes it with None."""
        with self._lock:
            self._outlet = outlet

    def permit(self) -> int:
        """Returns a permit that lasts until the next stop."""
        return self._stops

    def write(self, message: bytes, permit: int) -> bool:
        """Sends a message unless a stop came after its permit.

        Returns:
            Whether it went out.

        Raises:
            RobotError: the line did not take it.
        """
        with self._lock:
            if permit != self._stops or self._outlet is None:
                return False
            self._outlet.write(message)
        self._log(Direction.TO_ROBOT, message, self._clock())
        return True

    def stop(self) -> bool:
        """Revokes every permit and sends the stop.

        Returns:
            Whether there was a line to send it on.

        Raises:
            RobotError: the line did not take it.
        """
        with self._lock:
            self._stops += 1
            if self._outlet is None:
                return False
            self._outlet.write(encode_stop())
        self._log(Direction.TO_ROBOT, encode_stop(), self._clock())
        return True
