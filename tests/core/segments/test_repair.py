"""Ways out of a table in which an edited segment does not fit."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.errors import InputError
from core.library.library import library
from core.segments.repair import DraftTable, repairs
from core.segments.segment_table import SegmentTable


def walk() -> SegmentTable:
    table = library()["walk-manual-0"].gait.segment_table
    assert table is not None
    return table


def draft(foot: int, segment: int, name: str) -> DraftTable:
    """The manual walk with one other name; foot and segment counted from 0."""
    table = walk()
    rows = [list(row) for row in table.rows]
    rows[foot][segment] = name
    return DraftTable(
        tuple(map(tuple, rows)), 5, table.repeat_from, table.repeat_to, table.link, table.vocabulary
    )


def test_a_lift_too_many_is_followed_by_a_step_or_comes_down_in_a_new_segment() -> None:
    replaced, inserted = repairs(draft(0, 3, "Lift A"), {(0, 3)})
    assert (replaced.foot, replaced.first, replaced.inserted) == (0, 4, False)
    assert replaced.table.rows[0][3] == "Lift A"
    assert replaced.table.segment_count == 11
    assert (inserted.first, inserted.names, inserted.inserted) == (4, ("Push A",), True)
    assert inserted.table.rows[0][3:5] == ("Lift A", "Push A")
    assert inserted.table.segment_count == 12
    assert (inserted.table.repeat_from, inserted.table.repeat_to) == (4, 11)


def test_a_segment_is_not_inserted_where_another_foot_cannot_wait() -> None:
    found = repairs(draft(0, 2, "Lift A"), {(0, 2)})
    assert [one.inserted for one in found] == [False]


def test_segments_before_the_edited_one_give_way_too() -> None:
    replaced = repairs(draft(1, 2, "Step A"), {(1, 2)})[0]
    assert replaced.table.rows[1][1:4] == ("Lift A", "Step A", "Zero A")


def test_what_must_stay_stays_where_both_neighbours_are_kept() -> None:
    kept = {(0, 2), (0, 3), (0, 4)}
    inserted = repairs(draft(0, 3, "Lift A"), kept)
    assert [one.inserted for one in inserted] == [True]


def test_a_table_that_fits_needs_no_repair() -> None:
    assert repairs(draft(0, 4, "Wait A"), set()) == ()


def test_an_unknown_name_gives_way() -> None:
    replaced = repairs(draft(0, 4, "Hop A"), {(0, 4)})[0]
    assert replaced.table == replace(walk(), link=replaced.table.link)


def test_a_link_that_does_not_lead_on_is_mended() -> None:
    link = tuple(("Lean A",) if foot == 1 else names for foot, names in enumerate(walk().link))
    (repair,) = repairs(replace(draft(0, 4, "Wait A"), link=link), set())
    assert (repair.foot, repair.first, repair.names) == (1, 11, ())
    assert repair.table == walk()


def test_the_rows_give_way_where_the_link_must_stay() -> None:
    link = tuple(("Zero A",) if foot == 1 else names for foot, names in enumerate(walk().link))
    (repair,) = repairs(replace(draft(0, 4, "Wait A"), link=link), {(1, 11)})
    assert repair.table.link == link
    assert repair.table.chains


def test_rows_of_different_length_are_refused() -> None:
    uneven = replace(draft(0, 4, "Wait A"), rows=(("Wait A",), ("Wait A", "Wait A")))
    with pytest.raises(InputError, match="as many segments as foot 1"):
        repairs(uneven, set())


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"repeat_from": 12}, "Segments 12 to 10 repeat; they must lie in 1 to 11"),
        ({"repeat_to": 12}, "Segments 4 to 12 repeat"),
        ({"link": (("Wait A",),)}, "The link has 1 feet; it needs 4"),
        ({"rows": (), "link": ()}, "must lie in 1 to 0"),
    ],
)
def test_a_shape_that_cannot_be_is_refused(change: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=message):
        repairs(replace(draft(0, 4, "Wait A"), **change), set())


@given(st.integers(0, 3), st.integers(0, 10), st.sampled_from(sorted(walk().vocabulary.segments)))
def test_every_repair_is_a_table_that_keeps_what_was_typed(foot: int, segment: int, name: str) -> None:
    typed = draft(foot, segment, name)
    for repair in repairs(typed, {(foot, segment)}):
        shift = len(repair.names) if repair.inserted and repair.first <= segment else 0
        assert repair.table.rows[foot][segment + shift] == name
        assert repair.table.repeated(1) is not None
