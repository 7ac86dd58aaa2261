"""Drawn gaits as gaits for the robot's clock and back: the same document, or a sentence on why not."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import permutations
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.errors import InputError
from core.gait.gait import Gait, Orientation, drawn_timeline
from core.gait.held_feet import HeldFeet
from core.gait.poses import PinnedPose
from core.gait.step import without_rounding
from core.library.library import library
from core.library.new_gait import with_robot
from core.motion.contact_timeline import timeline_from_rows
from core.pose_gaits.conversion import (
    as_drawn_gait,
    as_pose_gait,
    conversion_notice,
    conversion_refusal,
    step_order,
)
from core.pose_gaits.gait_poses import pose_problem
from core.problem.motion_problem import Boundary
from core.robot.model import RobotModel, load_robot

MODEL = load_robot("deltawalker")


def gait(gait_id: str = "walk") -> Gait:
    return library()[gait_id].gait


def redrawn(one: Gait) -> Gait:
    return replace(one, timeline=drawn_timeline(one))


def painted(one: Gait, *rows: str, iterations: int = 1) -> Gait:
    """The gait with another timeline, a text of 1 and 0 a foot."""
    return replace(one, timeline=timeline_from_rows(rows, 0.4), iterations=iterations)


DRAWN = st.builds(
    lambda order, direction, iterations, step, turn, phase, merge: redrawn(
        replace(
            gait(),
            order=order,
            direction=direction,
            iterations=iterations,
            step=without_rounding((step, 0.001, turn if iterations == 1 else 0.0)),
        ).with_options(phase_knots=phase, merge=merge, margin=0.004)
    ),
    st.permutations([1, 2, 3, 4]).map(tuple),
    st.integers(1, 4),
    st.integers(1, 20),
    st.floats(-0.05, 0.05),
    st.floats(-2.0, 2.0),
    st.integers(2, 6),
    st.floats(0.0001, 0.005),
)


@given(DRAWN)
def test_there_and_back_gives_the_same_document(drawn: Gait) -> None:
    poses = as_pose_gait(drawn, MODEL)
    assert poses.poses is not None
    assert not poses.poses.free_step
    assert (poses.order, poses.direction, poses.step, poses.options) == (
        drawn.order,
        drawn.direction,
        drawn.step,
        drawn.options,
    )
    assert as_drawn_gait(poses, MODEL) == drawn


def test_another_robot_goes_there_and_back_too() -> None:
    hexapod = load_robot("hexapod")
    drawn = with_robot(gait(), hexapod, (4, 3, 2, 5, 6, 1))
    poses = as_pose_gait(drawn, hexapod)
    assert pose_problem(poses, hexapod).order == (4, 3, 2, 5, 6, 1)
    assert as_drawn_gait(poses, hexapod) == drawn


def test_poses_go_there_and_back_but_for_what_was_found() -> None:
    fast = gait("fast-c-gait")
    assert fast.poses is not None
    drawn = as_drawn_gait(fast, MODEL)
    assert drawn.step == fast.step  # the one that was found
    assert drawn.options.merge == 0.001
    again = as_pose_gait(drawn, MODEL)
    asked = replace(fast, poses=replace(fast.poses, found=None, free_step=False))
    assert again == asked.with_options(merge=0.001)


@pytest.mark.parametrize("direction", [1, 2, 3, 4])
def test_the_order_of_a_painted_timeline_is_read_from_it_in_each_direction(direction: int) -> None:
    for order in permutations((1, 2, 3, 4)):
        other = redrawn(replace(gait(), order=order, direction=direction, iterations=2))
        cells = np.insert(other.timeline.stance, 0, True, axis=1)  # no longer what an order draws
        timeline = replace(other.timeline, stance=cells, locked=np.zeros_like(cells))
        drawn = replace(other, order=(1, 2, 3, 4), timeline=timeline)
        assert step_order(drawn) == order
        assert as_pose_gait(drawn, MODEL).order == order


def test_a_segment_table_gives_its_order_and_is_set_aside() -> None:
    table = gait("amble-manual-0")
    poses = as_pose_gait(table, MODEL)
    assert poses.segment_table is None
    assert poses.order == (1, 3, 2, 4)
    notice = conversion_notice(table, poses)
    assert notice == "The segment table is set aside. Undo brings it back."


def test_options_that_are_not_used_are_named() -> None:
    drawn = gait().with_options(friction=0.5, end_plane_height=0.055)
    assert conversion_notice(drawn, as_pose_gait(drawn, MODEL)) == "Not used here: end body height, friction."
    assert conversion_notice(gait(), as_pose_gait(gait(), MODEL)) is None
    fast = gait("fast-c-gait")
    assert fast.poses is not None
    strict = replace(fast, poses=replace(fast.poses, slip=0.001, free_step=False))
    loose = as_drawn_gait(strict, MODEL)
    assert conversion_notice(strict, loose) == "A drawn gait does not use: slip. Undo brings them back."


REFUSED: dict[str, tuple[Callable[[], Gait], str, str]] = {
    "it is one": (lambda: gait("fast-c-gait"), "poses", "is a gait for the robot's clock already"),
    "a sequence": (lambda: gait("walk-turn-s-gait"), "sequence", "A sequence has several gaits"),
    "held feet": (
        lambda: replace(gait(), held=HeldFeet((1,), ())),
        "held",
        "every foot steps",
    ),
    "no way": (lambda: replace(gait(), step=(0.0, 0.0, 0.0)), "step", "Step and turn are 0"),
    "a wide turn": (lambda: replace(gait(), step=(0.0, 0.0, 2.5)), "step", "at most 120°"),
    "a curve": (
        lambda: redrawn(replace(gait(), step=(0.01, 0.0, 0.1), iterations=2)),
        "iterations",
        "goes in a curve",
    ),
    "no clearance": (lambda: gait().with_options(clearance=0.0), "clearance", "between 0.5 and 15 mm"),
    "a cycle": (lambda: gait().with_options(boundary=Boundary.PERIODIC), "boundary", "Set Ends to “at rest”"),
    "two in the air": (
        lambda: painted(gait(), "1001111", "1100111", "1111101", "1111101"),
        "timeline",
        "Feet 1 and 2 are in the air together at sample 3",
    ),
    "a foot twice": (
        lambda: painted(gait(), "101011111", "111110111", "111111011", "111111101"),
        "timeline",
        "In this timeline the feet step in the order 1, 1, 2, 3, 4, in one iteration",
    ),
    "another order in the second": (
        lambda: painted(gait(), "1011111101", "1101111011", "1110110111", "1111011111", iterations=2),
        "timeline",
        "in 2 iterations. In a gait for the robot's clock every foot steps once an iteration",
    ),
    "no step at all": (lambda: painted(gait(), *["111"] * 4), "timeline", "the feet step not at all"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_poses_cannot_express_is_refused_with_the_field(name: str) -> None:
    make, where, words = REFUSED[name]
    one = make()
    with pytest.raises(InputError) as refusal:
        as_pose_gait(one, MODEL)
    assert refusal.value.where == where
    assert words in refusal.value.sentence
    if one.poses is None:
        assert conversion_refusal(one, MODEL) == refusal.value.sentence


def test_locked_cells_are_unlocked_first() -> None:
    locked = np.zeros_like(gait().timeline.stance)
    locked[0, 0] = True
    one = replace(gait(), timeline=replace(gait().timeline, locked=locked))
    assert conversion_refusal(one, MODEL) == "The timeline has locked cells. Unlock them first."


def test_three_legs_are_too_few() -> None:
    tripod = cast("RobotModel", SimpleNamespace(leg_count=3))
    assert "With three legs none can be lifted" in (conversion_refusal(gait(), tripod) or "")


POSES: dict[str, tuple[dict[str, Any], str, str]] = {
    "pinned": ({"pinned": (PinnedPose(5, 0.0, 0.001),)}, "poses.pinned", "Pose 5 is pinned"),
    "sway": ({"sway": 0.1}, "poses.sway", "Set Sway to 0"),
    "overlap": ({"overlap": True}, "poses.overlap", "every foot down between two steps"),
    "not found yet": ({"found": None}, "poses.free_step", "The fastest step is not known yet"),
}


@pytest.mark.parametrize("name", POSES)
def test_what_a_drawing_cannot_express_is_refused_with_the_field(name: str) -> None:
    changes, where, words = POSES[name]
    fast = gait("fast-c-gait")
    assert fast.poses is not None
    one = replace(fast, poses=replace(fast.poses, **changes))
    with pytest.raises(InputError) as refusal:
        as_drawn_gait(one, MODEL)
    assert refusal.value.where == where
    assert words in refusal.value.sentence
    assert conversion_refusal(one, MODEL) == refusal.value.sentence


def test_a_curve_of_several_cycles_is_not_drawn_and_a_single_one_is() -> None:
    curve = gait("fast-curve-left")
    assert "goes in a curve" in (conversion_refusal(curve, MODEL) or "")
    assert curve.poses is not None
    single = replace(curve, iterations=1, poses=replace(curve.poses, free_step=False))
    drawn = as_drawn_gait(single, MODEL)
    assert drawn.orientation is Orientation.FBS
    assert as_pose_gait(drawn, MODEL).step == curve.step


def test_a_drawn_gait_is_not_drawn_again() -> None:
    with pytest.raises(InputError, match="no gait for the robot's clock"):
        as_drawn_gait(gait(), MODEL)
