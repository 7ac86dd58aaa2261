"""Wall times of the bridge's changes of state, noted when each is first seen."""

import threading
import time
from collections.abc import Callable, Sequence

from app.bridge.states import Transition
from app.common.clock import Clock


class TransitionTimes:
    """When changes of state happened by the wall clock as it was then; later steps of it move none of them.

    Args:
        clock: the clocks of the machine.
        monotonic: the clock of the bridge, s.
    """

    def __init__(self, clock: Clock, monotonic: Callable[[], float] = time.monotonic) -> None:
        self._clock, self._monotonic = clock, monotonic
        self._lock = threading.Lock()
        self._noted: dict[int, float] = {}

    def of(self, changes: Sequence[Transition]) -> list[float]:
        """Notes the changes that are new, and returns when each happened, s since 1970.

        Args:
            changes: all that the bridge still has, the oldest first.
        """
        with self._lock:
            offset = self._clock.wall() - self._monotonic()
            self._noted = {one.number: self._noted.get(one.number, one.time + offset) for one in changes}
            return list(self._noted.values())
