"""Simulated travels of gaits, in the process of their own."""

from __future__ import annotations

from dataclasses import replace

import pytest

from core.errors import SimulationCancelledError
from core.identification.learning import Walk
from core.physics.parameters import physics_set
from core.trials.displacement import Displacement, MeasuredWalk
from solver_jobs import BatchSimulator
from solver_jobs.workers.batch_simulation_worker import walked
from tests.support.solvers.rigs import problem_of_strokes, resting

USUAL = physics_set("scales")
MEASURED = MeasuredWalk("made", "made", 0.01, Displacement(0.01, 0.0), 1)


def lift_and_stand() -> Walk:
    strokes = resting(4)
    strokes[1:3, 0] -= 0.003
    return Walk(MEASURED, problem_of_strokes(strokes), 2, 0.0)


def falling() -> Walk:
    """Two feet side by side are pulled up."""
    strokes = resting(3)
    strokes[1:, :2] -= 0.0075
    return Walk(MEASURED, problem_of_strokes(strokes), 1, 0.0)


def test_a_process_of_its_own_answers_as_this_one_does() -> None:
    walk, soft = lift_and_stand(), replace(USUAL, link_stiffness=2000.0)
    simulator = BatchSimulator()
    try:
        first, second = simulator.submit(walk, (USUAL, soft)).result(120)
    finally:
        simulator.close()
    assert first == walked(walk, USUAL)
    assert first != second
    assert second is not None


def test_a_simulation_that_is_not_wanted_any_more_ends() -> None:
    with pytest.raises(SimulationCancelledError):
        walked(lift_and_stand(), USUAL, lambda share: False)


def test_a_robot_that_falls_has_no_travel() -> None:
    assert walked(falling(), replace(USUAL, centre_offset=(0.05, 0.05))) is None
