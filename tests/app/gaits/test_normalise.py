"""What an edit carries with it: locks, repetitions, directions, and tables that follow what is drawn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from app.gaits.normalise import normalise, normalise_imported
from core.errors import InputError, StateError
from core.gait.gait import Gait
from core.gait.poses import PinnedPose
from core.library.library import library
from core.segments.segment_table import SegmentTable


def gait(gait_id: str) -> Gait:
    return library()[gait_id].gait


def table_of(one: Gait) -> SegmentTable:
    assert one.segment_table is not None
    return one.segment_table


def drawn(before: Gait, cells: Sequence[tuple[int, int]], swing: bool) -> Gait:
    """The gait with cells changed; feet and samples counted from 0."""
    stance = before.timeline.stance.copy()
    for foot, sample in cells:
        stance[foot, sample] = not swing
    return replace(before, timeline=replace(before.timeline, stance=stance))


def with_lock(before: Gait, foot: int, sample: int) -> Gait:
    locked = before.timeline.locked.copy()
    locked[foot, sample] = True
    return replace(before, timeline=replace(before.timeline, locked=locked))


def test_a_swing_drawn_on_borders_goes_into_the_table() -> None:
    walk = gait("walk-manual-0")
    later = drawn(drawn(walk, [(2, s) for s in range(10, 15)], False), [(2, s) for s in range(20, 25)], True)
    changed, notice = normalise(walk, later)
    assert notice is None
    assert changed.timeline == later.timeline
    assert table_of(changed).rows[2][:6] == ("Push A", "Wait A", "Wait A", "Lift A", "Step A", "Zero A")


def test_a_drawing_that_the_table_cannot_say_sets_it_aside_with_the_reason() -> None:
    walk = gait("walk-manual-0")
    changed, notice = normalise(walk, drawn(walk, [(2, 10)], False))
    assert changed.segment_table is None
    assert notice is not None
    assert "Foot 3 would step from sample 12; segments change at samples 11 and 16." in notice
    assert "Undo brings the table back" in notice


def test_a_swing_without_room_for_a_step_stays_in_the_table_with_a_word() -> None:
    walk = gait("walk-manual-0")
    changed, notice = normalise(walk, drawn(walk, [(2, s) for s in range(15, 20)], False))
    assert changed.segment_table is not None
    assert notice is not None
    assert "its swing is too short for a step" in notice


def test_a_drawing_of_a_turned_gait_is_carried_into_the_row_of_its_foot() -> None:
    walk = gait("walk-manual-0")
    turned, _ = normalise(walk, replace(walk, direction=2))
    assert turned.timeline == walk.timeline.turned(1)
    emptied = drawn(turned, [(3, s) for s in range(10, 20)], False)
    changed, notice = normalise(turned, emptied)
    assert notice is None
    assert "Step A" not in table_of(changed).rows[2]
    assert table_of(changed).rows[3] == table_of(walk).rows[3]


def test_a_table_that_changed_draws_the_timeline() -> None:
    walk = gait("walk-manual-0")
    finer = replace(walk, segment_table=replace(table_of(walk), samples_per_segment=3))
    changed, notice = normalise(walk, finer)
    assert notice is None
    assert changed.timeline.sample_count == 33


def test_locks_hold_against_the_table_and_stay_with_it() -> None:
    walk = gait("walk-manual-0")
    locked = with_lock(walk, 2, 12)
    rows = list(table_of(walk).rows)
    rows[2] = ("Push A", *("Wait A",) * 10)
    link = tuple(("Wait A",) if f == 2 else one for f, one in enumerate(table_of(walk).link))
    without = replace(table_of(walk), rows=tuple(rows), link=link)
    with pytest.raises(StateError, match="Foot 3, sample 13 is locked"):
        normalise(locked, replace(locked, segment_table=without))
    with pytest.raises(StateError, match="how many samples the table has"):
        normalise(locked, replace(locked, iterations=2))
    elsewhere = with_lock(walk, 1, 0)
    kept, _ = normalise(elsewhere, replace(elsewhere, segment_table=without))
    assert kept.timeline.locked.sum() == 1
    assert kept.timeline.locked[1, 0]
    turned, _ = normalise(elsewhere, replace(elsewhere, direction=2))
    assert turned.timeline.locked[2, 0]


def test_a_timeline_drawn_by_hand_is_repeated_as_it_stands() -> None:
    walk = gait("walk")
    longer, _ = normalise(walk, drawn(walk, [(2, 10)], True))
    thrice, _ = normalise(longer, replace(longer, iterations=3))
    assert thrice.timeline.sample_count == 125
    assert [s.first for s in thrice.timeline.swings() if s.foot == 2] == [5, 45, 85]
    assert {s.last - s.first for s in thrice.timeline.swings() if s.foot == 2} == {5}
    assert normalise(thrice, replace(thrice, iterations=1))[0].timeline == longer.timeline


def test_iterations_and_direction_change_together() -> None:
    walk = gait("walk")
    changed, _ = normalise(walk, replace(walk, iterations=2, direction=3))
    twice, _ = normalise(walk, replace(walk, iterations=2))
    assert changed.timeline == twice.timeline.turned(2)
    assert normalise(changed, replace(changed, iterations=1, direction=1))[0].timeline == walk.timeline


def test_a_ring_of_six_turns_there_and_back() -> None:
    walk = gait("walk")
    stance = np.ones((6, 20), dtype=bool)
    stance[1, 5:9] = False
    timeline = replace(walk.timeline, stance=stance, locked=np.zeros_like(stance))
    ring = replace(walk, robot="hexapod", order=(1, 2, 3, 4, 5, 6), timeline=timeline)
    there, _ = normalise(ring, replace(ring, direction=2))
    back, _ = normalise(there, replace(there, direction=1))
    assert there.timeline != ring.timeline
    assert back.timeline == ring.timeline


def test_iterations_that_are_not_alike_cannot_be_repeated() -> None:
    walk = gait("walk")
    uneven = drawn(replace(walk, iterations=3), [(2, 10)], True)
    with pytest.raises(InputError, match="not equally long"):
        normalise(uneven, replace(uneven, iterations=2))


def test_locked_cells_are_not_lost_by_repeating() -> None:
    walk = with_lock(gait("walk"), 0, 0)
    with pytest.raises(StateError, match="locked cells"):
        normalise(walk, replace(walk, iterations=2))


def test_the_timeline_of_a_document_from_elsewhere_follows_its_table() -> None:
    walk = gait("walk-manual-0")
    assert normalise_imported(walk) == (walk, None)
    twice, notice = normalise_imported(replace(walk, iterations=2, direction=2))
    assert twice.timeline == normalise(walk, replace(walk, iterations=2, direction=2))[0].timeline
    assert notice is not None
    assert "follows the table" in notice
    assert normalise_imported(gait("walk")) == (gait("walk"), None)


def test_pinned_poses_go_along_with_a_step_and_are_let_go_with_other_poses() -> None:
    first = gait("fast-c-gait")
    assert first.poses is not None
    pinned = replace(first, poses=replace(first.poses, pinned=(PinnedPose(5, 0.0, 0.001),)))
    for kept in (
        replace(pinned, step=(0.02, 0.0, 0.0)),
        replace(pinned, direction=2),
        pinned.with_options(stop_bound=1.4),
    ):
        changed, notice = normalise(pinned, kept)
        assert changed.poses is not None
        assert changed.poses.pinned == (PinnedPose(5, 0.0, 0.001),)
        assert notice is None
    for other in (
        replace(pinned, iterations=2),
        replace(pinned, order=(2, 1, 3, 4)),
        replace(pinned, step=(0.0, 0.02, 0.0)),
        pinned.with_options(stop_bound=1.0),
    ):
        changed, notice = normalise(pinned, other)
        assert changed.poses is not None
        assert changed.poses.pinned == ()
        assert notice is not None
        assert notice.startswith("The pinned poses were removed")


def test_a_pose_that_is_pinned_in_the_same_edit_must_be_one_of_the_gait() -> None:
    first = gait("fast-c-gait")
    assert first.poses is not None
    with pytest.raises(InputError, match="names pose 27; 2 to 26"):
        normalise(first, replace(first, poses=replace(first.poses, pinned=(PinnedPose(27, 0.0, 0.0),))))
