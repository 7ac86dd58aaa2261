"""Ctrl-C that waits."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator

import pytest

from solver_jobs.workers.signals import interrupts_held


@pytest.fixture
def heard() -> Iterator[list[str]]:
    """What has happened; an interrupt is heard in place of raised."""
    happened: list[str] = []
    before = signal.signal(signal.SIGINT, lambda *_: happened.append("interrupt"))
    yield happened
    signal.signal(signal.SIGINT, before)


def test_an_interrupt_takes_effect_afterwards(heard: list[str]) -> None:
    with interrupts_held():
        signal.raise_signal(signal.SIGINT)
        heard.append("the rest")
    assert heard == ["the rest", "interrupt"]


def test_without_an_interrupt_nothing_is_raised_and_the_handler_is_as_before() -> None:
    before = signal.getsignal(signal.SIGINT)
    with interrupts_held():
        assert signal.getsignal(signal.SIGINT) is not before
    assert signal.getsignal(signal.SIGINT) is before


def test_other_threads_leave_the_handler_alone() -> None:
    seen = []

    def look() -> None:
        with interrupts_held():
            seen.append(signal.getsignal(signal.SIGINT))

    thread = threading.Thread(target=look)
    thread.start()
    thread.join()
    assert seen == [signal.getsignal(signal.SIGINT)]
