"""Reasons why there is no gait name what can be changed."""

from __future__ import annotations

from dataclasses import replace

import pytest

from core.library.library import library
from core.pose_gaits.gait_poses import found_gait
from core.robot.model import load_robot
from solver_jobs.pose_gaits.explain import NOT_PROVEN, arms_explained


@pytest.mark.parametrize(
    ("gait_id", "remedy"),
    [
        ("fast-turn", "Turn less (--turn), or ask for less room."),
        ("fast-c-gait", "Shorten the step (--step), or ask for less room."),
        ("fast-curve-left", "Shorten the step (--step), or ask for less room."),
    ],
)
def test_arms_that_come_near_ask_for_less_turn_on_the_spot_and_for_a_shorter_step(
    gait_id: str, remedy: str
) -> None:
    document = library()[gait_id].gait
    known = found_gait(document, load_robot(document.robot))
    assert known is not None
    bounds = replace(known.problem.bounds, arm_distance=0.003)
    why, proof = arms_explained(replace(known, problem=replace(known.problem, bounds=bounds)))
    assert "3 mm are asked (--arm-distance)" in why
    assert why.endswith(remedy)
    assert proof == NOT_PROVEN
