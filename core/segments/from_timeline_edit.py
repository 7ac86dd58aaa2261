"""Carries what was drawn on a timeline into a segment table, where the table can say it."""

from dataclasses import dataclass, replace

import numpy as np

from core.arrays import Bools
from core.motion.contact_timeline import ContactTimeline
from core.segments.segment_chains import (
    LEAST_COST_OF_TURNING,
    Break,
    Cell,
    LinkedRow,
    RowTemplate,
    airborne_positions,
    cheapest_chain,
    first_break,
)
from core.segments.segment_table import SegmentTable, SegmentVocabulary
from core.segments.table_layout import Column, Layout, Part, Shape, layouts

MOST_LAYOUTS = 24
"""Places at which an insertion or removal is tried, the likeliest ones first; more only until one will do."""


@dataclass(frozen=True)
class Carried:
    """What became of a drawing.

    Args:
        table: that implies exactly what was drawn, at direction 1; None where none can.
        sentence: why there is none, or what a person should know of the table.
    """

    table: SegmentTable | None
    sentence: str | None = None


def carried(table: SegmentTable, timeline: ContactTimeline, iterations: int, quarter_turns: int) -> Carried:
    """Changes as little of a segment table as possible, so that it implies what was drawn.

    Each foot is a dynamic program of its own (see `core.segments.segment_chains`): a segment starts where
    the one before ends, its swing flag is the timeline's, the row starts where it starts now, and where
    iterations could follow one another they still can. Samples may have been inserted or removed in whole
    segments; then they are where fewest cells change between air and ground, and among those where fewest
    names change.

    Args:
        table: as it is, at direction 1.
        timeline: as it was drawn, all iterations, of the robot's own feet.
        iterations: how many it holds.
        quarter_turns: from direction 1 to the gait's.

    Returns:
        The table, or the foot, the sample and the reason.
    """
    own = table.turned(quarter_turns)
    samples = own.samples_per_segment
    swing = ~timeline.stance
    refusal = border_refusal(swing, samples)
    if refusal is not None:
        return Carried(None, refusal)
    made = _best(own, swing[:, ::samples], iterations)
    if isinstance(made, str):
        return Carried(None, made)
    return Carried(made.turned_back(quarter_turns), _tap(own, made))


def border_refusal(swing: Bools, samples: int) -> str | None:
    """Says where a foot lifts or comes down within a segment; None where all changes lie on borders.

    Args:
        swing: (legs, samples) true in the air.
        samples: of each segment.
    """
    for foot, row in enumerate(swing, 1):
        for change in (int(index) + 1 for index in np.nonzero(np.diff(row.astype(np.int8)))[0]):
            if change % samples:
                verb = "step" if row[change] else "stand"
                before = change - change % samples + 1
                return (
                    f"Foot {foot} would {verb} from sample {change + 1}; segments change at samples {before} "
                    f"and {before + samples}."
                )
    if swing.shape[1] % samples:
        return (
            f"The timeline has {swing.shape[1]} samples, which is no whole number of segments of {samples} "
            "samples. Insert or remove whole segments."
        )
    return None


def _best(own: SegmentTable, blocks: Bools, iterations: int) -> SegmentTable | str:
    """The cheapest of the likeliest tables of the wanted length, or why there is none."""
    best: tuple[int, SegmentTable] | None = None
    # Whether a row can be walked depends on how long its parts are, not on the names that stand there now.
    refused: dict[Shape, str] = {}
    for tried, (changing, layout, wanted) in enumerate(_likeliest(own, blocks, iterations)):
        if best is not None and (best[0] <= changing * LEAST_COST_OF_TURNING or tried >= MOST_LAYOUTS):
            break
        if layout.shape in refused:
            continue
        made = wanted if isinstance(wanted, str) else _filled(own, layout, wanted)
        if isinstance(made, str):
            refused[layout.shape] = made
        elif best is None or made[0] < best[0]:
            best = made
    if best is not None:
        return best[1]
    return next(iter(refused.values()), None) or (
        f"The timeline now has {blocks.shape[1]} segments; what is inserted or removed must be the same in "
        f"each of its {iterations} iterations."
    )


@dataclass(frozen=True)
class _Asked:
    """What is asked of a column: which feet are in the air; its first place in all iterations."""

    swing: Bools
    place: int


_Wanted = dict[Column, _Asked]


def _likeliest(own: SegmentTable, blocks: Bools, iterations: int) -> list[tuple[int, Layout, _Wanted | str]]:
    """Every layout with the cells that it changes between air and ground, fewest first, and what is asked."""
    segments = own.vocabulary.segments
    row, link = (
        np.array([[segments[n].swing for n in names] for names in rows]) for rows in (own.rows, own.link)
    )
    asked: dict[Shape, tuple[_Wanted | str, dict[Part, Bools]]] = {}
    found = []
    for layout in layouts(own, iterations, blocks.shape[1]):
        if layout.shape not in asked:
            wanted = _wanted(layout, blocks, iterations)
            asked[layout.shape] = wanted, _swings(wanted)
        wanted, swings = asked[layout.shape]
        changing = blocks.size + 1 if isinstance(wanted, str) else 0
        for part, swing in swings.items():
            present = link if part is Part.LINK else row
            places, columns = _present(layout.part(part))
            changing += int(np.count_nonzero(present[:, columns] != swing[:, places]))
        found.append((changing, layout, wanted))
    return sorted(found, key=lambda one: one[0])


