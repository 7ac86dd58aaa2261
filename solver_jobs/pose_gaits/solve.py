"""The fastest pose gait of a problem: several starts, short moves made long, the gentlest of equals."""

import time
from dataclasses import replace

import numpy as np

from core.arrays import Floats
from core.pose_gaits.pace import pace_rank
from core.pose_gaits.pose_check import check_poses
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import PoseProblem
from core.pose_gaits.start_motion import MM, PosesStart
from solver_jobs.pose_gaits.arms_apart import fastest_apart, too_near_at_rest
from solver_jobs.pose_gaits.explain import FARTHEST, NOT_PROVEN, arms_explained, explained
from solver_jobs.pose_gaits.lengthening import lengthened
from solver_jobs.pose_gaits.pose_program import PoseProgram, asked_reach
from solver_jobs.pose_gaits.program import Attempt
from solver_jobs.pose_gaits.runs import FASTEST, FREE, Cancelled, Forced, Report, Runs, pace_of
from solver_jobs.pose_gaits.weights import Weights
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
GENTLE = Weights(time=1e-3, slip=10.0, sway=1e-3)
"""Least slip; among equals least sway."""
SAME_TIME = 1e-4
"""Share of the robot's time that a gentler gait may take more."""
CONVERGED = "Solve_Succeeded"
"""IPOPT's word for an optimum within its tolerance."""


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
    best = [*cancelled, *sorted(solved, key=_result_rank), *failed, results[-1]][0]
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
        "to where it was, or unpin it."
    )
    return replace(asked, explanation=(sentence, NOT_PROVEN))


def _result_rank(result: PoseResult) -> float:
    return 0.0 if result.gait is None else pace_rank(result.gait.pace)


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
    except Cancelled:
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
        self._runs = Runs(problem, report)
        self._begin = time.perf_counter()

    def result(self) -> PoseResult:
        too_near = too_near_at_rest(self.problem)
        if too_near is not None:
            return self.ended(SolveStatus.INFEASIBLE, (too_near,))
        self._runs.tell("Building the program", 0.0)
        program, found = self._found()
        if not found:
            return self.ended(SolveStatus.INFEASIBLE, self._reason(program))
        apart = fastest_apart(self._runs, program, found)
        if apart is None and self._near is not None:
            self._near = None  # other starts may lead to arms that keep apart
            return self.result()
        if apart is None:
            return self.ended(SolveStatus.INFEASIBLE, arms_explained(program.gait(found[0].values)))
        program, best = apart
        best, forced = lengthened(self._runs, program, best)
        gait, check = program.gait(best.values), check_poses(program.gait(best.values))
        gentle = self._gentle(program, best, forced)
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
        self._runs.tell("Looking for the reason", 0.8)
        longest = max(self._longest, key=lambda known: known[1].values[known[0].reach_place], default=None)
        return explained(self.problem, program, self._runs.of(program), longest)

    def _found(self) -> tuple[PoseProgram, list[Attempt]]:
        """The program and its gaits, fastest first: beside the poses that are known, or of several starts."""
        if self._near is not None:
            self._runs.tell("Solving", 0.1)
            program = PoseProgram(self.problem, self._near.step, start=PosesStart(self._near))
            attempt = self._runs.of(program)(
                program.program.start, self._runs.weights, reach=self._runs.reach
            )
            if attempt.converged:
                return program, [attempt]
        program = PoseProgram(self.problem, self.problem.step or STEP_GUESS)
        if self.problem.is_free:
            return program, self._fastest(program)
        self._runs.tell("Solving", 0.1)
        attempt = self._runs.of(program)(program.program.start, FASTEST, reach=self._runs.reach)
        return (program, [attempt]) if attempt.converged else self._of_farthest()

    def _of_farthest(self) -> tuple[PoseProgram, list[Attempt]]:
        """A gait with the step or turn that is set, by way of the longest; none where that is too short.

        Of 60 steps that an even start did not reach, other starts reached none.
        """
        self._runs.tell(f"Looking for the longest {self.problem.way_word}", 0.4)
        program = PoseProgram(self.problem, STEP_GUESS)
        run = self._runs.of(program)
        farthest = run(program.program.start, FARTHEST)
        if not farthest.converged:
            return program, []
        self._longest.append((program, farthest))
        if farthest.values[program.reach_place] < asked_reach(self.problem):
            return program, []
        attempt = run(farthest.values, FASTEST, reach=self._runs.reach)
        return program, [attempt] if attempt.converged else []

    def ended(self, status: SolveStatus, explanation: tuple[str, ...]) -> PoseResult:
        seconds = time.perf_counter() - self._begin
        return PoseResult(status, None, None, False, explanation, self._runs.solve_seconds, seconds)

    def _fastest(self, program: PoseProgram) -> list[Attempt]:
        """With a free step or turn what several starts lead to, the fastest first."""
        run = self._runs.of(program)
        found: list[Attempt] = []
        for number in range(STARTS):
            self._runs.tell(f"Solving, start {number + 1}", 0.1 + 0.2 * number)
            start = _moved_start(program, number)
            if self.problem.cycles is not None:  # a long way from a poor start often fails
                short = run(start, FREE, reach=(LEAST_STEP, STEP_GUESS * MM))
                start = short.values if short.converged else start
            attempt = run(start, FREE)
            if attempt.converged:
                found.append(attempt)
                found.sort(key=lambda one: pace_rank(pace_of(program, one)))
                self._runs.tell(
                    f"Solved, start {number + 1}", 0.1 + 0.2 * number, program.gait(found[0].values)
                )
        return found

    def _gentle(self, program: PoseProgram, best: Attempt, forced: Forced) -> Attempt | None:
        """Among gaits of the same step and time the one whose standing feet slip least."""
        self._runs.tell("Looking for the gentlest", 0.85)
        reach = float(best.values[program.reach_place])
        seconds = program.seconds(best.values) * (1.0 + SAME_TIME)
        attempt = self._runs.of(program)(
            best.values, GENTLE, reach=(reach, reach), seconds=seconds, forced=forced
        )
        return attempt if attempt.converged else None


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
