"""Pose gaits that turn: on the spot, in a curve, and with a heading that sways."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from core.errors import InputError
from core.pose_gaits.pose_check import check_poses
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import PoseProblem
from core.robot.model import load_robot
from solver_jobs import SolveStatus
from solver_jobs.pose_gaits.solve import solve_poses

C_GAIT = (1, 2, 3, 4)


def solved(**asked: Any) -> PoseGait:
    result = solve_poses(PoseProblem(load_robot("deltawalker"), C_GAIT, 0.0, **asked))
    assert result.gait is not None, result.explanation
    assert result.status is SolveStatus.SOLVED
    return result.gait


@pytest.fixture(scope="module")
def swaying() -> PoseGait:
    return solved(step=0.02, sway=float(np.radians(5.0)))


@pytest.mark.soak
def test_the_fastest_turn_on_the_spot_is_far_faster_than_a_given_one() -> None:
    fastest = solved(step=0.0, turn=1.0, free_turn=True)
    assert np.degrees(fastest.turn) > 70.0
    assert np.degrees(fastest.turn_rate) > 5.5
    assert np.allclose(fastest.bodies[-1], fastest.bodies[0], atol=1e-7)
    given = solved(step=0.0, turn=float(np.radians(20.0)))
    assert np.degrees(given.turn) == pytest.approx(20.0)
    assert given.pace < fastest.pace


@pytest.mark.soak
def test_a_turn_that_is_too_far_is_refused_with_the_farthest() -> None:
    result = solve_poses(PoseProblem(load_robot("deltawalker"), C_GAIT, 0.0, step=0.0, turn=2.0))
    assert result.status is SolveStatus.INFEASIBLE
    assert "A turn of 114.6° a cycle (--turn) is too far" in result.explanation[0]


@pytest.mark.heavy
def test_a_curve_goes_along_its_heading_half_way() -> None:
    turn = float(np.radians(-20.0))
    curve = solved(step=0.02, turn=turn)
    along = curve.bodies[-1, :2] - curve.bodies[0, :2]
    assert np.arctan2(along[1], along[0]) == pytest.approx(turn / 2.0)
    assert curve.headings[-1] - curve.headings[0] == pytest.approx(turn)


@pytest.mark.heavy
def test_a_swaying_heading_leaves_an_even_turn_and_comes_back(swaying: PoseGait) -> None:
    away = np.degrees(np.abs(swaying.headings))
    assert 0.5 < away.max() <= 5.0 + 1e-6
    assert swaying.headings[-1] == pytest.approx(swaying.headings[0], abs=1e-9)


def test_the_check_sees_more_sway_than_was_asked(swaying: PoseGait) -> None:
    assert check_poses(swaying).confirmed
    less = replace(swaying, problem=replace(swaying.problem, sway=0.0))
    assert "sway" in {finding.limit for finding in check_poses(less).findings}


@pytest.mark.parametrize(
    ("asked", "sentence"),
    [
        ({"step": 0.0}, "The step is 0 mm and the turn 0 rad"),
        ({"turn": 3.0}, "--turn is 3 rad a cycle"),
        ({"sway": 1.0}, "--sway is 1 rad"),
        ({"turn": 1.0, "free_turn": True}, "Only a turn on the spot"),
    ],
)
def test_what_no_gait_can_do_is_refused(asked: dict[str, Any], sentence: str) -> None:
    with pytest.raises(InputError, match=sentence):
        PoseProblem(load_robot("deltawalker"), C_GAIT, 0.0, **asked)


@pytest.mark.parametrize(
    ("asked", "limit"),
    [
        ({"step": 0.03}, "step"),
        ({"turn": 0.1}, "turn"),
        ({"turn": 1.0, "step": 0.0, "free_turn": True}, "turn"),
    ],
)
def test_the_check_holds_a_gait_to_what_was_asked(
    swaying: PoseGait, asked: dict[str, Any], limit: str
) -> None:
    other = replace(swaying, problem=replace(swaying.problem, **asked))
    assert limit in {finding.limit for finding in check_poses(other).findings}


@pytest.mark.heavy
def test_a_walk_from_rest_begins_with_the_heading_0() -> None:
    walk = solved(step=0.01, cycles=1, sway=float(np.radians(5.0)))
    turned = replace(walk, headings=walk.headings + 0.02)
    assert "ends" in {finding.limit for finding in check_poses(turned).findings}
