"""The columns of a segment table, part by part, and where columns can be inserted or removed."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from enum import StrEnum

from core.segments.segment_table import SegmentTable


class Part(StrEnum):
    """A part of a table: what an iteration begins with, repeats and ends with, and what leads to the next."""

    REPEATING = "repeating"
    CLOSING = "closing"
    OPENING = "opening"
    LINK = "link"


Column = tuple[Part, int]
"""A column by its part and its index there."""

Shape = tuple[int, int, int, int]
"""How many columns each part has."""


@dataclass(frozen=True)
class Layout:
    """Which columns of a table stand where: their indices in its rows or link, None for a new column."""

    opening: tuple[int | None, ...]
    repeating: tuple[int | None, ...]
    closing: tuple[int | None, ...]
    link: tuple[int | None, ...]

    def columns(self, iterations: int) -> tuple[Column, ...]:
        """Every column in the order in which all iterations run through them."""
        opening, repeating, closing, link = (
            tuple((part, index) for index in range(len(self.part(part))))
            for part in (Part.OPENING, Part.REPEATING, Part.CLOSING, Part.LINK)
        )
        return opening + repeating + (link + repeating) * (iterations - 1) + closing

    @property
    def shape(self) -> Shape:
        """How long its parts are."""
        return len(self.opening), len(self.repeating), len(self.closing), len(self.link)

    def part(self, part: Part) -> tuple[int | None, ...]:
        """The columns of one part."""
        columns: tuple[int | None, ...] = getattr(self, part.value)
        return columns


def layout_of(table: SegmentTable) -> Layout:
    """The table as it is."""
    first, last = table.repeat_from - 1, table.last_repeated
    indices = range(table.segment_count)
    link = range(len(table.link[0]) if table.link else 0)
    return Layout(tuple(indices[:first]), tuple(indices[first:last]), tuple(indices[last:]), tuple(link))


def layouts(table: SegmentTable, iterations: int, count: int) -> Iterator[Layout]:
    """Every layout with a number of segments, columns inserted or removed at one place.

    Args:
        table: whose columns they are.
        iterations: how often it is run through.
        count: segments of all iterations.
    """
    present = layout_of(table)
    missing = count - len(present.columns(iterations))
    if missing == 0:
        yield present
        return
    times = {Part.OPENING: 1, Part.REPEATING: iterations, Part.CLOSING: 1, Part.LINK: iterations - 1}
    for part in Part:
        if times[part] and missing % times[part] == 0:
            for columns in _changed(present.part(part), missing // times[part]):
                if columns or part is not Part.REPEATING:
                    yield replace(present, **{part.value: columns})


def _changed(columns: tuple[int | None, ...], more: int) -> Iterator[tuple[int | None, ...]]:
    """The columns with some more new ones at each place, or with as many fewer."""
    if more > 0:
        for place in range(len(columns) + 1):
            yield columns[:place] + (None,) * more + columns[place:]
        return
    for place in range(len(columns) + more + 1):
        yield columns[:place] + columns[place - more :]
