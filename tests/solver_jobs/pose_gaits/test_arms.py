"""The corners of an arm stand twice, in numpy and in CasADi; both say the same."""

from __future__ import annotations

import numpy as np
import pytest
from casadi import SX, Function, vertcat

from core.robot.arms import arm_bars
from core.robot.kinematics import BodyPose, walker_strokes
from core.robot.model import load_robot
from solver_jobs.pose_gaits.arms import arm_corners


@pytest.mark.parametrize("robot", ["deltawalker", "hexapod"])
def test_corners_are_those_of_the_bars(robot: str) -> None:
    model, dice = load_robot(robot), np.random.default_rng(5)
    body, heading = np.array([0.004, -0.003, 0.056]), 0.1
    away = dice.uniform(-0.006, 0.006, (model.leg_count, 2))
    feet = np.column_stack([model.module_centres_robot[:, :2] + away, np.zeros(model.leg_count)])
    strokes = walker_strokes(model, feet, BodyPose(body, np.array(heading)))
    bars = arm_bars(model, strokes[None])[0]
    for leg in range(model.leg_count):
        for arm in range(3):
            given = SX.sym("body", 3), SX.sym("foot", 3), SX.sym("stroke")
            corners = Function("corners", given, [vertcat(*arm_corners(model, leg, arm, *given, heading))])
            found = np.array(corners(body * 1000, feet[leg] * 1000, strokes[leg, arm] * 1000)).reshape(4, 3)
            left, right = bars[leg, arm, :2]
            assert np.allclose(found, np.array([left[0], right[0], left[1], right[1]]) * 1000, atol=1e-9)
