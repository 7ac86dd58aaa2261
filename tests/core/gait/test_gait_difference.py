"""Differences between gaits: the sentences that a person reads, and that no field goes without one."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.gait.gait import Gait, Orientation, SequencePart, drawn_timeline, with_iterations
from core.gait.gait_difference import OPTION_WORDS, gait_difference
from core.gait.held_feet import HeldFeet
from core.gait.options import GaitOptions
from core.gait.poses import FoundPoses, PinnedPose, Poses
from core.gait.recording import Recording, RecordingForm
from core.library.library import library
from core.motion.heading_profile import HeadingProfile
from core.problem.motion_problem import Boundary, Cost, Workspace
from core.segments.segment_table import Segment, SegmentTable

WALK = library()["walk"].gait
MANUAL = library()["walk-manual-0"].gait


def sentences(before: Gait, after: Gait) -> list[str]:
    return [sentence for group in gait_difference(before, after) for sentence in group.sentences]


def swinging(gait: Gait, foot: int, *samples: int) -> Gait:
    """The gait with one foot in the air at just these samples, 0-based."""
    stance = gait.timeline.stance.copy()
    stance[foot] = True
    stance[foot, list(samples)] = False
    return replace(gait, timeline=replace(gait.timeline, stance=stance))


def table_of(gait: Gait) -> SegmentTable:
    assert gait.segment_table is not None
    return gait.segment_table


CHANGES: dict[str, Any] = {
    "name": "Stroll",
    "robot": "deltawalker9",
    "orientation": Orientation.FBS,
    "direction": 2,
    "order": (1, 2, 3, 4),
    "step": (0.012, 0.0, 0.0),
    "iterations": 2,
    "timeline": swinging(WALK, 0, 7).timeline,
    "segment_table": MANUAL.segment_table,
    "options": replace(WALK.options, margin=0.001),
    "notes": "On felt",
    "recorded": Recording("a.csv", RecordingForm.WAYPOINTS, "1,2\n"),
    "sequence": (SequencePart(WALK, 3),),
    "held": HeldFeet(end=(2,)),
    "poses": Poses(),
}
OPTION_CHANGES: dict[str, Any] = {
    "clearance": 0.004,
    "margin": 0.0012345678,
    "body_speed": 0.02,
    "foot_speed": 0.02,
    "plane_height": 0.055,
    "workspace": Workspace.CYLINDER,
    "cost": Cost.GOAL_EFFORT,
    "phase_knots": 6,
    "closing_knots": 7,
    "end_plane_height": 0.054,
    "friction": 0.5,
    "motor_speed": 0.02,
    "motor_acceleration": 0.1,
    "boundary": Boundary.PERIODIC,
    "turning": HeadingProfile.RETURN,
    "merge": 0.0005,
    "stop_bound": 1.5,
}


@pytest.mark.parametrize("field", [field.name for field in fields(Gait) if field.name != "provenance"])
def test_every_field_of_a_gait_has_its_sentence(field: str) -> None:
    changed = replace(WALK, **{field: CHANGES[field]})
    assert len(sentences(WALK, changed)) == 1
    assert len(sentences(changed, WALK)) == 1


@pytest.mark.parametrize("field", [field.name for field in fields(GaitOptions)])
def test_every_option_has_its_sentence_in_both_directions(field: str) -> None:
    assert field in OPTION_WORDS
    changed = WALK.with_options(**{field: OPTION_CHANGES[field]})
    (there,), (back,) = sentences(WALK, changed), sentences(changed, WALK)
    assert there.startswith(OPTION_WORDS[field][0])
    old, new = there.removeprefix(OPTION_WORDS[field][0]).split(" → ")
    assert back == f"{OPTION_WORDS[field][0]} {new} →{old}"


@pytest.mark.parametrize("gait_id", list(library()))
def test_a_gait_is_no_different_from_itself(gait_id: str) -> None:
    gait = library()[gait_id].gait
    assert gait_difference(gait, replace(gait)) == ()


def test_what_only_gaits_for_the_robots_clock_ask_is_told_and_found_poses_are_not() -> None:
    before = replace(WALK, poses=Poses())
    found = FoundPoses("0" * 64, 0.01, np.zeros((2, 3)), np.zeros((2, 4, 3)))
    after = replace(WALK, poses=Poses(free_step=False, slip=0.001, arm_distance=0.0, found=found))
    assert sentences(before, after) == [
        "Step length: fastest → as set",
        "Slip 0.5 mm → 1.0 mm",
        "Arm distance 0.5 mm → 0.0 mm",
    ]
    assert sentences(before, replace(WALK, poses=Poses(found=found))) == []
    pinned = Poses(pinned=(PinnedPose(9, 0.001, 0.0), PinnedPose(5, -0.001, -0.002)))
    assert sentences(before, replace(WALK, poses=pinned)) == [
        "Pinned poses: none → 5 (1.00 mm behind, 2.00 mm to the right), "
        "9 (1.00 mm ahead, 0.00 mm to the left)"
    ]


def test_steps_are_told_by_length_where_the_way_is_the_same() -> None:
    assert sentences(replace(WALK, step=(0.01, 0.0, 0.0)), replace(WALK, step=(0.012, 0.0, 0.0))) == [
        "Step 10.0 mm → 12.0 mm"
    ]
    sideways = replace(WALK, step=(0.01, 0.002, 0.0))
    assert sentences(replace(WALK, step=(0.01, 0.0, 0.0)), sideways) == ["Step (10, 0.0) mm → (10, 2.0) mm"]
    turned = replace(WALK, step=(*WALK.step[:2], np.deg2rad(15.0)))
    assert sentences(WALK, turned) == ["Turn 0.0° → 15.0°"]


def test_held_feet_are_told_by_the_end_at_which_they_are() -> None:
    held = replace(WALK, held=HeldFeet(start=(1, 3), end=(4,)))
    assert sentences(WALK, held) == [
        "Held up at the start: none → feet 1 and 3",
        "Held up at the end: none → foot 4",
    ]


def test_swings_are_told_a_foot_at_a_time() -> None:
    before, after = swinging(WALK, 2, 5, 6, 7, 8, 9), swinging(WALK, 2, 7, 8, 9, 10, 11)
    assert sentences(before, after) == ["Foot 3 swings at samples 8–12 instead of 6–10"]
    more = swinging(WALK, 2, 5, 6, 7, 8, 9, 20)
    assert sentences(before, more) == ["Foot 3 also swings at sample 21"]
    assert sentences(more, before) == ["Foot 3 no longer swings at sample 21"]
    assert sentences(swinging(WALK, 2), more) == ["Foot 3 swings at samples 6–10 and 21"]


def test_many_stretches_are_counted() -> None:
    busy = swinging(WALK, 1, *range(1, 40, 2))
    assert sentences(swinging(WALK, 1), busy) == ["Foot 2 swings at samples 2, 4, 6, 8 and 16 more stretches"]


def test_locks_are_told() -> None:
    locked = WALK.timeline.locked.copy()
    locked[1, 3:6] = True
    after = replace(WALK, timeline=replace(WALK.timeline, locked=locked))
    assert sentences(WALK, after) == ["Foot 2 is locked at samples 4–6"]
    assert sentences(after, WALK) == ["Foot 2 is no longer locked at samples 4–6"]


def test_timelines_of_different_length_and_feet_are_compared() -> None:
    told = sentences(WALK, with_iterations(WALK, 2))
    assert told[:2] == ["Iterations 1 → 2", "45 samples → 85 samples"]
    assert "Foot 3 also swings at samples 46–50" in told
    slower = replace(WALK, timeline=replace(WALK.timeline, sample_time=0.5))
    assert sentences(WALK, slower) == ["Sample time 0.4 s → 0.5 s"]
    longer = drawn_timeline(WALK.with_options(closing_knots=9))
    assert sentences(WALK, replace(WALK, timeline=longer)) == ["45 samples → 49 samples"]


def test_segments_are_told_cell_by_cell_and_by_what_was_put_in() -> None:
    table = table_of(MANUAL)
    words = table.vocabulary.segments
    (start,) = {words[row[0]].start for row in table.rows}
    stay = Segment(start, start, False)
    vocabulary = replace(table.vocabulary, segments={**words, "Stay": stay, "Rest": stay})
    known = replace(MANUAL, segment_table=replace(table, vocabulary=vocabulary))
    rows = tuple(("Stay", *row) for row in table.rows)
    longer = replace(MANUAL, segment_table=replace(table_of(known), rows=rows))
    told = [f"Foot {foot}: Stay added as segment 1" for foot in (1, 2, 3, 4)]
    assert sentences(known, longer) == told
    assert sentences(longer, known)[0] == "Foot 1: Stay taken out at segment 1"
    rested = replace(table_of(longer), rows=(("Rest", *rows[0][1:]), *rows[1:]))
    assert sentences(longer, replace(MANUAL, segment_table=rested)) == ["Segment 1 of foot 1: Stay → Rest"]
    meaning = f"{start} to {start}, stance"
    assert sentences(MANUAL, known) == [
        f"Definition of Stay is new: {meaning}",
        f"Definition of Rest is new: {meaning}",
    ]


def test_the_table_itself_comes_and_goes() -> None:
    drawn = replace(MANUAL, segment_table=None)
    assert sentences(MANUAL, drawn) == ["The segment table is gone: the gait is drawn"]
    assert sentences(drawn, MANUAL) == ["A segment table of 11 segments"]
    finer = replace(table_of(MANUAL), samples_per_segment=9)
    assert sentences(MANUAL, replace(MANUAL, segment_table=finer)) == ["Samples a segment 5 → 9"]


def test_named_positions_are_told_with_their_unit() -> None:
    table = table_of(MANUAL)
    words = replace(table.vocabulary, z={**table.vocabulary.z, "Attic": 0.009})
    changed = replace(MANUAL, segment_table=replace(table, vocabulary=words))
    assert sentences(MANUAL, changed) == ["Height Attic is new: 9 mm"]
    assert sentences(changed, MANUAL) == ["Height Attic is gone"]


def test_long_notes_are_told_by_their_length() -> None:
    before = replace(WALK, notes="Oak")
    assert sentences(before, replace(WALK, notes="Felt")) == ["Notes “Oak” → “Felt”"]
    long, other = replace(WALK, notes="a" * 100), replace(WALK, notes="b" * 100)
    assert sentences(long, other) == ["Notes reworded"]
    assert sentences(replace(WALK, notes=""), long) == ["Notes of 0 characters → of 100 characters"]


def test_of_a_sequence_its_parts_are_told() -> None:
    once, thrice = (replace(WALK, sequence=(SequencePart(WALK, times),)) for times in (1, 3))
    name = WALK.name
    assert sentences(once, thrice) == [f"Parts: 1 × {name} → 3 × {name}"]
    newer = replace(once, sequence=(SequencePart(WALK.with_options(margin=0.001)),))
    assert sentences(once, newer) == ["A part's gait was brought up to date"]


CELLS = st.sets(st.integers(0, 43), max_size=12)


@given(CELLS, CELLS, st.floats(0.001, 0.15), st.floats(0.001, 0.15))
def test_whatever_differs_is_told(a: set[int], b: set[int], before_step: float, after_step: float) -> None:
    before = swinging(replace(WALK, step=(before_step, 0.0, 0.0)), 1, *a)
    after = swinging(replace(WALK, step=(after_step, 0.0, 0.0)), 1, *b)
    told = sentences(before, after)
    assert len(told) == (a != b) + (before_step != after_step)
    assert all(
        sentence.split(" → ")[0] != sentence.split(" → ")[-1] or " → " not in sentence for sentence in told
    )
