"""What would make an infeasible gait feasible: single changes, each tried by the live tier first."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import permutations

import numpy as np

from core.errors import FootfallError
from core.gait.gait import Gait, drawn_timeline, is_drawn, motion_problem
from core.gait.options import GaitOptions
from core.motion.contact_timeline import Swing
from core.problem.motion_problem import MotionLimits, Workspace
from core.robot.model import RobotModel

HALVINGS = 7
"""Rounds of bisection: to a hundredth of the range."""

MOST_PHASE_KNOTS = 12
"""Longest phases that are tried."""

HEIGHT_STEP = 0.0005
"""Between body heights that are tried, m."""

SIDES = 32
"""Edges of the polygons that stand for discs here: within half a per cent."""

MM = 1000.0


@dataclass(frozen=True, eq=False)
class Remedy:
    """A changed gait that the live tier solves.

    Args:
        label: text of a button.
        sentence: what it does.
        gait: the changed document.
    """

    label: str
    sentence: str
    gait: Gait


@dataclass(frozen=True, eq=False)
class RemedySearch:
    """What a search for remedies found, and whether it was not cut short."""

    remedies: tuple[Remedy, ...]
    complete: bool


def find_remedies(gait: Gait, model: RobotModel, go_on: Callable[[], bool]) -> RemedySearch:
    """Looks for single changes that make a gait feasible, the mildest of each kind.

    Args:
        gait: an infeasible gait.
        model: its robot.
        go_on: asked before each try; false ends the search with what was found.
    """
    found: list[Remedy] = []
    looks = (_swings, _step, _margin, _height, _phases, _clearance, _closing, _workspace, _order)
    try:
        for look in looks:
            if (remedy := look(gait, _Trial(model, go_on))) is not None:
                found.append(remedy)
    except _InterruptedError:
        return RemedySearch(tuple(found), complete=False)
    return RemedySearch(tuple(found), complete=True)


class _InterruptedError(Exception):
    """Something else is asked meanwhile."""


@dataclass(frozen=True, eq=False)
class _Trial:
    model: RobotModel
    go_on: Callable[[], bool]

    def works(self, gait: Gait) -> bool:
        """Whether the live tier solves a gait quickly and the checker confirms it."""
        from core.problem.motion_check import check_motion
        from solver_jobs.live.solve import quick_motion

        if not self.go_on():
            raise _InterruptedError
        try:
            problem = motion_problem(gait, self.model)
        except FootfallError:
            return False
        motion = quick_motion(problem, SIDES)
        return motion is not None and check_motion(problem, motion).confirmed

    def largest(self, most: float, change: Callable[[float], Gait], unit: float) -> float | None:
        """The largest value below `most`, in whole units, that works; None where not even 0 does."""
        if not self.works(change(0.0)):
            return None
        low, high = 0.0, most
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            low, high = (middle, high) if self.works(change(middle)) else (low, middle)
        rounded = float(np.floor(low / unit)) * unit
        return rounded if rounded > 0 and self.works(change(rounded)) else None

    def first(self, candidates: Iterable[tuple[float, Gait]]) -> tuple[float, Gait] | None:
        """The first candidate that works."""
        return next(((value, gait) for value, gait in candidates if self.works(gait)), None)


def _redrawn(gait: Gait) -> Gait:
    return replace(gait, timeline=drawn_timeline(gait))


def _is_drawn(gait: Gait) -> bool:
    """Whether the timeline is that of its order and phase lengths, with nothing locked."""
    return is_drawn(gait) and not bool(gait.timeline.locked.any())


def _swings(gait: Gait, trial: _Trial) -> Remedy | None:
    """Lengthens swings that are shorter than others, into the stance after them and then before them."""
    lengths = [swing.last - swing.first + 1 for swing in _whole_swings(gait)]
    if not lengths or min(lengths) == max(lengths):
        return None
    longer = range(min(lengths) + 1, max(lengths) + 1)
    found = trial.first((n, _with_swings(gait, n)) for n in longer)
    if found is None:
        return None
    count = int(found[0])
    words = f"It works where every swing lasts at least {count} knots."
    return Remedy(f"Swings of {count} knots", words, found[1])


def _whole_swings(gait: Gait) -> list[Swing]:
    """Swings of feet that stand before and after them, and are not held up there."""
    first, last = gait.held.start, gait.timeline.sample_count - 1
    return [
        swing
        for swing in gait.timeline.swings()
        if not (swing.first == 0 and swing.foot + 1 in first)
        and not (swing.last == last and swing.foot + 1 in gait.held.end)
    ]


def _with_swings(gait: Gait, least: int) -> Gait:
    stance, locked = np.array(gait.timeline.stance), gait.timeline.locked
    for swing in _whole_swings(gait):
        row, free = stance[swing.foot], ~locked[swing.foot]
        first, last = swing.first, swing.last
        while (
            last - first + 1 < least
            and last + 2 < len(row)
            and row[last + 1 : last + 3].all()
            and free[last + 1]
        ):
            last += 1
        while last - first + 1 < least and first > 1 and row[first - 2 : first].all() and free[first - 1]:
            first -= 1
        row[first : last + 1] = False
    return replace(gait, timeline=replace(gait.timeline, stance=stance))


def _step(gait: Gait, trial: _Trial) -> Remedy | None:
    length = float(np.hypot(*gait.step[:2]))
    turns = abs(gait.step[2])
    whole, unit = (length, 1e-4) if length > 0 else (turns, np.radians(0.5))
    if whole == 0.0:
        return None

    def scaled(value: float) -> Gait:
        dx, dy, yaw = (part * value / whole for part in gait.step)
        return replace(gait, step=(dx, dy, yaw))

    best = trial.largest(whole, scaled, unit)
    if best is None:
        return None
    if length > 0:
        text = f"{best * MM:.1f} mm"
        return Remedy(f"Step {text}", f"The largest step found that works is {text}.", scaled(best))
    text = f"{np.degrees(best):.1f}°"
    return Remedy(f"Turn {text}", f"The largest turn found that works is {text}.", scaled(best))


def _margin(gait: Gait, trial: _Trial) -> Remedy | None:
    if gait.options.margin <= 0:
        return None
    found = trial.largest(gait.options.margin, lambda margin: gait.with_options(margin=margin), 1e-4)
    best = 0.0 if found is None else found
    changed = gait.with_options(margin=best)
    if not trial.works(changed):
        return None
    text = f"{best * MM:.1f} mm"
    return Remedy(f"Margin {text}", f"A stability margin of {text} can be kept.", changed)


def _height(gait: Gait, trial: _Trial) -> Remedy | None:
    lowest, highest = MotionLimits().plane_height
    now = gait.options.plane_height
    heights = np.arange(lowest, highest + HEIGHT_STEP / 2, HEIGHT_STEP)
    near = sorted((float(h) for h in heights if abs(h - now) > 1e-9), key=lambda h: abs(h - now))
    found = trial.first((h, gait.with_options(plane_height=h, end_plane_height=None)) for h in near)
    if found is None:
        return None
    text = f"{found[0] * MM:.1f} mm"
    return Remedy(f"Body height {text}", f"It works with the actuator plane at {text}.", found[1])


def _phases(gait: Gait, trial: _Trial) -> Remedy | None:
    if not _is_drawn(gait):
        return None
    longer = range(gait.options.phase_knots + 1, MOST_PHASE_KNOTS + 1)
    found = trial.first((n, _redrawn(gait.with_options(phase_knots=n))) for n in longer)
    if found is None:
        return None
    count = int(found[0])
    return Remedy(
        f"Phases of {count} knots",
        f"It works where every phase lasts {count} knots, {count * gait.timeline.sample_time:.1f} s.",
        found[1],
    )


def _clearance(gait: Gait, trial: _Trial) -> Remedy | None:
    found = trial.largest(gait.options.clearance, lambda value: gait.with_options(clearance=value), 1e-4)
    if found is None:
        return None
    text = f"{found * MM:.1f} mm"
    return Remedy(f"Clearance {text}", f"Feet can rise {text}.", gait.with_options(clearance=found))


def _closing(gait: Gait, trial: _Trial) -> Remedy | None:
    default = GaitOptions().closing_knots
    if gait.options.closing_knots >= default or not _is_drawn(gait):
        return None
    changed = _redrawn(gait.with_options(closing_knots=default))
    if not trial.works(changed):
        return None
    words = f"It works with {default} knots of stance after the last swing."
    return Remedy(f"Closing stance of {default} knots", words, changed)


def _workspace(gait: Gait, trial: _Trial) -> Remedy | None:
    changed = gait.with_options(workspace=Workspace.STROKE)
    if gait.options.workspace is Workspace.STROKE or not trial.works(changed):
        return None
    words = "It works within what the motors truly reach, which is more than the paper's cylinder."
    return Remedy("Workspace stroke", words, changed)


def _order(gait: Gait, trial: _Trial) -> Remedy | None:
    if not _is_drawn(gait) or len(gait.order) > 4:
        return None
    found = trial.first(_reordered(gait))
    if found is None:
        return None
    text = "-".join(map(str, found[1].order))
    return Remedy(f"Order {text}", f"The same step works when the feet step in the order {text}.", found[1])


def _reordered(gait: Gait) -> Iterator[tuple[float, Gait]]:
    for number, order in enumerate(permutations(sorted(gait.order))):
        if order != gait.order:
            changed = replace(gait, order=order)
            yield float(number), replace(changed, timeline=drawn_timeline(changed))
