"""Makes a segment table of a drawn timeline, where its swings have room for the segments of a step."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from core.arrays import Bools
from core.errors import InputError
from core.motion.contact_timeline import ContactTimeline
from core.segments.from_timeline_edit import border_refusal, break_sentence
from core.segments.segment_chains import Cell, RowTemplate, cheapest_chain, first_break
from core.segments.segment_table import SegmentTable, SegmentVocabulary

HOME = "Home-Base"
"""Where every foot of a made table begins and ends an iteration."""


_REMEDY = (
    "A step is a segment of lifting and an equally long one of stepping: draw swings of an even number of "
    "samples, such as 6, and as many or half as many before, between and after them."
)


def table_from_timeline(
    timeline: ContactTimeline, iterations: int, quarter_turns: int, vocabulary: SegmentVocabulary
) -> SegmentTable:
    """A segment table that implies exactly a timeline, with segments as long as the timeline allows.

    Args:
        timeline: of the robot's own feet, all iterations and the closing stance.
        iterations: how many it holds.
        quarter_turns: from direction 1 to the gait's.
        vocabulary: what the table's names mean; it knows `HOME`.

    Raises:
        InputError: no length of segment will do; the sentence is about the longest one.
    """
    swing = ~timeline.stance
    if not swing.any():
        raise InputError("No foot leaves the ground; draw a swing first.", "timeline")
    refusal: InputError | None = None
    for samples in _lengths(swing):
        try:
            return _table(swing[:, ::samples], iterations, samples, vocabulary).turned_back(quarter_turns)
        except InputError as error:
            refusal = refusal or error
    where = border_refusal(swing, max(2, _shortest(swing) // 2))
    raise refusal or InputError(_REMEDY if where is None else f"{where} {_REMEDY}", "timeline")


def _lengths(swing: Bools) -> list[int]:
    """Lengths of a segment of which all borders are multiples, the longest first; two fit into each swing."""
    changes = np.nonzero((swing[:, 1:] != swing[:, :-1]).any(axis=0))[0] + 1
    common = int(np.gcd.reduce([*changes, swing.shape[1]]))
    return [length for length in range(_shortest(swing) // 2, 1, -1) if common % length == 0]


def _shortest(swing: Bools) -> int:
    """Samples of the shortest swing."""
    rows = ("".join("01"[int(one)] for one in row) for row in swing)
    return min(len(run) for row in rows for run in row.split("0") if run)


@dataclass(frozen=True)
class _Frame:
    """Segments before the repeating part, in it, and how often it is run through."""

    opening: int
    period: int
    iterations: int

    def one(self, blocks: Bools) -> Bools:
        """The columns of one iteration."""
        again = self.opening + self.period * self.iterations
        return np.concatenate([blocks[:, : self.opening + self.period], blocks[:, again:]], axis=1)

    def place(self, index: int) -> int:
        """Where a column of one iteration stands in all of them, for the first time."""
        inside = index < self.opening + self.period
        return index if inside else index + (self.iterations - 1) * self.period


def _frames(blocks: Bools, iterations: int) -> Iterator[_Frame]:
    """Ways to see the timeline as an opening, iterations that are alike, and a closing stance."""
    moving = np.nonzero(blocks.any(axis=0))[0]
    count = blocks.shape[1]
    lead, trail = int(moving[0]), count - 1 - int(moving[-1])
    if iterations == 1:
        yield from (_Frame(opening, count - opening, 1) for opening in dict.fromkeys((min(lead, trail), 0)))
        return
    for opening in range(lead + 1):
        for period in range((count - opening) // iterations, 0, -1):
            end = opening + period * iterations
            whole = blocks[:, opening:end].reshape(len(blocks), iterations, period)
            if (whole == whole[:, :1]).all() and end > moving[-1]:
                yield _Frame(opening, period, iterations)


def _table(blocks: Bools, iterations: int, samples: int, vocabulary: SegmentVocabulary) -> SegmentTable:
    refusal: InputError | None = None
    for frame in _frames(blocks, iterations):
        try:
            return _framed(frame, frame.one(blocks), samples, vocabulary)
        except InputError as error:
            refusal = refusal or error
    raise refusal or InputError(
        f"The {iterations} iterations are not drawn alike, so that one table cannot say them.",
        "timeline",
    )


def _framed(frame: _Frame, swing: Bools, samples: int, vocabulary: SegmentVocabulary) -> SegmentTable:
    rows = tuple(_row(foot, row, frame, samples, vocabulary) for foot, row in enumerate(swing))
    last = frame.opening + frame.period
    repeat_to = last if last < swing.shape[1] else None
    return SegmentTable(rows, samples, frame.opening + 1, vocabulary, repeat_to)


def _row(
    foot: int, swing: Bools, frame: _Frame, samples: int, vocabulary: SegmentVocabulary
) -> tuple[str, ...]:
    cells = tuple(Cell(None, bool(one)) for one in swing)
    first, last = frame.opening, frame.opening + frame.period
    wish = RowTemplate(cells[:first], cells[first:last], cells[last:], (), HOME, HOME, chained=True)
    chain = cheapest_chain(wish, vocabulary)
    if chain is not None:
        return chain.row
    found = first_break(wish, vocabulary)
    if found is None:
        raise InputError(
            f"Foot {foot + 1} has no time on the ground after its last swing to return to {HOME}; draw one "
            f"segment of {samples} samples there.",
            "timeline",
        )
    raise InputError(break_sentence(foot, found, wish, frame.place(found.index), samples), "timeline")
