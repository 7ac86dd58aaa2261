"""Searches for patterns, in a process of their own."""

from collections.abc import Callable

from core.patterns.problem import PatternProblem, PatternProgress, PatternResult, PatternStatus
from solver_jobs.workers.pattern_worker import Find, run_pattern_worker
from solver_jobs.workers.task_service import Task, TaskService

EXPLAIN_SECONDS = 30.0
"""How much longer than its limit a search may take, since a conflict is explained after it is proven."""


class PatternSearch(Task[Find, PatternProgress, PatternResult]):
    """A search that was asked for; one that is ended answers with what was last known.

    Args:
        find: what is sought.
        progress: told what is known, at most every 50 ms, from a thread of the solver's.
    """

    def __init__(self, find: Find, progress: Callable[[PatternProgress], object]) -> None:
        super().__init__(find, progress)
        self.is_cancelled = False
        self._known: PatternProgress | None = None

    def use_now(self) -> None:
        """Ends the search with the best pattern yet."""
        self.is_ending = True

    def cancel(self) -> None:
        """Ends the search; nothing of it is used."""
        self.is_cancelled = True
        super().cancel()

    def latest(self, begun: float, heard: float) -> float:
        """When the process is ended: a while after the time limit."""
        return begun + self.task.seconds + EXPLAIN_SECONDS

    def tell(self, known: PatternProgress) -> None:
        """Passes on what is known."""
        self._known = known
        super().tell(known)

    def answer(self, result: PatternResult) -> None:
        """Ends the wait; what was cancelled has no patterns."""
        if self.is_cancelled:
            result = PatternResult(PatternStatus.CANCELLED, (), result.bound, result.solve_seconds)
        super().answer(result)

    def hung(self, sentence: str, seconds: float) -> PatternResult:
        """The best pattern that was known.

        Raises:
            StateError: none was.
        """
        if self._known is None or self._known.pattern is None:
            return super().hung(sentence, seconds)
        return self.unanswered(seconds)

    def unanswered(self, seconds: float) -> PatternResult:
        """An answer out of what was last known."""
        known = self._known
        bound = None if known is None else known.bound
        if known is None or known.pattern is None:
            return PatternResult(PatternStatus.CANCELLED, (), bound, seconds)
        return PatternResult(PatternStatus.FEASIBLE, (known.pattern,), bound, seconds)


class PatternSolver(TaskService[PatternSearch]):
    """Searches in a process of their own, one after the other; it is started anew where it ends.

    Args:
        warm_up: a problem that is solved ahead; None for a small one.
    """

    def __init__(self, warm_up: PatternProblem | None = None) -> None:
        super().__init__("pattern solver", run_pattern_worker, warm_up)

    def submit(
        self,
        problem: PatternProblem,
        *,
        count: int = 1,
        seconds: float = 30.0,
        progress: Callable[[PatternProgress], object] = lambda known: None,
    ) -> PatternSearch:
        """Begins a search, after those that were asked for before.

        Args:
            problem: what is sought.
            count: how many different patterns, the best first.
            seconds: longest search.
            progress: told what is known, at most every 50 ms, from a thread of the solver's.
        """
        return self.ask(PatternSearch(Find(problem, count, seconds), progress))

    def solve(self, problem: PatternProblem, *, count: int = 1, seconds: float = 30.0) -> PatternResult:
        """Searches and waits for the answer (see `submit`, and `PatternSearch.result`)."""
        return self.submit(problem, count=count, seconds=seconds).result()
