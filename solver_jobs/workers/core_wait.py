"""Time in which a process was ready to run and no core was free, which is no silence of its own."""

import sys
import time
from pathlib import Path

_NANOSECOND = 1e-9
_READY = "R"
"""State of a process that runs or waits for a core, in proc(5)."""


class CoreWait:
    """Adds up how long a process waits for a core. Linux tells that; elsewhere it is 0.

    Args:
        process: its number.
    """

    def __init__(self, process: int) -> None:
        self._folder = Path(f"/proc/{process}")
        self._looked, self._ran = time.monotonic(), 0.0
        self._seconds = 0.0

    def look(self) -> float:
        """Returns the time so far, s; look often, as the state between two looks is not known."""
        if sys.platform != "linux":
            return 0.0
        try:
            state = (self._folder / "stat").read_text().rpartition(")")[2].split()[0]
            ran = int((self._folder / "schedstat").read_text().split()[0]) * _NANOSECOND
        except (OSError, IndexError, ValueError):  # it has ended, or the system keeps no such record
            return self._seconds
        now = time.monotonic()
        if state == _READY:
            self._seconds += max(0.0, (now - self._looked) - (ran - self._ran))
        self._looked, self._ran = now, ran
        return self._seconds
