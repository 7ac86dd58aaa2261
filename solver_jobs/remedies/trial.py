"""Trials of changed gaits with the live tier: whether a gait works, and the largest value that works."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

import numpy as np

from core.errors import FootfallError
from core.gait.gait import Gait, motion_problem
from core.robot.model import RobotModel
from solver_jobs.results.motion import Lack, MotionResult, SolveStatus

SIDES = 32
"""Edges of the polygons that approximate discs in trials; the error is below half a per cent."""


class InterruptedSearchError(Exception):
    """The search was ended before it was complete."""


@dataclass(frozen=True, eq=False)
class Trial:
    """Tries changed gaits.

    Args:
        model: the robot.
        go_on: called before each trial; False ends the search.
    """

    model: RobotModel
    go_on: Callable[[], bool]
    _known: list[tuple[Gait, bool]] = field(default_factory=list)

    def works(self, gait: Gait) -> bool:
        """Whether the live tier's quick solve finds a motion that the checker confirms.

        Raises:
            InterruptedSearchError: `go_on` returned False.
        """
        if not self.go_on():
            raise InterruptedSearchError
        known = next((works for tried, works in self._known if tried == gait), None)
        if known is None:
            known = self._quick(gait)
            self._known.append((gait, known))
        return known

    def _quick(self, gait: Gait) -> bool:
        from core.checks.made_plan import is_confirmed
        from solver_jobs.live.solve import quick_motion

        try:
            problem = motion_problem(gait, self.model)
        except FootfallError:
            return False
        motion = quick_motion(problem, SIDES)
        return motion is not None and is_confirmed(problem, motion)

    def solved(self, gait: Gait) -> MotionResult | None:
        """The motion of a gait by the full live tier; None if the checker confirms none."""
        from core.checks.made_plan import is_confirmed
        from solver_jobs.live.solve import solve_live

        try:
            problem = motion_problem(gait, self.model)
        except FootfallError:
            return None
        result = solve_live(problem)
        is_solved = result.status is SolveStatus.SOLVED and is_confirmed(problem, result.trajectory)
        return result if is_solved else None

    def lacks(self, gait: Gait) -> tuple[Lack, ...]:
        """What a gait lacks for a motion, as found by the live tier."""
        from solver_jobs.live.solve import solve_live

        try:
            return solve_live(motion_problem(gait, self.model)).lacks
        except FootfallError:
            return ()

    def best_margin(self, gait: Gait, most: float) -> float | None:
        """Estimate of the largest margin of a gait, at most `most`, m; None if there is none."""
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
        works: Callable[[Gait], bool] | None = None,
    ) -> float | None:
        """The largest value that works: `most`, `least`, or a multiple of `unit` between; None if none works.

        Args:
            least: the least value.
            most: the largest value.
            change: returns the gait with a value.
            unit: step between two values.
            near: a likely result, at which the search starts; None to start at `most`.
            works: whether a gait is good; None for `Trial.works`.
        """
        is_good = self.works if works is None else works
        first, last = int(np.floor(least / unit + 1e-9)), int(np.ceil(most / unit - 1e-9))

        def value(number: int) -> float:
            return most if number >= last else least if number <= first else round(number * unit, 9)

        # Invariant: `low` works or lies below the range; `high` fails or lies above it.
        low, high = first - 1, last + 1
        number = last if near is None else int(np.clip(near // unit, first, last))
        stride = max(last - first, 1) if near is None else 1
        while high - low > 1:
            low, high = (number, high) if is_good(change(value(number))) else (low, number)
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
