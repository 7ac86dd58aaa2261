"""Merging: one change goes over, everything else stays, and what cannot be told apart is a conflict."""

from __future__ import annotations

from copy import deepcopy
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.undo.merge import MISSING, merge, place_words, say_the_same, value_at

ROWS = st.lists(st.text("01", min_size=6, max_size=6), min_size=3, max_size=3)


def document(**changes: Any) -> dict[str, Any]:
    content: dict[str, Any] = {
        "name": "Walk",
        "order": [1, 2, 3, 4],
        "step": [0.01, 0.0, 0.0],
        "timeline": {"feet": ["111111", "110011"], "locked": ["000000", "000000"]},
        "segment_table": {"feet": [["Push A", "Lift A"], ["Wait A", "Wait B"]]},
        "options": {"margin": 0.0, "friction": None},
    }
    return {**content, **changes}


def with_cells(rows: list[str]) -> dict[str, Any]:
    return {"timeline": {"feet": rows}}


@given(ROWS, ROWS, ROWS)
def test_rows_take_a_change_over_whole_or_not_at_all(
    base: list[str], want: list[str], present: list[str]
) -> None:
    merged = merge(with_cells(base), with_cells(want), with_cells(present))
    for foot, (old, new, now) in enumerate(zip(base, want, present, strict=True)):
        row = merged.content["timeline"]["feet"][foot]
        altered = [sample for sample in range(6) if old[sample] != new[sample]]
        first, last = (min(altered) - 1, max(altered) + 1) if altered else (0, -1)
        beside = [at for at in range(max(first, 0), min(last, 5) + 1) if old[at] != now[at]]
        conflicts = [path[3] for path in merged.conflicts if path[2] == foot]
        if new == now or present == want or beside:
            assert row == now
            assert conflicts == ([] if new == now or present == want else beside)
        else:
            assert conflicts == []
            assert row == "".join(new[at] if at in altered else now[at] for at in range(6))
        assert {path[3] for path in merged.changed if path[2] == foot} == {
            at for at in range(6) if row[at] != now[at]
        }


@pytest.mark.parametrize("layer", ["feet", "locked"])
def test_half_a_moved_swing_is_never_put_back(layer: str) -> None:
    base, moved, further = "1100011111", "1111000111", "1110001111"  # by two to the right, then one back
    merged = merge(
        {"timeline": {layer: ["1" * 10, moved]}},
        {"timeline": {layer: ["1" * 10, base]}},
        {"timeline": {layer: ["1" * 10, further]}},
    )
    assert merged.conflicts == (("timeline", layer, 1, 3), ("timeline", layer, 1, 6))
    assert merged.content["timeline"][layer][1] == further
    assert [path[3] for path in merged.spans] == list(range(1, 8))


@given(ROWS, ROWS)
def test_where_nobody_else_edited_the_change_goes_over_whole(base: list[str], want: list[str]) -> None:
    assert merge(with_cells(base), with_cells(want), with_cells(base)).content == with_cells(want)
    assert merge(with_cells(base), with_cells(base), with_cells(want)).content == with_cells(want)


def test_fields_cells_and_axes_of_different_people_go_together() -> None:
    base, want, present = document(), document(name="Fast walk"), document(step=[0.01, 0.0, 0.2])
    want["step"], want["segment_table"] = (
        [0.02, 0.0, 0.0],
        {"feet": [["Push A", "Lift B"], ["Wait A", "Wait B"]]},
    )
    present["segment_table"] = {"feet": [["Push A", "Lift A"], ["Wait A", "Wait C"]]}
    merged = merge(base, want, present)
    assert merged.conflicts == ()
    assert merged.content["name"] == "Fast walk"
    assert merged.content["step"] == [0.02, 0.0, 0.2]
    assert merged.content["segment_table"]["feet"] == [["Push A", "Lift B"], ["Wait A", "Wait C"]]


