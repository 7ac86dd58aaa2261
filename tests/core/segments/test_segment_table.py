"""Segment tables: what they refuse, and iterations that follow one another without a pause."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from core.errors import InputError
from core.library.library import Group, default_vocabulary, group_ids, library
from core.robot.model import load_robot
from core.segments.segment_table import Segment, SegmentTable, SegmentVocabulary, require_heights

PERIOD = 8
"""Segments from one iteration to the next: each of four feet lifts and steps."""

BY_HAND = group_ids(Group.BY_HAND)
WALKING = [gait for gait in BY_HAND if not gait.startswith("s-gait")]


def table_of(gait_id: str) -> SegmentTable:
    table = library()[gait_id].gait.segment_table
    assert table is not None
    return table


def pauses(table: SegmentTable) -> list[int]:
    """Numbers of the segments in which no foot moves."""
    words = table.vocabulary.segments
    columns = zip(*table.rows, strict=True)
    return [n for n, names in enumerate(columns, 1) if all(words[s].start == words[s].end for s in names)]


def numbers(row: tuple[str, ...], name: str) -> list[int]:
    return [n for n, segment in enumerate(row, 1) if segment.startswith(name)]


@pytest.mark.parametrize("gait_id", BY_HAND)
def test_one_iteration_is_the_table_as_published(gait_id: str) -> None:
    table = table_of(gait_id)
    assert table.repeated(1).rows == table.rows
    longer = 0 if gait_id.startswith("s-gait") else int(gait_id[-1])
    assert table.segment_count == 11 + longer


@pytest.mark.parametrize("iterations", [2, 3, 20])
@pytest.mark.parametrize("gait_id", BY_HAND)
def test_iterations_follow_one_another_without_a_pause(gait_id: str, iterations: int) -> None:
    table = table_of(gait_id)
    long = table.repeated(iterations)
    later = PERIOD * (iterations - 1)
    assert long.segment_count == table.segment_count + later
    assert pauses(long) == [n if n <= 2 else n + later for n in pauses(table)]


@pytest.mark.parametrize("gait_id", BY_HAND)
def test_the_third_iteration_is_the_second_a_period_later(gait_id: str) -> None:
    table = table_of(gait_id)
    long = table.repeated(4)
    for row in long.rows:
        assert row[2 + PERIOD : 2 + 2 * PERIOD] == row[2 + 2 * PERIOD : 2 + 3 * PERIOD]
        assert [n - PERIOD for n in numbers(row, "Lift")[1:]] == numbers(row, "Lift")[:-1]


@pytest.mark.parametrize("gait_id", BY_HAND)
def test_feet_move_without_a_jump_and_end_at_home(gait_id: str) -> None:
    table = table_of(gait_id).repeated(3)
    feet = table.feet_displacements(np.array([0.010, 0.002]), -0.048)
    assert feet.shape == (5 * table.segment_count, 4, 3)
    ends, starts = feet[4:-1:5], feet[5::5]
    assert ends == pytest.approx(starts, abs=1e-12)
    assert feet[-1] == pytest.approx(np.tile([0.0, 0.0, -0.053], (4, 1)))


@pytest.mark.parametrize("gait_id", WALKING)
def test_a_foot_resets_as_late_as_its_version_says(gait_id: str) -> None:
    """Thesis 3.3.2: at once, after the next foot's lift, after its step; also from iteration to iteration."""
    gait = library()[gait_id].gait
    waits = int(gait_id[-1])
    rows = table_of(gait_id).repeated(3).rows
    steps = sorted((n, foot) for foot, row in enumerate(rows, 1) for n in numbers(row, "Step"))
    assert [foot for _, foot in steps] == list(gait.order) * 3
    for step, foot in steps[:-1]:
        reset = min(n for n in numbers(rows[foot - 1], "Zero") if n > step)
        assert reset - step - 1 == waits


def test_a_turned_table_repeats_like_the_first() -> None:
    table = table_of("walk-manual-2")
    assert table.turned(1).repeated(3) == table.repeated(3).turned(1)
    assert table.turned(1).turned(3) == table


def test_a_table_without_a_link_goes_on_where_it_says() -> None:
    table = SegmentTable((("Push A", "Lift A", "Step A", "Zero A"),), 5, 2, default_vocabulary())
    assert table.repeated(2).rows == (("Push A", "Lift A", "Step A", "Zero A", "Lift A", "Step A", "Zero A"),)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"repeat_to": 12}, "repeat_to is 12; it must lie in 1 to 11"),
        ({"repeat_from": 11}, "repeat_from is 11; it must lie in 1 to 10"),
        ({"repeat_from": 0}, "repeat_from is 0"),
        ({"link": (("Wait A",),)}, "The link has 1 feet; it needs 4"),
        ({"link": (("Wait A",),) * 3 + ((),)}, "Foot 4 has 0 segments; it needs 1"),
        ({"samples_per_segment": 1}, "it needs at least 2"),
    ],
)
def test_a_repetition_that_cannot_be_is_refused(change: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError, match=message):
        replace(table_of("walk-manual-0"), **change)


@pytest.mark.parametrize("samples", [200, 10**9, 10**400])
def test_more_samples_than_a_timeline_takes_are_refused(samples: int) -> None:
    long = replace(table_of("walk-manual-0"), samples_per_segment=samples)
    assert long.chains
    with pytest.raises(InputError, match=f"11 segments of {samples} samples are more than 2000"):
        long.timeline(0.4)
    with pytest.raises(InputError, match="Take fewer of either"):
        long.feet_displacements(np.zeros(2), -0.1)


@pytest.mark.parametrize("segment", ["Step A", "Hop A"])
def test_a_link_that_does_not_fit_is_refused_when_it_is_walked(segment: str) -> None:
    table = replace(table_of("walk-manual-0"), link=((segment,), ("Wait A",), ("Lift A",), ("Wait A",)))
    assert table.repeated(1).rows == table.rows
    with pytest.raises(InputError, match="Foot 1, segment 11"):
        table.repeated(2)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"z": {"Base": 5.0}}, "The height “Base” is 5 m; it must lie between 0 and 0.1"),
        ({"xy": {"Far": 11.0}}, "The place “Far” is 11 times the step"),
        ({"xy": {"Half-way": 0.5}}, "The place “Half-way” cannot be called so"),
        ({"z": {"": 0.005}}, "1 to 40 characters"),
        ({"segments": {"Lift, high": Segment("Home-Base", "Home-None", True)}}, "no tabs, commas"),
        ({"segments": {" Lift": Segment("Home-Base", "Home-None", True)}}, "no blanks around it"),
        ({"segments": {"Lift Z": Segment("Home-Base", "Home-Top", True)}}, "unknown position “Home-Top”"),
    ],
)
def test_a_vocabulary_that_cannot_be_is_refused(change: dict[str, Any], message: str) -> None:
    words = default_vocabulary()
    parts = {name: {**getattr(words, name), **change.get(name, {})} for name in ("xy", "z", "segments")}
    with pytest.raises(InputError, match=message):
        SegmentVocabulary(**parts)


def test_a_height_outside_the_motors_travel_is_refused() -> None:
    stroke = load_robot("deltawalker").stroke
    require_heights({"None": 0.0, "Base": 0.0005, "Top": 0.02}, stroke)
    with pytest.raises(InputError, match=r"“High” is 99 mm; the robot's motors travel 0 to 20 mm") as refused:
        require_heights({"High": 0.099}, stroke)
    assert "reach 0.5 to 19.5 mm" in refused.value.sentence
