"""The fastest pose gait of a problem: several starts, short moves made long, the gentlest of equals."""

import time
from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from core.arrays import Floats
from core.pose_gaits.pose_check import check_poses
from core.pose_gaits.pose_problem import SHORTEST_MOVE, PoseProblem
from solver_jobs.pose_gaits.explain import explained
from solver_jobs.pose_gaits.pose_program import SLACKS, PoseProgram, Weights
from solver_jobs.pose_gaits.program import Attempt
from solver_jobs.pose_gaits.start_motion import MM
from solver_jobs.results.motion import SolveStatus
from solver_jobs.results.pose import PoseProgress, PoseResult

STARTS = 3
"""Starts that are tried where the step is free."""
STEP_GUESS = 0.030
"""Step a cycle from which a search with a free step begins, m."""
SPREAD = 3.0
"""Standard deviation by which further starts move the body sideways, mm."""
FASTEST = Weights(time=1.0, pace=0.0)
FREE = Weights(pace=1.0)
GENTLE = Weights(time=1e-3, slip=10.0, sway=1e-3)
"""Least slip; among equals least sway."""
SAME_TIME = 1e-4
"""Share of the robot's time that a gentler gait may take more."""
CONVERGED = "Solve_Succeeded"
"""IPOPT's word for an optimum within its tolerance."""
MOST_SECONDS = 30.0
"""For one run of IPOPT."""
MORE_SECONDS = 2.0
"""Making short moves long takes at most this much longer than the gait took itself, s."""
LENGTHENINGS = 3
"""Times that short moves are made long."""
NEARLY_LONG = 0.02
"""A move that is shorter than `SHORTEST_MOVE` by less than this is long enough, mm."""
WORTH = 0.995
"""Longer moves are taken where the gait stays this fast by the law: the board has fewer second ramps then."""


Report = Callable[[PoseProgress], bool]
"""Tells what is known; false where the search is to end."""


class _Cancelled(Exception):  # noqa: N818 - it is no error
    """Somebody ended the search."""


def solve_poses(problem: PoseProblem, report: Report = lambda progress: True) -> PoseResult:
    """Looks for the fastest pose gait.

    Args:
        problem: what is asked.
        report: called between and within the stages.
    """
    results = [_solved(replace(problem, parts=parts), report) for parts in problem.parts_to_try]
    cancelled = [result for result in results if result.status is SolveStatus.CANCELLED]
    solved = [result for result in results if result.gait is not None]
    best = cancelled[0] if cancelled else max(solved, key=_result_speed) if solved else results[0]
    return replace(
        best,
        solve_seconds=sum(result.solve_seconds for result in results),
        seconds=sum(result.seconds for result in results),
    )


def _result_speed(result: PoseResult) -> float:
    return 0.0 if result.gait is None else result.gait.speed


def _solved(problem: PoseProblem, report: Report) -> PoseResult:
    """The search with a given number of parts."""
    search = _Search(problem, report)
    try:
        return search.result()
    except _Cancelled:
        return search.ended(SolveStatus.CANCELLED, ("The search was cancelled.",))


