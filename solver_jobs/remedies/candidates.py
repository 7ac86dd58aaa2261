"""Changes that may make a drawing walk, the most likely first; the live tier tries each of them.

Which changes help, and in which order, was measured on random drawings. A motion tends to have exactly the
margin that is requested, so every remedy tries the robot's own margin first (docs/remedies.md).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from core.errors import FootfallError
from core.gait.gait import Gait, drawn_timeline, with_iterations
from core.patterns.limits import needed_swing
from core.problem.motion_problem import PLANE_HEIGHTS, Workspace
from core.robot.model import RobotModel
from solver_jobs.remedies.arms import arm_caution, arm_room
from solver_jobs.remedies.layout import (
    CLOSING,
    Item,
    items_of,
    longer,
    one_after_the_other,
    with_ends,
    with_forgotten_feet,
    with_single_swings,
)
from solver_jobs.remedies.remedy import (
    Remedy,
    RemedyKind,
    Trouble,
    duration_words,
    is_one_by_one,
    order_words,
    step_length,
    way_of,
)
from solver_jobs.remedies.trial import Trial

SMALL_STEP, SMALL_TURN = 0.002, np.radians(1.0)
"""If a drawing works with this step or turn, its own is too large, m and rad."""

LEAST_STEP, LEAST_TURN = 0.005, np.radians(2.0)
"""The smallest step and turn that are offered, m and rad."""

USUAL_MARGIN = 0.003
"""If a drawing works with this margin, its own is too large, m."""

UNIT_STEP, UNIT_TURN, UNIT_MARGIN = 1e-4, np.radians(0.5), 1e-4
"""Offered values are multiples of these, m and rad."""

GAPS = (1, 2, 3, 4, 5, 6, 8)
LONG_GAPS = (1, 2, 3, 4, 5, 6, 8, 10, 12)
"""Samples of stance that are tried between two swings: in the same time, and in a longer gait."""

LONG_SWING = 5
"""Length of pauses and swings that is tried when shorter ones do not work, samples."""

HEIGHT_STEP = 0.0005
"""Distance between the body heights that are tried, m."""

MORE_MARGIN, MOST_MORE_MARGIN = 0.001, 0.006
"""Least and largest increase of the margin that is offered to a gait that tips, m."""

SHORTER = (0.75, 0.5)
"""Fractions of the step that are tried in place of the full step."""

MM = 1000.0


class Candidates:
    """Finds the changes that make one gait work.

    Args:
        gait: a gait without a motion, or one that tips in physics.
        model: its robot.
        trial: tries the changed gaits.
        tips: whether the gait has a motion but tips in physics.

    Attributes:
        trouble: what is wrong with the gait; None until it is known.
    """

    def __init__(self, gait: Gait, model: RobotModel, trial: Trial, *, tips: bool = False) -> None:
        self.trouble = Trouble.TIPS if tips else None
        self._asked = gait
        self._model = model
        self._trial = trial
        self._raised = max(gait.options.margin, model.margin)
        self._mended = with_forgotten_feet(with_ends(gait))
        self._found: list[Remedy] = []

    def remedies(self) -> Iterator[Remedy]:
        """All changes that work, the most likely first; no two have the same label or the same document."""
        known = [(self._asked, "")]
        for remedy in self._candidates():
            if remedy is None or any(remedy.gait == gait or remedy.label == label for gait, label in known):
                continue
            known.append((remedy.gait, remedy.label))
            self._found.append(remedy)
            yield remedy

    def _candidates(self) -> Iterator[Remedy | None]:
        if self.trouble is Trouble.TIPS:
            yield from self._for_tipping()
            return
        if self._mended is not self._asked:
            yield self._ends()
        self.trouble = self._found_out()
        match self.trouble:
            case Trouble.STEP:
                yield from self._for_step()
            case Trouble.MARGIN:
                yield from self._for_margin()
            case _:
                yield from self._for_shape()
                yield self._no_margin()
        if self._good < 2:
            yield from self._fallbacks()
        yield from self._single_changes()

    def _found_out(self) -> Trouble:
        """Finds what is wrong, with two or three trials."""
        step = self._scaled(self._mended, SMALL_TURN if self._turns else SMALL_STEP)
        if self._at_best_margin(step) is not None:
            return Trouble.STEP
        margin = min(self._asked.options.margin, USUAL_MARGIN)
        return Trouble.MARGIN if self._trial.works(_margin(self._mended, margin)) else Trouble.SHAPE

    def _for_tipping(self) -> Iterator[Remedy | None]:
        """Changes for a gait that tips: more margin, longer pauses and swings, a shorter step."""
        asked = self._asked.options.margin
        if self._raised > asked and self._trial.works(_margin(self._asked, self._raised)):
            yield self._margin_remedy(self._asked, self._raised, "Below this, the robot is likely to tip.")
        else:
            yield self._largest_margin(self._asked, asked + MORE_MARGIN, asked + MOST_MORE_MARGIN)
        yield from self._for_shape()
        yield self._slower()
        for share in SHORTER:
            size = self._size(self._asked) * share
            shorter = self._at_best_margin(self._scaled(self._asked, size)) if size else None
            yield None if shorter is None else self._step_remedy(shorter, f"{share:.0%} of the step.")

    @property
    def _good(self) -> int:
        """Number of remedies found so far that keep at least the robot's own margin."""
        return sum(remedy.gait.options.margin >= self._model.margin for remedy in self._found)

    @property
    def _turns(self) -> bool:
        return step_length(self._asked) == 0 and self._asked.step[2] != 0

    def _ends(self) -> Remedy | None:
        gait = self._at_best_margin(self._mended)
        words = "Every foot swings, and stands at the start and at the end."
        return None if gait is None else self._remedy(RemedyKind.MENDED, "Repair the ends", words, gait)

    def _for_shape(self) -> Iterator[Remedy | None]:
        """Changes for swings that overlap or are too short."""
        found: set[RemedyKind] = set()
        for items in self._item_lists(self._mended):
            for kind, change in (
                (RemedyKind.ONE_BY_ONE, self._one_by_one),
                (RemedyKind.LONGER, self._longer),
            ):
                if kind not in found and (remedy := change(items)) is not None:
                    found.add(kind)
                    yield remedy
        yield from self._single_swings()

    def _single_swings(self) -> Iterator[Remedy | None]:
        """For drawings with more: one swing for each foot and iteration, with a shorter step if needed."""
        single = with_single_swings(self._mended)
        if single is self._mended:
            return
        gait = self._at_best_margin(single) or self._laid_apart(single)
        if gait is not None:
            yield self._in_same_time("One swing a foot", gait)
            return
        for share in SHORTER:
            gait = self._laid_apart(self._scaled(single, self._size(single) * share))
            if gait is not None:
                yield self._step_remedy(gait, "With one swing a foot.")
                return

    def _laid_apart(self, gait: Gait) -> Gait | None:
        """The gait with its swings one after the other in the same time; None if that does not work."""
        for items in self._item_lists(gait):
            found = self._first_at_best_margin([one_after_the_other(gait, items, gap) for gap in GAPS])
            if found is not None:
                return found
        return None

    def _item_lists(self, base: Gait) -> list[list[Item]]:
        """Item lists to try: first with swings joined that may overlap, then with every swing alone."""
        apart = items_of(base)
        if base.timeline.leg_count <= 4:
            return [apart]
        stands = np.asarray(base.timeline.stance.sum(axis=0) >= 3)
        for lack in self._trial.lacks(base):
            stands[lack.first : lack.last + 1] = False
        together = items_of(base, stands)
        return [apart] if len(together) == len(apart) else [together, apart]

    def _one_by_one(self, items: list[Item]) -> Remedy | None:
        gait = self._first_at_best_margin([one_after_the_other(self._mended, items, gap) for gap in GAPS])
        if gait is None:
            return None
        label = "One foot after the other" if is_one_by_one(gait) else "One group after the other"
        if is_one_by_one(self._mended):
            label = "Longer swings" if not self._keeps_swings(gait) else "Other pauses"
        return self._in_same_time(label, gait)

    def _in_same_time(self, label: str, gait: Gait) -> Remedy | None:
        return self._remedy(RemedyKind.ONE_BY_ONE, label, f"{order_words(gait)}, in the same time.", gait)

    def _longer(self, items: list[Item], gaps: tuple[int, ...] = LONG_GAPS, least: int = 0) -> Remedy | None:
        gait = self._first_at_best_margin([longer(self._mended, items, gap, least) for gap in gaps])
        return None if gait is None else self._longer_remedy(gait)

    def _longer_remedy(self, gait: Gait) -> Remedy | None:
        if gait.timeline.sample_count <= self._asked.timeline.sample_count:
            return None
        words = f"{order_words(gait)}; {duration_words(gait)} instead of {duration_words(self._asked)}."
        label = "Same swings, longer gait" if self._keeps_swings(gait) else "Longer swings, longer gait"
        return self._remedy(RemedyKind.LONGER, label, words, gait)

    def _keeps_swings(self, gait: Gait) -> bool:
        before, after = (
            [(s.foot, len(s.samples)) for s in one.timeline.swings()] for one in (self._mended, gait)
        )
        return sorted(before) == sorted(after)

    def _for_step(self) -> Iterator[Remedy | None]:
        """Changes for a step that is too long."""
        # A person waits, so the quickest change comes first.
        yield self._more_iterations()
        shorter = self._shorter_step(self._mended, self._raised)
        if shorter is not None:
            largest = self._step_remedy(shorter, "The largest that works for this drawing.")
            yield largest
            if largest is not None:
                yield self._clear_step(largest)
        if self._asked.options.margin > self._model.margin:
            yield self._kept_margin(self._mended)
        yield self._slower()

    def _shorter_step(self, gait: Gait, margin: float) -> Gait | None:
        """The gait with the largest step or turn that works; None if even the smallest offered one fails."""
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

    def _clear_step(self, largest: Remedy) -> Remedy | None:
        """The largest step or turn whose arms keep clear, where those of the largest that works do not."""
        room = arm_room(largest.gait, self._model, largest.motion)
        if room >= 0.0:
            return None
        size = self._size(largest.gait)
        least, unit = (LEAST_TURN, UNIT_TURN) if self._turns else (LEAST_STEP, UNIT_STEP)
        if size <= least:
            return None
        # Two neighbouring feet come nearer to each other by about what the step grows.
        near = None if self._turns else size + room
        change = partial(self._scaled, largest.gait)
        found = self._trial.largest(least, size, change, unit, near, self._keeps_arms_clear)
        if found is None:
            return None
        return self._step_remedy(change(found), "The largest whose arms keep clear of each other.")

    def _keeps_arms_clear(self, gait: Gait) -> bool:
        """Whether a gait works with arms that the check does not warn of."""
        motion = self._trial.solved(gait) if self._trial.works(gait) else None
        return motion is not None and arm_room(gait, self._model, motion) >= 0.0

    def _step_remedy(self, gait: Gait, words: str) -> Remedy | None:
        return self._remedy(RemedyKind.STEP, self._step_words(gait), words, gait)

    def _step_words(self, gait: Gait) -> str:
        size = self._size(gait)
        return f"Turn {np.degrees(size):.1f}°" if self._turns else f"Step {size * MM:.1f} mm"

    def _size(self, gait: Gait) -> float:
        """Length of the step, m; for a gait that only turns, the angle of its turn, rad."""
        return abs(gait.step[2]) if self._turns else step_length(gait)

    def _scaled(self, gait: Gait, value: float) -> Gait:
        """The gait with its step or turn scaled to another size, m or rad (see `_size`)."""
        size = self._size(gait)
        if size in (0.0, value):
            return gait
        dx, dy, yaw = (part * value / size for part in gait.step)
        return replace(gait, step=(dx, dy, yaw))

    def _more_iterations(self) -> Remedy | None:
        """The same distance in two or three times as many iterations."""
        for times in (2, 3):
            count = self._mended.iterations * times
            try:
                repeated = with_iterations(self._mended, count)
            except FootfallError:
                return None
            dx, dy, yaw = (part / times for part in self._mended.step)
            gait = self._at_best_margin(replace(repeated, step=(dx, dy, yaw)))
            if gait is not None:
                size = self._step_words(gait).lower()
                words = (
                    f"The same distance, each with {size}; "
                    f"{duration_words(gait)} instead of {duration_words(self._asked)}."
                )
                return self._remedy(RemedyKind.ITERATIONS, f"{count} iterations", words, gait)
        return None

    def _slower(self) -> Remedy | None:
        """Pauses and swings of five samples or more, with a shorter step if the full one does not work."""
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
        """Pauses and swings of five samples or more, with the largest step that works with them."""
        slow = longer(self._mended, items_of(self._mended), LONG_SWING, LONG_SWING)
        gait = None if slow is None else self._shorter_step(slow, margin)
        if gait is None:
            return None
        if way_of(gait) >= way_of(self._asked):
            return self._longer_remedy(gait)
        steps = [self._size(found.gait) for found in self._found if found.kind is RemedyKind.STEP]
        if self._size(gait) <= max(steps, default=0.0):
            return None
        return self._step_remedy(gait, f"With longer swings; {duration_words(gait)} in all.")

    def _for_margin(self) -> Iterator[Remedy | None]:
        """Changes for a margin that no motion can keep."""
        yield self._kept_margin(self._mended)
        slow = longer(self._mended, items_of(self._mended), LONG_SWING)
        if slow is not None:
            found = self._at_best_margin(slow)
            yield self._longer_remedy(found) if found is not None else self._kept_margin(slow)

    def _kept_margin(self, gait: Gait) -> Remedy | None:
        """The largest margin that works, up to the requested one."""
        asked = self._asked.options.margin
        return self._largest_margin(gait, min(USUAL_MARGIN, asked), asked)

    def _largest_margin(self, gait: Gait, least: float, most: float) -> Remedy | None:
        near = self._trial.best_margin(gait, most)
        best = self._trial.largest(least, most, lambda value: _margin(gait, value), UNIT_MARGIN, near)
        if best is None:
            return None
        is_known = best < most or most <= self._asked.options.margin
        words = "The largest margin that works" if is_known else "More margin"
        if gait.timeline.sample_count != self._asked.timeline.sample_count:
            words += f" in {duration_words(gait)}"
        return self._margin_remedy(gait, best, f"{words}.")

    def _margin_remedy(self, gait: Gait, margin: float, words: str) -> Remedy | None:
        changed = _margin(gait, margin)
        return self._remedy(RemedyKind.MARGIN, f"Margin {margin * MM:.1f} mm", words, changed)

    def _fallbacks(self) -> Iterator[Remedy | None]:
        """Longer pauses and swings with a shorter step; then a standard gait in place of the drawing."""
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
                step = f"{self._step_words(gait)}. " if way_of(gait) < way_of(self._asked) else ""
                words = f"{step}{order_words(gait)}; {duration_words(gait)} in all."
                return self._remedy(RemedyKind.ANEW, "Draw a standard gait instead", words, gait)
        return None

    def _single_changes(self) -> Iterator[Remedy | None]:
        """Changes of one other option: workspace, body height or clearance."""
        if self._asked.options.workspace is Workspace.CYLINDER:
            yield self._workspace()
        if not self._found:
            yield self._height()
            yield self._clearance()

    def _workspace(self) -> Remedy | None:
        gait = self._at_best_margin(self._mended.with_options(workspace=Workspace.STROKE))
        if gait is None:
            return None
        words = "Feet may go wherever the motors reach, not only in the cylinder of the paper."
        return self._remedy(RemedyKind.WORKSPACE, "Workspace: motor strokes", words, gait)

    def _height(self) -> Remedy | None:
        lowest, highest = PLANE_HEIGHTS
        now = self._asked.options.plane_height
        heights = np.arange(lowest, highest + HEIGHT_STEP / 2, HEIGHT_STEP)
        near = sorted((float(h) for h in heights if abs(h - now) > 1e-9), key=lambda h: abs(h - now))
        changed = [self._mended.with_options(plane_height=h, end_plane_height=None) for h in near]
        gait = self._first_at_best_margin(changed)
        if gait is None:
            return None
        text = f"{gait.options.plane_height * MM:.1f} mm"
        words = f"There is a motion with the actuator plane {text} above the ground."
        if self._asked.options.end_plane_height is not None:
            words = f"There is a motion with the actuator plane {text} above the ground from start to end."
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
        return self._remedy(
            RemedyKind.CLEARANCE, f"Clearance {text}", "The highest that works for this drawing.", gait
        )

    def _no_margin(self) -> Remedy | None:
        gait = _margin(self._mended, 0.0)
        if self._asked.options.margin == 0 or not self._trial.works(gait):
            return None
        words = "The centre of mass may lie on the edge of the support polygon."
        return self._remedy(RemedyKind.NO_MARGIN, "Ask for no margin", words, gait, "Likely to tip.")

    def _at_best_margin(self, gait: Gait) -> Gait | None:
        """The gait with the robot's own margin if that works, else with the requested one, or None."""
        return self._first_at_best_margin([gait])

    def _first_at_best_margin(self, gaits: Sequence[Gait | None]) -> Gait | None:
        """The first gait that works with the robot's own margin, else the first with the requested one."""
        for margin in dict.fromkeys((self._raised, self._asked.options.margin)):
            found = self._trial.first(None if gait is None else _margin(gait, margin) for gait in gaits)
            if found is not None:
                return found
        return None

    def _remedy(
        self, kind: RemedyKind, label: str, words: str, gait: Gait, caution: str = ""
    ) -> Remedy | None:
        """The remedy for a changed gait; None if the full live tier finds no confirmed motion."""
        motion = self._trial.solved(gait)
        if motion is None:
            return None
        margin, asked = gait.options.margin, self._asked.options.margin
        others = []
        if margin != asked and kind not in (RemedyKind.MARGIN, RemedyKind.NO_MARGIN):
            others.append(f"Margin {margin * MM:g} mm.")
        if self._mended is not self._asked and kind is not RemedyKind.MENDED:
            others.append("The ends are repaired too.")
        cautions = " ".join(filter(None, [caution, arm_caution(gait, self._model, motion)]))
        return Remedy(kind, label, " ".join([words, *others]), gait, motion, cautions)


def _margin(gait: Gait, margin: float) -> Gait:
    return gait.with_options(margin=margin)
