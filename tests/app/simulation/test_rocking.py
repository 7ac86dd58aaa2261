"""Rocking onto a foot: an error of the plan, and a warning where the simulated robot does not fall."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from app.cli.gait_motion import trajectory_of
from app.plans.plan import sending_of
from app.simulation.problem import way_problem
from core.checks.checked_plan import CheckedPlan, checked_plan
from core.checks.rocking import SIMULATE
from core.checks.rules import check_plan, check_waypoints
from core.checks.simulation import Simulated
from core.findings import Finding, Verdict
from core.library.library import library
from core.physics.metrics import report
from core.physics.parameters import physics_set
from core.physics.problem import SimulationProblem
from core.robot.model import load_robot
from core.wire.waypoint_merging import plan_waypoints
from tests.support.simulated_walk import followed

MODEL = load_robot("deltawalker")
LEAN = float(np.radians(6.0))
ONTO_FOOT_4 = np.array([0.1, 0.1, 0.1, 0.9])
GAIT = "walk-manual-2"
"""A walk by hand that tips onto foot 4."""


@cache
def parts(gait_id: str = GAIT) -> tuple[CheckedPlan, SimulationProblem]:
    gait = library()[gait_id].gait
    motion = trajectory_of(gait)
    way = plan_waypoints(MODEL, motion, *sending_of(gait))
    return checked_plan(gait, MODEL, motion, way), way_problem(MODEL, motion, way, physics_set())


def simulated(gait_id: str = GAIT, **other: Any) -> Verdict:
    """The verdict with a simulation that leans onto foot 4, some of its figures otherwise."""
    plan, problem = parts(gait_id)
    rocks: dict[str, Any] = {"max_tilt": LEAN, "max_tilt_time": 6.0, "swing_load": ONTO_FOOT_4}
    figures = replace(report(problem, followed(problem)), **rocks | other)
    return check_plan(plan, Simulated(figures, problem, "key"))


def rules(findings: tuple[Finding, ...]) -> set[str]:
    return {one.rule for one in findings}


def test_without_a_simulation_rocking_is_an_error_that_names_the_simulation_and_then_the_override() -> None:
    plan, problem = parts()
    for verdict, expected in (
        (check_plan(plan), {"balance", "path_balance"}),
        (check_waypoints(MODEL, problem.waypoints), {"balance"}),
    ):
        assert rules(verdict.errors) == expected
        for one in verdict.errors:
            assert one.is_overridable
            assert one.sentence.endswith(one.remedy)
            assert one.remedy.endswith(SIMULATE)
    assert SIMULATE.index("simulation") < SIMULATE.index("override")


def test_a_simulated_robot_that_rocks_and_does_not_fall_makes_it_a_warning_that_names_the_foot() -> None:
    verdict = simulated()
    assert verdict.passed
    tips = [one for one in verdict.warnings if "In the simulation of these waypoints" in one.sentence]
    assert rules(tuple(tips)) == {"balance", "path_balance"}
    for one in tips:
        assert "the robot rocks onto foot 4 and does not fall." in one.sentence
        assert one.sentence.endswith(one.remedy)
        assert SIMULATE not in one.sentence


def test_a_robot_that_hardly_leans_is_said_to_lean() -> None:
    verdict = simulated(max_tilt=float(np.radians(1.2)), swing_load=np.zeros(4))
    assert verdict.passed
    assert any("the robot leans by up to 1.2° and does not fall." in one.sentence for one in verdict.warnings)


def way(share: float) -> dict[str, Any]:
    _, problem = parts()
    figures = report(problem, followed(problem))
    return {"way": replace(figures.way, made=share * figures.way.asked)}


@pytest.mark.parametrize(
    ("other", "rule"),
    [
        ({"fell": True, "fell_time": 6.0, "max_tilt": 0.6}, "simulated_fall"),
        ({"ended_early": "The solver lost its way."}, "simulated_end"),
        (way(0.49), "simulated_travel"),
    ],
)
def test_a_fall_an_early_end_and_less_than_half_of_the_way_leave_the_errors_of_the_plan(
    other: dict[str, Any], rule: str
) -> None:
    verdict = simulated(**other)
    assert rules(verdict.errors) >= {"balance", "path_balance", rule}
    assert not any("does not fall" in one.sentence for one in verdict.findings)


def test_half_of_the_way_is_enough() -> None:
    assert simulated(**way(0.51)).passed


def test_a_plan_on_the_edge_may_rock_and_one_with_a_reserve_may_not() -> None:
    assert simulated("walk-manual-0").passed
    plan, problem = parts("walk-manual-0")
    early = replace(report(problem, followed(problem)), max_tilt=LEAN, max_tilt_time=0.5)
    verdict = check_plan(plan, Simulated(early, problem, "key"))
    assert rules(verdict.errors) == {"simulated_tilt"}


def test_a_plan_in_which_no_foot_stands_has_none_to_rock_onto() -> None:
    plan, problem = parts()
    contact = np.array(plan.trajectory.contact)
    contact[20:23] = False
    floating = replace(plan, trajectory=replace(plan.trajectory, contact=contact), way=None)
    figures = report(problem, followed(problem))
    for given in (None, Simulated(figures, problem, "key")):
        (error,) = [one for one in check_plan(floating, given).errors if one.value is None]
        assert error.rule == "balance"
        assert SIMULATE not in error.sentence


def test_only_the_robots_usual_physics_says_that_it_rocks() -> None:
    plan, problem = parts()
    other = replace(
        problem, physics=replace(problem.physics, name="soft", friction=problem.physics.friction / 2)
    )
    rocks: dict[str, Any] = {"max_tilt": LEAN, "max_tilt_time": 6.0, "swing_load": ONTO_FOOT_4}
    figures = replace(report(other, followed(other)), **rocks)
    verdict = check_plan(plan, Simulated(figures, other, "key"))
    assert {"balance", "path_balance"} <= rules(verdict.errors)
