"""Wall times of the bridge's changes of state, noted when each is first seen."""

import threading
from collections.abc import Sequence

from app.bridge.states import LinkState, Transition
from app.common.clock import Clock


class TransitionTimes:
    """When changes of state happened: by the wall clock at the connection, and the time that passed since.

    Args:
        clock: the clocks of the machine; `boot` is that of the bridge.
    """

    def __init__(self, clock: Clock) -> None:
        self._clock = clock
        self._lock = threading.Lock()
        self._noted: dict[int, float] = {}
        self._offset = 0.0

    def of(self, changes: Sequence[Transition]) -> list[float]:
        """Notes the changes that are new, and returns when each happened, s since 1970.

        Args:
            changes: all that the bridge still has, the oldest first.
        """
        with self._lock:
            self._noted = {one.number: self._noted.get(one.number) or self._time_of(one) for one in changes}
            return list(self._noted.values())

    def _time_of(self, change: Transition) -> float:
        if not self._offset or change.link in (LinkState.CONNECTING, LinkState.DISCONNECTED):
            self._offset = self._clock.wall() - self._clock.boot()
        return change.time + self._offset
