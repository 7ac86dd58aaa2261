"""Arms of neighbouring legs that touch, or have little room between them, are a warning."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from core.arrays import Floats
from core.checks.arms import check_arms_of_waypoints
from core.checks.rules import check_waypoints
from core.findings import Finding, Severity
from core.robot.arms import ARM_GAP, arm_gaps, least_arm_gaps
from core.robot.leg import strokes_from_foot
from core.robot.model import RobotModel, load_robot
from core.wire.executed_path import STEPS
from core.wire.waypoints import Waypoints

MODEL = load_robot("deltawalker")


def leaning(*ways: float) -> Floats:
    """(n, legs, 3) strokes with feet 1 and 2 moved so far towards each other along x and y, m."""
    feet = np.tile([0.0, 0.0, -0.056], (len(ways), 4, 1))
    # A module's x points clockwise round the robot, away from the next leg, and y outwards.
    feet[:, 0, 0], feet[:, 1, 0] = -np.array(ways), np.array(ways)
    feet[:, :2, 1] = -np.array(ways)[:, None]
    return strokes_from_foot(MODEL.leg, feet)


def found(strokes: Floats, model: RobotModel = MODEL) -> list[Finding]:
    verdict = check_waypoints(model, Waypoints(strokes, np.full(len(strokes), 0.4)))
    return [finding for finding in verdict.findings if finding.rule == "arm_distance"]


def test_legs_that_stand_straight_have_five_millimetres_between_their_arms() -> None:
    assert arm_gaps(MODEL, leaning(0.0)).min() == pytest.approx(0.015 * np.sqrt(2) / 2 - 0.005, abs=1e-6)
    assert found(leaning(0.0)) == []


def test_arms_that_reach_into_one_another_are_a_warning_with_legs_waypoint_and_a_remedy() -> None:
    (finding,) = found(leaning(0.0, 0.013))
    assert (finding.severity, finding.foot, finding.sample) == (Severity.WARNING, 0, 1)
    assert finding.value is not None
    assert finding.value < 0
    assert "On the way to waypoint 2 the arms of legs 1 and 2 touch" in finding.sentence
    assert finding.sentence.endswith("in one another. Shorten the step, or keep these feet further apart.")


def test_little_room_is_a_warning() -> None:
    ways = np.linspace(0.0, 0.012, 600)
    gaps = arm_gaps(MODEL, leaning(*ways)).min(axis=1)
    little = float(ways[np.nonzero((gaps > 0.0001) & (gaps < ARM_GAP - 0.0001))[0][0]])
    (finding,) = found(leaning(little))
    assert (finding.severity, finding.limit) == (Severity.WARNING, ARM_GAP)
    assert "At waypoint 1 the arms of legs 1 and 2 come within" in finding.sentence


def test_moves_between_waypoints_that_are_left_out_hold_no_smaller_gap() -> None:
    rng = np.random.default_rng(8)
    for _ in range(20):
        strokes = rng.uniform(0.002, 0.016, (6, 4, 3))
        steps = np.arange(STEPS + 1)[:, None, None] / STEPS
        way = np.concatenate([a + steps * (b - a) for a, b in pairwise(strokes)])
        whole = float(np.nanmin(arm_gaps(MODEL, way)))
        (outcome,) = check_arms_of_waypoints(MODEL, Waypoints(strokes, np.full(6, 0.4)))
        margin = outcome.margin.margin
        assert margin is not None
        assert margin == pytest.approx(whole) if whole < ARM_GAP else margin >= ARM_GAP


@pytest.mark.parametrize("robot", ["deltawalker", "hexapod"])
def test_the_least_gaps_over_samples_are_those_of_all_bars(robot: str) -> None:
    model = load_robot(robot)
    rng = np.random.default_rng(3)
    begin = rng.uniform(0.003, 0.016, (12, 1, model.leg_count, 3))
    end = begin + rng.uniform(-0.007, 0.007, begin.shape)
    steps = np.linspace(0.0, 1.0, 9)[:, None, None]
    way = (1 - steps) * begin + steps * end
    all_bars = [np.nan_to_num(arm_gaps(model, group), nan=np.inf).min(axis=0) for group in way]
    assert np.array_equal(least_arm_gaps(model, way), all_bars)


def test_robots_whose_motors_share_actuators_are_left_out() -> None:
    coupled = load_robot("deltawalker9")
    assert found(leaning(0.013), coupled) == []


def test_other_arms_are_other_parameters() -> None:
    thick = replace(MODEL, shape=replace(MODEL.shape, rod_diameter=0.006))
    assert thick.parameters_hash != MODEL.parameters_hash
