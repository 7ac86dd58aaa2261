"""Wall times of the bridge's changes of state, noted when each is first seen."""

import threading
from collections.abc import Sequence

from app.bridge.states import Transition
from app.common.clock import Clock


class TransitionTimes:
    """When changes of state happened by the wall clock as it was then; later steps of it move none of them.

    Args:
        clock: the clocks of the machine; `boot` is that of the bridge.
    """

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._lock = threading.Lock()
        self._noted: dict[int, float] = {}

    def of(self, changes: Sequence[Transition]) -> list[float]:
        """Notes the changes that are new, and returns when each happened, s since 1970.

        Args:
            changes: all that the bridge still has, the oldest first.
        """
        with self._lock:
            offset = self._clock.wall() - self._clock.boot()
            self._noted = {one.number: self._noted.get(one.number, one.time + offset) for one in changes}
            return list(self._noted.values())
