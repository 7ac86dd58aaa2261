"""Looks for the fastest among several pose gaits, in as many processes as there are cores."""

import os
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from contextlib import suppress
from dataclasses import dataclass
from queue import Empty, SimpleQueue

from core.pose_gaits.pace import pace_rank
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import PoseProblem
from solver_jobs.results.motion import SolveStatus
from solver_jobs.results.pose import PoseResult
from solver_jobs.workers.pose_service import PoseGaitSolver
from solver_jobs.workers.spawning import NICENESS

MOST_PROCESSES = 8
CANCELLED = "The search was cancelled."
TICK_SECONDS = 0.1
"""Between two looks whether the search is to end."""


@dataclass(frozen=True, eq=False)
class TriedGait:
    """A problem of a search and its result.

    Args:
        problem: what was asked.
        result: the outcome; cancelled where the search ended before.
    """

    problem: PoseProblem
    result: PoseResult

    @property
    def pace(self) -> float:
        """Speed, on the spot turn a second, to compare it by; below 0 where there is no gait."""
        return -1.0 if self.result.gait is None else self.result.gait.pace


@dataclass(frozen=True, eq=False)
class SearchStep:
    """How far a search is.

    Args:
        done: problems that are answered.
        count: all of its problems.
        number: place of the newest answer among the problems, counted from 0.
        newest: that answer.
        fastest: the fastest gait yet; None where there is none.
    """

    done: int
    count: int
    number: int
    newest: TriedGait
    fastest: TriedGait | None


class FastestSearch:
    """Processes that solve several problems at a time. Thread-safe: calls of `solve` share the processes.

    Args:
        processes: how many; None for one a core.
        niceness: of the processes; 0 where somebody waits for nothing else.
    """

    def __init__(self, processes: int | None = None, niceness: int = NICENESS) -> None:
        self._count = processes or min(os.cpu_count() or 1, MOST_PROCESSES)
        self._solvers = [PoseGaitSolver(niceness) for _ in range(self._count)]
        self._idle: SimpleQueue[PoseGaitSolver] = SimpleQueue()
        for solver in self._solvers:
            self._idle.put(solver)
        self._ending = threading.Event()

    def solve(
        self,
        problems: Sequence[PoseProblem],
        report: Callable[[SearchStep], object] = lambda step: None,
        near: Sequence[PoseGait | None] = (),
        ending: threading.Event | None = None,
    ) -> list[TriedGait]:
        """Solves every problem; the answers stand in the order of the problems.

        Args:
            problems: what is asked.
            report: told after each answer, from this thread.
            near: for each problem poses to begin with, or None; empty for none at all.
            ending: set by another thread to cancel what is not answered yet.

        Raises:
            StateError: a process ended twice.
        """
        known = list(near) or [None] * len(problems)
        ending = ending or threading.Event()
        tried: dict[int, TriedGait] = {}
        with ThreadPoolExecutor(self._count) as pool:
            try:
                numbers = {
                    pool.submit(self._one, problem, known[number], ending): number
                    for number, problem in enumerate(problems)
                }
                for answered in as_completed(numbers):
                    number = numbers[answered]
                    newest = tried[number] = TriedGait(problems[number], answered.result())
                    fastest = fastest_of([tried[place] for place in sorted(tried)])
                    report(SearchStep(len(tried), len(problems), number, newest, fastest))
            except BaseException:
                ending.set()
                raise
        return [tried[number] for number in range(len(problems))]

    def _one(self, problem: PoseProblem, near: PoseGait | None, ending: threading.Event) -> PoseResult:
        solver = None
        while solver is None:
            if ending.is_set() or self._ending.is_set():
                return PoseResult(SolveStatus.CANCELLED, None, None, False, (CANCELLED,), 0.0, 0.0)
            with suppress(Empty):
                solver = self._idle.get(timeout=TICK_SECONDS)
        try:
            search = solver.submit(problem, near=near, explain=False)
            while True:
                with suppress(TimeoutError):
                    return search.result(TICK_SECONDS)
                if ending.is_set() or self._ending.is_set():
                    search.cancel()
        finally:
            self._idle.put(solver)

    def cancel(self) -> None:
        """Ends the search for good; what is known by then is its answer."""
        self._ending.set()

    def close(self) -> None:
        """Ends the processes."""
        self.cancel()
        for solver in self._solvers:
            solver.close()


def fastest_of(tried: Sequence[TriedGait]) -> TriedGait | None:
    """The fastest gait that was found; None where there is none."""
    best = min(tried, key=lambda one: pace_rank(one.pace), default=None)
    return best if best is not None and best.result.gait is not None else None
