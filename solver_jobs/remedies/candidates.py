"""Changes that may make a drawing walk, the most likely first; the live tier tries each of them.

Which changes help, and in which order, was measured on random drawings. A motion tends to have exactly the
margin that is requested, so every remedy tries the robot's own margin first (docs/remedies.md).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from core.errors import FootfallError
from core.gait.gait import Gait, drawn_timeline, with_iterations
from core.patterns.limits import needed_swing
from core.problem.motion_problem import PLANE_HEIGHTS, Workspace
from core.robot.model import RobotModel
from solver_jobs.remedies.arms import arm_room
from solver_jobs.remedies.layout import CLOSING, items_of, longer
from solver_jobs.remedies.remedy import Remedy, RemedyKind, Trouble, duration_words, order_words, way_of
from solver_jobs.remedies.remedy_maker import MM, RemedyMaker, with_margin
from solver_jobs.remedies.swing_changes import SHORTER, SwingChanges
from solver_jobs.remedies.trial import Trial

SMALL_STEP, SMALL_TURN = 0.002, np.radians(1.0)
"""If a drawing works with this step or turn, its own is too large, m and rad."""

LEAST_STEP, LEAST_TURN = 0.005, np.radians(2.0)
"""The smallest step and turn that are offered, m and rad."""

USUAL_MARGIN = 0.003
"""If a drawing works with this margin, its own is too large, m."""

UNIT_STEP, UNIT_TURN, UNIT_MARGIN = 1e-4, np.radians(0.5), 1e-4
"""Offered values are multiples of these, m and rad."""

LONG_SWING = 5
"""Length of pauses and swings that is tried when shorter ones do not work, samples."""

HEIGHT_STEP = 0.0005
"""Distance between the body heights that are tried, m."""

MORE_MARGIN, MOST_MORE_MARGIN = 0.001, 0.006
"""Least and largest increase of the margin that is offered to a gait that tips, m."""


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
        self._maker = RemedyMaker(gait, model, trial)
        self._swings = SwingChanges(self._maker, trial)
        self._mended, self._raised = self._maker.mended, self._maker.raised
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
                yield from self._swings.remedies()
                yield self._no_margin()
        if self._good < 2:
            yield from self._fallbacks()
        yield from self._single_changes()

    def _found_out(self) -> Trouble:
        """Finds what is wrong, with two or three trials."""
        step = self._maker.scaled(self._mended, SMALL_TURN if self._maker.turns else SMALL_STEP)
        if self._maker.at_best_margin(step) is not None:
            return Trouble.STEP
        margin = min(self._asked.options.margin, USUAL_MARGIN)
        return Trouble.MARGIN if self._trial.works(with_margin(self._mended, margin)) else Trouble.SHAPE

    def _for_tipping(self) -> Iterator[Remedy | None]:
        """Changes for a gait that tips: more margin, longer pauses and swings, a shorter step."""
        asked = self._asked.options.margin
        if self._raised > asked and self._trial.works(with_margin(self._asked, self._raised)):
            yield self._margin_remedy(self._asked, self._raised, "Below this, the robot is likely to tip.")
        else:
            yield self._largest_margin(self._asked, asked + MORE_MARGIN, asked + MOST_MORE_MARGIN)
        yield from self._swings.remedies()
        yield self._slower()
        for share in SHORTER:
            size = self._maker.size(self._asked) * share
            shorter = self._maker.at_best_margin(self._maker.scaled(self._asked, size)) if size else None
            yield None if shorter is None else self._maker.step_remedy(shorter, f"{share:.0%} of the step.")

    @property
    def _good(self) -> int:
        """Number of remedies found so far that keep at least the robot's own margin."""
        return sum(remedy.gait.options.margin >= self._model.margin for remedy in self._found)

    def _ends(self) -> Remedy | None:
        gait = self._maker.at_best_margin(self._mended)
        words = "Every foot swings, and stands at the start and at the end."
        return None if gait is None else self._maker.remedy(RemedyKind.MENDED, "Repair the ends", words, gait)

    def _for_step(self) -> Iterator[Remedy | None]:
        """Changes for a step that is too long."""
        # A person waits, so the quickest change comes first.
        yield self._more_iterations()
        shorter = self._shorter_step(self._mended, self._raised)
        if shorter is not None:
            largest = self._maker.step_remedy(shorter, "The largest that works for this drawing.")
            yield largest
            if largest is not None:
                yield self._clear_step(largest)
        if self._asked.options.margin > self._model.margin:
            yield self._kept_margin(self._mended)
        yield self._slower()

    def _shorter_step(self, gait: Gait, margin: float) -> Gait | None:
        """The gait with the largest step or turn that works; None if even the smallest offered one fails."""
        size = self._maker.size(gait)
        if size == 0.0:
            return None
        least, unit = (LEAST_TURN, UNIT_TURN) if self._maker.turns else (LEAST_STEP, UNIT_STEP)
        for asked in dict.fromkeys((margin, self._asked.options.margin)):
            safe = with_margin(gait, asked)
            found = self._trial.largest(min(least, size), size, partial(self._maker.scaled, safe), unit)
            if found is not None:
                return self._maker.scaled(safe, found)
        return None

    def _clear_step(self, largest: Remedy) -> Remedy | None:
        """The largest step or turn whose arms keep clear, where those of the largest that works do not."""
        room = arm_room(largest.gait, self._model, largest.motion)
        if room >= 0.0:
            return None
        size = self._maker.size(largest.gait)
        least, unit = (LEAST_TURN, UNIT_TURN) if self._maker.turns else (LEAST_STEP, UNIT_STEP)
        if size <= least:
            return None
        # Two neighbouring feet come nearer to each other by about what the step grows.
        near = None if self._maker.turns else size + room
        change = partial(self._maker.scaled, largest.gait)
        found = self._trial.largest(least, size, change, unit, near, self._keeps_arms_clear)
        if found is None:
            return None
        return self._maker.step_remedy(change(found), "The largest whose arms keep clear of each other.")

    def _keeps_arms_clear(self, gait: Gait) -> bool:
        """Whether a gait works with arms that the check does not warn of."""
        motion = self._trial.solved(gait) if self._trial.works(gait) else None
        return motion is not None and arm_room(gait, self._model, motion) >= 0.0

    def _more_iterations(self) -> Remedy | None:
        """The same distance in two or three times as many iterations."""
        for times in (2, 3):
            count = self._mended.iterations * times
            try:
                repeated = with_iterations(self._mended, count)
            except FootfallError:
                return None
            dx, dy, yaw = (part / times for part in self._mended.step)
            gait = self._maker.at_best_margin(replace(repeated, step=(dx, dy, yaw)))
            if gait is not None:
                size = self._maker.step_words(gait).lower()
                words = (
                    f"The same distance, each with {size}; "
                    f"{duration_words(gait)} instead of {duration_words(self._asked)}."
                )
                return self._maker.remedy(RemedyKind.ITERATIONS, f"{count} iterations", words, gait)
        return None

    def _slower(self) -> Remedy | None:
        """Pauses and swings of five samples or more, with a shorter step if the full one does not work."""
        items = items_of(self._mended)
        for least in range(LONG_SWING, 9):
            slow = longer(self._mended, items, LONG_SWING, least)
            if slow is None:
                return None
            found = self._maker.at_best_margin(slow)
            if found is not None:
                return self._swings.longer_remedy(found)
        return self._with_longer_swings(self._raised)

    def _with_longer_swings(self, margin: float) -> Remedy | None:
        """Pauses and swings of five samples or more, with the largest step that works with them."""
        slow = longer(self._mended, items_of(self._mended), LONG_SWING, LONG_SWING)
        gait = None if slow is None else self._shorter_step(slow, margin)
        if gait is None:
            return None
        if way_of(gait) >= way_of(self._asked):
            return self._swings.longer_remedy(gait)
        steps = [self._maker.size(found.gait) for found in self._found if found.kind is RemedyKind.STEP]
        if self._maker.size(gait) <= max(steps, default=0.0):
            return None
        return self._maker.step_remedy(gait, f"With longer swings; {duration_words(gait)} in all.")

    def _for_margin(self) -> Iterator[Remedy | None]:
        """Changes for a margin that no motion can keep."""
        yield self._kept_margin(self._mended)
        slow = longer(self._mended, items_of(self._mended), LONG_SWING)
        if slow is not None:
            found = self._maker.at_best_margin(slow)
            yield self._swings.longer_remedy(found) if found is not None else self._kept_margin(slow)

    def _kept_margin(self, gait: Gait) -> Remedy | None:
        """The largest margin that works, up to the requested one."""
        asked = self._asked.options.margin
        return self._largest_margin(gait, min(USUAL_MARGIN, asked), asked)

    def _largest_margin(self, gait: Gait, least: float, most: float) -> Remedy | None:
        near = self._trial.best_margin(gait, most)
        best = self._trial.largest(least, most, lambda value: with_margin(gait, value), UNIT_MARGIN, near)
        if best is None:
            return None
        is_known = best < most or most <= self._asked.options.margin
        words = "The largest margin that works" if is_known else "More margin"
        if gait.timeline.sample_count != self._asked.timeline.sample_count:
            words += f" in {duration_words(gait)}"
        return self._margin_remedy(gait, best, f"{words}.")

    def _margin_remedy(self, gait: Gait, margin: float, words: str) -> Remedy | None:
        changed = with_margin(gait, margin)
        return self._maker.remedy(RemedyKind.MARGIN, f"Margin {margin * MM:.1f} mm", words, changed)

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
                step = f"{self._maker.step_words(gait)}. " if way_of(gait) < way_of(self._asked) else ""
                words = f"{step}{order_words(gait)}; {duration_words(gait)} in all."
                return self._maker.remedy(RemedyKind.ANEW, "Draw a standard gait instead", words, gait)
        return None

    def _single_changes(self) -> Iterator[Remedy | None]:
        """Changes of one other option: workspace, body height or clearance."""
        if self._asked.options.workspace is Workspace.CYLINDER:
            yield self._workspace()
        if not self._found:
            yield self._height()
            yield self._clearance()

    def _workspace(self) -> Remedy | None:
        gait = self._maker.at_best_margin(self._mended.with_options(workspace=Workspace.STROKE))
        if gait is None:
            return None
        words = "Feet may go wherever the motors reach, not only in the cylinder of the paper."
        return self._maker.remedy(RemedyKind.WORKSPACE, "Workspace: motor strokes", words, gait)

    def _height(self) -> Remedy | None:
        lowest, highest = PLANE_HEIGHTS
        now = self._asked.options.plane_height
        heights = np.arange(lowest, highest + HEIGHT_STEP / 2, HEIGHT_STEP)
        near = sorted((float(h) for h in heights if abs(h - now) > 1e-9), key=lambda h: abs(h - now))
        changed = [self._mended.with_options(plane_height=h, end_plane_height=None) for h in near]
        gait = self._maker.first_at_best_margin(changed)
        if gait is None:
            return None
        text = f"{gait.options.plane_height * MM:.1f} mm"
        words = f"There is a motion with the actuator plane {text} above the ground."
        if self._asked.options.end_plane_height is not None:
            words = f"There is a motion with the actuator plane {text} above the ground from start to end."
        return self._maker.remedy(RemedyKind.HEIGHT, f"Body height {text}", words, gait)

    def _clearance(self) -> Remedy | None:
        asked = self._asked.options.clearance
        best = self._trial.largest(
            0.001, asked, lambda value: self._mended.with_options(clearance=value), UNIT_MARGIN
        )
        if best is None:
            return None
        gait = self._mended.with_options(clearance=best)
        text = f"{best * MM:.1f} mm"
        return self._maker.remedy(
            RemedyKind.CLEARANCE, f"Clearance {text}", "The highest that works for this drawing.", gait
        )

    def _no_margin(self) -> Remedy | None:
        gait = with_margin(self._mended, 0.0)
        if self._asked.options.margin == 0 or not self._trial.works(gait):
            return None
        words = "The centre of mass may lie on the edge of the support polygon."
        return self._maker.remedy(RemedyKind.NO_MARGIN, "Ask for no margin", words, gait, "Likely to tip.")
