"""How far a gait can step: bisection on the live tier, then probing upwards with the exact tier.

The solvers are imported where they are called, so that the public face loads none.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from core.checks.made_plan import RULE, is_confirmed, unmade_words
from core.errors import FootfallError
from core.gait.gait import Gait, drawn_timeline, heading_step, motion_problem, with_return
from core.motion.trajectory import Trajectory
from core.problem.motion_problem import PLANE_HEIGHTS, MotionProblem
from core.robot.model import RobotModel
from solver_jobs.results.motion import Iterate, MotionResult, SolveStatus

HEIGHTS = tuple(PLANE_HEIGHTS[0] + 0.0005 * k for k in range(16))
"""Actuator planes at start and goal that are tried, m: the body's bounds in steps of 0.5 mm."""

PHASES = (6, 7, 8, 9, 10, 12, 14, 16, 20)
"""Phase lengths that are tried where they are free, knots."""

STEPS_A_METRE, TURNS_A_DEGREE = 10_000, 10
"""Steps are found to 0.1 mm, turns to 0.1°: both are counted in these units."""

MOST = 1200
"""No gait of these robots gets 120 mm or 120°; where the search begins to close in."""

JUST_ABOVE = (1.02, 1.05, 1.1, 1.2, 1.5, 2.0)
"""Shares of the frontier at which it is asked what is lacking, until something is: the live tier may get a
little further than its quick search, which keeps the body at one height."""

PATIENCE = 45
"""Iterations after which the exact tier is taken to find no motion; one that exists takes 9 to 30."""


@dataclass(frozen=True, eq=False)
class Frontier:
    """The furthest that a gait gets.

    Args:
        gait: the document at its frontier.
        reach: the largest step, m, or turn, rad, an iteration; 0 where there is none.
        turns: whether the reach is a turn.
        live_reach: the largest that the live tier finds.
        confirmed: whether the exact tier has a motion, which the checker confirms, at `reach`.
        limited_by: families of constraints that are lacking just above, the worst first.
        explanation: the same in sentences.
        motion: the motion at `reach`; None where there is none.
    """

    gait: Gait
    reach: float
    turns: bool
    live_reach: float
    confirmed: bool
    limited_by: tuple[str, ...]
    explanation: tuple[str, ...]
    motion: Trajectory | None


