"""The fastest pose gait of a problem: several starts, short moves made long, the gentlest of equals."""

import time
from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from core.arrays import Floats
from core.pose_gaits.pose_check import check_poses, least_arm_distance, rest_strokes
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import SHORTEST_MOVE, PoseProblem
from core.pose_gaits.start_motion import MM, PosesStart
from core.robot.arms import arm_gaps
from solver_jobs.pose_gaits.arms import NEAR, ArmPlace, Plane, near_arms
from solver_jobs.pose_gaits.explain import FARTHEST, NOT_PROVEN, arms_explained, explained
from solver_jobs.pose_gaits.pose_program import SLACKS, ArmRows, PoseProgram, Weights, asked_reach
from solver_jobs.pose_gaits.program import MOST_ITERATIONS, Attempt
from solver_jobs.results.motion import SolveStatus
from solver_jobs.results.pose import PoseProgress, PoseResult

STARTS = 3
"""Starts that are tried where the step is free."""
STEP_GUESS = 0.030
"""Step a cycle from which a search with a free step begins, m."""
LEAST_STEP = 1.0
"""Shortest step a cycle of such a search, mm."""
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
LENGTHENING_ITERATIONS = 60
"""IPOPT gets this many to make short moves long; where it needs more it stalls."""
STALLED = 2.0
"""It stalls too where its iterations take this many times as long as those that found the gait."""
LENGTHENINGS = 3
"""Times that short moves are made long."""
NEARLY_LONG = 0.02
"""A move that is shorter than `SHORTEST_MOVE` by less than this is long enough, mm."""
MOST_ARM_ROUNDS = 4
"""Times that a gait whose arms come too near is looked for anew."""
ARM_TOLERANCE = 0.00002
"""Less than this is no lack of room between arms, m; the check allows more."""
ARM_ROOM = 0.0001
"""Arms are kept this much farther apart than asked at the places that have rows, m."""
SAME_PACE = 1e-3
"""Starts that lead to gaits as near as this in speed lead to the same one."""
WORTH = 0.995
"""Longer moves are taken where the gait stays this fast by the law: the board has fewer second ramps then."""


Report = Callable[[PoseProgress], bool]
"""Tells what is known; false where the search is to end."""


class _Cancelled(Exception):  # noqa: N818 - it is no error
    """Somebody ended the search."""


def solve_poses(
    problem: PoseProblem,
    report: Report = lambda progress: True,
    near: PoseGait | None = None,
    explain: bool = True,
) -> PoseResult:
    """Looks for the fastest pose gait.

    Args:
        problem: what is asked.
        report: called between and within the stages.
        near: poses to begin with instead of several starts; they need not answer the problem.
        explain: whether to look for the reason where there is no gait, which takes as long again.
    """
    results: list[PoseResult] = []
    longest: Longest = []
    for parts in problem.parts_to_try:
        # Finding a reason is slow, so it is looked for only if no number of parts gave a gait.
        is_last = parts == problem.parts_to_try[-1] and all(result.gait is None for result in results)
        needs_reason = explain and is_last and not problem.pinned
        results.append(_solved(replace(problem, parts=parts), report, near, longest, needs_reason))
    cancelled = [result for result in results if result.status is SolveStatus.CANCELLED]
    solved = [result for result in results if result.gait is not None]
    failed = [result for result in results if result.status is SolveStatus.FAILED]
    best = [*cancelled, *sorted(solved, key=_result_pace, reverse=True), *failed, results[-1]][0]
    if best.status is SolveStatus.INFEASIBLE and problem.pinned:
        results.append(_solved_without_pinned(problem, report, near))
        best = _pinned_answer(problem, best, results[-1])
    return replace(
        best,
        solve_seconds=sum(result.solve_seconds for result in results),
        seconds=sum(result.seconds for result in results),
    )


def _solved_without_pinned(problem: PoseProblem, report: Report, near: PoseGait | None) -> PoseResult:
    """The same problem with no pose pinned; its progress is none of the gait that was asked."""

    def said(progress: PoseProgress) -> bool:
        return report(PoseProgress("Searching without the pinned poses", progress.done))

    return _solved(replace(problem, pinned=()), said, near, [], needs_reason=True)


def _pinned_answer(problem: PoseProblem, asked: PoseResult, without: PoseResult) -> PoseResult:
    """Explains an infeasible result by that of the same problem without pinned poses."""
    if without.status in (SolveStatus.INFEASIBLE, SolveStatus.CANCELLED):
        return without
    poses = ", ".join(str(pin.pose) for pin in problem.pinned)
    but_without = ", but one was found without" if without.gait is not None else ""
    sentence = (
        f"No gait was found with the body where it is pinned (at pose {poses}){but_without}. Pin it nearer "
        "to where it was, or let it go."
    )
    return replace(asked, explanation=(sentence, NOT_PROVEN))


def _result_pace(result: PoseResult) -> float:
    return 0.0 if result.gait is None else result.gait.pace


Longest = list[tuple[PoseProgram, Attempt]]
"""Searches for the longest step or turn that converged, each with its program."""


