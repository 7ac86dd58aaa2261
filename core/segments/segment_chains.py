"""Rows of segments that follow one another: what is asked of each cell, with the least change."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from core.segments.segment_table import Segment, SegmentVocabulary

_DIGIT = 10_000
"""More than the segments of any row, so that a weightier reason is never outweighed by many lighter ones."""
_ELSEWHERE = _DIGIT**4

LEAST_COST_OF_TURNING = _DIGIT**2 + _DIGIT
"""What a cell costs at least that changes between air and ground: another name, and the change itself."""
_NO_WAY = 10**18
"""More than any row costs; four of them still fit into 64 bits."""

Integers = npt.NDArray[np.int64]
Costs = Integers
"""Costs of going on, a row for each named position."""


@dataclass(frozen=True)
class Cell:
    """What is asked of one cell of a foot's row.

    Args:
        name: of the segment that stands there now; None where the cell is new.
        swing: whether the foot is in the air; None where either will do.
        kept: whether the name must stay.
    """

    name: str | None
    swing: bool | None = None
    kept: bool = False


@dataclass(frozen=True)
class RowTemplate:
    """What is asked of one foot's row and of its link.

    Args:
        opening: cells before the repeating part.
        repeating: cells of the repeating part.
        closing: cells after it.
        link: cells from the end of the repeating part to its beginning.
        start: where the foot is at first; None for anywhere.
        end: where it had better be at last; None for anywhere.
        chained: whether the link must lead from the end of the repeating part to its beginning.
    """

    opening: tuple[Cell, ...]
    repeating: tuple[Cell, ...]
    closing: tuple[Cell, ...]
    link: tuple[Cell, ...]
    start: str | None
    end: str | None
    chained: bool

    @property
    def row(self) -> tuple[Cell, ...]:
        """All cells but the link's."""
        return self.opening + self.repeating + self.closing


@dataclass(frozen=True)
class LinkedRow:
    """A row that can be walked, and what it costs."""

    row: tuple[str, ...]
    link: tuple[str, ...]
    cost: int


@dataclass(frozen=True)
class Break:
    """Where no row can go on: the cell's index, and the positions that the foot can be at before it."""

    index: int
    reached: tuple[str, ...]


def airborne_positions(vocabulary: SegmentVocabulary) -> frozenset[str]:
    """Positions at which one segment in the air ends and another begins."""
    swings = [segment for segment in vocabulary.segments.values() if segment.swing]
    return frozenset(s.end for s in swings) & frozenset(s.start for s in swings)


def cheapest_chain(wish: RowTemplate, vocabulary: SegmentVocabulary) -> LinkedRow | None:
    """The cheapest row that fits together, a dynamic program over named positions.

    What counts, the weightier first: the row ends where it had better; no foot comes down at a position in
    mid-air; few names change; few cells change between air and ground; few new segments move the foot. Among
    equals the segment that stands earlier in the vocabulary is taken, the row's first cells first.

    Returns:
        The row, or None where there is none.
    """
    maker = _Maker(vocabulary)
    places = len(maker.places)
    ends = [0 if wish.end in (None, place) else _ELSEWHERE for place in maker.places]
    anywhere = np.where(np.eye(places, dtype=bool), 0, _NO_WAY)
    opening, repeating, link = (
        maker.to_go(cells, anywhere) for cells in (wish.opening, wish.repeating, wish.link)
    )
    closing = maker.to_go(wish.closing, np.array(ends)[:, None])
    back = link[0] if wish.chained else np.zeros_like(anywhere)
    # By where the repeating part ends, x, and begins, y, and by where the row starts.
    total = (closing[0][:, :, None] + (repeating[0].T + back)[:, :, None]) + opening[0].T[None]
    if wish.start is not None:
        total[:, :, [place != wish.start for place in maker.places]] = _NO_WAY
    x, y, start = (int(index) for index in np.unravel_index(int(total.argmin()), total.shape))
    if total[x, y, start] >= _NO_WAY:
        return None
    row = maker.walk(wish.opening, start, [layer[:, y] for layer in opening])
    row += maker.walk(wish.repeating, y, [layer[:, x] for layer in repeating])
    row += maker.walk(wish.closing, x, [layer[:, 0] for layer in closing])
    kept = tuple(cell.name for cell in wish.link if cell.name is not None)
    linked = maker.walk(wish.link, x, [layer[:, y] for layer in link]) if wish.chained else kept
    return LinkedRow(row, linked, int(total[x, y, start]))


