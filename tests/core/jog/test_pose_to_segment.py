"""A pose becomes the last segment of a table: feet end where strokes put them, and nothing else changes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from core.arrays import Floats
from core.errors import InputError
from core.gait.gait import Gait
from core.gait.manual_motion import manual_motion
from core.jog.pose_to_segment import SAME, PoseSegment, pose_to_segment
from core.jog.steps import Axis, JogPart, JogStep, jog_strokes
from core.library.library import library
from core.robot.kinematics import feet_in_robot
from core.robot.model import load_robot

WALKER = load_robot("deltawalker")
WALK = library()["walk-manual-0"].gait
ROUNDING = 2e-5


def with_pose(gait: Gait, taken: PoseSegment) -> Gait:
    """The gait with the longer table and its timeline."""
    implied = taken.table.repeated(gait.iterations).timeline(gait.timeline.sample_time)
    return replace(gait, segment_table=taken.table, timeline=implied)


def last_feet(gait: Gait) -> Floats:
    """(legs, 3) feet in the robot's frame at the end of a gait made by hand."""
    motion = manual_motion(gait, WALKER).trajectory
    return np.asarray(motion.feet_world[-1] - motion.pose(WALKER).position_world[-1])


@given(arrays(np.float64, (4, 3), elements=st.floats(0.004, 0.016)), st.integers(1, 4))
def test_the_gait_ends_with_every_foot_where_the_pose_has_it(strokes: Floats, direction: int) -> None:
    gait = replace(WALK, direction=direction, step=(0.01, 0.01, 0.0))
    taken = pose_to_segment(gait, WALKER, strokes)
    away = np.abs(last_feet(with_pose(gait, taken)) - feet_in_robot(WALKER, strokes))
    assert away[:, 2].max() <= SAME + ROUNDING
    np.testing.assert_array_less(np.linalg.norm(away[:, :2], axis=1), taken.beside + SAME + ROUNDING)


def test_a_pose_that_the_names_can_say_makes_no_new_ones() -> None:
    table = WALK.segment_table
    assert table is not None
    taken = pose_to_segment(WALK, WALKER, np.full((4, 3), 0.005))
    assert (taken.table.vocabulary.xy, taken.table.vocabulary.z) == (table.vocabulary.xy, table.vocabulary.z)
    assert [row[:-1] for row in taken.table.rows] == list(table.rows)
    assert taken.table.vocabulary.segments[taken.table.rows[0][-1]].end == "Home-Base"
    assert taken.beside.max() < 1e-12


def test_a_lifted_foot_swings_and_new_names_are_the_poses() -> None:
    up = JogStep(JogPart.FOOT, 0.003, 1, None, Axis.Z)
    taken = pose_to_segment(WALK, WALKER, jog_strokes(WALKER, np.full((4, 3), 0.008), [up]))
    words = taken.table.vocabulary
    assert taken.name == "Pose 1"
    assert words.z["Pose 1"] == pytest.approx(0.008)
    ends = [words.segments[row[-1]] for row in taken.table.rows]
    assert [(end.end, end.swing) for end in ends] == [
        ("Home-Pose 1", False),
        ("Home-Base", True),
        ("Home-Pose 1", False),
        ("Home-Pose 1", False),
    ]


def test_the_next_pose_gets_the_next_number_and_iterations_repeat_what_they_did() -> None:
    table = WALK.segment_table
    assert table is not None
    once = with_pose(WALK, pose_to_segment(WALK, WALKER, np.full((4, 3), 0.012)))
    twice = pose_to_segment(once, WALKER, np.full((4, 3), 0.014))
    assert twice.name == "Pose 2"
    assert twice.table.last_repeated == table.last_repeated
    assert twice.table.chains == table.chains
    assert twice.table.segment_count == table.segment_count + 2


def test_a_foot_beside_the_steps_line_is_told_by_how_much() -> None:
    gait = replace(WALK, step=(0.01, 0.0, 0.0))
    aside = JogStep(JogPart.FOOT, 0.004, 2, None, Axis.Y)
    taken = pose_to_segment(gait, WALKER, jog_strokes(WALKER, np.full((4, 3), 0.008), [aside]))
    np.testing.assert_allclose(taken.beside, [0.0, 0.0, 0.004, 0.0], atol=1e-9)


def test_what_no_table_or_name_can_say_is_refused() -> None:
    strokes = np.full((4, 3), 0.008)
    with pytest.raises(InputError, match="has no segment table"):
        pose_to_segment(library()["walk"].gait, WALKER, strokes)
    with pytest.raises(InputError, match="has no step"):
        pose_to_segment(replace(WALK, step=(0.0, 0.0, 0.0)), WALKER, strokes)
    far = jog_strokes(WALKER, strokes, [JogStep(JogPart.FOOT, 0.006, 0, None, Axis.X)])
    with pytest.raises(InputError, match=r"Foot 1 stands at 12\.0 times the step"):
        pose_to_segment(replace(WALK, step=(0.0005, 0.0, 0.0)), WALKER, far)
