"""Ways to mend a segment table in which an edited segment does not fit to its neighbours."""

from collections import deque
from collections.abc import Collection
from dataclasses import dataclass, replace
from itertools import pairwise

from core.errors import InputError
from core.segments.segment_chains import Cell, RowTemplate, cheapest_chain
from core.segments.segment_table import SegmentTable, SegmentVocabulary

Rows = tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class DraftTable:
    """A table as it was typed: its segments need not fit together (fields as in `SegmentTable`)."""

    rows: Rows
    samples_per_segment: int
    repeat_from: int
    repeat_to: int | None
    link: Rows
    vocabulary: SegmentVocabulary

    def table(self) -> SegmentTable:
        """The table.

        Raises:
            InputError: naming the first segment that does not fit.
        """
        return SegmentTable(
            self.rows, self.samples_per_segment, self.repeat_from, self.vocabulary, self.repeat_to, self.link
        )


@dataclass(frozen=True)
class Repair:
    """One way out.

    Args:
        foot: whose segments change, 0-based.
        first: the first of them, 0-based; the number of segments where only the link changes.
        names: of the segments put there.
        inserted: whether they come in between, as new segments of every foot.
        table: what comes of it.
    """

    foot: int
    first: int
    names: tuple[str, ...]
    inserted: bool
    table: SegmentTable


def repairs(draft: DraftTable, kept: Collection[tuple[int, int]]) -> tuple[Repair, ...]:
    """Changes after which a table can be walked, the smaller ones first; empty where none was found.

    Args:
        draft: the table as it was typed.
        kept: foot and segment of the cells that must stay, 0-based; a link's count on after the row's.

    Raises:
        InputError: the rows are not of one length, or the repeating part lies outside of them.
    """
    _require_shape(draft)
    feet = range(len(draft.rows))
    broken = [f for f in feet if _first_break(draft, f) is not None] or [
        f for f in feet if not _chains(draft, f)
    ]
    if not broken:
        return ()
    foot = broken[0]
    found = (_replaced(draft, foot, kept), _inserted(draft, foot))
    return tuple(repair for repair in found if repair is not None)


def _require_shape(draft: DraftTable) -> None:
    for rows in (draft.rows, draft.link):
        if len({len(row) for row in rows}) > 1:
            raise InputError("Every foot needs as many segments as foot 1.", "segment_table")
    if draft.link and len(draft.link) != len(draft.rows):
        raise InputError(f"The link has {len(draft.link)} feet; it needs {len(draft.rows)}.", "link")
    count = len(draft.rows[0]) if draft.rows else 0
    last = count if draft.repeat_to is None else draft.repeat_to
    if not 1 <= draft.repeat_from <= last <= count:
        raise InputError(
            f"Segments {draft.repeat_from} to {last} repeat; they must lie in 1 to {count}.", "repeat_from"
        )


def _first_break(draft: DraftTable, foot: int) -> int | None:
    """Index of the first segment that does not start where the one before ends."""
    known, row = draft.vocabulary.segments, draft.rows[foot]
    for index, name in enumerate(row):
        if name not in known or (index and known[row[index - 1]].end != known[name].start):
            return index
    return None


def _chains(draft: DraftTable, foot: int) -> bool:
    """Whether a foot's link leads from the end of its repeating part to its beginning."""
    known, row = draft.vocabulary.segments, draft.rows[foot]
    link = draft.link[foot] if draft.link else ()
    around = (row[(draft.repeat_to or len(row)) - 1], *link, row[draft.repeat_from - 1])
    return all(
        before in known and after in known and known[before].end == known[after].start
        for before, after in pairwise(around)
    )


def _replaced(draft: DraftTable, foot: int, kept: Collection[tuple[int, int]]) -> Repair | None:
    """The row with the fewest other names changed."""
    known, row = draft.vocabulary.segments, draft.rows[foot]
    cells = tuple(
        Cell(name if name in known else None, kept=(foot, index) in kept and name in known)
        for index, name in enumerate(row)
    )
    first, last = draft.repeat_from - 1, draft.repeat_to or len(row)
    end = known[row[-1]].end if row[-1] in known else None
    link = tuple(
        Cell(name if name in known else None, kept=(foot, len(row) + index) in kept and name in known)
        for index, name in enumerate(draft.link[foot] if draft.link else ())
    )
    for chained in (True, False):
        wish = RowTemplate(cells[:first], cells[first:last], cells[last:], link, None, end, chained)
        chain = cheapest_chain(wish, draft.vocabulary)
        if chain is not None:
            break
    else:
        return None
    changed = [index for index, name in enumerate(chain.row) if name != row[index]] or [len(row)]
    links = tuple(chain.link if f == foot else one for f, one in enumerate(draft.link))
    rows = tuple(chain.row if f == foot else one for f, one in enumerate(draft.rows))
    names = chain.row[changed[0] : changed[-1] + 1]
    return _valid(foot, changed[0], names, False, replace(draft, rows=rows, link=links))


def _inserted(draft: DraftTable, foot: int) -> Repair | None:
    """The table with segments in between that lead on; the other feet wait meanwhile."""
    index, known = _first_break(draft, foot), draft.vocabulary.segments
    if not index or draft.rows[foot][index] not in known:
        return None
    row = draft.rows[foot]
    names = _way(draft.vocabulary, known[row[index - 1]].end, known[row[index]].start)
    rows = []
    for one, other in enumerate(draft.rows):
        between = names if one == foot else _waiting(draft.vocabulary, other, index, len(names))
        if between is None:
            return None
        rows.append(other[:index] + between + other[index:])
    more = len(names)
    before = index <= draft.repeat_from - 1
    longer = replace(
        draft,
        rows=tuple(rows),
        repeat_from=draft.repeat_from + (more if before else 0),
        repeat_to=None if draft.repeat_to is None else draft.repeat_to + (more * (index < draft.repeat_to)),
    )
    return _valid(foot, index, names, True, longer) if names else None


def _way(vocabulary: SegmentVocabulary, start: str, end: str) -> tuple[str, ...]:
    """The fewest segments from one position to another; empty where there is no way."""
    ways: dict[str, tuple[str, ...]] = {start: ()}
    queue = deque([start])
    while queue and end not in ways:
        here = queue.popleft()
        for name, segment in vocabulary.segments.items():
            if segment.start == here and segment.end not in ways:
                ways[segment.end] = (*ways[here], name)
                queue.append(segment.end)
    return ways.get(end, ())


def _waiting(
    vocabulary: SegmentVocabulary, row: tuple[str, ...], index: int, count: int
) -> tuple[str, ...] | None:
    """A wait where the foot is before a segment; None where the vocabulary has none."""
    name = row[index - 1]
    place = vocabulary.segments[name].end if name in vocabulary.segments else None
    wait = next((n for n, s in vocabulary.segments.items() if s.start == s.end == place), None)
    return None if wait is None else (wait,) * count


def _valid(foot: int, first: int, names: tuple[str, ...], inserted: bool, draft: DraftTable) -> Repair | None:
    try:
        return Repair(foot, first, names, inserted, draft.table())
    except InputError:
        return None
