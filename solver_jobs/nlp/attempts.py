"""Attempts to solve one problem: starting points, solver calls, iterates."""

import time
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from core.arrays import Floats
from core.motion.trajectory import Trajectory
from solver_jobs.nlp.assembly import asked_families
from solver_jobs.nlp.compiled_problem import CompiledProblem, Ipopt
from solver_jobs.nlp.constraint import Box, Family, Situation
from solver_jobs.nlp.costs import COST_SCALE
from solver_jobs.nlp.diagnosis import Shortfall, shortfalls
from solver_jobs.nlp.variables import (
    forces_of_slopes,
    parameter_values,
    slopes_of_forces,
    trajectory_of_vector,
    unpacked,
    vector_of_trajectory,
)
from solver_jobs.results.motion import Iterate

Progress = Callable[[Iterate], bool]
"""Is told of each iteration; false cancels."""


@dataclass(frozen=True, eq=False)
class Point:
    """Where IPOPT starts or has ended.

    Args:
        vector: the unknowns in the solver's scale.
        bound_multipliers: of each unknown's bounds, or None where unknown.
        row_multipliers: of each row, or None where unknown.
    """

    vector: Floats
    bound_multipliers: Floats | None = None
    row_multipliers: Floats | None = None


@dataclass(frozen=True, eq=False)
class Attempt:
    """One run of IPOPT.

    Args:
        word: IPOPT's return status.
        begin: where it started.
        end: where it ended.
        cost: of the end, SI.
        missed: demands that the end misses notably, the worst first.
    """

    word: str
    begin: Point
    end: Point
    cost: float
    missed: tuple[Shortfall, ...]


class Attempts:
    """Runs IPOPT on one problem, once or several times, and keeps the course.

    Args:
        situation: the problem.
        initial: the drawing to start from.
        box: bounds of every unknown.
        progress: told of each iteration.
        shift: by how many feet the problem was handed back to stand in direction 1.
    """

    def __init__(
        self, situation: Situation, initial: Trajectory, box: Box, progress: Progress, shift: int = 0
    ) -> None:
        self._situation = situation
        self._initial = initial
        self._progress = progress
        self._shift = shift
        self._slopes = Family.FRICTION in asked_families(situation.problem)
        self.parameters = parameter_values(situation.problem, situation.successor)
        self.lower, self.upper = box.lower.packed(), box.upper.packed()
        self._vectors: list[Floats] = []
        self.drawing = self.point(initial)
        self.iterates: list[Iterate] = []
        self.seconds = 0.0

    def point(self, motion: Trajectory) -> Point:
        """A motion as a start: within the bounds from the first, so that what is fixed is exact.

        Raises:
            ValueError: it lacks velocities or forces.
        """
        vector = vector_of_trajectory(motion)
        packed = (slopes_of_forces(vector) if self._slopes else vector).packed()
        return Point(np.clip(packed, self.lower, self.upper))

    def broken_constants(self, compiled: CompiledProblem) -> tuple[Shortfall, ...]:
        """Violations that the fixed unknowns cause by themselves, whatever the free ones are."""
        values = self._rows(compiled, self.drawing.vector)
        constant = compiled.constant_rows(self.upper > self.lower)
        lower, upper = compiled.row_bounds(self._situation)
        values = np.where(constant, values, np.clip(values, lower, upper))
        return shortfalls(compiled, self._situation, values, self._shift)

    def attempt(self, compiled: CompiledProblem, start: Point, solver: Ipopt | None = None) -> Attempt:
        """Runs IPOPT from a start.

        Args:
            compiled: the problem's shape.
            start: with multipliers for a solver that goes on from them.
            solver: another one than the structure's own.
        """
        function, monitor = solver or compiled.solver
        row_lower, row_upper = compiled.row_bounds(self._situation)
        vector = np.clip(start.vector, self.lower, self.upper)
        misses = compiled.misses_of(self._rows(compiled, vector), row_lower, row_upper)
        none = np.zeros_like(misses)
        known = {"lam_x0": start.bound_multipliers, "lam_g0": start.row_multipliers}
        monitor.error = None
        monitor.listener = lambda now, figures: self._note(compiled, now, figures)
        begin = time.perf_counter()
        try:
            answer = function(
                x0=np.concatenate([vector, misses]),
                p=self.parameters,
                lbx=np.concatenate([self.lower, none]),
                ubx=np.concatenate([self.upper, none + np.inf]),
                lbg=row_lower,
                ubg=row_upper,
                **{name: values for name, values in known.items() if values is not None},
            )
        finally:
            monitor.listener = None
            self.seconds += time.perf_counter() - begin
        if monitor.error is not None:
            raise monitor.error
        found, bounds, rows = (np.array(answer[name]).reshape(-1) for name in ("x", "lam_x", "lam_g"))
        end = Point(found[: len(vector)], bounds[: len(vector)], rows)
        missed = shortfalls(compiled, self._situation, self._rows(compiled, end.vector), self._shift)
        word = str(function.stats()["return_status"])
        return Attempt(word, replace(start, vector=vector), end, self._cost(compiled, end.vector), missed)

    def trajectory(self, vector: Floats) -> Trajectory:
        """The motion of these unknowns."""
        problem = self._situation.problem
        motion = unpacked(vector, problem.knot_count, problem.model.leg_count)
        return trajectory_of_vector(forces_of_slopes(motion) if self._slopes else motion, self._initial)

    def iterate_motions(self) -> tuple[Trajectory, ...]:
        """The motion at each of `iterates`."""
        return tuple(self.trajectory(vector) for vector in self._vectors)

    def _note(self, compiled: CompiledProblem, vector: Floats, figures: dict[str, float]) -> bool:
        motion = vector[: len(self.drawing.vector)]
        iterate = Iterate(
            number=len(self.iterates),
            objective=self._cost(compiled, motion),
            primal_infeasibility=figures["inf_pr"],
            dual_infeasibility=figures["inf_du"],
            step=figures["alpha_pr"],
        )
        self.iterates.append(iterate)
        self._vectors.append(motion)
        return self._progress(iterate)

    def _cost(self, compiled: CompiledProblem, vector: Floats) -> float:
        return float(compiled.cost(vector, self.parameters)) / COST_SCALE

    def _rows(self, compiled: CompiledProblem, vector: Floats) -> Floats:
        return np.array(compiled.rows(vector, self.parameters)).reshape(-1)
