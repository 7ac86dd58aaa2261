"""The search for the shortest timing: the motion's problem with a stretch of each phase as an unknown."""

import time
from collections import OrderedDict
from collections.abc import Callable, Hashable
from dataclasses import dataclass, replace

import numpy as np
from casadi import SX, dot, sum2, vertcat

from core.arrays import Floats
from core.motion.trajectory import Trajectory
from core.problem.motion_problem import MotionProblem
from core.robot.model import RobotModel
from solver_jobs.nlp.assembly import box_of
from solver_jobs.nlp.attempts import Attempts
from solver_jobs.nlp.block_jacobian import RowBlock
from solver_jobs.nlp.compiled_problem import (
    IPOPT_OPTIONS,
    Ipopt,
    Shape,
    assembled_rows,
    bounds_of,
    fingerprint,
    ipopt,
    shape_of,
)
from solver_jobs.nlp.constraint import Family, situation_of
from solver_jobs.nlp.diagnosis import DIAGNOSED
from solver_jobs.nlp.motion_nlp import STOPPED, SUCCEEDED, solve_motion
from solver_jobs.nlp.variables import make_symbols, stretched
from solver_jobs.results.motion import Iterate, MotionResult, SolveStatus

LONGEST_PHASE = 60.0
"""No phase gets longer than this, s."""

SLOWER = 4.0
"""Where no motion keeps the drawn timing, one is looked for that takes so many times as long."""

CALM = 1e-6
"""Weight of ½(Σ‖λ‖² + Σ‖v‖²) (N², mm²/s²) beside the duration in s: it picks one of equally short motions and
costs them some milliseconds."""

TIMING_OPTIONS: dict[str, int | float | str] = {"ipopt.max_iter": 300, "ipopt.mu_init": 0.1}
"""What differs from the search for a motion: it takes 30 to 80 iterations."""

Spans = tuple[tuple[int, int], ...]


@dataclass(frozen=True, eq=False)
class Stretched:
    """What the search ended with, in direction 1.

    Args:
        status: how it ended.
        durations: (n − 1,) time from each knot to the next, s; as drawn where it is not solved.
        trajectory: with these times where it is solved.
        seconds: time in the solver.
        iterations: of the solver.
        explanation: sentences where it is not solved.
    """

    status: SolveStatus
    durations: Floats
    trajectory: Trajectory
    seconds: float
    iterations: int
    explanation: tuple[str, ...]


