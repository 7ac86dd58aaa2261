"""What is drawn goes into the segment table where the table can say it, and nowhere else."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.arrays import Bools
from core.errors import InputError
from core.library.library import Group, default_vocabulary, group_ids, library
from core.motion.contact_timeline import ContactTimeline, timeline_from_order
from core.segments.from_timeline import table_from_timeline
from core.segments.from_timeline_edit import Carried, carried
from core.segments.segment_chains import LinkedRow, RowTemplate, cheapest_chain
from core.segments.segment_table import SegmentTable, SegmentVocabulary

BY_HAND = group_ids(Group.BY_HAND)
SAMPLE_TIME = 0.4
VOCABULARY = default_vocabulary()


def table_of(gait_id: str) -> SegmentTable:
    table = library()[gait_id].gait.segment_table
    assert table is not None
    return table


def implied(table: SegmentTable, iterations: int = 1, turns: int = 0) -> ContactTimeline:
    return table.repeated(iterations).turned(turns).timeline(SAMPLE_TIME)


def drawn(stance: Bools) -> ContactTimeline:
    return ContactTimeline(stance, np.zeros_like(stance), SAMPLE_TIME)


def painted(timeline: ContactTimeline, foot: int, *swings: tuple[int, int]) -> ContactTimeline:
    """The timeline with other swings of a foot; both counted from 1, both ends included."""
    stance = timeline.stance.copy()
    stance[foot - 1] = True
    for first, last in swings:
        stance[foot - 1, first - 1 : last] = False
    return drawn(stance)


def carry(gait_id: str, timeline: ContactTimeline, iterations: int = 1, turns: int = 0) -> Carried:
    return carried(table_of(gait_id), timeline, iterations, turns)


@st.composite
def rows(draw: st.DrawFn, length: int, start: str, end: str) -> tuple[str, ...]:
    """A walk over the vocabulary between two positions, which there are two segments apart at most."""
    segments = VOCABULARY.segments
    homeward = {"Home-None": ("Push A",), "Step-Base": ("Zero A",), "Home-Base": ()}
    names: list[str] = []
    place = start
    while True:
        left = length - len(names)
        ways = [n for n, s in segments.items() if s.start == place and s.end in homeward]
        ways = [n for n in ways if len(homeward[segments[n].end]) <= left - 1]
        if not left:
            break
        names.append(draw(st.sampled_from(ways)))
        place = segments[names[-1]].end
    assert place == end
    return tuple(names)


@st.composite
def pairs(draw: st.DrawFn) -> tuple[SegmentTable, SegmentTable, int]:
    """Two tables of one shape that chain, and iterations."""
    first, period, rest, linked = (draw(st.integers(low, 4)) for low in (1, 2, 0, 0))
    samples, legs = draw(st.integers(2, 4)), draw(st.sampled_from((2, 4, 6)))

    def table() -> SegmentTable:
        row = [
            draw(rows(first, "Home-None", "Home-Base"))
            + draw(rows(period, "Home-Base", "Home-Base"))
            + draw(rows(rest, "Home-Base", "Home-Base"))
            for _ in range(legs)
        ]
        link = [draw(rows(linked, "Home-Base", "Home-Base")) for _ in range(legs)] if linked else []
        to = first + period if rest else None
        return SegmentTable(tuple(row), samples, first + 1, VOCABULARY, to, tuple(link))

    return table(), table(), draw(st.integers(1, 3))


@given(pairs(), st.integers(0, 3))
def test_the_timeline_of_one_table_is_carried_into_another(
    case: tuple[SegmentTable, SegmentTable, int], turns: int
) -> None:
    wanted, table, iterations = case
    timeline = implied(wanted, iterations, turns)
    found = carried(table, timeline, iterations, turns).table
    assert found is not None
    assert implied(found, iterations, turns) == timeline
    assert found.rows[0][0].startswith(("Push", "Step"))
    assert found.chains


@given(pairs(), st.data())
def test_a_carried_table_implies_exactly_what_was_drawn_or_there_is_a_reason(
    case: tuple[SegmentTable, SegmentTable, int], data: st.DataObject
) -> None:
    table, _, iterations = case
    stance = implied(table, iterations).stance.copy()
    foot = data.draw(st.integers(0, len(stance) - 1))
    first, last = sorted(data.draw(st.lists(st.integers(0, stance.shape[1]), min_size=2, max_size=2)))
    stance[foot, first:last] = data.draw(st.booleans())
    found = carried(table, drawn(stance), iterations, 0)
    if found.table is None:
        assert found.sentence is not None
        assert found.sentence.startswith(f"Foot {foot + 1} would ")
    else:
        assert np.array_equal(implied(found.table, iterations).stance, stance)


@given(st.sampled_from(BY_HAND), st.integers(1, 3), st.integers(0, 3))
def test_an_unchanged_timeline_changes_nothing(gait_id: str, iterations: int, turns: int) -> None:
    timeline = implied(table_of(gait_id), iterations, turns)
    assert carry(gait_id, timeline, iterations, turns) == Carried(table_of(gait_id))


WAITS = {s.start: name for name, s in VOCABULARY.segments.items() if s.start == s.end}


@given(st.sampled_from(BY_HAND), st.integers(1, 3), st.data())
def test_whole_segments_can_be_inserted_into_each_iteration_and_removed_again(
    gait_id: str, iterations: int, data: st.DataObject
) -> None:
    table = table_of(gait_id)
    first, last = table.repeat_from - 1, table.last_repeated
    ends = [[VOCABULARY.segments[row[place - 1]].end for row in table.rows] for place in range(first, last)]
    place = data.draw(st.sampled_from([first + i for i, feet in enumerate(ends) if {*feet} <= {*WAITS}]))
    waits = [WAITS[end] for end in ends[place - first]]
    longer = replace(
        table,
        rows=tuple((*row[:place], wait, *row[place:]) for row, wait in zip(table.rows, waits, strict=True)),
        repeat_from=table.repeat_from + (place == first),
        repeat_to=last + 1,
    )
    for before, after in ((table, longer), (longer, table)):
        wanted = implied(after, iterations)
        found = carried(before, wanted, iterations, 0).table
        assert found is not None
        assert implied(found, iterations) == wanted
        assert found.segment_count == after.segment_count


def test_a_swing_that_moves_by_a_segment_takes_its_names_along() -> None:
    found = carry("walk-manual-0", painted(implied(table_of("walk-manual-0")), 3, (16, 25))).table
    assert found is not None
    assert found.rows[2][:6] == ("Push A", "Wait A", "Wait A", "Lift A", "Step A", "Zero A")
    assert found.link[2] == ("Wait A",)
    assert [found.rows[f] for f in (0, 1, 3)] == [table_of("walk-manual-0").rows[f] for f in (0, 1, 3)]


def test_a_change_within_a_segment_is_named_with_the_borders_around_it() -> None:
    start = carry("walk-manual-0", painted(implied(table_of("walk-manual-0")), 3, (12, 20)))
    assert start == Carried(None, "Foot 3 would step from sample 12; segments change at samples 11 and 16.")
    end = carry("walk-manual-0", painted(implied(table_of("walk-manual-0")), 3, (11, 18)))
    assert end == Carried(None, "Foot 3 would stand from sample 19; segments change at samples 16 and 21.")


def test_a_swing_too_long_for_the_vocabulary_is_named_with_where_the_foot_is() -> None:
    found = carry("walk-manual-0", painted(implied(table_of("walk-manual-0")), 3, (11, 25)))
    assert found.table is None
    assert found.sentence is not None
    assert "Foot 3 would be in the air at samples 21 to 25" in found.sentence
    assert "no segment in the air starts at Step-Base" in found.sentence


def test_a_swing_too_short_for_a_step_is_carried_and_said() -> None:
    timeline = painted(implied(table_of("walk-manual-0")), 3, (11, 15))
    found = carry("walk-manual-0", timeline)
    assert found.table is not None
    assert implied(found.table) == timeline
    assert found.sentence is not None
    assert "Foot 3 now comes down in segment 4 where it lifted" in found.sentence


def test_iterations_drawn_differently_are_named() -> None:
    table = table_of("walk-manual-0")
    whole = implied(table, 3)
    swings = [(s.first + 1, s.last + 1) for s in whole.swings() if s.foot == 1]
    found = carry("walk-manual-0", painted(whole, 2, *swings[:-1]), 3)
    assert found.table is None
    assert found.sentence is not None
    assert "Foot 2 would be in the air in segment 5 and on the ground in segment 21" in found.sentence


def test_what_two_iterations_say_of_the_link_alone_is_carried() -> None:
    table = table_of("walk-manual-0")
    whole = implied(table, 2)
    swings = [(s.first + 1, s.last + 1) for s in whole.swings() if s.foot == 2]
    found = carry("walk-manual-0", painted(whole, 3, swings[0]), 2)
    assert found.table is None
    assert found.sentence is not None
    assert "Foot 3 would be in the air in segment 4 and on the ground in segment 12" in found.sentence
    every = carry("walk-manual-0", painted(whole, 3, *((f + 5, last + 5) for f, last in swings)), 2)
    assert every.table is not None
    assert every.table.link[2] == ("Wait A",)


def test_a_length_that_is_no_whole_number_of_segments_is_refused() -> None:
    stance = implied(table_of("walk-manual-0")).stance
    found = carry("walk-manual-0", drawn(np.concatenate([stance, stance[:, -1:]], axis=1)))
    assert found.sentence is not None
    assert "56 samples, which is no whole number of segments of 5" in found.sentence


@pytest.mark.parametrize("turns", [0, 1, 2, 3])
@pytest.mark.parametrize("iterations", [1, 2, 3])
@pytest.mark.parametrize("knots", [(6, 6), (6, 3), (4, 4), (12, 6)])
def test_a_table_is_made_of_a_timeline_with_room_for_steps(
    knots: tuple[int, int], iterations: int, turns: int
) -> None:
    phase, closing = knots
    timeline = timeline_from_order(
        4, (3, 2, 4, 1), phase_knots=phase, closing_knots=closing, iterations=iterations
    ).turned(turns)
    made = table_from_timeline(timeline, iterations, turns, VOCABULARY)
    assert implied(made, iterations, turns) == timeline
    assert made.samples_per_segment == phase // 2
    assert made.chains
    assert {name for row in made.rows for name in row} == {"Wait A", "Lift A", "Step A", "Zero A"}


@pytest.mark.parametrize(
    ("rows", "sentence"),
    [
        (["1111", "1111"], "No foot leaves the ground"),
        (
            ["1111100000111111", "1" * 16],
            "Foot 1 would step from sample 6; segments change at samples 5 and 7",
        ),
        (
            ["1100001111", "1111000000"],
            "Foot 2 would be in the air at samples 9 to 10, and no segment in the air",
        ),
        (
            ["11110000", "1" * 8],
            "Foot 1 has no time on the ground after its last swing to return to Home-Base",
        ),
    ],
)
def test_a_timeline_without_a_table_says_why(rows: list[str], sentence: str) -> None:
    stance = np.array([[cell == "1" for cell in row] for row in rows])
    with pytest.raises(InputError, match=sentence):
        table_from_timeline(drawn(stance), 1, 0, VOCABULARY)


def test_iterations_that_are_not_alike_make_no_table() -> None:
    timeline = timeline_from_order(4, (3, 2, 4, 1), phase_knots=6, closing_knots=6, iterations=2)
    with pytest.raises(InputError, match="2 iterations are not drawn alike"):
        table_from_timeline(painted(timeline, 3, (7, 12)), 2, 0, VOCABULARY)


def test_a_length_that_fits_nowhere_in_hundreds_of_segments_is_refused_after_a_try_a_part(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    table = table_of("walk-manual-0")
    first, last = table.repeat_from - 1, table.last_repeated
    rows = tuple(
        (*row[:first], *(row[first:last] + link) * 39, *row[first:])
        for row, link in zip(table.rows, table.link, strict=True)
    )
    long = SegmentTable(rows, table.samples_per_segment, 1, table.vocabulary)
    assert long.segment_count > 250
    stance = implied(long).stance
    place = 5 * long.samples_per_segment
    airborne = np.zeros((4, long.samples_per_segment), dtype=bool)
    tried = []

    def counted(wish: RowTemplate, vocabulary: SegmentVocabulary) -> LinkedRow | None:
        tried.append(wish)
        return cheapest_chain(wish, vocabulary)

    monkeypatch.setattr("core.segments.from_timeline_edit.cheapest_chain", counted)
    longer = np.concatenate([stance[:, :place], airborne, stance[:, place:]], axis=1)
    found = carried(long, drawn(longer), 1, 0)
    assert found.table is None
    assert "no segment in the air starts at" in str(found.sentence)
    assert 1 <= len(tried) <= 3 * 4  # opening, repeating part and closing, four feet
