"""The exact tier: the whole motion as one nonlinear programme, solved by IPOPT."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from core.arrays import Floats
from core.draft import initial_motion
from core.motion_problem import MotionProblem
from core.trajectory import Trajectory
from solver_jobs.constraint import Situation, situation_of
from solver_jobs.costs import COST_SCALE
from solver_jobs.diagnosis import explanation, shortfalls
from solver_jobs.obstacles import obstacles, violated_constants
from solver_jobs.results import Evidence, Iterate, MotionResult, SolveStatus
from solver_jobs.structure import Structure, StructureCache, box_of
from solver_jobs.variables import parameter_values, trajectory_of_vector, unpacked, vector_of_trajectory

Progress = Callable[[Iterate], bool]
"""Is told of each iteration; false cancels."""

STATUS_OF_WORD = {
    "Solve_Succeeded": SolveStatus.SOLVED,
    "Infeasible_Problem_Detected": SolveStatus.INFEASIBLE,
    "User_Requested_Stop": SolveStatus.CANCELLED,
}
"""IPOPT's words that are not a failure."""

_structures = StructureCache()


def solve_motion(problem: MotionProblem, progress: Progress = lambda iterate: True) -> MotionResult:
    """Solves a motion problem; not for several threads at once.

    Args:
        problem: what is asked.
        progress: told of each iteration in the calling thread.

    Returns:
        The result; solved only where IPOPT says Solve_Succeeded.
    """
    situation = situation_of(problem)
    initial = initial_motion(problem)
    box = box_of(situation)
    blocking = obstacles(situation, box)
    if blocking:
        return _ruled_out(blocking, initial, 0.0)
    structure, build_seconds = _structures.get(problem)
    run = _Run(structure, situation, initial, box.lower.packed(), box.upper.packed(), progress)
    blocking = run.broken_constants()
    if blocking:
        return _ruled_out(blocking, initial, build_seconds)
    return run.solve(build_seconds)


def _ruled_out(sentences: tuple[str, ...], initial: Trajectory, build_seconds: float) -> MotionResult:
    closing = "This is proven: no motion of the model can do it."
    return MotionResult(
        status=SolveStatus.INFEASIBLE,
        solver_word="",
        explanation=(*sentences, closing),
        evidence=Evidence.PROVEN,
        iterations=(),
        objective=None,
        solve_seconds=0.0,
        build_seconds=build_seconds,
        trajectory=initial,
        initial=initial,
    )


@dataclass(eq=False)
class _Run:
    """One solve over a structure."""

    structure: Structure
    situation: Situation
    initial: Trajectory
    lower: Floats
    upper: Floats
    progress: Progress
    iterates: list[Iterate] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.parameters = parameter_values(self.situation.problem, self.situation.successor)
        # A start at the fixed values makes the fixed rows exact.
        self.start = np.clip(vector_of_trajectory(self.initial).packed(), self.lower, self.upper)
        self.row_lower, self.row_upper = self.structure.row_bounds(self.situation)

    def broken_constants(self) -> tuple[str, ...]:
        """Sentences for rows that the fixed unknowns alone decide, and break."""
        values = np.array(self.structure.rows(self.start, self.parameters)).reshape(-1)
        constant = self.structure.constant_rows(self.upper > self.lower)
        held = np.where(constant, values, np.clip(values, self.row_lower, self.row_upper))
        found = shortfalls(self.structure, self.situation, held)
        return tuple(violated_constants(one.family, one.knots, one.amount, one.unit) for one in found)

    def solve(self, build_seconds: float) -> MotionResult:
        """Runs IPOPT and reads its answer."""
        monitor = self.structure.monitor
        monitor.listener, monitor.error = self._note, None
        begin = time.perf_counter()
        try:
            answer = self.structure.solver(
                x0=self.start,
                p=self.parameters,
                lbx=self.lower,
                ubx=self.upper,
                lbg=self.row_lower,
                ubg=self.row_upper,
            )
        finally:
            monitor.listener = None
        seconds = time.perf_counter() - begin
        if monitor.error is not None:
            raise monitor.error
        return self._result(np.array(answer["x"]).reshape(-1), seconds, build_seconds)

    def _note(self, vector: Floats, figures: dict[str, float]) -> bool:
        iterate = Iterate(
            number=len(self.iterates),
            objective=self._cost(vector),
            primal_infeasibility=figures["inf_pr"],
            dual_infeasibility=figures["inf_du"],
            step=figures["alpha_pr"],
        )
        self.iterates.append(iterate)
        return self.progress(iterate)

    def _cost(self, vector: Floats) -> float:
        return float(self.structure.cost(vector, self.parameters)) / COST_SCALE

    def _result(self, vector: Floats, seconds: float, build_seconds: float) -> MotionResult:
        word = str(self.structure.solver.stats()["return_status"])
        status = STATUS_OF_WORD.get(word, SolveStatus.FAILED)
        sentences: tuple[str, ...] = ()
        if status in (SolveStatus.INFEASIBLE, SolveStatus.FAILED):
            rows = np.array(self.structure.rows(vector, self.parameters)).reshape(-1)
            sentences = explanation(shortfalls(self.structure, self.situation, rows))
        elif status is SolveStatus.CANCELLED:
            sentences = (f"Cancelled after {self.iterates[-1].number} iterations.",)
        problem = self.situation.problem
        motion = unpacked(vector, problem.knot_count, problem.model.leg_count)
        return MotionResult(
            status=status,
            solver_word=word,
            explanation=sentences,
            evidence=Evidence.DIAGNOSED if status in (SolveStatus.INFEASIBLE, SolveStatus.FAILED) else None,
            iterations=tuple(self.iterates),
            objective=self._cost(vector),
            solve_seconds=seconds,
            build_seconds=build_seconds,
            trajectory=trajectory_of_vector(motion, self.initial),
            initial=self.initial,
        )
