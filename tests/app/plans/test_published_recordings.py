"""Published trajectories open, play and simulate, and can be sent: clipped, and some with an override."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.export.import_gait import read_gait
from app.plans.make_plan import make_plan
from app.plans.plan import Plan, verdict_of
from app.scene.overlay import plan_poses
from app.simulation.problem import simulation_problem
from core.checks.simulation import Simulated
from core.findings import Severity
from core.gait.gait import Gait
from core.gait.recording import RecordingFit, WithinStroke
from core.overrides import OVERRIDABLE
from core.physics.masses import default_physics
from core.physics.metrics import report
from core.recorded.fit_choices import refitted
from solver_jobs import simulate, solve_live
from tests.support.reference import reference_path

SAMPLE = ("direction1/walk_a.csv", "direction2/mtri_d.csv", "rotation/rots_d.csv", "rotation/rots_dance.csv")
COUNT = 79
NEED_OVERRIDE = {"rots_d.csv", "rots_dance.csv"}
"""All feet of the first end its turn beyond the range, the second has five poses; the others pass."""


def imported(path: Path) -> Gait:
    """The gait of a published file."""
    return read_gait(path.read_text("utf-8-sig"), path.name).gait


def clipped(path: Path) -> tuple[Gait, Plan]:
    """A published recording kept within the motors' range, and its plan."""
    gait = refitted(imported(path), RecordingFit(within_stroke=WithinStroke.CLIP))
    return gait, make_plan(gait, None, solve_live)


def errors_of(path: Path) -> set[str]:
    """Rules of the errors that stand once it was simulated."""
    gait, plan = clipped(path)
    assert plan.way is not None, plan.note
    assert plan.moved is not None
    plan_poses(plan.model, plan.moved, None)
    problem = simulation_problem(plan, default_physics(plan.model))
    simulated = Simulated(report(problem, simulate(problem)), problem)
    findings = verdict_of(plan, gait, simulated).findings
    return {finding.rule for finding in findings if finding.severity is Severity.ERROR}


@pytest.mark.heavy
@pytest.mark.parametrize("name", SAMPLE)
def test_a_published_trajectory_can_be_sent(name: str) -> None:
    errors = errors_of(reference_path(f"trajectories/{name}"))
    assert errors <= OVERRIDABLE.keys()
    assert bool(errors) == (Path(name).name in NEED_OVERRIDE)


@pytest.mark.soak
def test_every_published_trajectory_can_be_sent() -> None:
    files = sorted(reference_path("trajectories").rglob("*.csv"))
    assert len(files) == COUNT
    errors = {path: errors_of(path) for path in files}
    assert {path.name for path, rules in errors.items() if rules} == NEED_OVERRIDE
    assert all(rules <= OVERRIDABLE.keys() for rules in errors.values())


def test_every_published_trajectory_opens_and_all_but_one_leave_the_range() -> None:
    plans = [
        make_plan(imported(path), None, solve_live) for path in reference_path("trajectories").rglob("*.csv")
    ]
    assert len(plans) == COUNT
    assert all(plan.trajectory is not None for plan in plans)
    assert sum(plan.misfit is not None for plan in plans) == COUNT - 1
