"""Questions to a process: answers, progress, an end when asked, and a new process in place of a dead one."""

from __future__ import annotations

import os
import queue
import signal
from collections.abc import Iterator

import pytest

from core.errors import InputError, SimulationCancelledError, StateError
from tests.support.solvers.errands import (
    AskedErrand,
    Errands,
    HastyErrand,
    ShortErrand,
    broken,
    cancelled,
    deaf,
    endless,
    refused,
    seven,
    silent,
)

PATIENCE = 60.0
"""Longest wait for anything, s."""


@pytest.fixture(scope="module")
def errands() -> Iterator[Errands]:
    service = Errands()
    service.start()
    yield service
    service.close()


def works(errands: Errands) -> bool:
    return errands.ask(AskedErrand(seven)).result(PATIENCE) == 7


def begun(errands: Errands, errand: AskedErrand, told: queue.SimpleQueue[int]) -> AskedErrand:
    errands.ask(errand)
    told.get(timeout=PATIENCE)
    return errand


def test_an_answer_comes_after_what_was_told(errands: Errands) -> None:
    told: queue.SimpleQueue[int] = queue.SimpleQueue()
    errand = errands.ask(AskedErrand(seven, told.put))
    assert errand.result(PATIENCE) == 7
    assert (told.get_nowait(), errand.is_done) == (3, True)


def test_a_refusal_comes_as_itself(errands: Errands) -> None:
    with pytest.raises(InputError, match="There is no errand"):
        errands.ask(AskedErrand(refused)).result(PATIENCE)


def test_a_bug_is_named_and_the_process_goes_on(errands: Errands) -> None:
    assert works(errands)
    before = errands.process_id
    with pytest.raises(StateError, match=r"ZeroDivisionError.*this is a bug"):
        errands.ask(AskedErrand(broken)).result(PATIENCE)
    assert works(errands)
    assert errands.process_id == before


def test_what_is_cancelled_makes_room_for_the_next(errands: Errands) -> None:
    told: queue.SimpleQueue[int] = queue.SimpleQueue()
    first = begun(errands, AskedErrand(cancelled, told.put), told)
    waiting, last = errands.ask(AskedErrand(endless)), errands.ask(AskedErrand(seven))
    waiting.cancel()
    first.cancel()
    with pytest.raises(SimulationCancelledError, match="The errand was cancelled"):
        first.result(PATIENCE)
    assert (waiting.result(PATIENCE), last.result(PATIENCE)) == (-1, 7)


def test_nothing_is_told_after_a_cancel(errands: Errands) -> None:
    told: list[int] = []

    def listen(known: int) -> None:
        told.append(known)
        errand.cancel()

    errand = AskedErrand(endless, listen)
    assert errands.ask(errand).result(PATIENCE) >= 0
    assert told == [0]


def test_a_process_that_does_not_end_when_asked_is_replaced(errands: Errands) -> None:
    told: queue.SimpleQueue[int] = queue.SimpleQueue()
    errand = begun(errands, HastyErrand(deaf, told.put), told)
    before = errands.process_id
    errand.cancel()
    assert errand.result(PATIENCE) == -1
    assert works(errands)
    assert errands.process_id != before


def test_a_process_that_answers_too_late_is_replaced(errands: Errands) -> None:
    assert works(errands)
    before = errands.process_id
    with pytest.raises(StateError, match=r"errand runner gave no sign of life for 0 s and was ended\. Try"):
        errands.ask(ShortErrand(silent)).result(PATIENCE)
    assert works(errands)
    assert errands.process_id != before


def test_a_question_outlives_one_death_of_its_process(errands: Errands) -> None:
    told: queue.SimpleQueue[int] = queue.SimpleQueue()
    errand = begun(errands, AskedErrand(endless, told.put), told)
    first = kill(errands)
    while told.get(timeout=PATIENCE) > 0 or errands.process_id in (None, first):
        pass
    errand.cancel()
    assert errand.result(PATIENCE) >= 0


def test_the_second_death_is_told_and_the_next_question_answered(errands: Errands) -> None:
    told: queue.SimpleQueue[int] = queue.SimpleQueue()
    errand = errands.ask(AskedErrand(endless, told.put))
    killed: set[int] = set()
    while len(killed) < 2:
        told.get(timeout=PATIENCE)
        if errands.process_id is not None and errands.process_id not in killed:
            killed.add(kill(errands))
    with pytest.raises(StateError, match="ended twice"):
        errand.result(PATIENCE)
    assert works(errands)


def test_a_listener_that_fails_ends_its_own_question_only(errands: Errands) -> None:
    def fails(known: int) -> None:
        raise ValueError("not heard")

    with pytest.raises(StateError, match="not heard"):
        errands.ask(AskedErrand(endless, fails)).result(PATIENCE)
    assert works(errands)


def test_a_closed_service_says_so() -> None:
    service = Errands()
    told: queue.SimpleQueue[int] = queue.SimpleQueue()
    running = begun(service, AskedErrand(endless, told.put), told)
    waiting = service.ask(AskedErrand(seven))
    service.close()
    for refused_one in (running, waiting, service.ask(AskedErrand(seven))):
        with pytest.raises(StateError, match="closing"):
            refused_one.result(PATIENCE)
    assert service.process_id is None


def kill(errands: Errands) -> int:
    number = errands.process_id
    assert number is not None
    os.kill(number, signal.SIGKILL)
    return number
