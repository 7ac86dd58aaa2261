"""The gaits for the robot's clock that come with the program: their poses answer what they ask, confirmed."""

from __future__ import annotations

import numpy as np
import pytest

from core.library.library import Group, group_ids, library
from core.pose_gaits.gait_poses import found_gait
from core.pose_gaits.pose_check import check_poses
from core.robot.arms import ARM_GAP
from core.robot.model import load_robot


@pytest.mark.parametrize("gait_id", group_ids(Group.FOR_ROBOT))
def test_its_poses_are_confirmed(gait_id: str) -> None:
    document = library()[gait_id].gait
    poses = found_gait(document, load_robot(document.robot))
    assert poses is not None, "python -m solver_jobs.pose_gaits.library_poses finds them anew"
    check = check_poses(poses)
    assert check.confirmed, check.findings
    assert check.figures.arm_distance >= ARM_GAP - 5e-5
    assert document.timeline.sample_count == len(poses.bodies)


def test_the_first_is_the_fast_c_gait() -> None:
    first = next(iter(library().values()))
    poses = found_gait(first.gait, load_robot("deltawalker"))
    assert poses is not None
    assert first.id == "fast-c-gait"
    assert poses.speed > 0.0022


def test_the_rotation_makes_three_turns_of_15_degrees_as_the_drawn_one_does() -> None:
    rotation, drawn = library()["rotate-45"].gait, library()["rotate"].gait
    assert rotation.order == drawn.order
    assert rotation.step == pytest.approx(drawn.step)
    poses = found_gait(rotation, load_robot(rotation.robot))
    assert poses is not None
    assert np.degrees(poses.turn * rotation.iterations) == pytest.approx(45.0)
    assert drawn.poses is None