def _swings(wanted: _Wanted | str) -> dict[Part, Bools]:
    """(legs, columns) which feet are in the air, for each part of which something is asked."""
    if isinstance(wanted, str):
        return {}
    columns: dict[Part, list[Bools]] = {}
    for part, index in sorted(wanted, key=lambda column: column[1]):
        columns.setdefault(part, []).append(wanted[part, index].swing)
    return {part: np.stack(swings, axis=1) for part, swings in columns.items()}


def _present(columns: tuple[int | None, ...]) -> tuple[list[int], list[int]]:
    """Places of the columns that are there already, and which they are."""
    kept = [(place, column) for place, column in enumerate(columns) if column is not None]
    return [place for place, _ in kept], [column for _, column in kept]


def _wanted(layout: Layout, blocks: Bools, iterations: int) -> _Wanted | str:
    """What the timeline asks of each column, or where two iterations ask for different things."""
    places: dict[Column, int] = {}
    firsts = [places.setdefault(column, place) for place, column in enumerate(layout.columns(iterations))]
    differing = np.argwhere((blocks != blocks[:, firsts]).T)
    if differing.size:
        place, foot = (int(index) for index in differing[0])
        words = [_word(bool(blocks[foot, one])) for one in (firsts[place], place)]
        return (
            f"Foot {foot + 1} would be {words[0]} in segment {firsts[place] + 1} and {words[1]} in segment "
            f"{place + 1}, which is the same one an iteration later. Draw all iterations alike."
        )
    return {column: _Asked(blocks[:, place], place) for column, place in places.items()}


def _word(swings: bool) -> str:
    return "in the air" if swings else "on the ground"


def _filled(own: SegmentTable, layout: Layout, wanted: _Wanted) -> tuple[int, SegmentTable] | str:
    """The cheapest table of a layout and its cost, or which foot is in the way."""
    chains: list[LinkedRow] = []
    chained = own.chains
    for foot in range(len(own.rows)):
        wish = _wish(own, foot, layout, wanted, chained)
        chain = cheapest_chain(wish, own.vocabulary)
        if chain is None:
            return _reason(foot, wish, layout, wanted, own)
        chains.append(chain)
    first = len(layout.opening) + 1
    last = first - 1 + len(layout.repeating)
    made = replace(
        own,
        rows=tuple(chain.row for chain in chains),
        link=tuple(chain.link for chain in chains) if layout.link else (),
        repeat_from=first,
        repeat_to=last if layout.closing or own.repeat_to is not None else None,
    )
    return sum(chain.cost for chain in chains), made


def _wish(own: SegmentTable, foot: int, layout: Layout, wanted: _Wanted, chained: bool) -> RowTemplate:
    segments = own.vocabulary.segments
    row, link = own.rows[foot], own.link[foot] if own.link else ()

    def cells(part: Part) -> tuple[Cell, ...]:
        names = link if part is Part.LINK else row
        found = []
        for index, column in enumerate(layout.part(part)):
            asked = wanted.get((part, index))
            swing = None if asked is None else bool(asked.swing[foot])
            found.append(Cell(None if column is None else names[column], swing))
        return tuple(found)

    return RowTemplate(
        cells(Part.OPENING),
        cells(Part.REPEATING),
        cells(Part.CLOSING),
        cells(Part.LINK),
        start=segments[row[0]].start,
        end=segments[row[-1]].end,
        chained=chained,
    )


def _reason(foot: int, wish: RowTemplate, layout: Layout, wanted: _Wanted, own: SegmentTable) -> str:
    """Why no row does what is asked of a foot."""
    found = first_break(wish, own.vocabulary)
    if found is None:
        return (
            f"Foot {foot + 1} would not be where its next iteration begins. Leave it a segment on the ground "
            "in which it returns."
        )
    place = [asked.place for column, asked in wanted.items() if column[0] is not Part.LINK][found.index]
    return break_sentence(foot, found, wish, place, own.samples_per_segment)


def break_sentence(foot: int, found: Break, wish: RowTemplate, place: int, samples: int) -> str:
    """Says at which samples nothing in the vocabulary can go on, and from where.

    Args:
        foot: 0-based.
        found: the break.
        wish: what was asked.
        place: of the segment in the timeline, 0-based.
        samples: of each segment.
    """
    word = _word(bool(wish.row[found.index].swing))
    first = place * samples + 1
    return (
        f"Foot {foot + 1} would be {word} at samples {first} to {first + samples - 1}, and no segment {word} "
        f"starts at {' or '.join(found.reached)}. Draw another swing, or add such a segment."
    )


def taps(rows: tuple[tuple[str, ...], ...], vocabulary: SegmentVocabulary) -> frozenset[tuple[int, int]]:
    """Feet and segments, 0-based, in which a foot comes down at a position in mid-air."""
    airborne, known = airborne_positions(vocabulary), vocabulary.segments
    return frozenset(
        (foot, index)
        for foot, row in enumerate(rows)
        for index, name in enumerate(row)
        if index and known[row[index - 1]].swing and not known[name].swing and known[name].start in airborne
    )


def _tap(before: SegmentTable, after: SegmentTable) -> str | None:
    """Says where a foot now comes down without a step."""
    feet = {foot for foot, _ in taps(before.rows, before.vocabulary)}
    for foot, index in sorted(taps(after.rows, after.vocabulary)):
        if foot not in feet:
            return (
                f"Foot {foot + 1} now comes down in segment {index + 1} where it lifted: its swing is too "
                "short for a step. Lengthen it by a segment."
            )
    return None
