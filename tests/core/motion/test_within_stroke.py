"""Motions beyond the motors' range are kept within it, and what was cut is said."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.errors import InputError
from core.motion.within_stroke import (
    MOST_CLIPPED,
    beyond_range,
    clipped_motion,
    clipped_places,
    clipped_words,
)
from core.robot.kinematics import free_strokes
from core.robot.model import load_robot
from tests.support.beyond_range import MODEL, lowered

LIMITS = MODEL.stroke


def test_strokes_beyond_the_range_go_to_its_end_and_the_others_stay() -> None:
    motion = lowered(0.002)
    wanted = free_strokes(MODEL, motion.feet_world, motion.pose(MODEL))
    assert wanted.min() < LIMITS.lower, "the motion leaves the range"
    kept = clipped_motion(MODEL, motion)
    strokes = kept.trajectory.strokes(MODEL)
    assert np.abs(strokes - np.clip(wanted, LIMITS.lower, LIMITS.upper)).max() < 1e-9
    assert kept.clipped == pytest.approx(np.maximum(LIMITS.lower - wanted, 0.0), abs=1e-9)
    untouched = ~(kept.clipped > 0).any(axis=-1)
    assert (kept.trajectory.feet_world[untouched] == motion.feet_world[untouched]).all()
    assert (kept.trajectory.body_world == motion.body_world).all()


def test_a_motion_within_the_range_is_the_same_motion() -> None:
    motion = lowered(0.0)
    kept = clipped_motion(MODEL, motion)
    assert kept.trajectory is motion
    assert not kept.clipped.any()
    assert clipped_places(kept.clipped) == []


def test_what_was_cut_names_foot_and_sample() -> None:
    kept = clipped_motion(MODEL, lowered(0.002))
    places = clipped_places(kept.clipped)
    worst = max(places, key=lambda place: place.by)
    assert worst.by == kept.clipped.max() == kept.clipped[worst.sample, worst.foot].max()
    words = clipped_words(kept.clipped)
    assert f"(foot {worst.foot + 1}, sample {worst.sample + 1})" in words
    assert f"at {len({place.sample for place in places})} of {len(kept.clipped)} samples" in words


def test_more_than_five_millimetres_are_not_clipped() -> None:
    furthest = lowered(MOST_CLIPPED + 0.004)
    assert beyond_range(MODEL, furthest).max() > MOST_CLIPPED
    with pytest.raises(InputError, match=r"at most 5 mm are clipped"):
        clipped_motion(MODEL, furthest)


def test_a_foot_that_no_rod_reaches_is_not_clipped() -> None:
    motion = lowered(0.0)
    feet = np.array(motion.feet_world)
    feet[7, 2, 0] += 0.1
    with pytest.raises(InputError, match=r"Foot 3, sample 8: no rod is long enough"):
        clipped_motion(MODEL, replace(motion, feet_world=feet))


def test_a_motion_of_another_robot_is_refused() -> None:
    with pytest.raises(InputError, match=r"has 4 feet, the robot 6"):
        clipped_motion(load_robot("hexapod"), lowered(0.0))
