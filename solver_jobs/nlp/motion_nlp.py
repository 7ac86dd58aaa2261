"""The exact tier: the whole motion as one nonlinear program, solved by IPOPT."""

from dataclasses import replace

from core.errors import InputError
from core.motion.trajectory import Trajectory, turn_trajectory
from core.problem.initial_guess import initial_guess
from core.problem.motion_problem import MotionProblem
from solver_jobs.nlp.assembly import box_of
from solver_jobs.nlp.attempts import Attempt, Attempts, Progress
from solver_jobs.nlp.compiled_problem import CompiledProblem, CompiledProblemCache
from solver_jobs.nlp.constraint import situation_of
from solver_jobs.nlp.diagnosis import Shortfall, broken_pose, explanation, lacks, nearest_motion
from solver_jobs.nlp.presolve import presolve
from solver_jobs.nlp.warm_starts import WarmStarts
from solver_jobs.results.motion import Evidence, MotionResult, SolveStatus

SUCCEEDED = "Solve_Succeeded"
STOPPED = "User_Requested_Stop"
INFEASIBLE = "Infeasible_Problem_Detected"
"""IPOPT's return statuses that mean something by themselves; every other one is a failure."""

NEARLY = 0.05
"""Where the nearest motion misses less than this (mm, mm/s, N), the price may have been too low for one that
misses nothing, and IPOPT starts there once more."""

_compiled = CompiledProblemCache()
_warm_starts = WarmStarts()


def solve_motion(
    problem: MotionProblem,
    progress: Progress = lambda iterate: True,
    start: Trajectory | None = None,
    *,
    resume: bool = False,
    doubtful: bool = False,
) -> MotionResult:
    """Solves a motion problem; not for several threads at once.

    IPOPT starts from the last solution where this problem is an edit of the last one, then from the given
    motion, then from a drawing, until one of them ends in a motion. Where none does, a second search finds
    the nearest motion: balance, reach and speeds may be missed there at a price. What it still misses is the
    explanation; if it misses nothing, its motion is where IPOPT starts again.

    Args:
        problem: what is asked.
        progress: told of each iteration in the calling thread; false cancels.
        start: a motion of the same knots with velocities and forces, such as the live tier's.
        resume: whether to go on from the last solution of the same shape that was solved with `resume`.
        doubtful: whether a motion is not expected, so that the nearest one is sought first.

    Returns:
        The result; solved only where IPOPT says Solve_Succeeded for the problem as asked.

    Raises:
        InputError: the given motion has other knots or feet, or lacks velocities or forces.
    """
    if start is not None:
        _require_start(problem, start)
    situation = situation_of(problem)
    blocking = presolve(situation, box_of(situation))
    if blocking:
        # Feet are named here, so this looks at the problem in its own direction.
        return _ruled_out(blocking, initial_guess(problem), 0.0)
    turns = problem.quarter_turns
    given = None if start is None else turn_trajectory(start, -turns)
    result = _Solve(problem.turned(-turns), progress, given, turns).run(resume, doubtful)
    return replace(
        result,
        trajectory=turn_trajectory(result.trajectory, turns),
        initial=turn_trajectory(result.initial, turns),
        iterate_motions=tuple(turn_trajectory(motion, turns) for motion in result.iterate_motions),
    )


def _require_start(problem: MotionProblem, start: Trajectory) -> None:
    known = (start.body_velocity, start.feet_velocity, start.contact_forces)
    if start.feet_world.shape[:2] != (problem.knot_count, problem.model.leg_count):
        raise InputError("The motion to start from has other samples or feet than the problem.", "start")
    if any(values is None for values in known):
        raise InputError("The motion to start from lacks velocities or contact forces.", "start")


