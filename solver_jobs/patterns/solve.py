"""The best patterns of a problem, by the number of their events, the most promising number first."""

import heapq
import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace

from ortools.sat.python.cp_model import INFEASIBLE, OPTIMAL, CpSolverSolutionCallback

from core.errors import InputError
from core.patterns.check import scored, weighted_sum
from core.patterns.problem import Pattern, PatternProblem, PatternProgress, PatternResult, PatternStatus
from solver_jobs.patterns.bounds import event_counts, floor_of, row_floors
from solver_jobs.patterns.callbacks import SearchMonitor
from solver_jobs.patterns.event_rules import ruled_model
from solver_jobs.patterns.events import EventModel, forbid
from solver_jobs.patterns.explain import explained
from solver_jobs.patterns.extract import read_pattern, read_samples
from solver_jobs.patterns.model import build_model

MOST_PATTERNS = 50
"""How many different patterns may be asked for."""

PATIENCE = 3
"""After so many numbers of events without a pattern, it is asked whether there is any."""

FEW_LIMBS = 8
"""Up to so many walking limbs a search with a drawing is quicker without linear programs."""


def solve_pattern(
    problem: PatternProblem,
    *,
    count: int = 1,
    seconds: float = 30.0,
    progress: Callable[[PatternProgress], bool] = lambda known: True,
) -> PatternResult:
    """The best patterns of a problem, or why there is none (see `best_patterns`)."""
    return explained(problem, best_patterns(problem, count=count, seconds=seconds, progress=progress))


def best_patterns(
    problem: PatternProblem,
    *,
    count: int = 1,
    seconds: float = 30.0,
    progress: Callable[[PatternProgress], bool] = lambda known: True,
) -> PatternResult:
    """The best patterns of a problem, in this process; the same each time where the clock does not end it.

    Args:
        problem: what is sought.
        count: how many different patterns, the best first; rotations of a gait that nothing pins are one.
        seconds: longest search.
        progress: told every 50 ms from a thread of its own; false ends the search with what is known.

    Raises:
        InputError: a number is out of range.
    """
    if not 1 <= count <= MOST_PATTERNS:
        raise InputError(f"{count} patterns were asked for; ask for 1 to {MOST_PATTERNS}.", "count")
    if not 0.001 <= seconds <= 3600:
        raise InputError(f"The time limit is {seconds:g} s; it must lie between 0.001 and 3600 s.", "seconds")
    with SearchMonitor(problem, seconds, progress) as monitor:
        return _Search(problem, monitor).run(count)


@dataclass(order=True)
class _Entry:
    """What is known of one number of events: its next pattern, or that none is cheaper."""

    cost: int
    is_bound: bool
    events: int
    model: EventModel | None = field(default=None, compare=False)
    pattern: Pattern | None = field(default=None, compare=False)


class _Search:
    """Best first: a number of events waits under its lower bound until it is worth a proof."""

    def __init__(self, problem: PatternProblem, monitor: SearchMonitor) -> None:
        self._problem = problem
        self._monitor = monitor
        self._floors = row_floors(problem)
        self._heap = [
            _Entry(floor_of(problem, events, self._floors), True, events) for events in event_counts(problem)
        ]
        heapq.heapify(self._heap)
        self._fruitless = 0
        self._found: list[Pattern] = []

    def run(self, count: int) -> PatternResult:
        """The `count` best patterns, or as many as there are."""
        found = self._found
        while self._heap and len(found) < count and not self._monitor.is_over:
            entry = heapq.heappop(self._heap)
            if not found:
                self._monitor.bound = entry.cost
            if entry.pattern is not None and entry.model is not None:
                found.append(entry.pattern)
                if len(found) < count:
                    forbid(entry.model, entry.pattern.stance)
                    self._push(entry.model)
            else:
                self._open(entry)
        return self._result(found)

    def _open(self, entry: _Entry) -> None:
        if self._fruitless == PATIENCE and not self._is_possible():
            self._heap.clear()
        elif not self._is_simply_possible(entry.events):
            self._fruitless += 1
        else:
            built = ruled_model(self._problem, entry.events, self._floors)
            built.model.minimize(built.objective())
            self._push(built, entry)

    def _is_simply_possible(self, events: int) -> bool:
        """Whether so many events can do without drawing and balance: mostly not, which is proven at once."""
        problem = self._problem
        if problem.drawing is None and problem.rules.balance is None:
            return True
        simple = replace(problem, drawing=None, rules=replace(problem.rules, balance=None))
        built = ruled_model(simple, events, row_floors(simple))
        status, solver = self._monitor.solve(built.model)
        if status == OPTIMAL and problem.rules.balance is None:
            self._monitor.offer(scored(problem, read_pattern(built, solver.value).stance))
        return bool(status != INFEASIBLE)

    def _push(self, built: EventModel, entry: _Entry | None = None) -> None:
        """The best pattern that the model still allows, put where its cost belongs."""
        others = self._heap[0].cost if self._heap else math.inf

        def bounded(bound: float) -> None:
            if not self._found:
                self._monitor.bound = max(self._monitor.bound, min(bound, others))

        status, solver = self._monitor.solve(
            built.model, _Listener(built, self._monitor), linear=_linear(self._problem), bounded=bounded
        )
        if status == OPTIMAL:
            pattern = read_pattern(built, solver.value)
            self._monitor.offer(pattern)
            cost = weighted_sum(self._problem, pattern)
            heapq.heappush(self._heap, _Entry(cost, False, built.events, built, pattern))
        elif status == INFEASIBLE:
            self._fruitless += 1
        elif entry is not None:
            heapq.heappush(self._heap, entry)

    def _is_possible(self) -> bool:
        """Whether any pattern at all keeps the rules: one proof instead of one for each number of events."""
        self._fruitless += 1
        built = build_model(self._problem)
        status, solver = self._monitor.solve(built.model, linear=0)
        if status == OPTIMAL:
            self._monitor.offer(read_samples(built, solver.value))
        return bool(status != INFEASIBLE)

    def _result(self, found: list[Pattern]) -> PatternResult:
        monitor, best = self._monitor, self._monitor.best
        if found:
            bound = float(weighted_sum(self._problem, found[0]))
            return PatternResult(PatternStatus.OPTIMAL, tuple(found), bound, monitor.elapsed)
        if not monitor.is_over:
            return PatternResult(PatternStatus.INFEASIBLE, (), None, monitor.elapsed)
        if best is not None:
            return PatternResult(PatternStatus.FEASIBLE, (best,), monitor.bound, monitor.elapsed)
        return PatternResult(PatternStatus.CANCELLED, (), monitor.bound, monitor.elapsed)


def _linear(problem: PatternProblem) -> int:
    """How much linear programs help, as measured: the costs of a drawing make them weak."""
    if problem.drawing is None or not problem.weights.drawing:
        return 2
    return 0 if problem.walking.sum() <= FEW_LIMBS else 1


class _Listener(CpSolverSolutionCallback):
    """Offers each better pattern to the watch."""

    def __init__(self, built: EventModel, monitor: SearchMonitor) -> None:
        super().__init__()
        self._built = built
        self._monitor = monitor

    def on_solution_callback(self) -> None:
        """Called by the solver."""
        self._monitor.offer(read_pattern(self._built, self.value))
