"""The queue of the bridge's worker: bytes with the times of their arrival, and lines that hung up."""

import queue
from dataclasses import dataclass


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


class Inbox:
    """A queue that any thread fills and the worker empties."""

    def __init__(self) -> None:
        self._queue: queue.SimpleQueue[Bytes | HungUp | None] = queue.SimpleQueue()

    def put(self, item: Bytes | HungUp) -> None:
        """Adds what came."""
        self._queue.put(item)

    def wake(self) -> None:
        """Ends the worker's waiting."""
        self._queue.put(None)

    def take(self, seconds: float = 0.0) -> list[Bytes | HungUp]:
        """Returns everything there is, in its order; waits at most so long for the first, s."""
        items: list[Bytes | HungUp] = []
        try:
            item = self._queue.get(timeout=seconds)
            while True:
                if item is not None:
                    items.append(item)
                item = self._queue.get_nowait()
        except queue.Empty:
            return items