@pytest.mark.parametrize(
    ("mine", "theirs", "place", "words"),
    [
        ({"name": "A"}, {"name": "B"}, ("name",), "the name"),
        ({"order": [2, 1, 3, 4]}, {"order": [1, 2, 4, 3]}, ("order",), "the order"),
        ({"step": [0.02, 0.0, 0.0]}, {"step": [0.03, 0.0, 0.0]}, ("step", 0), "the step"),
        ({"step": [0.01, 0.0, 0.1]}, {"step": [0.01, 0.0, 0.2]}, ("step", 2), "the turn"),
        (
            {"segment_table": {"feet": [["Push A", "Lift B"], ["Wait A", "Wait B"]]}},
            {"segment_table": {"feet": [["Push A", "Lift C"], ["Wait A", "Wait B"]]}},
            ("segment_table", "feet", 0, 1),
            "segment 2 of foot 1",
        ),
        ({"segment_table": None}, {"segment_table": {"feet": []}}, ("segment_table",), "the segment table"),
        (
            {"options": {"margin": 1.0, "friction": None}},
            {"options": {"margin": 2.0, "friction": None}},
            ("options", "margin"),
            "the stability margin",
        ),
        (
            {"timeline": {"feet": ["1111", "1100"], "locked": ["0000", "0000"]}},
            {"timeline": {"feet": ["111111", "110001"], "locked": ["000000", "000000"]}},
            ("timeline", "feet", 1),
            "the timeline of foot 2",
        ),
    ],
)
def test_the_same_place_changed_differently_is_a_conflict_and_stays(
    mine: dict[str, Any], theirs: dict[str, Any], place: tuple[str | int, ...], words: str
) -> None:
    present = document(**theirs)
    merged = merge(document(), document(**mine), present)
    assert merged.conflicts == (place,)
    assert value_at(merged.content, place) == value_at(present, place)
    assert place_words(merged.conflicts) == words


def test_parts_that_changed_places_are_not_mixed_with_what_others_did_to_them() -> None:
    walk, turn = ({"gait": {"name": name}, "times": 2, "source": name.lower()} for name in ("Walk", "Turn"))
    swapped = merge({"sequence": [turn, walk]}, {"sequence": [walk, turn]}, {"sequence": [turn, walk]})
    assert swapped.content == {"sequence": [walk, turn]}
    longer = {"sequence": [{**turn, "times": 5}, walk]}
    merged = merge({"sequence": [turn, walk]}, {"sequence": [walk, turn]}, longer)
    assert merged.conflicts == (("sequence", 0),)
    assert merged.content["sequence"][0] == {**turn, "times": 5}


def test_a_key_comes_and_goes() -> None:
    base = {"definitions": {"a": 1}}
    want = {"definitions": {"b": 2}}
    assert merge(base, want, {"definitions": {"a": 1, "c": 3}}).content == {"definitions": {"c": 3, "b": 2}}
    assert merge(base, want, {"definitions": {"a": 9}}).conflicts == (("definitions", "a"),)


def test_provenance_is_nobodys_edit() -> None:
    base, want, present = ({"name": "a", "provenance": mark} for mark in (None, {"motion": 1}, {"motion": 2}))
    merged = merge(base, want, present)
    assert (merged.content, merged.conflicts) == (present, ())
    assert say_the_same(want, present)
    assert not say_the_same(want, {**present, "name": "b"})


def test_the_inputs_stay_as_they_are() -> None:
    contents = [document(), document(name="A"), document(step=[0.0, 0.0, 0.0])]
    before = deepcopy(contents)
    merge(*contents)
    assert contents == before


@pytest.mark.parametrize("path", [("nothing",), ("timeline", "feet", 9), ("name", "x"), ("step", 0, 0)])
def test_a_place_that_is_not_there_is_missing(path: tuple[str | int, ...]) -> None:
    assert value_at(document(), path) is MISSING


def test_places_are_named_as_a_person_counts() -> None:
    feet = tuple(("timeline", "feet", 2, sample) for sample in (8, 9, 10))
    assert place_words(feet) == "foot 3, samples 9–11"
    assert place_words((*feet, ("name",))) == "foot 3, samples 9–11 and the name"
    assert place_words((("timeline", "locked", 0, 4),)) == "the locks of foot 1, sample 5"
    many = (("a",), ("b",), ("c",), ("d",))
    assert place_words(many) == "the a, the b and 2 more places"
    assert place_words(((),)) == "the document"


def test_pinned_poses_are_merged_as_a_whole_and_never_by_their_place_in_the_list() -> None:
    def pinned(*poses: tuple[int, float]) -> dict[str, Any]:
        pins = [{"pose": pose, "along": 0.0, "sideways": sideways} for pose, sideways in poses]
        return {"poses": {"slip": 0.0005, "pinned": pins}}

    moved_back = merge(pinned((5, 0.0015)), pinned((5, 0.001)), pinned((9, 0.0015)))
    assert moved_back.conflicts == (("poses", "pinned"),)
    assert moved_back.content == pinned((9, 0.0015))
    assert place_words(moved_back.conflicts) == "the pinned poses"
    assert merge(pinned((5, 0.0015)), pinned((5, 0.001)), pinned((5, 0.0015))).content == pinned((5, 0.001))
