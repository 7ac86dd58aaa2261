"""Times of records while the wall clock is set."""

import time

import pytest

from app.common.clock import Clock, boot_seconds
from tests.support.set_clock import SetClock


@pytest.mark.parametrize("step", [-7200.0, 7200.0, -1.8e9, 2.3e9, 0.0])
def test_the_end_of_a_span_is_its_start_and_what_a_watch_counts(step: float) -> None:
    clock = SetClock()
    span = clock.start()
    clock.pass_seconds(12.5)
    clock.step(step)
    assert span.seconds == 12.5
    assert span.now == span.started + 12.5


def test_the_boot_clock_grows_and_is_never_behind_the_monotonic_one() -> None:
    monotonic, first = time.monotonic(), boot_seconds()
    assert boot_seconds() >= first >= monotonic


def test_the_clocks_of_the_machine_are_the_default() -> None:
    before = time.time()
    span = Clock().start()
    assert before <= span.started <= time.time()
    assert 0.0 <= span.seconds < 60.0
