"""A person at the keyboard who is asked while a command runs."""

import os
import select
import sys

try:
    import termios
except ImportError:  # not on Windows, where nobody is asked
    termios = None  # type: ignore[assignment]


def has_keyboard() -> bool:
    """Whether a person may sit at a keyboard, also while the program is in the background."""
    return termios is not None and sys.stdin is not None and sys.stdin.isatty()


def forget_typed() -> bool:
    """Forgets what was typed before a question; returns whether a person can answer at all."""
    if not _is_at_keyboard():
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
    try:
        return has_keyboard() and os.tcgetpgrp(sys.stdin.fileno()) == os.getpgrp()
    except OSError:  # not the terminal that controls this program
        return False
