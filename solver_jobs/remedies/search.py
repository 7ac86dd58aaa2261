"""What would make a drawing walk: up to four changes, best first, each tried by the live tier.

Which changes help, in which order, was measured on random drawings: a motion runs along the margin that is
asked, so that every remedy asks for the robot's own margin first (docs/remedies.md).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import partial

import numpy as np

from core.errors import FootfallError
from core.gait.gait import Gait, drawn_timeline, with_iterations
from core.patterns.limits import needed_swing
from core.problem.motion_problem import MotionLimits, Workspace
from core.robot.model import RobotModel
from solver_jobs.remedies.layout import (
    CLOSING,
    Item,
    items_of,
    longer,
    one_after_the_other,
    with_ends,
    with_forgotten_feet,
)
from solver_jobs.remedies.trial import InterruptedSearchError, Trial

MOST = 4
"""Remedies that a person is offered."""

SMALL_STEP, SMALL_TURN = 0.002, np.radians(1.0)
"""Where this works, m and rad, what is wrong is the step."""

LEAST_STEP, LEAST_TURN = 0.005, np.radians(2.0)
"""No smaller step is offered, m and rad."""

USUAL_MARGIN = 0.003
"""Where this margin works, m, what is wrong is the margin."""

UNIT_STEP, UNIT_TURN, UNIT_MARGIN = 1e-4, np.radians(0.5), 1e-4
"""Whole units of what is offered, m and rad."""

GAPS = (1, 2, 3, 4, 5, 6, 8)
LONG_GAPS = (1, 2, 3, 4, 5, 6, 8, 10, 12)
"""Samples of stance between two swings, in the same time and in a longer gait."""

LONG_SWING = 5
"""Samples of pauses and swings where a short gait does not do."""

SHORT_SWING = 4
"""Swings that were made this short or shorter tip more easily."""

HEIGHT_STEP = 0.0005
"""Between body heights that are tried, m."""

MM = 1000.0


class RemedyKind(StrEnum):
    """What a remedy changes."""

    ONE_BY_ONE = "one_by_one"
    LONGER = "longer"
    STEP = "step"
    ITERATIONS = "iterations"
    MARGIN = "margin"
    ANEW = "anew"
    WORKSPACE = "workspace"
    HEIGHT = "height"
    CLEARANCE = "clearance"
    NO_MARGIN = "no_margin"


@dataclass(frozen=True, eq=False)
class Remedy:
    """A changed gait that the live tier solves.

    Args:
        kind: what is changed.
        label: text of a button.
        sentence: what it does, and its price.
        gait: the changed document.
        caution: why it comes last; empty for every other one.
    """

    kind: RemedyKind
    label: str
    sentence: str
    gait: Gait
    caution: str = ""


@dataclass(frozen=True, eq=False)
class RemedySearch:
    """What a search for remedies found, best first, and whether it was not cut short."""

    remedies: tuple[Remedy, ...]
    complete: bool


def find_remedies(gait: Gait, model: RobotModel, go_on: Callable[[], bool]) -> RemedySearch:
    """Looks for changes that make a gait walk.

    Args:
        gait: one that has no motion, or one that tips.
        model: its robot.
        go_on: asked before each try; false ends the search with what was found.
    """
    search = _Search(gait, model, Trial(model, go_on))
    found: list[Remedy] = []
    complete = True
    try:
        for remedy in search.remedies():
            if not any(remedy.label == other.label or remedy.gait == other.gait for other in found):
                found.append(remedy)
    except InterruptedSearchError:
        complete = False
    return RemedySearch(tuple(sorted(found, key=search.rank)[:MOST]), complete)


class _Search:
    """One gait's remedies as they are found, and how good each is."""

    def __init__(self, gait: Gait, model: RobotModel, trial: Trial) -> None:
        self._asked = gait
        self._model = model
        self._trial = trial
        self._raised = max(gait.options.margin, model.margin)
        self._mended = with_forgotten_feet(with_ends(gait))
        self._found: list[Remedy] = []

    def remedies(self) -> Iterator[Remedy]:
        """Every change that works, the likely ones first."""
        for remedy in self._candidates():
            if remedy is not None:
                self._found.append(remedy)
                yield remedy

    def rank(self, remedy: Remedy) -> tuple[bool, bool, float]:
        """Smaller is better: caution and too small a margin last; then what is lost, and how much changes."""
        asked, gait = self._asked, remedy.gait
        way = _way(asked)
        lost_way = 0.0 if way == 0 else max(0.0, 1.0 - _way(gait) / way)
        margin = asked.options.margin
        lost_margin = 0.0 if margin == 0 else max(0.0, 1.0 - gait.options.margin / margin)
        low = gait.options.margin < self._model.margin
        return bool(remedy.caution), low, lost_way + lost_margin + 0.3 * self._effort(gait)

    def _effort(self, gait: Gait) -> float:
        """Share of the drawing that changes."""
        before, after = self._asked.timeline, gait.timeline
        if before.sample_count != after.sample_count:
            return 0.15 + abs(after.sample_count - before.sample_count) / before.sample_count
        changed = int((before.stance != after.stance).sum())
        swings = after.swings()
        lengths = {swing.foot: swing.last - swing.first + 1 for swing in before.swings()}
        short = [s for s in swings if s.last - s.first + 1 <= min(SHORT_SWING, lengths.get(s.foot, 0) - 1)]
        return changed / max(2 * int((~before.stance).sum()), 1) + len(short) / max(len(swings), 1)

    def _candidates(self) -> Iterator[Remedy | None]:
        if self._mended is not self._asked:
            yield self._ends()
        step = self._scaled(self._mended, SMALL_TURN if self._turns else SMALL_STEP)
        if self._at_best_margin(step) is not None:
            yield from self._for_step()
        elif self._trial.works(_margin(self._mended, min(self._asked.options.margin, USUAL_MARGIN))):
            yield from self._for_margin()
        else:
            yield from self._for_shape()
            yield self._no_margin()
        if self._good < 2:
            yield from self._fallbacks()
        yield from self._single_changes()

    @property
    def _good(self) -> int:
        """Remedies found with the robot's own margin."""
        return sum(remedy.gait.options.margin >= self._model.margin for remedy in self._found)

    @property
    def _turns(self) -> bool:
        return _length(self._asked) == 0 and self._asked.step[2] != 0

    def _ends(self) -> Remedy | None:
        gait = self._at_best_margin(self._mended)
        words = "Every foot stands or swings to its end."
        return None if gait is None else self._remedy(RemedyKind.LONGER, "Mend the drawing", words, gait)

    def _for_shape(self) -> Iterator[Remedy | None]:
        """Overlaps, swings that are too short."""
        found: set[RemedyKind] = set()
        for items in self._item_lists():
            for kind, change in (
                (RemedyKind.ONE_BY_ONE, self._one_by_one),
                (RemedyKind.LONGER, self._longer),
            ):
                if kind not in found and (remedy := change(items)) is not None:
                    found.add(kind)
                    yield remedy

    def _item_lists(self) -> list[list[Item]]:
        """Swings that may stay beside each other together first, then every swing by itself."""
        apart = items_of(self._mended)
        if self._mended.timeline.leg_count <= 4:
            return [apart]
        stands = np.asarray(self._mended.timeline.stance.sum(axis=0) >= 3)
        for lack in self._trial.lacks(self._mended):
            stands[lack.first : lack.last + 1] = False
        together = items_of(self._mended, stands)
        return [apart] if len(together) == len(apart) else [together, apart]

    def _one_by_one(self, items: list[Item]) -> Remedy | None:
        gait = self._first_at_best_margin([one_after_the_other(self._mended, items, gap) for gap in GAPS])
        if gait is None:
            return None
        words = f"{_order_words(gait)}, in the same time."
        return self._remedy(RemedyKind.ONE_BY_ONE, "One foot after the other", words, gait)

    def _longer(self, items: list[Item], gaps: tuple[int, ...] = LONG_GAPS, least: int = 0) -> Remedy | None:
        gait = self._first_at_best_margin([longer(self._mended, items, gap, least) for gap in gaps])
        return None if gait is None else self._longer_remedy(gait)

    def _longer_remedy(self, gait: Gait) -> Remedy:
        words = f"{_order_words(gait)}; {_duration(gait)} instead of {_duration(self._asked)}."
        return self._remedy(RemedyKind.LONGER, "Same swings, longer gait", words, gait)

    def _for_step(self) -> Iterator[Remedy | None]:
        """Steps that are too long."""
        shorter = self._shorter_step(self._mended, self._raised)
        if shorter is not None:
            yield self._step_remedy(shorter, "The largest that works for this drawing.")
        yield self._more_iterations()
        if self._asked.options.margin > self._model.margin:
            yield self._largest_margin(self._mended)
        yield self._slower()

    def _shorter_step(self, gait: Gait, margin: float) -> Gait | None:
        """The gait with the largest step, or turn, that works; not less than one that is worth it."""
        size = self._size(gait)
        if size == 0.0:
            return None
        least, unit = (LEAST_TURN, UNIT_TURN) if self._turns else (LEAST_STEP, UNIT_STEP)
        for asked in dict.fromkeys((margin, self._asked.options.margin)):
            safe = _margin(gait, asked)
            found = self._trial.largest(min(least, size), size, partial(self._scaled, safe), unit)
            if found is not None:
                return self._scaled(safe, found)
        return None

    def _step_remedy(self, gait: Gait, words: str) -> Remedy:
        size = self._size(gait)
        text = f"turn {np.degrees(size):.1f}°" if self._turns else f"step {size * MM:.1f} mm"
        return self._remedy(RemedyKind.STEP, text.capitalize(), words, gait)

    def _size(self, gait: Gait) -> float:
        """Length of the step, m; of a gait that only turns, its angle, rad."""
        return abs(gait.step[2]) if self._turns else _length(gait)

    def _scaled(self, gait: Gait, value: float) -> Gait:
        """The gait with another length of step, or another turn."""
        size = self._size(gait)
        if size in (0.0, value):
            return gait
        dx, dy, yaw = (part * value / size for part in gait.step)
        return replace(gait, step=(dx, dy, yaw))

    def _more_iterations(self) -> Remedy | None:
        """The same way in two or three times as many iterations."""
        for times in (2, 3):
            count = self._mended.iterations * times
            try:
                repeated = with_iterations(self._mended, count)
            except FootfallError:
                return None
            dx, dy, yaw = (part / times for part in self._mended.step)
            gait = self._at_best_margin(replace(repeated, step=(dx, dy, yaw)))
            if gait is not None:
                words = f"The same way; {_duration(gait)} instead of {_duration(self._asked)}."
                return self._remedy(RemedyKind.ITERATIONS, f"{count} iterations", words, gait)
        return None

    def _slower(self) -> Remedy | None:
        """Pauses and swings of five samples or more, and the largest step with them."""
        items = items_of(self._mended)
        for least in range(LONG_SWING, 9):
            slow = longer(self._mended, items, LONG_SWING, least)
            if slow is None:
                return None
            found = self._at_best_margin(slow)
            if found is not None:
                return self._longer_remedy(found)
        return self._with_longer_swings(self._raised)

    def _with_longer_swings(self, margin: float) -> Remedy | None:
        """Pauses and swings of five samples or more with the largest step that works then."""
        slow = longer(self._mended, items_of(self._mended), LONG_SWING, LONG_SWING)
        gait = None if slow is None else self._shorter_step(slow, margin)
        if gait is None:
            return None
        if _way(gait) >= _way(self._asked):
            return self._longer_remedy(gait)
        steps = [self._size(found.gait) for found in self._found if found.kind is RemedyKind.STEP]
        if self._size(gait) <= max(steps, default=0.0):
            return None
        return self._step_remedy(gait, f"With longer swings; {_duration(gait)} in all.")

    def _for_margin(self) -> Iterator[Remedy | None]:
        """Margins that nobody can keep."""
        yield self._largest_margin(self._mended)
        slow = longer(self._mended, items_of(self._mended), LONG_SWING)
        if slow is not None:
            found = self._at_best_margin(slow)
            yield self._longer_remedy(found) if found is not None else self._largest_margin(slow)

    def _largest_margin(self, gait: Gait) -> Remedy | None:
        asked = self._asked.options.margin
        best = self._trial.largest(
            min(USUAL_MARGIN, asked), asked, lambda value: _margin(gait, value), UNIT_MARGIN
        )
        if best is None:
            return None
        words = "The largest margin that works"
        if gait.timeline.sample_count != self._asked.timeline.sample_count:
            words += f" in {_duration(gait)}"
        return self._remedy(RemedyKind.MARGIN, f"Margin {best * MM:.1f} mm", f"{words}.", _margin(gait, best))

    def _fallbacks(self) -> Iterator[Remedy | None]:
        """Long pauses and swings with a shorter step; then the same feet drawn anew."""
        for margin in dict.fromkeys((self._raised, self._model.margin)):
            remedy = self._with_longer_swings(margin)
            if remedy is not None and remedy.gait.options.margin >= self._model.margin:
                yield remedy
                break
        if self._good < 2 and not self._mended.timeline.locked.any():
            yield self._anew()

    def _anew(self) -> Remedy | None:
        options = self._asked.options
        knots = max(options.phase_knots, LONG_SWING, needed_swing(self._asked))
        anew = self._asked.with_options(phase_knots=knots, closing_knots=max(options.closing_knots, CLOSING))
        drawn = replace(anew, timeline=drawn_timeline(anew))
        for margin in dict.fromkeys((self._raised, self._model.margin)):
            gait = self._shorter_step(drawn, margin)
            if gait is not None and gait.options.margin >= self._model.margin:
                words = f"In the order {'-'.join(map(str, anew.order))}; {_duration(gait)} in all."
                if _way(gait) < _way(self._asked):
                    words = f"{self._step_remedy(gait, '').label}, in the order {words[13:]}"
                return self._remedy(RemedyKind.ANEW, "Drawn anew", words, gait)
        return None

    def _single_changes(self) -> Iterator[Remedy | None]:
        """What else one number can do."""
        if self._asked.options.workspace is Workspace.CYLINDER:
            yield self._workspace()
        if not self._found:
            yield self._height()
            yield self._clearance()

    def _workspace(self) -> Remedy | None:
        gait = self._at_best_margin(self._mended.with_options(workspace=Workspace.STROKE))
        if gait is None:
            return None
        words = "Within what the motors truly reach, which is more than the paper's cylinder."
        return self._remedy(RemedyKind.WORKSPACE, "Workspace stroke", words, gait)

    def _height(self) -> Remedy | None:
        lowest, highest = MotionLimits().plane_height
        now = self._asked.options.plane_height
        heights = np.arange(lowest, highest + HEIGHT_STEP / 2, HEIGHT_STEP)
        near = sorted((float(h) for h in heights if abs(h - now) > 1e-9), key=lambda h: abs(h - now))
        changed = [self._mended.with_options(plane_height=h, end_plane_height=None) for h in near]
        gait = self._first_at_best_margin(changed)
        if gait is None:
            return None
        text = f"{gait.options.plane_height * MM:.1f} mm"
        words = f"It works with the actuator plane at {text}."
        return self._remedy(RemedyKind.HEIGHT, f"Body height {text}", words, gait)

    def _clearance(self) -> Remedy | None:
        asked = self._asked.options.clearance
        best = self._trial.largest(
            0.001, asked, lambda value: self._mended.with_options(clearance=value), UNIT_MARGIN
        )
        if best is None:
            return None
        gait = self._mended.with_options(clearance=best)
        text = f"{best * MM:.1f} mm"
        return self._remedy(RemedyKind.CLEARANCE, f"Clearance {text}", f"Feet can rise {text}.", gait)

    def _no_margin(self) -> Remedy | None:
        gait = _margin(self._mended, 0.0)
        if self._asked.options.margin == 0 or not self._trial.works(gait):
            return None
        words = "It balances on the edge of its feet."
        return Remedy(RemedyKind.NO_MARGIN, "Ask for no margin", words, gait, "The robot tips.")

    def _at_best_margin(self, gait: Gait) -> Gait | None:
        """The gait with the robot's own margin where that works, else with the one that is asked."""
        return self._first_at_best_margin([gait])

    def _first_at_best_margin(self, gaits: Sequence[Gait | None]) -> Gait | None:
        """The first of some gaits that works with the robot's own margin, else with the one that is asked."""
        for margin in dict.fromkeys((self._raised, self._asked.options.margin)):
            found = self._trial.first(None if gait is None else _margin(gait, margin) for gait in gaits)
            if found is not None:
                return found
        return None

    def _remedy(self, kind: RemedyKind, label: str, words: str, gait: Gait) -> Remedy:
        margin, asked = gait.options.margin, self._asked.options.margin
        told = "" if kind is RemedyKind.MARGIN or margin == asked else f" Margin {margin * MM:g} mm."
        return Remedy(kind, label, f"{words}{told}", gait)


def _margin(gait: Gait, margin: float) -> Gait:
    return gait.with_options(margin=margin)


def _length(gait: Gait) -> float:
    return float(np.hypot(*gait.step[:2]))


def _way(gait: Gait) -> float:
    """How far, or how much round, all iterations go."""
    return (_length(gait) or abs(gait.step[2])) * gait.iterations


def _duration(gait: Gait) -> str:
    return f"{(gait.timeline.sample_count - 1) * gait.timeline.sample_time:.1f} s"


def _order_words(gait: Gait) -> str:
    """The feet in the order of their swings, such as “3, 2, 4, 1”; short where there are many."""
    swings = sorted(gait.timeline.swings(), key=lambda swing: (swing.first, swing.foot))
    if len(swings) > 8:
        return f"{len(swings)} swings one after the other"
    return "Feet " + ", ".join(str(swing.foot + 1) for swing in swings)
