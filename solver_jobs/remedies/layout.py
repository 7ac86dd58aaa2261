"""Rearranges the swings of a drawing in time, so that the other feet stand during each of them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice, pairwise, permutations, product

import numpy as np

from core.arrays import Bools, Floats
from core.gait.gait import Gait
from core.motion.contact_timeline import ContactTimeline, Swing
from core.patterns.limits import needed_swing
from core.problem.initial_guess import Indices

MOST_ORDERS = 6
"""Number of orders that are tried if several swings have nearly the same middle."""

CLOSING = 5
"""Samples of stance that are added to a drawing that ends in the air."""

MOST_SAMPLES = 240
"""Largest number of samples of a changed drawing."""


@dataclass(frozen=True)
class Item:
    """Swings that are moved together; usually one."""

    swings: tuple[Swing, ...]

    @property
    def first(self) -> int:
        """First sample in the air."""
        return min(swing.first for swing in self.swings)

    @property
    def last(self) -> int:
        """Last sample in the air."""
        return max(swing.last for swing in self.swings)

    @property
    def length(self) -> int:
        """Number of samples from the first to the last."""
        return self.last - self.first + 1

    @property
    def middle(self) -> float:
        """Midpoint of the first and the last sample."""
        return (self.first + self.last) / 2


@dataclass(frozen=True)
class _Place:
    """An item with its new first sample and length."""

    item: Item
    first: int
    length: int

    @property
    def swings(self) -> tuple[Swing, ...]:
        """The item's swings at this place."""
        if len(self.item.swings) == 1:
            return (Swing(self.item.swings[0].foot, self.first, self.first + self.length - 1),)
        shift = self.first - self.item.first
        return tuple(Swing(s.foot, s.first + shift, s.last + shift) for s in self.item.swings)


def with_ends(gait: Gait) -> Gait:
    """The gait with its ends mended: every foot that is not held up stands there.

    A foot that is in the air only at the first sample is made to stand there. If feet are in the air at the
    last sample, a closing stance is added; if cells are locked, the feet stand at the last sample instead.
    """
    timeline = gait.timeline
    stance = timeline.stance.copy()
    held_start, held_end = _flags(gait.held.start, stance), _flags(gait.held.end, stance)
    stance[:, 0] |= ~held_start & stance[:, 1]
    if not (stance[:, -1] | held_end).all():
        if timeline.locked.any():
            stance[~held_end, -1] = True
        else:
            stance = np.concatenate([stance, np.repeat(~held_end[:, None], CLOSING, axis=1)], axis=1)
    return gait if np.array_equal(stance, timeline.stance) else _with(gait, stance)


def with_forgotten_feet(gait: Gait) -> Gait:
    """The gait with a swing added at the end for every foot that has none and is not held up.

    Nothing changes if no foot swings, cells are locked, or the gait neither steps nor turns.
    """
    swinging = {swing.foot for swing in gait.timeline.swings()}
    walking = set(range(gait.timeline.leg_count)) - {foot - 1 for foot in gait.held.both}
    forgotten = sorted(walking - swinging)
    if not swinging or not forgotten or gait.timeline.locked.any() or not any(gait.step):
        return gait
    legs, least = gait.timeline.leg_count, needed_swing(gait)
    parts = [gait.timeline.stance]
    for foot in forgotten:
        swing = np.ones((legs, least + 1), dtype=np.bool_)
        swing[foot, :least] = False
        parts.append(swing)
    return _with(gait, np.concatenate([*parts, np.ones((legs, CLOSING), dtype=np.bool_)], axis=1))


def with_single_swings(gait: Gait) -> Gait:
    """The gait in which each foot swings at most once an iteration.

    Swings during which the fewest feet stand are removed first. Swings with locked cells stay, and so do
    those at the start and at the end.
    """
    timeline = gait.timeline
    stance = timeline.stance.copy()
    last = timeline.sample_count - 1

    def standing_feet(swing: Swing) -> tuple[int, int]:
        return int(stance[:, swing.first : swing.last + 1].sum(axis=0).min()), len(swing.samples)

    for foot in range(timeline.leg_count):
        swings = [swing for swing in timeline.swings() if swing.foot == foot]
        free = [
            swing
            for swing in swings
            if swing.first > 0
            and swing.last < last
            and not timeline.locked[foot, swing.first : swing.last + 1].any()
        ]
        for swing in sorted(free, key=standing_feet)[: max(len(swings) - gait.iterations, 0)]:
            stance[foot, swing.first : swing.last + 1] = True
    return gait if np.array_equal(stance, timeline.stance) else _with(gait, stance)


