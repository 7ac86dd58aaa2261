"""One problem in the solver's hands: start, attempts, the course of iterations."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from core.arrays import Floats
from core.trajectory import Trajectory
from solver_jobs.constraint import Box, Situation
from solver_jobs.costs import COST_SCALE
from solver_jobs.diagnosis import Shortfall, shortfalls
from solver_jobs.results import Iterate
from solver_jobs.structure import Structure
from solver_jobs.variables import parameter_values, trajectory_of_vector, unpacked, vector_of_trajectory

Progress = Callable[[Iterate], bool]
"""Is told of each iteration; false cancels."""


@dataclass(frozen=True, eq=False)
class Attempt:
    """One run of IPOPT.

    Args:
        word: IPOPT's return status.
        vector: the unknowns at its end.
        cost: of these, SI.
        missed: demands that they miss notably, the worst first.
    """

    word: str
    vector: Floats
    cost: float
    missed: tuple[Shortfall, ...]


class Search:
    """Runs IPOPT on one problem, once or several times, and keeps the course.

    Args:
        situation: the problem.
        initial: the drawing to start from.
        box: bounds of every unknown.
        progress: told of each iteration.
    """

    def __init__(self, situation: Situation, initial: Trajectory, box: Box, progress: Progress) -> None:
        self._situation = situation
        self._initial = initial
        self._progress = progress
        self._parameters = parameter_values(situation.problem, situation.successor)
        self._lower, self._upper = box.lower.packed(), box.upper.packed()
        # Within the bounds from the first, so that what is fixed is exact.
        self.start = np.clip(vector_of_trajectory(initial).packed(), self._lower, self._upper)
        self.iterates: list[Iterate] = []
        self.seconds = 0.0

    def broken_constants(self, structure: Structure) -> tuple[Shortfall, ...]:
        """What the fixed unknowns alone decide, and break."""
        values = self._rows(structure, self.start)
        constant = structure.constant_rows(self._upper > self._lower)
        lower, upper = structure.row_bounds(self._situation)
        return shortfalls(
            structure, self._situation, np.where(constant, values, np.clip(values, lower, upper))
        )

    def attempt(self, structure: Structure, start: Floats) -> Attempt:
        """Runs IPOPT from a start."""
        free = np.zeros(structure.misses)
        row_lower, row_upper = structure.row_bounds(self._situation)
        monitor = structure.monitor
        monitor.error = None
        monitor.listener = lambda vector, figures: self._note(structure, vector, figures)
        begin = time.perf_counter()
        try:
            answer = structure.solver(
                x0=np.concatenate([start, free]),
                p=self._parameters,
                lbx=np.concatenate([self._lower, free]),
                ubx=np.concatenate([self._upper, free + np.inf]),
                lbg=row_lower,
                ubg=row_upper,
            )
        finally:
            monitor.listener = None
            self.seconds += time.perf_counter() - begin
        if monitor.error is not None:
            raise monitor.error
        vector = np.array(answer["x"]).reshape(-1)[: len(self.start)]
        missed = shortfalls(structure, self._situation, self._rows(structure, vector))
        word = str(structure.solver.stats()["return_status"])
        return Attempt(word, vector, self._cost(structure, vector), missed)

    def trajectory(self, attempt: Attempt) -> Trajectory:
        """The motion at the end of an attempt."""
        problem = self._situation.problem
        motion = unpacked(attempt.vector, problem.knot_count, problem.model.leg_count)
        return trajectory_of_vector(motion, self._initial)

    def _note(self, structure: Structure, vector: Floats, figures: dict[str, float]) -> bool:
        iterate = Iterate(
            number=len(self.iterates),
            objective=self._cost(structure, vector[: len(self.start)]),
            primal_infeasibility=figures["inf_pr"],
            dual_infeasibility=figures["inf_du"],
            step=figures["alpha_pr"],
        )
        self.iterates.append(iterate)
        return self._progress(iterate)

    def _cost(self, structure: Structure, vector: Floats) -> float:
        return float(structure.cost(vector, self._parameters)) / COST_SCALE

    def _rows(self, structure: Structure, vector: Floats) -> Floats:
        return np.array(structure.rows(vector, self._parameters)).reshape(-1)