def _solved(
    problem: PoseProblem, report: Report, near: PoseGait | None, longest: Longest, needs_reason: bool
) -> PoseResult:
    """The search with a given number of parts.

    Args:
        problem: what is asked.
        report: told of the progress.
        near: poses to begin with.
        longest: what earlier searches know of the longest step; this one adds its own.
        needs_reason: whether an infeasible result is to be explained.
    """
    fits = near is not None and np.array_equal(near.problem.airborne, problem.airborne)
    search = _Search(problem, report, near if fits else None, longest, needs_reason)
    try:
        return search.result()
    except _Cancelled:
        return search.ended(SolveStatus.CANCELLED, ("The search was cancelled.",))


class _Search:
    """One search; it keeps what is known for its reports."""

    def __init__(
        self,
        problem: PoseProblem,
        report: Report,
        near: PoseGait | None,
        longest: Longest,
        needs_reason: bool,
    ) -> None:
        self.problem = problem
        self._near = near
        self._longest = longest
        self._needs_reason = needs_reason
        self._report = report
        self._begin = time.perf_counter()
        self._solve_seconds = 0.0
        self._forced: Forced = ()
        self._progress = PoseProgress("Building the program", 0.0)

    def result(self) -> PoseResult:
        too_near = self._too_near_at_rest()
        if too_near is not None:
            return self.ended(SolveStatus.INFEASIBLE, (too_near,))
        self._tell("Building the program", 0.0)
        program, found = self._found()
        if not found:
            return self.ended(SolveStatus.INFEASIBLE, self._reason(program))
        apart = self._fastest_apart(program, found)
        if apart is None and self._near is not None:
            self._near = None  # other starts may lead to arms that keep apart
            return self.result()
        if apart is None:
            return self.ended(SolveStatus.INFEASIBLE, arms_explained(program.gait(found[0].values)))
        program, best = apart
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
        if self._near is not None:
            self._near = None
            return self.result()
        sentences = tuple(finding.sentence for finding in check.findings[:5])
        explanation = ("The independent check does not confirm the gait that was found.", *sentences)
        return self.ended(SolveStatus.FAILED, explanation)

    def _reason(self, program: PoseProgram) -> tuple[str, ...]:
        if not self._needs_reason:
            return ()
        self._tell("Looking for the reason", 0.8)
        longest = max(self._longest, key=lambda known: known[1].values[known[0].reach_place], default=None)
        return explained(self.problem, program, self._run(program), longest)

    def _found(self) -> tuple[PoseProgram, list[Attempt]]:
        """The program and its gaits, fastest first: beside the poses that are known, or of several starts."""
        if self._near is not None:
            self._tell("Solving", 0.1)
            program = PoseProgram(self.problem, self._near.step, start=PosesStart(self._near))
            weights = FREE if self.problem.is_free else FASTEST
            attempt = self._run(program)(program.program.start, weights, reach=self._reach)
            if attempt.converged:
                return program, [attempt]
        program = PoseProgram(self.problem, self.problem.step or STEP_GUESS)
        if self.problem.is_free:
            return program, self._fastest(program)
        self._tell("Solving", 0.1)
        attempt = self._run(program)(program.program.start, FASTEST, reach=self._reach)
        return (program, [attempt]) if attempt.converged else self._of_farthest()

    def _of_farthest(self) -> tuple[PoseProgram, list[Attempt]]:
        """A gait with the step or turn that is set, by way of the longest; none where that is too short.

        Of 60 steps that an even start did not reach, other starts reached none.
        """
        self._tell(f"Looking for the longest {self.problem.way_word}", 0.4)
        program = PoseProgram(self.problem, STEP_GUESS)
        run = self._run(program)
        farthest = run(program.program.start, FARTHEST)
        if not farthest.converged:
            return program, []
        self._longest.append((program, farthest))
        if farthest.values[program.reach_place] < asked_reach(self.problem):
            return program, []
        attempt = run(farthest.values, FASTEST, reach=self._reach)
        return program, [attempt] if attempt.converged else []

    def ended(self, status: SolveStatus, explanation: tuple[str, ...]) -> PoseResult:
        seconds = time.perf_counter() - self._begin
        return PoseResult(status, None, None, False, explanation, self._solve_seconds, seconds)

    def _tell(self, stage: str, done: float, gait: PoseGait | None = None) -> None:
        known = self._progress
        if gait is not None:
            known = replace(known, speed=gait.speed, turn_rate=gait.turn_rate)
        self._progress = replace(known, stage=stage, done=done)
        if not self._report(self._progress):
            raise _Cancelled

    def _keep_on(self) -> bool:
        return self._report(self._progress)

    def _run(self, program: PoseProgram) -> Callable[..., Attempt]:
        """Calls IPOPT with a step or turn, weights and changed bounds; an ended search raises."""

        def run(
            start: Floats,
            weights: Weights,
            *,
            reach: tuple[float, float] | None = None,
            seconds: float = np.inf,
            forced: Forced = (),
            slack: Mapping[str, float] | None = None,
            most_iterations: int = MOST_ITERATIONS,
            most_seconds: float = np.inf,
        ) -> Attempt:
            lower, upper = program.program.variable_bounds
            if reach is not None:
                lower[program.reach_place], upper[program.reach_place] = reach
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
                weights.values,
                start,
                (lower, upper),
                (row_lower, row_upper),
                self._keep_on,
                most_iterations,
                most_seconds,
            )
            self._solve_seconds += attempt.seconds
            if attempt.status == "User_Requested_Stop" and not self._report(self._progress):
                raise _Cancelled
            return attempt

        return run

    @property
    def _reach(self) -> tuple[float, float] | None:
        reach = asked_reach(self.problem)
        return None if self.problem.is_free else (reach, reach)

    def _fastest(self, program: PoseProgram) -> list[Attempt]:
        """With a free step or turn what several starts lead to, the fastest first."""
        run = self._run(program)
        found: list[Attempt] = []
        for number in range(STARTS):
            self._tell(f"Solving, start {number + 1}", 0.1 + 0.2 * number)
            start = _moved_start(program, number)
            if self.problem.cycles is not None:  # a long way from a poor start often fails
                short = run(start, FREE, reach=(LEAST_STEP, STEP_GUESS * MM))
                start = short.values if short.converged else start
            attempt = run(start, FREE)
            if attempt.converged:
                found.append(attempt)
                found.sort(key=lambda one: -_pace(program, one))
                self._tell(f"Solved, start {number + 1}", 0.1 + 0.2 * number, program.gait(found[0].values))
        return found

    def _fastest_apart(
        self, program: PoseProgram, found: list[Attempt]
    ) -> tuple[PoseProgram, Attempt] | None:
        """The fastest gait whose arms keep apart, and its program. The arm limit only makes gaits slower."""
        best: tuple[PoseProgram, Attempt] | None = None
        for attempt in found:
            if best is not None and _pace(program, attempt) < (1.0 + SAME_PACE) * _pace(*best):
                break
            apart = self._with_arms_apart(program, attempt)
            if apart is not None and (best is None or _pace(*apart) > _pace(*best)):
                best = apart
        return best

    def _with_arms_apart(self, program: PoseProgram, best: Attempt) -> tuple[PoseProgram, Attempt] | None:
        """The fastest gait near the one that was found whose arms keep apart, and its program."""
        asked, room = self.problem.bounds.arm_distance, ARM_ROOM
        planes: dict[ArmPlace, Plane] = {}
        for number in range(MOST_ARM_ROUNDS):
            gait = program.gait(best.values)
            lacking = asked - least_arm_distance(gait)
            if asked == 0.0 or lacking <= ARM_TOLERANCE:
                break
            self._tell("Keeping arms apart", 0.62 + 0.02 * number, gait)
            if planes and near_arms(gait, asked - NEAR).keys() <= planes.keys():
                # Between the places that have rows the arms come a little nearer.
                room += lacking
            planes |= near_arms(gait, asked + room)
            program = PoseProgram(self.problem, gait.step, ArmRows(asked + room, planes))
            start = program.program.start
            start[: program.own_count] = best.values[: program.own_count]
            weights = FREE if self.problem.is_free else FASTEST
            best = self._run(program)(start, weights, reach=self._reach)
            if not best.converged:
                return None
        return program, best

    def _too_near_at_rest(self) -> str | None:
        """That arms are nearer than asked where the walk begins and ends; None where they are not."""
        asked = self.problem.bounds.arm_distance
        if self.problem.cycles is None or asked == 0.0:
            return None
        gap = float(np.nanmin(arm_gaps(self.problem.model, rest_strokes(self.problem.model)[None])))
        if gap >= asked:
            return None
        return (
            f"The arms of neighbouring legs are {gap * MM:.1f} mm apart in the standard stance, and "
            f"{asked * MM:g} mm are asked (--arm-distance). Ask for less."
        )

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
            weights = FREE if self.problem.is_free else FASTEST
            usual = best.seconds / max(best.iterations, 1) * LENGTHENING_ITERATIONS
            attempt = run(
                best.values,
                weights,
                reach=self._reach,
                forced=forced,
                most_iterations=LENGTHENING_ITERATIONS,
                most_seconds=STALLED * usual,
            )
            if not attempt.converged or _pace(program, attempt) < WORTH * _pace(program, best):
                return best
            best, self._forced = attempt, forced
        return best

    def _gentle(self, program: PoseProgram, best: Attempt) -> Attempt | None:
        """Among gaits of the same step and time the one whose standing feet slip least."""
        self._tell("Looking for the gentlest", 0.85)
        reach = float(best.values[program.reach_place])
        seconds = program.seconds(best.values) * (1.0 + SAME_TIME)
        attempt = self._run(program)(
            best.values, GENTLE, reach=(reach, reach), seconds=seconds, forced=self._forced
        )
        return attempt if attempt.converged else None


Forced = tuple[tuple[int, int, int], ...]
"""(move, motor, sign) of motors that have to go at least `SHORTEST_MOVE`."""


def _pace(program: PoseProgram, attempt: Attempt) -> float:
    return program.gait(attempt.values).pace


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
    moved[program.reach_place] += 8.0 * number
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
