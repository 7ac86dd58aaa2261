"""Pinned poses in a document: which can be pinned, and what is drawn before a solver has answered."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from core.errors import InputError
from core.gait.gait import Gait
from core.gait.poses import PinnedPose, Poses
from core.library.library import library
from core.pose_gaits.gait_poses import asked_of, drawn_poses, found_gait, pose_problem
from core.pose_gaits.start_motion import TURN_GUESS
from core.robot.model import load_robot

MODEL = load_robot("deltawalker")


def gait(*pinned: PinnedPose, stop_bound: float = 1.5) -> Gait:
    first = library()["fast-c-gait"].gait.with_options(stop_bound=stop_bound)
    assert first.poses is not None
    return replace(first, poses=replace(first.poses, pinned=pinned))


def test_poses_that_are_found_hold_only_for_the_same_pinned_ones() -> None:
    assert found_gait(gait(), MODEL) is not None
    assert found_gait(gait(PinnedPose(5, 0.0, 0.001)), MODEL) is None
    hashes = [asked_of(pose_problem(gait(PinnedPose(5, 0.0, place)), MODEL)) for place in (0.001, 0.002)]
    assert len({*hashes, asked_of(pose_problem(gait(), MODEL))}) == 3


def test_drawn_poses_have_the_body_where_it_was_put() -> None:
    before, after = drawn_poses(gait(), MODEL), drawn_poses(gait(PinnedPose(5, 0.001, -0.002)), MODEL)
    moved = np.abs(after.bodies - before.bodies).max(axis=1) > 0.0
    assert np.nonzero(moved)[0].tolist() == [4]
    place = after.problem.pinned_place(after.problem.pinned[0], after.step)
    assert after.bodies[4, :2] == pytest.approx(place)


def test_an_even_travel_is_where_nothing_is_asked() -> None:
    drawn = drawn_poses(gait(PinnedPose(14, 0.0, 0.0)), MODEL)
    half = (drawn.bodies[0, :2] + drawn.bodies[-1, :2]) / 2
    assert drawn.problem.move_count == 26
    assert drawn.bodies[13, :2] == pytest.approx(half)


def turn(**changes: Any) -> Gait:
    return replace(library()["fast-turn"].gait, **changes)


def test_an_edited_free_turn_is_drawn_as_it_was_found() -> None:
    before, edited = turn(), turn().with_options(margin=0.008, clearance=0.006)
    known = found_gait(before, MODEL)
    assert known is not None
    assert found_gait(edited, MODEL) is None
    drawn = drawn_poses(edited, MODEL)
    assert drawn.turn == pytest.approx(known.turn)
    np.testing.assert_array_equal(drawn.bodies, known.bodies)
    np.testing.assert_array_equal(drawn.feet[..., :2], known.feet[..., :2])
    assert (drawn.feet[..., 2] >= drawn.problem.floor).all()


@pytest.mark.parametrize("changes", [{"order": (3, 2, 4, 1)}, {"iterations": 2}])
def test_where_other_poses_are_needed_it_turns_as_far_evenly(changes: dict[str, Any]) -> None:
    drawn = drawn_poses(turn(**changes), MODEL)
    assert drawn.turn == pytest.approx(turn().step[2])
    assert np.diff(drawn.headings) == pytest.approx(drawn.headings[-1] / drawn.problem.move_count)


def test_to_the_other_side_it_is_drawn_anew() -> None:
    other = turn(step=(0.0, 0.0, -turn().step[2]))
    assert drawn_poses(other, MODEL).turn == pytest.approx(-turn().step[2])


def test_a_turn_for_which_no_rod_is_long_enough_is_drawn_with_less() -> None:
    assert drawn_poses(turn(iterations=5), MODEL).turn == pytest.approx(TURN_GUESS)


@pytest.mark.parametrize("pose", [1, 27, 200])
def test_an_end_cannot_be_pinned(pose: int) -> None:
    with pytest.raises(InputError, match=f"names pose {pose}; 2 to 26 can be pinned"):
        pose_problem(gait(PinnedPose(pose, 0.0, 0.0)), MODEL)


def test_no_pose_is_pinned_where_moves_may_be_divided() -> None:
    with pytest.raises(InputError, match="A stop bound of 1 s may divide moves") as refusal:
        pose_problem(gait(PinnedPose(5, 0.0, 0.0), stop_bound=1.0), MODEL)
    assert "at least 1.2 s" in refusal.value.sentence
    pose_problem(gait(PinnedPose(5, 0.0, 0.0), stop_bound=1.2), MODEL)


def test_a_pose_is_pinned_once_and_not_far_away() -> None:
    with pytest.raises(InputError, match="names a pose twice"):
        Poses(pinned=(PinnedPose(5, 0.0, 0.0), PinnedPose(5, 0.0, 0.001)))
    with pytest.raises(InputError, match="31 mm sideways"):
        PinnedPose(5, 0.0, 0.031)