def items_of(gait: Gait, together: Bools | None = None) -> list[Item]:
    """The swings of a drawing in the order of their middles, without those of feet that are held up.

    Args:
        gait: the drawing.
        together: (samples,) True where overlapping swings are moved together; None for nowhere.
    """
    last = gait.timeline.sample_count - 1
    swings = [
        swing
        for swing in gait.timeline.swings()
        if not (swing.first == 0 and swing.foot + 1 in gait.held.start)
        and not (swing.last == last and swing.foot + 1 in gait.held.end)
    ]
    swings.sort(key=lambda swing: (swing.first + swing.last, swing.foot))
    found: list[Item] = []
    for swing in swings:
        overlaps = [item for item in found if swing.first <= item.last and item.first <= swing.last]
        joined = Item((*(s for item in overlaps for s in item.swings), swing))
        if together is not None and overlaps and together[joined.first : joined.last + 1].all():
            found = [item for item in found if item not in overlaps] + [joined]
        else:
            found.append(Item((swing,)))
    return sorted(found, key=lambda item: (item.middle, item.swings[0].foot))


def one_after_the_other(gait: Gait, items: Sequence[Item], gap: int) -> Gait | None:
    """The same swings in the same time without overlap, with as few changed cells as possible.

    Args:
        gait: the drawing; its locked cells stay as they are.
        items: of `items_of`.
        gap: samples of stance between two items, and at both ends.

    Returns:
        None if the items do not fit.
    """
    layout = _Layout(gait.timeline, gap, needed_swing(gait), *_room(gait))
    found = [placed for order in _orders(items) if (placed := layout.placed(order)) is not None]
    if not found:
        return None
    _, places = min(found, key=lambda one: one[0])
    return _with(gait, _laid(gait, places, gait.timeline.sample_count))


def _room(gait: Gait) -> tuple[int, int]:
    """First and last sample that are free of the swings of feet held up at one end."""
    first, last = 0, gait.timeline.sample_count - 1
    end = last
    for swing in gait.timeline.swings():
        starts = swing.first == 0 and swing.foot + 1 in gait.held.start
        ends = swing.last == end and swing.foot + 1 in gait.held.end
        if starts and not ends:
            first = max(first, swing.last + 1)
        if ends and not starts:
            last = min(last, swing.first - 1)
    return first, last


def longer(gait: Gait, items: Sequence[Item], gap: int, least: int = 0) -> Gait | None:
    """The same swings one after the other in a longer gait.

    Args:
        gait: a drawing without locked cells. Feet that are held at one end swing there as before.
        items: of `items_of`.
        gap: least samples of stance between two items, and at both ends.
        least: least samples of each swing, unless the step needs more.

    Returns:
        None if cells are locked, nothing swings, or the gait would be too long.
    """
    if gait.timeline.locked.any() or not items:
        return None
    least = max(least, needed_swing(gait))
    first, last = _room(gait)
    at, places = max(items[0].first, first + max(gap, 1)), []
    for item, following in pairwise([*items, None]):
        if item is None:
            continue
        length = max(item.length, least) if len(item.swings) == 1 else item.length
        places.append(_Place(item, at, length))
        pause = 0 if following is None else following.first - item.last - 1
        at += length + max(gap, pause)
    closing = max(last - items[-1].last, gap, 1)
    tail = gait.timeline.sample_count - 1 - last
    samples = places[-1].first + places[-1].length + closing + tail
    return _with(gait, _laid(gait, places, samples)) if samples <= MOST_SAMPLES else None


def _orders(items: Sequence[Item]) -> Iterator[list[Item]]:
    """Orders of items; items with nearly the same middle are permuted."""
    groups: list[list[Item]] = []
    for item in items:
        if groups and item.middle - groups[-1][0].middle <= 1:
            groups[-1].append(item)
        else:
            groups.append([item])
    for chosen in islice(product(*(permutations(group) for group in groups)), MOST_ORDERS):
        yield [item for group in chosen for item in group]


