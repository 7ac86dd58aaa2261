"""The gaits of the group “For this robot” walk in physics, as sent and under variations."""

from __future__ import annotations

import numpy as np
import pytest

import footfall
from core.library.library import Group, group_ids, library
from core.physics.metrics import report
from core.physics.pose_gait_problem import pose_gait_problem
from core.physics.problem import SimulationProblem
from core.pose_gaits.gait_poses import found_gait
from core.robot.model import load_robot
from solver_jobs import simulate, simulate_variations

GAITS = group_ids(Group.FOR_ROBOT)
IN_CI = frozenset(("fast-c-gait", "fast-walk", "fast-curve-left", "rotate-45"))
"""Gaits that are simulated outside of a soak: of each kind one."""


def simulation(gait_id: str) -> SimulationProblem:
    gait = library()[gait_id].gait
    poses = found_gait(gait, load_robot(gait.robot))
    assert poses is not None
    return pose_gait_problem(poses)


@pytest.mark.parametrize("gait_id", GAITS)
def test_it_passes_the_check_before_sending(gait_id: str) -> None:
    verdict = footfall.check(footfall.plan(gait_id))
    assert verdict.passed, str(verdict)


@pytest.mark.parametrize(
    "gait_id",
    [pytest.param(one, marks=pytest.mark.heavy if one in IN_CI else pytest.mark.soak) for one in GAITS],
)
def test_it_goes_as_planned_and_upright(gait_id: str) -> None:
    problem = simulation(gait_id)
    figures = report(problem, simulate(problem))
    assert not figures.fell
    assert figures.distance >= 0.97 * figures.planned_distance
    turn = float(np.degrees(problem.plan.heading[-1]))
    assert abs(np.degrees(figures.heading) - turn) <= max(2.0, 0.1 * abs(turn))
    assert np.degrees(figures.max_tilt) <= 1.0
    assert figures.swing_load.max() == 0.0


@pytest.mark.soak
@pytest.mark.parametrize("gait_id", GAITS)
def test_all_variations_walk(gait_id: str) -> None:
    assert all(run.walks for run in simulate_variations(simulation(gait_id), 64))
