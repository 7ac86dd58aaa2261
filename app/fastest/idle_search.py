"""Processes of a search that end when nobody has used them for a while."""

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from solver_jobs import FastestSearch

IDLE_SECONDS = 180.0
"""So long processes wait for another use; each takes some hundred megabytes."""


class IdleSearch:
    """Processes that several searches share, started when they are needed. Thread-safe.

    Args:
        make: starts them.
        seconds: how long they wait for another use, s.
    """

    def __init__(
        self, make: Callable[[], FastestSearch] = FastestSearch, seconds: float = IDLE_SECONDS
    ) -> None:
        self._make, self._seconds = make, seconds
        self._lock = threading.Lock()
        self._users = 0
        self._search: FastestSearch | None = None
        self._timer: threading.Timer | None = None

    @contextmanager
    def use(self) -> Iterator[FastestSearch]:
        """The processes, which do not end meanwhile."""
        with self._lock:
            self._users += 1
            self._stop_timer()
            search = self._search = self._search or self._make()
        try:
            yield search
        finally:
            with self._lock:
                self._users -= 1
                if self._users == 0 and self._search is not None:
                    self._timer = threading.Timer(self._seconds, self.close)
                    self._timer.daemon = True
                    self._timer.start()

    def _stop_timer(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None

    def close(self) -> None:
        """Ends the processes where nobody uses them; the next use starts others."""
        with self._lock:
            self._stop_timer()
            if self._users:
                return
            search, self._search = self._search, None
        if search is not None:
            search.close()
