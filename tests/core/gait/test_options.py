"""Options of a gait, and the limits of its motions that they set."""

from __future__ import annotations

from dataclasses import MISSING, fields, replace

import pytest

from core.gait.options import GaitOptions
from core.problem.motion_problem import PLANE_HEIGHTS, MotionLimits, Workspace

OPTIONS = GaitOptions(
    foot_speed=0.03,
    body_speed=0.02,
    clearance=0.004,
    margin=0.006,
    workspace=Workspace.CYLINDER,
    friction=0.5,
    motor_speed=0.01,
    motor_acceleration=0.02,
)
CONSTANTS = {"plane_height": PLANE_HEIGHTS}


def test_every_limit_of_a_motion_comes_from_the_options_or_is_a_named_constant() -> None:
    limits, usual = OPTIONS.motion_limits(), GaitOptions().motion_limits()
    for limit in fields(MotionLimits):
        value = getattr(limits, limit.name)
        assert value == CONSTANTS.get(limit.name, getattr(OPTIONS, limit.name)), limit.name
        assert (value == getattr(usual, limit.name)) is (limit.name in CONSTANTS), limit.name
        assert (limit.default is MISSING) is (limit.name not in CONSTANTS), limit.name


@pytest.mark.parametrize(("heights", "reached"), [((0.054,), PLANE_HEIGHTS), ((0.05, 0.062), (0.05, 0.062))])
def test_heights_that_a_motion_has_to_reach_widen_its_range(
    heights: tuple[float, ...], reached: tuple[float, float]
) -> None:
    widened = OPTIONS.motion_limits(heights)
    assert widened == replace(OPTIONS.motion_limits(), plane_height=reached)
