"""The simulator's process: answers, progress, an end when asked, and a new one where it dies."""

from __future__ import annotations

import os
import queue
import signal
from collections.abc import Iterator
from functools import cache

import numpy as np
import pytest

from core.errors import InputError, SimulationCancelledError, StateError
from core.physics.problem import SimulationProblem
from core.robot import load_robot
from solver_jobs import Simulator, simulate, simulate_variations
from tests.solver_jobs.physics.rigs import SCALES, problem_of_strokes, resting

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


def test_one_that_dies_twice_is_told_and_the_next_one_works(simulator: Simulator) -> None:
    told = heard()
    simulation = simulator.submit(long(), progress=told.put)
    killed: set[int] = set()
    while not simulation.is_done and len(killed) < 2:
        told.get(timeout=PATIENCE)
        now = simulator.process_id
        if now is not None and now not in killed:
            os.kill(now, signal.SIGKILL)
            killed.add(now)
    with pytest.raises(StateError, match="ended twice"):
        simulation.result(PATIENCE)
    assert np.isfinite(simulator.submit(SHORT).result(PATIENCE).motion.body_world).all()


def test_a_listener_that_fails_ends_its_own_simulation_only(simulator: Simulator) -> None:
    def fails(share: float) -> None:
        raise ValueError("not heard")

    with pytest.raises(StateError, match="not heard"):
        simulator.submit(long(), progress=fails).result(PATIENCE)
    assert simulator.submit(SHORT).result(PATIENCE).runs == ()


def test_a_closed_simulator_says_so() -> None:
    made = Simulator()
    simulation = made.submit(long())
    made.close()
    for refused in (simulation, made.submit(SHORT)):
        with pytest.raises(StateError, match="closing"):
            refused.result(PATIENCE)
    assert made.process_id is None
