"""The live tier's answer to a problem: a motion, or why there is none."""

import time
from dataclasses import dataclass, replace

import numpy as np

from core.motion.trajectory import Trajectory, turn_trajectory
from core.problem.initial_guess import initial_guess
from core.problem.motion_check import check_motion
from core.problem.motion_problem import MotionProblem
from solver_jobs.live.assembly import (
    inner_rows,
    natural_linearisation,
    outer_rows,
    quadratic_program,
)
from solver_jobs.live.elastic import PROOF_MM, Nearest, nearest
from solver_jobs.live.explain import PROVEN, lacks_of, low_lacks, sentences
from solver_jobs.live.free_heights import at_heights_of, with_free_heights
from solver_jobs.live.linearisation import Linearisation
from solver_jobs.live.motion import motion_cost, trajectory_of
from solver_jobs.live.motors import motor_rows
from solver_jobs.live.qp import QpResult, QuadraticProgram, Solver
from solver_jobs.live.rows import Rows
from solver_jobs.live.shoes import shoe_rows, shoes_meet
from solver_jobs.nlp.assembly import box_of
from solver_jobs.nlp.constraint import situation_of
from solver_jobs.nlp.presolve import presolve
from solver_jobs.results.motion import Evidence, MotionResult, SolveStatus

COARSE, FINE, AROUND = 16, 64, 32
"""Edges of the polygons that stand for discs: while dragging, before saying no, and in a proof."""

NEARLY_MM = 0.05
"""A total miss below this may be due to the tangents, which are exact where heights do not change."""

HEIGHTS = 3
"""How often heights are made linear anew."""

ROUNDS = 5
"""How often motor limits, and the room between shoes, are made linear anew."""

AT_THE_EDGE = (
    "This lies at the edge of what the model allows: no motion was found, though less than 0.005 mm is "
    "missing. Shorten the step a little. This is diagnosed, not proven."
)
"""What is said where nothing notable is missing."""

_solver = Solver()


@dataclass(eq=False)
class _Search:
    """One problem of direction 1 and the time spent on it."""

    problem: MotionProblem
    seconds: float = 0.0

    def solve(self, qp: QuadraticProgram) -> QpResult:
        answer = _solver.solve(qp)
        self.seconds += answer.seconds
        return answer


def solve_live(problem: MotionProblem) -> MotionResult:
    """Solves the convex problem; not for several threads at once.

    Args:
        problem: what is asked. It is solved in direction 1 and turned back, so that directions agree.

    Returns:
        Solved with a motion; or infeasible with the nearest one, proven for the model of given footholds and
        heights where weak duality says so, else diagnosed; failed where the solver has no answer.
    """
    begin = time.perf_counter()
    situation = situation_of(problem)
    blocking = presolve(situation, box_of(situation))
    search = _Search(problem.turned(-problem.quarter_turns))
    result = _blocked(search, problem, blocking) if blocking else _turned(_solve(search), problem)
    return replace(result, build_seconds=max(time.perf_counter() - begin - result.solve_seconds, 0.0))


def _blocked(search: _Search, problem: MotionProblem, sentences: tuple[str, ...]) -> MotionResult:
    """What bounds alone rule out; where it happens is looked for in the nearest motion."""
    told = (*sentences, PROVEN)
    if not problem.timeline.contact[:-1].any(axis=1).all():
        return _result(SolveStatus.INFEASIBLE, initial_guess(problem), 0.0, told, Evidence.PROVEN)
    found = _turned(_unsolved(search, natural_linearisation(search.problem)), problem)
    lacks = (*low_lacks(problem), *found.lacks)
    return replace(
        found, status=SolveStatus.INFEASIBLE, explanation=told, evidence=Evidence.PROVEN, lacks=lacks
    )


def quick_motion(problem: MotionProblem, sides: int = COARSE) -> Trajectory | None:
    """A motion with the body at its natural height and polygons of so many edges; None if there is none."""
    situation = situation_of(problem)
    if presolve(situation, box_of(situation)):
        return None
    turns = problem.quarter_turns
    search = _Search(problem.turned(-turns))
    motion = _attempt(search, natural_linearisation(search.problem), sides)
    return None if motion is None else turn_trajectory(motion, turns)


