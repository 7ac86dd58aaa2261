"""Clocks and deadlines that count the time in which their judge ran."""

from __future__ import annotations

import pytest

from core.running_time import Deadline, RunningClock, wait_within


class SetClock:
    def __init__(self) -> None:
        self.now = 1000.0

    def __call__(self) -> float:
        return self.now


def test_a_judge_that_looks_often_counts_all_of_the_time() -> None:
    real = SetClock()
    clock = RunningClock(real, 0.5)
    for _ in range(40):
        real.now += 0.25
        assert clock.look() == 0.0
    assert clock() == pytest.approx(10.0)


@pytest.mark.parametrize("away", [0.6, 2.0, 20.0, 86400.0])
def test_time_without_a_look_counts_no_more_than_between_two_looks(away: float) -> None:
    real = SetClock()
    clock = RunningClock(real, 0.5)
    real.now += away
    assert clock() == pytest.approx(0.5)
    assert clock.look() == pytest.approx(away)
    assert clock() == pytest.approx(0.5)
    assert clock.look() == 0.0


def test_whoever_asks_between_two_looks_never_sees_the_time_go_back() -> None:
    real = SetClock()
    clock = RunningClock(real, 0.5)
    seen = [clock()]
    for step in (0.1, 3.0, 0.2, 0.4, 60.0, 0.0):
        real.now += step
        seen.append(clock())
        clock.look()
        seen.append(clock())
    assert seen == sorted(seen)


@pytest.mark.parametrize("away", [2.0, 20.0, 3600.0])
def test_a_deadline_is_not_over_because_nobody_ran(away: float) -> None:
    real = SetClock()
    deadline = Deadline(2.0, real, most=0.5)
    real.now += away
    assert not deadline.is_over
    assert deadline.left == pytest.approx(1.5)
    for _ in range(4):
        real.now += 0.4
    assert not deadline.is_over
    for _ in range(3):
        real.now += 0.4
        late = deadline.is_over
    assert late


@pytest.mark.parametrize("away", [0.0, 5.0, 3600.0])
def test_what_is_waited_for_may_come_after_a_time_in_which_nobody_ran(away: float) -> None:
    real, waits = SetClock(), list[float]()

    def wait(seconds: float) -> str:
        waits.append(seconds)
        real.now += seconds + (away if len(waits) == 2 else 0.0)
        if len(waits) < 6:
            raise TimeoutError
        return "here"

    assert wait_within(wait, 2.0, real) == "here"


def test_what_does_not_come_is_given_up_in_time() -> None:
    real = SetClock()

    def wait(seconds: float) -> str:
        real.now += seconds
        raise TimeoutError

    with pytest.raises(TimeoutError):
        wait_within(wait, 2.0, real)
    assert real.now == pytest.approx(1002.0, abs=0.3)
