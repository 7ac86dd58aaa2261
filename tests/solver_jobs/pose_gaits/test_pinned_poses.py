"""Poses whose body somebody has put to a place: kept, checked, and refused with a reason."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.gait.poses import PinnedPose
from core.pose_gaits.pose_check import check_poses
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import PoseProblem
from core.robot.model import load_robot
from solver_jobs import SolveStatus
from solver_jobs.pose_gaits.solve import solve_poses

POSE = 5


@pytest.fixture(scope="module")
def free() -> PoseGait:
    result = solve_poses(PoseProblem(load_robot("deltawalker"), (1, 2, 3, 4), 0.0, 0.010, cycles=1))
    assert result.gait is not None
    return result.gait


def offset(gait: PoseGait) -> tuple[float, float]:
    """Of the body at `POSE` from an even travel, m along and to the left."""
    even = gait.problem.pinned_place(PinnedPose(POSE, 0.0, 0.0), gait.step)
    along, sideways = (gait.bodies[POSE - 1, :2] - gait.bodies[0, :2] - even).tolist()
    return along, sideways


def pinned(free: PoseGait, along: float, sideways: float) -> PoseProblem:
    """The problem with that pose moved on from where it is."""
    here = offset(free)
    return replace(free.problem, pinned=(PinnedPose(POSE, here[0] + along, here[1] + sideways),))


@pytest.mark.heavy
def test_the_body_is_where_it_was_put_and_the_rest_goes_along(free: PoseGait) -> None:
    problem = pinned(free, -0.0005, -0.0004)
    result = solve_poses(problem, near=free)
    assert result.status is SolveStatus.SOLVED
    assert result.gait is not None
    assert offset(result.gait) == pytest.approx((problem.pinned[0].along, problem.pinned[0].sideways))
    assert check_poses(result.gait).confirmed
    assert result.gait.seconds == pytest.approx(free.seconds, rel=0.05)
    assert np.abs(result.gait.bodies - free.bodies)[POSE].max() > 1e-5


@pytest.mark.heavy
def test_the_check_sees_a_pose_that_is_not_where_it_was_put(free: PoseGait) -> None:
    moved = replace(free, problem=pinned(free, 0.0, 0.002))
    limits = {finding.limit: finding for finding in check_poses(moved).findings}
    assert limits["pinned pose"].amount == pytest.approx(0.002)
    assert f"pose {POSE}" in limits["pinned pose"].sentence


@pytest.mark.heavy
def test_a_place_that_no_gait_reaches_is_named(free: PoseGait) -> None:
    result = solve_poses(pinned(free, 0.0, 0.025), near=free)
    assert result.status is SolveStatus.INFEASIBLE
    assert f"at pose {POSE}" in result.explanation[0]
    assert "unpin it" in result.explanation[0]