class StretchSearch:
    """Finds a motion at the drawn pace or slower, and from there the shortest one.

    Args:
        problem: of direction 1.
        spans: first and last knot of every phase.
        smallest_phase: s.
        progress: told of each iteration, its objective in s; false cancels.
    """

    def __init__(
        self,
        problem: MotionProblem,
        spans: Spans,
        smallest_phase: float,
        progress: Callable[[Iterate], bool],
    ) -> None:
        self._problem = problem
        self._spans = spans
        self._smallest = smallest_phase
        self._progress = progress
        self._seconds = 0.0
        self._iterates: list[Iterate] = []

    def run(self) -> Stretched:
        """The whole search."""
        drawn = self._problem
        first = self._motion(drawn)
        as_drawn = first.trajectory
        if first.status is SolveStatus.INFEASIBLE:
            slow = replace(drawn, durations=drawn.intervals * SLOWER)
            second = self._motion(slow)
            slower = f"Slowing down does not help: no motion even at {SLOWER:g}× the time."
            drawn, first = slow, replace(second, explanation=(slower, *second.explanation))
        if first.status is not SolveStatus.SOLVED:
            return self._unsolved(first.status, first.explanation, as_drawn)
        return self._shortest(drawn, first.trajectory)

    def _motion(self, problem: MotionProblem) -> MotionResult:
        def told(iterate: Iterate) -> bool:
            return self._note(iterate, float(problem.intervals.sum()))

        result = solve_motion(problem, told)
        self._seconds += result.solve_seconds
        return result

    def _note(self, iterate: Iterate, duration: float) -> bool:
        self._iterates.append(replace(iterate, number=len(self._iterates), objective=duration))
        return self._progress(self._iterates[-1])

    def _shortest(self, problem: MotionProblem, start: Trajectory) -> Stretched:
        """The shortest motion, from one that keeps every limit."""
        drawn = np.array([problem.intervals[a : b + 1].sum() for a, b in self._spans])
        situation = situation_of(problem)
        search = Attempts(situation, start, box_of(situation), self._progress)
        phases = _phase_of_interval(self._spans, problem.knot_count)
        solver, blocks = _compiled(problem, phases)
        row_lower, row_upper = bounds_of(blocks, situation)
        motion = search.drawing.vector
        solver.monitor.error = None
        solver.monitor.listener = lambda now, figures: self._tell(float(drawn @ now[len(motion) :]), figures)
        begin = time.perf_counter()
        try:
            answer = solver.function(
                x0=np.concatenate([motion, np.maximum(1.0, self._smallest / drawn)]),
                p=search.parameters,
                lbx=np.concatenate([search.lower, self._smallest / drawn]),
                ubx=np.concatenate([search.upper, np.maximum(LONGEST_PHASE, self._smallest) / drawn]),
                lbg=row_lower,
                ubg=row_upper,
            )
        finally:
            solver.monitor.listener = None
            self._seconds += time.perf_counter() - begin
        if solver.monitor.error is not None:
            raise solver.monitor.error
        word = str(solver.function.stats()["return_status"])
        if word == STOPPED:
            return self._unsolved(SolveStatus.CANCELLED, ("Cancelled.",), start)
        if word != SUCCEEDED:
            words = f"IPOPT found a motion but ended its search for the shortest one with “{word}”."
            return self._unsolved(SolveStatus.FAILED, (words, DIAGNOSED), start)
        found = np.array(answer["x"]).reshape(-1)
        durations = problem.intervals * found[len(motion) :][list(phases)]
        times = replace(problem, durations=durations).times
        trajectory = replace(search.trajectory(found[: len(motion)]), times=times)
        return self._ended(SolveStatus.SOLVED, durations, trajectory, ())

    def _tell(self, duration: float, figures: dict[str, float]) -> bool:
        iterate = Iterate(
            number=0,
            objective=duration,
            primal_infeasibility=figures["inf_pr"],
            dual_infeasibility=figures["inf_du"],
            step=figures["alpha_pr"],
        )
        return self._note(iterate, duration)

    def _unsolved(
        self, status: SolveStatus, explanation: tuple[str, ...], trajectory: Trajectory
    ) -> Stretched:
        return self._ended(status, self._problem.intervals, trajectory, explanation)

    def _ended(
        self, status: SolveStatus, durations: Floats, trajectory: Trajectory, explanation: tuple[str, ...]
    ) -> Stretched:
        count = len(self._iterates)
        return Stretched(status, durations, trajectory, self._seconds, count, explanation)


def _phase_of_interval(spans: Spans, knots: int) -> tuple[int, ...]:
    """(n − 1) number of the phase of each interval; the last knot begins none."""
    return tuple(phase for phase, (a, b) in enumerate(spans) for _ in range(a, min(b + 1, knots - 1)))


_KEPT = 4
_known: OrderedDict[Hashable, tuple[Ipopt, tuple[RowBlock, ...]]] = OrderedDict()


def _compiled(problem: MotionProblem, phases: tuple[int, ...]) -> tuple[Ipopt, tuple[RowBlock, ...]]:
    """The solver of a problem's shape and phases, kept for the next time."""
    shape = shape_of(problem)
    key = (shape, phases, fingerprint(problem.model))
    if key not in _known:
        _known[key] = _build(problem.model, shape, phases)
    _known.move_to_end(key)
    if len(_known) > _KEPT:
        _known.popitem(last=False)
    return _known[key]


def _build(model: RobotModel, shape: Shape, phases: tuple[int, ...]) -> tuple[Ipopt, tuple[RowBlock, ...]]:
    still = make_symbols(model.leg_count, shape.knots, slopes=Family.FRICTION in shape.asked)
    symbols = stretched(still, phases)
    blocks, expressions = assembled_rows(symbols, model, shape)
    calm = (*symbols.force, *symbols.slope, *symbols.velocity)
    price = sum2(symbols.intervals) + CALM / 2 * sum((dot(part, part) for part in calm), SX(0))
    nlp = {"x": symbols.vector, "p": symbols.parameters, "f": price, "g": vertcat(*expressions)}
    return ipopt(nlp, {**IPOPT_OPTIONS, **TIMING_OPTIONS}), blocks
