"""The simulator's process: answers, progress, refusals, and an end when asked.

What every process does that answers questions is in `test_questions`.
"""

from __future__ import annotations

import queue
from collections.abc import Iterator
from functools import cache

import pytest

from core.errors import InputError, SimulationCancelledError
from core.physics.problem import SimulationProblem
from core.robot.model import load_robot
from solver_jobs import Simulator, simulate, simulate_variations
from tests.support.solvers.rigs import SCALES, problem_of_strokes, resting

PATIENCE = 120.0
"""Longest wait for anything, s."""

SHORT = problem_of_strokes(resting(3))


@cache
def long() -> SimulationProblem:
    """A quarter of an hour of robot time: it ends only where it is ended."""
    return problem_of_strokes(resting(3000))


@pytest.fixture(scope="module")
def simulator() -> Iterator[Simulator]:
    made = Simulator()
    yield made
    made.close()


def heard() -> queue.SimpleQueue[float]:
    return queue.SimpleQueue()


def test_it_answers_as_the_functions_do(simulator: Simulator) -> None:
    told = heard()
    answer = simulator.submit(SHORT, 2, seed=3, progress=told.put).result(PATIENCE)
    assert answer.motion.feet_world.tobytes() == simulate(SHORT).feet_world.tobytes()
    assert answer.runs == simulate_variations(SHORT, 2, 3)
    shares = [told.get(timeout=PATIENCE)]
    while not told.empty():
        shares.append(told.get())
    assert shares == sorted(shares)
    assert shares[-1] == 1.0


def test_a_refusal_comes_as_itself(simulator: Simulator) -> None:
    model = load_robot("hexapod")
    never_weighed = problem_of_strokes(resting(model=model), model=model, physics=SCALES)
    with pytest.raises(InputError, match="no masses"):
        simulator.submit(never_weighed).result(PATIENCE)


def test_a_cancelled_simulation_makes_room_for_the_next(simulator: Simulator) -> None:
    told = heard()
    first = simulator.submit(long(), progress=told.put)
    waiting, last = simulator.submit(long()), simulator.submit(SHORT)
    told.get(timeout=PATIENCE)
    waiting.cancel()
    first.cancel()
    for cancelled in (first, waiting):
        with pytest.raises(SimulationCancelledError):
            cancelled.result(PATIENCE)
    assert last.result(PATIENCE).motion.ended_early == ""
