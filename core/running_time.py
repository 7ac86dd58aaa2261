"""Time in which a program ran: no deadline counts time in which its judge could not look."""

from collections.abc import Callable
from typing import TypeVar

T = TypeVar("T")

MOST_SECONDS = 0.5
"""A judge that runs looks more often than this, s."""


class RunningClock:
    """Seconds in which its judge has run.

    A program that is suspended, frozen or put aside from the keyboard does not look. That time does not
    count.

    Args:
        clock: seconds that only grow.
        most: the most that counts between two looks, s.
    """

    def __init__(self, clock: Callable[[], float], most: float = MOST_SECONDS) -> None:
        self._clock = clock
        self._most = most
        self._look = (clock(), 0.0)

    def __call__(self) -> float:
        """Returns the time in s; any thread may ask."""
        looked, counted = self._look
        return counted + min(self._clock() - looked, self._most)

    def look(self) -> float:
        """Notes that the judge runs; for one thread at a time, more often than every `most` s.

        Returns:
            0, or the time since the last look where that was longer than `most`, s.
        """
        looked, counted = self._look
        now = self._clock()
        self._look = (now, counted + min(now - looked, self._most))
        return now - looked if now - looked > self._most else 0.0


class Deadline:
    """A time limit that counts the time in which the waiting thread ran.

    Args:
        seconds: the limit.
        clock: seconds that only grow.
        most: the most that counts between two looks, s; look more often.
    """

    def __init__(self, seconds: float, clock: Callable[[], float], most: float = MOST_SECONDS) -> None:
        self._seconds = seconds
        self._running = RunningClock(clock, most)

    @property
    def left(self) -> float:
        """Time left, s; 0 when it is over."""
        self._running.look()
        return max(0.0, self._seconds - self._running())

    @property
    def is_over(self) -> bool:
        """Whether nothing is left."""
        return self.left == 0.0


def wait_within(wait: Callable[[float], T], seconds: float, clock: Callable[[], float]) -> T:
    """Waits for something in short pieces, so that only time in which the program ran counts.

    Args:
        wait: waits at most so long, s, as `Future.result` does.
        seconds: the limit.
        clock: seconds that only grow.

    Raises:
        TimeoutError: it did not come in time.
    """
    deadline = Deadline(seconds, clock)
    while True:
        try:
            return wait(min(deadline.left, MOST_SECONDS / 2))
        except TimeoutError:
            if deadline.is_over:
                raise
