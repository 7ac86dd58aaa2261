"""One motion, three verdicts: the check of its trajectory, of its waypoints alone, and the physics."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

import pytest

from app.cli.gait_motion import trajectory_of
from app.plans.plan import sending_of
from app.simulation.problem import way_problem
from core.checks.checked_plan import checked_plan
from core.checks.made_plan import made_plan
from core.checks.rocking import PLANNED_ROCKING
from core.checks.rules import check_plan, check_waypoints
from core.checks.simulation import Simulated
from core.errors import InfeasibleError
from core.findings import Finding, Severity, Verdict
from core.gait.gait import Gait
from core.library.library import library
from core.library.new_gait import with_robot
from core.physics.findings import physics_outcomes
from core.physics.masses import default_physics
from core.physics.metrics import report
from core.physics.report import SimulationReport
from core.robot.model import ROBOT_NAMES, load_robot
from core.wire.waypoint_merging import plan_waypoints
from solver_jobs import simulate
from tests.support.soak import is_soak
from tests.support.studio_process import PROJECT

COUPLED = tuple(name for name in ROBOT_NAMES if load_robot(name).is_coupled)
SHORT = frozenset(
    (
        *("walk", "amble", "s-gait", "c-gait", "amble-order-3", "fast-c-gait"),
        *("walk-manual-0", "walk-manual-2", "amble-manual-1", "s-gait-manual-0"),
        *("hexapod-tripod", "hexapod-front-up", "dodecapod-three-up"),
    )
)
"""Gaits that are tried outside of a soak."""
NEAR = 0.1
"""A part of a way in the documentation may be so far off on another computer: physics is chaotic there."""


@dataclass(frozen=True)
class Verdicts:
    """What is said of one motion."""

    trajectory: Verdict
    waypoints: Verdict
    simulated: Verdict
    figures: SimulationReport
    found: tuple[Finding, ...]
    estimate: float | None

    @property
    def walks(self) -> bool:
        return all(found.severity is not Severity.ERROR for found in self.found)

    @property
    def agree(self) -> bool:
        """Whether all pass alike, but for a plan that tips and a robot that rocks and does not fall."""
        if self.trajectory.passed == self.waypoints.passed == self.simulated.passed == self.walks:
            return True
        broken = {error.rule for error in self.trajectory.errors}
        rocks = self.walks and not self.figures.fell and broken >= {"balance"}
        others = broken - set(PLANNED_ROCKING)
        return rocks and not self.waypoints.passed and self.simulated.passed == (not others)


def gaits_for(robot: str) -> Iterator[str]:
    """Gaits of the library for a robot's number of legs, poses for their own robot alone; in a soak all."""
    for entry in library().values():
        own, legs = entry.gait.robot == robot, load_robot(entry.gait.robot).leg_count
        fits = own or (legs == load_robot(robot).leg_count and entry.gait.poses is None)
        if fits and (is_soak() or entry.id in SHORT):
            yield entry.id


@cache
def verdicts(robot: str, gait_id: str) -> Verdicts | None:
    """All verdicts of a gait for a robot; None where it has no motion."""
    model = load_robot(robot)
    try:
        gait: Gait = with_robot(library()[gait_id].gait, model)
        motion = trajectory_of(gait)
    except InfeasibleError:
        return None
    way = plan_waypoints(model, motion, *sending_of(gait))
    problem = way_problem(model, motion, way, default_physics(model))
    figures = report(problem, simulate(problem))
    outcomes = physics_outcomes(figures, problem)
    plan = checked_plan(gait, model, motion, way)
    return Verdicts(
        check_plan(plan),
        check_waypoints(model, way.waypoints),
        check_plan(plan, Simulated(figures, problem)),
        figures,
        tuple(found for outcome in outcomes for found in outcome.findings),
        made_plan(model, motion, way).way.share if model.is_coupled else None,
    )


@pytest.mark.soak(short=True)
@pytest.mark.parametrize("robot", ROBOT_NAMES)
def test_no_verdict_passes_what_another_one_does_not(robot: str) -> None:
    contradictions = []
    for gait_id in gaits_for(robot):
        of = verdicts(robot, gait_id)
        if of is not None and not of.agree:
            contradictions.append((gait_id, of.trajectory.passed, of.waypoints.passed, of.walks))
    assert contradictions == []


@pytest.mark.soak(short=True)
@pytest.mark.parametrize("robot", ROBOT_NAMES)
def test_what_does_not_get_on_is_said_with_its_place(robot: str) -> None:
    for gait_id in gaits_for(robot):
        of = verdicts(robot, gait_id)
        if of is None:
            continue
        for rule, share in (
            ("simulated_travel", of.figures.way.share),
            ("simulated_heading", of.figures.way.turn_share),
        ):
            if share is None or share >= 0.9:
                continue
            (found,) = [one for one in of.found if one.rule == rule]
            assert found.severity is (Severity.ERROR if share < 0.5 else Severity.WARNING), gait_id
            assert found.foot is not None
            assert found.time is not None


def told(robot: str) -> dict[str, tuple[float, float]]:
    """Parts of the way, estimated and in physics, by gait, as the documentation has them, in per cent."""
    text = (PROJECT / "docs" / "robots.md").read_text()
    rows = re.findall(rf"^\| `([\w-]+)`, {robot} \| (−?\d+) \| (−?\d+) \|", text, re.MULTILINE)
    return {gait: (_number(estimate), _number(physics)) for gait, estimate, physics in rows}


def _number(text: str) -> float:
    return float(text.replace("−", "-"))


@pytest.mark.soak(short=True)
@pytest.mark.parametrize("robot", COUPLED)
def test_the_documentation_says_what_these_robots_make_of_a_gait(robot: str) -> None:
    rows = told(robot)
    assert len(rows) >= 4
    rows = {gait: row for gait, row in rows.items() if is_soak() or gait in SHORT}
    for gait_id, (estimate, physics) in rows.items():
        of = verdicts(robot, gait_id)
        assert of is not None
        assert of.estimate == pytest.approx(estimate / 100, abs=NEAR)
        assert of.figures.way.share == pytest.approx(physics / 100, abs=NEAR)