def _solve(search: _Search) -> MotionResult:
    natural = natural_linearisation(search.problem)
    if (motion := _attempt(search, natural, COARSE)) is not None:
        return _solved(search, motion)
    free = with_free_heights(natural)
    rows = outer_rows(free, AROUND)
    if (found := _nearest(search, free, rows)) is not None and found.proven >= PROOF_MM:
        return _infeasible(search, free, rows, found, Evidence.PROVEN)
    # Nothing rules a motion out: it is sought at the heights where least is missing.
    about = natural
    for _ in range(HEIGHTS):
        free = with_free_heights(about)
        rows = inner_rows(free, FINE)
        if (found := _nearest(search, free, rows)) is None:
            break
        about = at_heights_of(free, found.x)
        # The nearest motion itself, where there is no room beside it.
        for motion in (_attempt(search, about, FINE), trajectory_of(about, found.x)):
            if motion is not None and check_motion(search.problem, motion).confirmed:
                return _solved(search, motion)
        if found.total > NEARLY_MM:
            break
    return _unsolved(search, about)


def _attempt(search: _Search, linearisation: Linearisation, sides: int) -> Trajectory | None:
    """A motion within the polygons; None where the solver finds none."""
    rows = inner_rows(linearisation, sides)
    motion = _motion(search, linearisation, rows)
    limits = search.problem.limits
    is_curved = limits.motor_speed is not None or limits.motor_acceleration is not None
    if motion is None or not (is_curved or shoes_meet(search.problem, motion)):
        return motion
    for _ in range(ROUNDS):
        motion = _motion(search, linearisation, rows + _curved_rows(linearisation, motion))
        if motion is None or check_motion(search.problem, motion).confirmed:
            return motion
    return None


def _curved_rows(linearisation: Linearisation, about: Trajectory) -> list[Rows]:
    """Limits that are linear about a motion only: those of motors, and the room between shoes."""
    return motor_rows(linearisation, about) + shoe_rows(linearisation, about)


def _motion(search: _Search, linearisation: Linearisation, rows: list[Rows]) -> Trajectory | None:
    qp = quadratic_program(linearisation, rows)
    answer = None if qp is None else search.solve(qp)
    return trajectory_of(linearisation, answer.x) if answer is not None and answer.solved else None


def _nearest(search: _Search, linearisation: Linearisation, rows: list[Rows]) -> Nearest | None:
    found = nearest(_solver, linearisation, rows)
    if found is not None:
        search.seconds += found.answer.seconds
    return found


def _unsolved(search: _Search, about: Linearisation) -> MotionResult:
    """What is missing at given heights, without a proof."""
    rows = inner_rows(about, FINE)
    found = _nearest(search, about, rows)
    if found is None:
        words = ("The convex solver found neither a motion nor what is missing.",)
        motion = initial_guess(search.problem)
        return _result(SolveStatus.FAILED, motion, search.seconds, words, Evidence.DIAGNOSED)
    return _infeasible(search, about, rows, found, Evidence.DIAGNOSED)


def _infeasible(
    search: _Search, linearisation: Linearisation, rows: list[Rows], found: Nearest, evidence: Evidence
) -> MotionResult:
    """The nearest motion and what it lacks."""
    known = at_heights_of(linearisation, found.x)
    motion = trajectory_of(known, found.x)
    lacks = lacks_of(linearisation, rows, found.misses, found.x)
    if not lacks:
        curved = _curved_rows(known, motion)
        lacks = lacks_of(known, curved, [np.maximum(one.excess(found.x), 0.0) for one in curved], found.x)
    result = _result(SolveStatus.INFEASIBLE, motion, search.seconds, (AT_THE_EDGE,), evidence)
    return replace(result, lacks=lacks)


def _turned(result: MotionResult, problem: MotionProblem) -> MotionResult:
    """The result in the problem's own direction, its sentences with the feet's own names."""
    turns, legs = problem.quarter_turns, problem.model.leg_count
    motion = turn_trajectory(result.trajectory, turns)
    lacks = tuple(
        replace(lack, feet=tuple((foot + turns * legs // 4) % legs for foot in lack.feet))
        for lack in result.lacks
    )
    explanation, evidence = result.explanation, result.evidence
    if not lacks and result.status is SolveStatus.INFEASIBLE:
        evidence = Evidence.DIAGNOSED
    if lacks:
        explanation, lacks = sentences(problem, lacks, result.evidence, result.trajectory.body_world[:, 2])
    return replace(
        result, trajectory=motion, initial=motion, lacks=lacks, explanation=explanation, evidence=evidence
    )


def _solved(search: _Search, motion: Trajectory) -> MotionResult:
    result = _result(SolveStatus.SOLVED, motion, search.seconds, (), None)
    return replace(result, objective=motion_cost(search.problem, motion))


def _result(
    status: SolveStatus,
    motion: Trajectory,
    seconds: float,
    explanation: tuple[str, ...],
    evidence: Evidence | None,
) -> MotionResult:
    return MotionResult(
        status=status,
        solver_word="",
        explanation=explanation,
        evidence=evidence,
        iterations=(),
        objective=None,
        solve_seconds=seconds,
        build_seconds=0.0,
        trajectory=motion,
        initial=motion,
    )
