"""Notices gait files that somebody changes while the studio runs."""

import threading
from collections.abc import Callable

LOOK_SECONDS = 2.0
"""How often the files' times and sizes are looked at, s."""


class FileWatch:
    """A thread that asks again and again for a look at the files.

    Args:
        look: asks for it; called from the thread.
    """

    def __init__(self, look: Callable[[], object]) -> None:
        self._look = look
        self._closing = threading.Event()
        self._thread = threading.Thread(target=self._work, name="file watch", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Ends."""
        self._closing.set()
        self._thread.join()

    def _work(self) -> None:
        while not self._closing.wait(LOOK_SECONDS):
            self._look()
