"""File descriptors: how many the process may have, and a few kept for the worst moment."""

import os
import sys

WANTED = 1024
"""Raised to this where the system starts programs with fewer. Not more: the serial port's `select` takes none
from 1024 on."""

SPARE = 8
"""Kept open to be given up for new connections when there are no others."""


def raise_limit(wanted: int = WANTED) -> int:
    """How many files and connections the process may have open, after raising it as far as it may be.

    Args:
        wanted: what a lower limit is raised to.
    """
    if sys.platform == "win32":
        return wanted
    import resource

    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    if soft == resource.RLIM_INFINITY or soft >= wanted:
        return wanted
    highest = wanted if hard == resource.RLIM_INFINITY else min(wanted, hard)
    try:
        resource.setrlimit(resource.RLIMIT_NOFILE, (highest, hard))
    except (ValueError, OSError):
        return soft
    return highest


class Spares:
    """Descriptors that are held open for nothing, until they are needed."""

    def __init__(self) -> None:
        self._held: list[int] = []
        self.fill()

    def fill(self) -> None:
        """Takes as many as are missing, as far as the system has some."""
        while len(self._held) < SPARE:
            try:
                self._held.append(os.open(os.devnull, os.O_RDONLY | os.O_CLOEXEC))
            except OSError:
                return

    def give_up(self) -> bool:
        """Closes one, so that a connection can have it; False where none is left."""
        if not self._held:
            return False
        os.close(self._held.pop())
        return True

    def close(self) -> None:
        """Closes all."""
        while self.give_up():
            pass
