"""A person at the keyboard who is asked while a command runs."""

import os
import select
import sys

try:
    import termios
except ImportError:  # not on Windows, where nobody is asked
    termios = None  # type: ignore[assignment]


def forget_typed() -> bool:
    """Forgets what was typed before a question; returns whether a person can answer at all."""
    if termios is None or not _is_at_keyboard():
        return False
    termios.tcflush(sys.stdin.fileno(), termios.TCIFLUSH)
    return True


def has_typed_line() -> bool:
    """Takes the next line that was typed, and returns whether there was one; never waits."""
    if not _is_at_keyboard() or not select.select([sys.stdin], [], [], 0)[0]:
        return False
    return sys.stdin.readline() != ""


def _is_at_keyboard() -> bool:
    """Whether standard input is a terminal that this program has in the foreground."""
    if sys.stdin is None or not sys.stdin.isatty():
        return False
    return os.tcgetpgrp(sys.stdin.fileno()) == os.getpgrp()