def first_break(wish: RowTemplate, vocabulary: SegmentVocabulary) -> Break | None:
    """The first cell that nothing can stand in; None where only the row's end or link is in the way."""
    maker = _Maker(vocabulary)
    reached: Iterable[str] = maker.places if wish.start is None else (wish.start,)
    for index, cell in enumerate(wish.row):
        before = tuple(reached)
        reached = dict.fromkeys(s.end for _, s, _ in maker.choices(cell) if s.start in before)
        if not reached:
            return Break(index, before)
    return None


@dataclass(frozen=True, eq=False)
class _Move:
    """What may stand in a cell, sorted by where it starts; positions by their index.

    Args:
        starts: where something starts, each once.
        firsts: index of the first choice that starts there.
        ends: where each choice ends.
        costs: (choices, 1).
    """

    starts: Integers
    firsts: Integers
    ends: Integers
    costs: Costs


class _Maker:
    """Costs over one vocabulary."""

    def __init__(self, vocabulary: SegmentVocabulary) -> None:
        self._segments = vocabulary.segments
        self._airborne = airborne_positions(vocabulary)
        named = (position for s in self._segments.values() for position in (s.start, s.end))
        self.places = tuple(dict.fromkeys(named))
        self._index = {place: index for index, place in enumerate(self.places)}
        self._choices: dict[Cell, tuple[tuple[str, Segment, int], ...]] = {}
        self._moves: dict[Cell, _Move | None] = {}

    def choices(self, cell: Cell) -> tuple[tuple[str, Segment, int], ...]:
        """Name, segment and cost of all that may stand in a cell, in the vocabulary's order."""
        if cell not in self._choices:
            fits = ((name, s) for name, s in self._segments.items() if _fits(cell, name, s))
            self._choices[cell] = tuple((name, s, self._cost(cell, name, s)) for name, s in fits)
        return self._choices[cell]

    def _cost(self, cell: Cell, name: str, segment: Segment) -> int:
        if name == cell.name:
            return 0
        comes_down = not segment.swing and segment.start in self._airborne
        turns = cell.name is not None and self._segments[cell.name].swing != segment.swing
        reasons = (comes_down, cell.name is not None, turns, segment.start != segment.end)
        cost = 0
        for reason in reasons:
            cost = cost * _DIGIT + reason
        return cost

    def to_go(self, cells: Sequence[Cell], ends: Costs) -> list[Costs]:
        """Least cost from each position before each cell to each of several ends.

        Args:
            cells: in their order.
            ends: (positions, ends) what is still to be paid at each position behind the last cell.

        Returns:
            Before each cell and behind the last one (positions, ends); `_NO_WAY` where there is none.
        """
        layers = [ends]
        for cell in reversed(cells):
            layer = np.full_like(ends, _NO_WAY)
            move = self._move(cell)
            if move is not None:
                least = np.minimum.reduceat(layers[-1][move.ends] + move.costs, move.firsts)
                layer[move.starts] = np.minimum(least, _NO_WAY)
            layers.append(layer)
        return layers[::-1]

    def _move(self, cell: Cell) -> _Move | None:
        """All that may stand in a cell, by where it starts; None where nothing may."""
        if cell not in self._moves:
            choices = sorted(self.choices(cell), key=lambda one: self._index[one[1].start])
            starts = np.array([self._index[s.start] for _, s, _ in choices], dtype=np.int64)
            firsts = np.nonzero(np.diff(starts, prepend=-1))[0]
            ends = np.array([self._index[s.end] for _, s, _ in choices], dtype=np.int64)
            costs = np.array([cost for _, _, cost in choices], dtype=np.int64)[:, None]
            self._moves[cell] = _Move(starts[firsts], firsts, ends, costs) if choices else None
        return self._moves[cell]

    def walk(self, cells: Sequence[Cell], place: int, layers: Sequence[Costs]) -> tuple[str, ...]:
        """The cheapest way from a position to one end, by what `to_go` found for that end."""
        names = []
        for cell, here, after in zip(cells, layers, layers[1:], strict=False):
            name, place = next(
                (name, end)
                for name, s, cost in self.choices(cell)
                if self._index[s.start] == place and cost + after[end := self._index[s.end]] == here[place]
            )
            names.append(name)
        return tuple(names)


def _fits(cell: Cell, name: str, segment: Segment) -> bool:
    return (cell.swing is None or segment.swing == cell.swing) and (not cell.kept or name == cell.name)
