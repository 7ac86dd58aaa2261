"""Changes of when the feet of a drawing swing: one after the other, and longer."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from core.gait.gait import Gait
from solver_jobs.remedies.layout import Item, items_of, longer, one_after_the_other, with_single_swings
from solver_jobs.remedies.remedy import Remedy, RemedyKind, duration_words, is_one_by_one, order_words
from solver_jobs.remedies.remedy_maker import RemedyMaker
from solver_jobs.remedies.trial import Trial

GAPS = (1, 2, 3, 4, 5, 6, 8)
LONG_GAPS = (1, 2, 3, 4, 5, 6, 8, 10, 12)
"""Samples of stance that are tried between two swings: in the same time, and in a longer gait."""

SHORTER = (0.75, 0.5)
"""Fractions of the step that are tried in place of the full step."""


class SwingChanges:
    """Finds changes for swings that overlap or are too short.

    Args:
        maker: makes the remedies of the gait.
        trial: tries the changed gaits.
    """

    def __init__(self, maker: RemedyMaker, trial: Trial) -> None:
        self._maker = maker
        self._mended = maker.mended
        self._trial = trial

    def remedies(self) -> Iterator[Remedy | None]:
        """The swings one after the other in the same time, in a longer gait, and fewer of them."""
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
        gait = self._maker.at_best_margin(single) or self._laid_apart(single)
        if gait is not None:
            yield self._in_same_time("One swing a foot", gait)
            return
        for share in SHORTER:
            gait = self._laid_apart(self._maker.scaled(single, self._maker.size(single) * share))
            if gait is not None:
                yield self._maker.step_remedy(gait, "With one swing a foot.")
                return

    def _laid_apart(self, gait: Gait) -> Gait | None:
        """The gait with its swings one after the other in the same time; None if that does not work."""
        for items in self._item_lists(gait):
            found = self._maker.first_at_best_margin([one_after_the_other(gait, items, gap) for gap in GAPS])
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
        gait = self._maker.first_at_best_margin(
            [one_after_the_other(self._mended, items, gap) for gap in GAPS]
        )
        if gait is None:
            return None
        label = "One foot after the other" if is_one_by_one(gait) else "One group after the other"
        if is_one_by_one(self._mended):
            label = "Longer swings" if not self._keeps_swings(gait) else "Other pauses"
        return self._in_same_time(label, gait)

    def _in_same_time(self, label: str, gait: Gait) -> Remedy | None:
        return self._maker.remedy(
            RemedyKind.ONE_BY_ONE, label, f"{order_words(gait)}, in the same time.", gait
        )

    def _longer(self, items: list[Item], gaps: tuple[int, ...] = LONG_GAPS, least: int = 0) -> Remedy | None:
        gait = self._maker.first_at_best_margin([longer(self._mended, items, gap, least) for gap in gaps])
        return None if gait is None else self.longer_remedy(gait)

    def longer_remedy(self, gait: Gait) -> Remedy | None:
        """The remedy for a gait that works; None if it takes no longer than the requested one."""
        if gait.timeline.sample_count <= self._maker.asked.timeline.sample_count:
            return None
        words = f"{order_words(gait)}; {duration_words(gait)} instead of {duration_words(self._maker.asked)}."
        label = "Same swings, longer gait" if self._keeps_swings(gait) else "Longer swings, longer gait"
        return self._maker.remedy(RemedyKind.LONGER, label, words, gait)

    def _keeps_swings(self, gait: Gait) -> bool:
        before, after = (
            [(s.foot, len(s.samples)) for s in one.timeline.swings()] for one in (self._mended, gait)
        )
        return sorted(before) == sorted(after)
