"""The timer of a test: a test that is too slow fails alone, whatever it waits in, and the others go on."""

from __future__ import annotations

import asyncio
import signal
from collections.abc import Callable
from types import FrameType

import pytest
from greenlet import getcurrent


class TooSlowError(BaseException):
    """A test took too long.

    Neither the program nor Hypothesis catches it; Hypothesis would try the same example again, without end.
    """


def harden_timer(seconds: float) -> Callable[[], None]:
    """Changes the timer that pytest-timeout has just started by a signal.

    It raises an error of its own, and in the test: a signal that comes while the test waits for the browser
    finds Playwright's event loop, which would not survive it. It comes again and again, so that no fixture
    can hang at its end either.

    Args:
        seconds: until the signal, and from one to the next.

    Returns:
        A function that starts the timer again.
    """
    fail = signal.getsignal(signal.SIGALRM)
    test = getcurrent()

    def end_test(number: int, frame: FrameType | None) -> None:
        __tracebackhide__ = True
        try:
            if callable(fail):
                fail(number, frame)
        except pytest.fail.Exception as failure:
            error = TooSlowError(failure.msg)
            if getcurrent() is test:
                raise error from None
            test.throw(error)
            # The next call to the browser goes on here, and its loop may wait in the system.
            asyncio.get_running_loop().call_soon_threadsafe(lambda: None)

    def start() -> None:
        if callable(fail):  # else pytest-timeout uses a thread
            signal.signal(signal.SIGALRM, end_test)
            signal.setitimer(signal.ITIMER_REAL, seconds, seconds)

    start()
    return start