class _Layout:
    """Places items one after the other, by dynamic programming over the sample at which each ends."""

    def __init__(self, timeline: ContactTimeline, gap: int, least: int, first: int, last: int) -> None:
        self._timeline = timeline
        self._from, self._to = first, last
        self._gap, self._least = max(gap, 1), least

    def placed(self, items: Sequence[Item]) -> tuple[float, list[_Place]] | None:
        """The least number of changed cells and the places that need it; None if the items do not fit."""
        samples = self._timeline.sample_count
        reached = np.zeros(samples)
        chosen: list[tuple[Item, Floats, Indices]] = []
        for item in items:
            cost, lengths = np.full(samples, np.inf), np.zeros(samples, dtype=np.intp)
            for length in self._lengths(item):
                starts = np.arange(self._from + self._gap, self._to + 1 - self._gap - length + 1)
                if not len(starts):
                    continue
                # The first item has no item before it; no later one can begin at the earliest start.
                before = reached[starts - 1 - self._gap] if chosen else np.zeros(len(starts))
                before = np.where(starts > self._from + self._gap, before, np.inf if chosen else 0.0)
                total, ends = before + self._cost(item, starts, length), starts + length - 1
                better = total < cost[ends]
                cost[ends] = np.where(better, total, cost[ends])
                lengths[ends] = np.where(better, length, lengths[ends])
            chosen.append((item, cost, lengths))
            reached = np.minimum.accumulate(cost)
        if not items or not np.isfinite(reached[-1]):
            return None
        return float(reached[-1]), self._traced(chosen)

    def _lengths(self, item: Item) -> range:
        if len(item.swings) > 1:
            return range(item.length, item.length + 1)
        return range(self._least, max(item.length, self._least) + 1)

    def _cost(self, item: Item, starts: Indices, length: int) -> Floats:
        """Number of changed cells for each start; infinite if a locked cell would change."""
        total = np.zeros(len(starts))
        for swing in item.swings:
            drawn = np.zeros(self._timeline.sample_count)
            drawn[swing.first : swing.last + 1] = 1.0
            first = starts + (swing.first - item.first)
            count = length if len(item.swings) == 1 else swing.last - swing.first + 1
            total += drawn.sum() + count - 2 * _sums(drawn, first, count)
            locked = self._timeline.locked[swing.foot]
            lifted = _sums((locked & self._timeline.stance[swing.foot]) * 1.0, first, count)
            lowered = (locked * drawn).sum() - _sums(locked * drawn, first, count)
            total[(lifted > 0) | (lowered > 0)] = np.inf
        return total

    def _traced(self, chosen: Sequence[tuple[Item, Floats, Indices]]) -> list[_Place]:
        places: list[_Place] = []
        end = self._timeline.sample_count - 1
        for item, cost, lengths in reversed(chosen):
            end = int(np.argmin(cost[: end + 1]))
            places.append(_Place(item, end - int(lengths[end]) + 1, int(lengths[end])))
            end -= int(lengths[end]) + self._gap
        return places[::-1]


def _sums(flags: Floats, first: Indices, count: int) -> Floats:
    """Sums of flags over `count` samples from each of the first ones."""
    sums = np.concatenate([[0.0], np.cumsum(flags)])
    return np.asarray(sums[first + count] - sums[first])


def _laid(gait: Gait, places: Sequence[_Place], samples: int) -> Bools:
    """The stance with the items in their places; swings of feet that are held up stay at their end."""
    stance = np.ones((gait.timeline.leg_count, samples), dtype=np.bool_)
    moved = {swing for place in places for swing in place.item.swings}
    count = gait.timeline.sample_count
    for swing in gait.timeline.swings():
        if swing in moved:
            continue
        ends = swing.last == count - 1
        first = swing.first + (samples - count if ends and swing.first > 0 else 0)
        last = samples - 1 if ends else swing.last
        stance[swing.foot, first : last + 1] = False
    for swing in (swing for place in places for swing in place.swings):
        stance[swing.foot, swing.first : swing.last + 1] = False
    return stance


def _with(gait: Gait, stance: Bools) -> Gait:
    """The gait with another drawing; locks are kept if the number of samples is the same."""
    same = stance.shape == gait.timeline.locked.shape
    locked = gait.timeline.locked if same else np.zeros(stance.shape, dtype=np.bool_)
    return replace(gait, timeline=ContactTimeline(stance, locked, gait.timeline.sample_time))


def _flags(feet: tuple[int, ...], stance: Bools) -> Bools:
    flags = np.zeros(len(stance), dtype=np.bool_)
    flags[[foot - 1 for foot in feet]] = True
    return flags
