"""Callbacks of a running search: what is known every 50 ms, and a way to stop it."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from types import TracebackType

from ortools.sat.python.cp_model import CpModel, CpSolver, CpSolverSolutionCallback, CpSolverStatus

from core.patterns.check import weighted_sum
from core.patterns.problem import Pattern, PatternProblem, PatternProgress
from core.running_time import RunningClock

TICK_SECONDS = 0.05
"""A listener is told no more often."""

SEED = 5
"""One worker with this seed answers the same way each time."""


class SearchMonitor:
    """Runs solvers one after the other under one listener and one time limit.

    Args:
        problem: for the weights.
        seconds: longest search; nothing is stopped by the clock before.
        progress: told every 50 ms, from a thread of its own; false stops the search.
    """

    def __init__(
        self, problem: PatternProblem, seconds: float, progress: Callable[[PatternProgress], bool]
    ) -> None:
        self.bound = 0.0
        self.best: Pattern | None = None
        self._problem = problem
        self._progress = progress
        self._running = RunningClock(time.monotonic)
        self._seconds = seconds
        self._solver: CpSolver | None = None
        self._stopped = False
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._tell, name="pattern-progress", daemon=True)

    def __enter__(self) -> SearchMonitor:
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._ended.set()
        self._thread.join()

    @property
    def elapsed(self) -> float:
        """Since the start, as far as the program ran, s."""
        return self._running()

    @property
    def is_over(self) -> bool:
        """Whether the listener or the clock has ended the search."""
        return self._stopped or self.elapsed >= self._seconds

    def offer(self, pattern: Pattern) -> None:
        """Keeps a pattern where it is the best yet."""
        if self.best is None or weighted_sum(self._problem, pattern) < weighted_sum(self._problem, self.best):
            self.best = pattern

    def solve(
        self,
        model: CpModel,
        callback: CpSolverSolutionCallback | None = None,
        *,
        linear: int = 2,
        bounded: Callable[[float], None] | None = None,
    ) -> tuple[CpSolverStatus, CpSolver]:
        """Solves a model with one worker and a fixed seed, within the time that is left.

        Args:
            model: what to solve.
            callback: told of each better solution.
            linear: how much linear programs help, 0 to 2; where lengths are compared they do.
            bounded: told of each better bound of this model.
        """
        solver = CpSolver()
        solver.parameters.num_workers = 1
        solver.parameters.random_seed = SEED
        solver.parameters.catch_sigint_signal = False
        solver.parameters.linearization_level = linear
        solver.best_bound_callback = bounded
        self._solver = solver
        status = solver.solve(model, callback)
        self._solver = None
        return status, solver

    def _tell(self) -> None:
        while not self._ended.wait(TICK_SECONDS):
            self._running.look()
            best = self.best
            objective = None if best is None else float(weighted_sum(self._problem, best))
            bound = self.bound if objective is None else min(self.bound, objective)
            if not self._progress(PatternProgress(self.elapsed, objective, bound, best)):
                self._stopped = True
            solver = self._solver
            if self.is_over and solver is not None:
                solver.stop_search()