class _Solve:
    """One problem of direction 1 that no bound rules out."""

    def __init__(
        self, problem: MotionProblem, progress: Progress, given: Trajectory | None, turns: int
    ) -> None:
        situation = situation_of(problem)
        self._problem = problem
        self._given = given
        self._initial = initial_guess(problem)
        shift = (turns % 4) * problem.model.leg_count // 4
        self._attempts = Attempts(situation, self._initial, box_of(situation), progress, shift)
        self._build_seconds = 0.0

    def run(self, resume: bool, doubtful: bool) -> MotionResult:
        """Attempts from every start, then the search for the nearest motion."""
        compiled = self._compiled()
        broken = self._attempts.broken_constants(compiled)
        if broken:
            sentences = tuple(broken_pose(one) for one in broken)
            return _ruled_out(sentences, self._initial, self._build_seconds, broken)
        if doubtful and (missing := self._missing(self._elastic())) is not None:
            return missing
        attempt = self._attempt(compiled, resume)
        if attempt.word not in (SUCCEEDED, STOPPED):
            return self._nearest(compiled, attempt)
        if attempt.word == SUCCEEDED and resume:
            _warm_starts.keep(compiled, self._problem, attempt.end)
        return self._ended(attempt)

    def _compiled(self, *, elastic: bool = False) -> CompiledProblem:
        compiled, seconds = _compiled.get(self._problem, elastic=elastic)
        self._build_seconds += seconds
        return compiled

    def _attempt(self, compiled: CompiledProblem, resume: bool) -> Attempt:
        """From one start after the other, until one of them ends in a motion or is cancelled."""
        search = self._attempts
        last = _warm_starts.near(compiled, self._problem) if resume else None
        if last is not None:
            attempt = search.attempt(compiled, last, compiled.warm_solver)
            if attempt.word in (SUCCEEDED, STOPPED):
                return attempt
        if self._given is not None:
            attempt = search.attempt(compiled, search.point(self._given))
            if attempt.word in (SUCCEEDED, STOPPED):
                return attempt
        return search.attempt(compiled, search.drawing)

    def _nearest(self, compiled: CompiledProblem, attempt: Attempt) -> MotionResult:
        """What the search for the nearest motion says after IPOPT has found none."""
        nearest = self._elastic()
        if (missing := self._missing(nearest)) is not None:
            return missing
        if nearest.word != SUCCEEDED:
            return self._ended(attempt)
        again = self._attempts.attempt(compiled, nearest.end)
        if again.word in (SUCCEEDED, STOPPED) or not nearest.missed:
            return self._ended(again)
        return self._infeasible(nearest)

    def _elastic(self) -> Attempt:
        return self._attempts.attempt(self._compiled(elastic=True), self._attempts.drawing)

    def _missing(self, nearest: Attempt) -> MotionResult | None:
        """What the nearest motion says by itself: cancelled, or a demand that is missed by far; else None."""
        if nearest.word == STOPPED:
            return self._ended(nearest)
        if nearest.word != SUCCEEDED or not nearest.missed or nearest.missed[0].amount < NEARLY:
            return None
        return self._infeasible(nearest)

    def _infeasible(self, nearest: Attempt) -> MotionResult:
        return replace(
            self._ended(nearest),
            status=SolveStatus.INFEASIBLE,
            explanation=nearest_motion(nearest.missed),
            evidence=Evidence.DIAGNOSED,
            lacks=lacks(nearest.missed),
            optimal=False,
        )

    def _ended(self, attempt: Attempt) -> MotionResult:
        """A result in the words of one attempt."""
        search = self._attempts
        status = {
            SUCCEEDED: SolveStatus.SOLVED,
            STOPPED: SolveStatus.CANCELLED,
            INFEASIBLE: SolveStatus.INFEASIBLE,
        }.get(attempt.word, SolveStatus.FAILED)
        unsolved = status in (SolveStatus.INFEASIBLE, SolveStatus.FAILED)
        sentences: tuple[str, ...] = ()
        if status is SolveStatus.CANCELLED:
            sentences = (f"Cancelled after {search.iterates[-1].number} iterations.",)
        elif unsolved:
            sentences = explanation(attempt.missed)
        return MotionResult(
            status=status,
            solver_word=attempt.word,
            explanation=sentences,
            evidence=Evidence.DIAGNOSED if unsolved else None,
            iterations=tuple(search.iterates),
            objective=attempt.cost,
            solve_seconds=search.seconds,
            build_seconds=self._build_seconds,
            trajectory=search.trajectory(attempt.end.vector),
            initial=search.trajectory(attempt.begin.vector),
            lacks=lacks(attempt.missed) if unsolved else (),
            iterate_motions=search.iterate_motions(),
            optimal=status is SolveStatus.SOLVED,
        )


def _ruled_out(
    sentences: tuple[str, ...],
    initial: Trajectory,
    build_seconds: float,
    broken: tuple[Shortfall, ...] = (),
) -> MotionResult:
    """Proven infeasible before any search."""
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
        lacks=lacks(broken),
    )