class _Search:
    """One search; it keeps what is known for its reports."""

    def __init__(self, problem: PoseProblem, report: Report) -> None:
        self.problem = problem
        self._report = report
        self._begin = time.perf_counter()
        self._solve_seconds = 0.0
        self._ran_out = False
        self._forced: Forced = ()
        self._progress = PoseProgress("Building the program", 0.0, None)

    def result(self) -> PoseResult:
        self._tell("Building the program", 0.0)
        program = PoseProgram(self.problem, self.problem.step or STEP_GUESS)
        best = self._fastest(program)
        if best is None:
            self._tell("Looking for the reason", 0.8)
            short = program if self.problem.step is None else PoseProgram(self.problem, STEP_GUESS)
            if self._ran_out:
                sentence = (
                    f"The search took longer than {MOST_SECONDS:.0f} s for one start. Choose fewer --cycles, "
                    "or try again when the computer has less to do."
                )
                return self.ended(SolveStatus.FAILED, (sentence,))
            sentences = explained(self.problem, short, self._run(short))
            return self.ended(SolveStatus.INFEASIBLE, sentences)
        best = self._lengthened(program, best)
        gait, check = program.gait(best.values), check_poses(program.gait(best.values))
        gentle = self._gentle(program, best)
        if gentle is not None:
            kinder = program.gait(gentle.values)
            kinder_check = check_poses(kinder)
            if kinder_check.confirmed or not check.confirmed:
                gait, check = kinder, kinder_check
        if check.confirmed:
            ended, optimal = self.ended(SolveStatus.SOLVED, ()), best.status == CONVERGED
            return replace(ended, gait=gait, check=check, optimal=optimal)
        sentences = tuple(finding.sentence for finding in check.findings[:5])
        explanation = ("The independent check does not confirm the gait that was found.", *sentences)
        return self.ended(SolveStatus.FAILED, explanation)

    def ended(self, status: SolveStatus, explanation: tuple[str, ...]) -> PoseResult:
        seconds = time.perf_counter() - self._begin
        return PoseResult(status, None, None, False, explanation, self._solve_seconds, seconds)

    def _tell(self, stage: str, done: float, speed: float | None = None) -> None:
        speed = self._progress.speed if speed is None else speed
        self._progress = PoseProgress(stage, done, speed)
        if not self._report(self._progress):
            raise _Cancelled

    def _keep_on(self) -> bool:
        return self._report(self._progress)

    def _run(self, program: PoseProgram) -> Callable[..., Attempt]:
        """Calls IPOPT with a step, weights and changed bounds; an ended search raises."""

        def run(
            start: Floats,
            weights: Weights,
            *,
            step: tuple[float, float] | None = None,
            seconds: float = np.inf,
            forced: Forced = (),
            slack: Mapping[str, float] | None = None,
            most_seconds: float = MOST_SECONDS,
        ) -> Attempt:
            lower, upper = program.program.variable_bounds
            if step is not None:
                lower[program.step_place], upper[program.step_place] = step
            for name, most in (slack or {}).items():
                upper[SLACKS.index(name)] = most
            row_lower, row_upper = program.program.row_bounds
            row_upper[program.seconds_row] = seconds
            for move, motor, sign in forced:
                place = program.changes[move].start + motor
                if sign > 0:
                    row_lower[place] = SHORTEST_MOVE * MM
                else:
                    row_upper[place] = -SHORTEST_MOVE * MM
            attempt = program.program.run(
                weights.values, start, (lower, upper), (row_lower, row_upper), self._keep_on, most_seconds
            )
            self._solve_seconds += attempt.seconds
            if attempt.status == "User_Requested_Stop" and not self._report(self._progress):
                raise _Cancelled
            self._ran_out = self._ran_out or attempt.status == "User_Requested_Stop"
            return attempt

        return run

    @property
    def _step(self) -> tuple[float, float] | None:
        step = self.problem.step
        return None if step is None else (step * MM, step * MM)

    def _fastest(self, program: PoseProgram) -> Attempt | None:
        """The fastest of several starts; None where none converges."""
        run = self._run(program)
        found: list[Attempt] = []
        for number in range(STARTS):
            self._tell(f"Solving, start {number + 1}", 0.1 + 0.2 * number)
            start = _moved_start(program, number)
            if self.problem.step is not None:
                attempt = run(start, FASTEST, step=self._step)
            else:
                if self.problem.cycles is not None:  # a long way from a poor start often fails
                    short = run(start, FREE, step=(STEP_GUESS * MM, STEP_GUESS * MM))
                    start = short.values if short.converged else start
                attempt = run(start, FREE)
            if attempt.converged:
                found.append(attempt)
                fastest = max(found, key=lambda one: _speed(program, one))
                self._tell(f"Solved, start {number + 1}", 0.1 + 0.2 * number, _speed(program, fastest))
                if self.problem.step is not None:
                    break
        return max(found, key=lambda one: _speed(program, one)) if found else None

    def _lengthened(self, program: PoseProgram, best: Attempt) -> Attempt:
        """The gait with moves of at least `SHORTEST_MOVE` where the law calls it as fast.

        The program counts a shorter move as if it were that long; the board ramps twice for it instead.
        """
        run = self._run(program)
        forced: Forced = ()
        if self.problem.largest_move <= SHORTEST_MOVE:
            return best
        for number in range(LENGTHENINGS):
            short = _short_moves(program, best)
            if not short:
                return best
            self._tell("Making short moves long", 0.7 + 0.03 * number)
            forced = (*forced, *short)
            weights = FREE if self.problem.step is None else FASTEST
            patience = MORE_SECONDS + best.seconds
            attempt = run(best.values, weights, step=self._step, forced=forced, most_seconds=patience)
            if not attempt.converged or _speed(program, attempt) < WORTH * _speed(program, best):
                return best
            best, self._forced = attempt, forced
        return best

    def _gentle(self, program: PoseProgram, best: Attempt) -> Attempt | None:
        """Among gaits of the same step and time the one whose standing feet slip least."""
        self._tell("Looking for the gentlest", 0.85)
        step = float(best.values[program.step_place])
        seconds = program.seconds(best.values) * (1.0 + SAME_TIME)
        attempt = self._run(program)(
            best.values, GENTLE, step=(step, step), seconds=seconds, forced=self._forced
        )
        return attempt if attempt.converged else None


Forced = tuple[tuple[int, int, int], ...]
"""(move, motor, sign) of motors that have to go at least `SHORTEST_MOVE`."""


def _speed(program: PoseProgram, attempt: Attempt) -> float:
    return program.gait(attempt.values).speed


def _moved_start(program: PoseProgram, number: int) -> Floats:
    """The start of the program, from the second one on with a disturbed body."""
    start = program.program.start
    if number == 0:
        return start
    noise = np.random.default_rng(number).normal(size=start.shape) * SPREAD
    disturbed = np.zeros(len(start), dtype=np.bool_)
    for place in program.body_places:
        disturbed[place : place + 2] = True
    moved = start + np.where(disturbed, noise, 0.0)
    if program.problem.step is None:
        moved[program.step_place] += 8.0 * number
    return moved


def _short_moves(program: PoseProgram, attempt: Attempt) -> Forced:
    """The largest motor of each move that is shorter than `SHORTEST_MOVE`."""
    strokes = program.gait(attempt.values).strokes.reshape(program.problem.move_count + 1, -1) * MM
    changes = np.diff(strokes, axis=0)
    largest = np.abs(changes).argmax(axis=1)
    return tuple(
        (move, int(motor), 1 if changes[move, motor] >= 0 else -1)
        for move, motor in enumerate(largest)
        if abs(changes[move, motor]) < SHORTEST_MOVE * MM - NEARLY_LONG
    )