@dataclass(eq=False)
class FrontierSearch:
    """Looks for the frontier of one gait; not for several threads at once.

    The step goes along the gait's own, or along its heading where it has none; a gait that only turns is
    asked how far it turns. A longer step is taken to be harder than a shorter one.

    Args:
        gait: everything but how far it goes.
        model: its robot.
        heights: actuator planes at start and goal that may be chosen, m; empty for the gait's own.
        free_phases: whether the phases may be longer than the gait's.
        free_return: whether the closing stance is as long as the turn back takes.
        exact: whether the exact tier confirms and probes further.
    """

    gait: Gait
    model: RobotModel
    heights: tuple[float, ...] = HEIGHTS
    free_phases: bool = False
    free_return: bool = False
    exact: bool = True
    _last: Trajectory | None = field(default=None, init=False)

    @property
    def turns(self) -> bool:
        """Whether the gait only turns."""
        dx, dy, yaw = self.gait.step
        return yaw != 0.0 and dx == dy == 0.0

    def reach(self, count: int) -> float:
        """A number of units as a step, m, or turn, rad."""
        return float(np.radians(count / TURNS_A_DEGREE)) if self.turns else count / STEPS_A_METRE

    def run(self) -> Frontier:
        """Finds the frontier."""
        if self.model.is_coupled and (unmade := self._unmade()):
            return unmade
        live, gait = self._live()
        count, gait = self._exact(live, gait) if self.exact else (live, gait)
        lacking = self._lacking(gait, count)
        best = self._at(gait, count)
        return Frontier(
            gait=best,
            reach=self.reach(count),
            turns=self.turns,
            live_reach=self.reach(live),
            confirmed=self.exact and count > 0,
            limited_by=tuple(dict.fromkeys(lack.family for lack in lacking.lacks)),
            explanation=lacking.explanation,
            motion=self._last if self.exact or count == 0 else self._start(self._problem(best)),
        )

    def _unmade(self) -> Frontier | None:
        """No frontier, where shared motors do not make the gait's motion, or that of a shorter step."""
        dx, dy, yaw = self.gait.step
        asked = abs(np.degrees(yaw)) * TURNS_A_DEGREE if self.turns else np.hypot(dx, dy) * STEPS_A_METRE
        for count in (round(float(asked)), round(float(asked) / 2), 10, 1):
            tried = self._at(self.gait, count)
            motion = self._start(self._problem(tried))
            words = "" if motion is None else unmade_words(self.model, motion)
            if words:
                return Frontier(tried, 0.0, self.turns, 0.0, False, (RULE,), (words,), None)
        return None

    def _at(self, gait: Gait, count: int) -> Gait:
        """The gait with a step of so many units."""
        reach = self.reach(count)
        dx, dy, yaw = self.gait.step
        if self.turns:
            step = (0.0, 0.0, float(np.copysign(reach, yaw)))
        elif length := float(np.hypot(dx, dy)):
            step = (dx * reach / length, dy * reach / length, yaw)
        else:
            step = heading_step(gait.orientation, reach)
        stepping = replace(gait, step=step)
        return with_return(stepping, self.model) if self.free_return else stepping

    def _problem(self, gait: Gait) -> MotionProblem | None:
        try:
            return motion_problem(gait, self.model)
        except FootfallError:
            return None

    def _live(self) -> tuple[int, Gait]:
        """The furthest of all heights and phase lengths by the live tier."""
        best, chosen = 0, self.gait
        for phases in self._phase_lengths():
            before = best
            for gait in self._raised(phases):
                # Only what gets further than the best so far is worth a bisection.
                if not self._live_works(gait, best + 1):
                    continue
                works = partial(self._live_works, gait)
                best, chosen = _largest(works, best + 1, MOST), gait
            if best == before > 0:
                break
        return best, chosen

    def _raised(self, gait: Gait) -> Iterable[Gait]:
        """The gait at every height, its own or the nearest first."""
        if not self.heights:
            yield gait
        for height in sorted(self.heights, key=lambda h: (round(abs(h - gait.options.plane_height), 6), h)):
            yield gait.with_options(plane_height=height, end_plane_height=None)

    def _phase_lengths(self) -> Iterable[Gait]:
        yield self.gait
        yield from self._longer(self.gait)

    def _longer(self, gait: Gait) -> Iterable[Gait]:
        """The gait with longer phases, where they are free."""
        if self.free_phases:
            for knots in (n for n in PHASES if n > gait.options.phase_knots):
                changed = gait.with_options(phase_knots=knots)
                yield replace(changed, timeline=drawn_timeline(changed))

    def _live_works(self, gait: Gait, count: int) -> bool:
        from solver_jobs.live.solve import quick_motion

        problem = self._problem(self._at(gait, count))
        motion = None if problem is None else quick_motion(problem)
        return problem is not None and motion is not None and is_confirmed(problem, motion)

    def _lacking(self, gait: Gait, count: int) -> MotionResult:
        """What the live tier says just above the frontier."""
        from solver_jobs.live.solve import solve_live

        counts = [max(count + 1, int(np.ceil(count * share))) for share in JUST_ABOVE]
        for above in counts:
            result = solve_live(motion_problem(self._at(gait, above), self.model))
            if result.status is not SolveStatus.SOLVED:
                break
        return result

    def _exact(self, count: int, gait: Gait) -> tuple[int, Gait]:
        """The furthest that the exact tier confirms, looked for from the live tier's answer."""
        low = next((n for n in _downwards(count) if self._exact_works(gait, n)), 0)
        if low < count:
            return low, gait
        low = self._further(low, gait)
        for longer in self._longer(gait):
            if not self._exact_works(longer, low + 1):
                break
            low, gait = self._further(low + 1, longer), longer
        return low, gait

    def _further(self, low: int, gait: Gait) -> int:
        """The largest count that the exact tier confirms; it does `low`."""
        stride = 1
        while self._exact_works(gait, low + stride):
            low, stride = low + stride, 2 * stride
        return _largest(partial(self._exact_works, gait), low, low + stride)

    def _exact_works(self, gait: Gait, count: int) -> bool:
        from solver_jobs.nlp.motion_nlp import solve_motion

        problem = self._problem(self._at(gait, count))
        if problem is None:
            return False
        result = solve_motion(problem, _with_patience, self._start(problem))
        works = result.status is SolveStatus.SOLVED and is_confirmed(problem, result.trajectory)
        if works:
            self._last = result.trajectory
        return works

    def _start(self, problem: MotionProblem | None) -> Trajectory | None:
        """The last motion found, or the live tier's."""
        from solver_jobs.live.solve import quick_motion

        if problem is None:
            return None
        if self._last is not None and self._last.knot_count == problem.knot_count:
            return self._last
        return quick_motion(problem)


def _largest(works: Callable[[int], bool], low: int, high: int) -> int:
    """The largest count that works, by bisection: `low` does and `high` does not."""
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if works(middle) else (low, middle)
    return low


def _with_patience(iterate: Iterate) -> bool:
    return iterate.number < PATIENCE


def _downwards(count: int) -> Iterable[int]:
    """The count, then smaller ones in growing strides, above 0."""
    stride = 0
    while count - stride > 0:
        yield count - stride
        stride = 2 * stride + 1
