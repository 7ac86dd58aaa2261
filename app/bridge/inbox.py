"""The queue of the bridge's worker: bytes with the times of their arrival, and lines that hung up."""

import threading
from collections import deque
from dataclasses import dataclass

MOST_BYTES = 1_000_000
"""Memory of the bytes that wait: a sound robot sends so much in two minutes."""

ITEM_BYTES = 200
"""Memory that bytes which arrive together take beside themselves."""

TURN_BYTES = 65_536
"""Bytes that the worker takes at a time, so that others get to the robot's state in between."""


@dataclass(frozen=True)
class Bytes:
    """Bytes from the robot and when they were read, s of time in which the program ran."""

    data: bytes
    time: float


@dataclass(frozen=True)
class HungUp:
    """A line, by its number, that hung up by itself."""

    line: int
    reason: str


@dataclass(frozen=True)
class LeftOut:
    """Bytes stood here that found no room."""


Item = Bytes | HungUp | LeftOut


class Inbox:
    """A queue that any thread fills and the worker empties; bytes that find no room are left out."""

    def __init__(self) -> None:
        self._items: deque[Item] = deque()
        self._memory = 0
        self._is_woken = False
        self._changed = threading.Condition()

    def put(self, item: Bytes | HungUp) -> None:
        """Adds what came."""
        with self._changed:
            if isinstance(item, Bytes) and self._memory + _memory(item) > MOST_BYTES:
                if not (self._items and isinstance(self._items[-1], LeftOut)):
                    self._items.append(LeftOut())
                    self._changed.notify()
                return
            self._items.append(item)
            self._memory += _memory(item)
            self._changed.notify()

    def judged_until(self, now: float) -> float:
        """The time up to which everything was taken: that of the oldest bytes that wait, or `now`."""
        with self._changed:
            return next((item.time for item in self._items if isinstance(item, Bytes)), now)

    def wake(self) -> None:
        """Ends the worker's waiting."""
        with self._changed:
            self._is_woken = True
            self._changed.notify()

    def take(self, seconds: float = 0.0, most: int = TURN_BYTES) -> list[Item]:
        """Returns what there is, in its order; waits at most so long for the first, s.

        Args:
            seconds: longest wait.
            most: bytes after which the rest is left for the next call.
        """
        items: list[Item] = []
        taken = 0
        with self._changed:
            self._changed.wait_for(lambda: self._items or self._is_woken, seconds)
            self._is_woken = False
            while self._items and taken < most:
                items.append(self._items.popleft())
                taken += _memory(items[-1])
            self._memory -= taken
        return items


def _memory(item: Item) -> int:
    return len(item.data) + ITEM_BYTES if isinstance(item, Bytes) else 0
