"""Trials of changed gaits by the live tier: does it work, and up to which value?"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

import numpy as np

from core.errors import FootfallError
from core.gait.gait import Gait, motion_problem
from core.robot.model import RobotModel
from solver_jobs.results.motion import Lack, MotionResult, SolveStatus

SIDES = 32
"""Edges of the polygons that stand for discs here: within half a per cent."""


class InterruptedSearchError(Exception):
    """Something else is asked meanwhile."""


@dataclass(frozen=True, eq=False)
class Trial:
    """Tries changed gaits.

    Args:
        model: the robot.
        go_on: asked before each try; false ends the search.
    """

    model: RobotModel
    go_on: Callable[[], bool]
    _known: list[tuple[Gait, bool]] = field(default_factory=list)

    def works(self, gait: Gait) -> bool:
        """Whether the live tier solves a gait quickly and the checker confirms it.

        Raises:
            InterruptedSearchError: the search shall end.
        """
        if not self.go_on():
            raise InterruptedSearchError
        known = next((works for tried, works in self._known if tried == gait), None)
        if known is None:
            known = self._quick(gait)
            self._known.append((gait, known))
        return known

    def _quick(self, gait: Gait) -> bool:
        from core.problem.motion_check import check_motion
        from solver_jobs.live.solve import quick_motion

        try:
            problem = motion_problem(gait, self.model)
        except FootfallError:
            return False
        motion = quick_motion(problem, SIDES)
        return motion is not None and check_motion(problem, motion).confirmed

    def solved(self, gait: Gait) -> MotionResult | None:
        """A gait's motion by the whole live tier; None where there is none that the checker confirms."""
        from core.problem.motion_check import check_motion
        from solver_jobs.live.solve import solve_live

        try:
            problem = motion_problem(gait, self.model)
        except FootfallError:
            return None
        result = solve_live(problem)
        confirmed = result.status is SolveStatus.SOLVED and check_motion(problem, result.trajectory).confirmed
        return result if confirmed else None

    def lacks(self, gait: Gait) -> tuple[Lack, ...]:
        """What the live tier finds missing in a gait."""
        from solver_jobs.live.solve import solve_live

        try:
            return solve_live(motion_problem(gait, self.model)).lacks
        except FootfallError:
            return ()

    def best_margin(self, gait: Gait, most: float) -> float | None:
        """About the largest margin of a gait up to `most`, m; None where there is none."""
        from solver_jobs.live.best_margin import best_margin

        try:
            return best_margin(motion_problem(gait.with_options(margin=most), self.model), SIDES)
        except FootfallError:
            return None

    def largest(
        self,
        least: float,
        most: float,
        change: Callable[[float], Gait],
        unit: float,
        near: float | None = None,
    ) -> float | None:
        """The largest value that works: `most`, `least`, or whole units between; None where none works.

        Args:
            least: not less than this.
            most: not more than this.
            change: the gait with a value.
            unit: of the values between.
            near: where the answer is likely; only there is it looked for first.
        """
        first, last = int(np.floor(least / unit + 1e-9)), int(np.ceil(most / unit - 1e-9))

        def value(number: int) -> float:
            return most if number >= last else least if number <= first else number * unit

        # `low` works and `high` does not, or they lie beyond the ends.
        low, high = first - 1, last + 1
        number = last if near is None else int(np.clip(near // unit, first, last))
        stride = max(last - first, 1) if near is None else 1
        while high - low > 1:
            low, high = (number, high) if self.works(change(value(number))) else (low, number)
            if high > last:
                number = min(low + stride, last)
            elif low < first:
                number = max(high - stride, first)
            else:
                number = (low + high) // 2
            stride *= 2
        return None if low < first else value(low)

    def first(self, gaits: Iterable[Gait | None]) -> Gait | None:
        """The first gait that works."""
        return next((gait for gait in gaits if gait is not None and self.works(gait)), None)
