"""The runs of IPOPT in one search: how they are called, what is reported between them, how one cancels."""

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from core.arrays import Floats
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import SHORTEST_MOVE, PoseProblem
from core.pose_gaits.start_motion import MM
from solver_jobs.pose_gaits.pose_program import PoseProgram, asked_reach
from solver_jobs.pose_gaits.program import MOST_ITERATIONS, Attempt
from solver_jobs.pose_gaits.weights import SLACKS, Weights
from solver_jobs.results.pose import PoseProgress

FASTEST = Weights(time=1.0, pace=0.0)
FREE = Weights(pace=1.0)

Report = Callable[[PoseProgress], bool]
"""Tells what is known; false where the search is to end."""
Forced = tuple[tuple[int, int, int], ...]
"""(move, motor, sign) of motors that have to go at least `SHORTEST_MOVE`."""


class Cancelled(Exception):  # noqa: N818 - it is no error
    """Somebody ended the search."""


class Runs:
    """The runs of a search; it keeps what is known for its reports.

    Args:
        problem: what is asked.
        report: called between and within the stages.
    """

    def __init__(self, problem: PoseProblem, report: Report) -> None:
        self.problem = problem
        self.solve_seconds = 0.0
        self._report = report
        self._progress = PoseProgress("Building the program", 0.0)

    def tell(self, stage: str, done: float, gait: PoseGait | None = None) -> None:
        """Reports a stage and the fastest gait yet.

        Raises:
            Cancelled: the search is to end.
        """
        known = self._progress
        if gait is not None:
            known = replace(known, speed=gait.speed, turn_rate=gait.turn_rate)
        self._progress = replace(known, stage=stage, done=done)
        self._require_wanted()

    def _keep_on(self) -> bool:
        return self._report(self._progress)

    def _require_wanted(self) -> None:
        if not self._keep_on():
            raise Cancelled

    @property
    def weights(self) -> Weights:
        """The cost of the fastest gait."""
        return FREE if self.problem.is_free else FASTEST

    @property
    def reach(self) -> tuple[float, float] | None:
        """Least and most of the step or turn that is set, mm (`asked_reach`); None where it is free."""
        reach = asked_reach(self.problem)
        return None if self.problem.is_free else (reach, reach)

    def of(self, program: PoseProgram) -> Callable[..., Attempt]:
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
            )
            self.solve_seconds += attempt.seconds
            if attempt.status == "User_Requested_Stop":
                self._require_wanted()
            return attempt

        return run


def pace_of(program: PoseProgram, attempt: Attempt) -> float:
    """Speed of a solution, m/s, or on the spot its turn, rad/s."""
    return program.gait(attempt.values).pace
