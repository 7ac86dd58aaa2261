"""Simulations that are kept: fresh for the very plan, gone stale with any edit, told apart by waypoints."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from app.common.version import VERSION
from app.plans.make_plan import make_plan
from app.plans.plan import Plan
from app.simulation.problem import (
    key_before,
    physics_content,
    report_content,
    report_from_content,
    simulation_key,
    simulation_problem,
)
from app.simulation.repository import SimulationRepository
from app.store.database import Database
from app.store.tables.simulation_store import MOST_KEPT, SimulationRow, SimulationStore
from core.errors import CheckError, NotFoundError
from core.library.library import library
from core.physics.parameters import PhysicsSet, physics_set, physics_sets
from tests.support import stored_contents
from tests.support.simulated_walk import GAIT, no_solver, walk_plan, walk_report


@pytest.fixture
def kept(database: Database) -> SimulationRepository:
    return SimulationRepository(SimulationStore(database))


def row_of(plan: Plan, physics: PhysicsSet, made: float = 1.0) -> SimulationRow:
    assert plan.waypoints is not None
    return SimulationRow(GAIT, simulation_key(plan, physics), plan.waypoints.content_hash, physics.name, made)


def put(
    kept: SimulationRepository, plan: Plan, name: str | None = None, made: float = 1.0, **more: Any
) -> str:
    physics = physics_set(name)
    row = row_of(plan, physics, made)
    content = {
        **stored_contents.simulation(row.key, made),
        "program": VERSION,
        "physics": physics_content(physics),
        "report": report_content(walk_report()),
        "variations": None,
    }
    kept.put(row, {**content, **more})
    return row.key


def shorter_plan() -> Plan:
    gait = library()[GAIT].gait
    x, y, yaw = gait.step
    return make_plan(replace(gait, step=(0.9 * x, 0.9 * y, yaw)), None, no_solver)


def test_a_simulation_is_fresh_for_its_plan_and_stale_for_another(kept: SimulationRepository) -> None:
    assert kept.standing(GAIT, walk_plan()) is None
    key = put(kept, walk_plan())
    standing, later = kept.standing(GAIT, walk_plan()), kept.standing(GAIT, shorter_plan())
    assert standing is not None
    assert later is not None
    assert [(one["key"], one["fresh"]) for one in (standing, later)] == [(key, True), (key, False)]
    assert kept.is_fresh(GAIT, key, walk_plan())
    assert not kept.is_fresh(GAIT, key, shorter_plan())


def test_going_back_to_a_simulated_plan_finds_its_simulation_again(kept: SimulationRepository) -> None:
    first = put(kept, walk_plan(), made=1.0)
    second = put(kept, shorter_plan(), made=2.0)
    standing = [kept.standing(GAIT, plan) for plan in (walk_plan(), shorter_plan())]
    assert [one and one["key"] for one in standing] == [first, second]


def test_the_report_of_a_plan_comes_back_as_it_was(kept: SimulationRepository) -> None:
    slip = np.array([0.001, 0.0, 0.002, 1 / 3])
    put(kept, walk_plan(), report=report_content(walk_report(slip=slip, fell=True, fell_time=3.5)))
    found = kept.simulated(walk_plan())
    assert found is not None
    assert (found.report.fell, found.report.fell_time) == (True, 3.5)
    assert (found.report.slip == slip).all()
    assert kept.simulated(shorter_plan()) is None


def test_what_the_robots_usual_parameters_find_stands_whatever_else_is_tried(
    kept: SimulationRepository,
) -> None:
    put(kept, walk_plan(), "published", made=1.0)
    put(kept, walk_plan(), "model", made=2.0)
    newest = kept.simulated(walk_plan())
    put(kept, walk_plan(), "scales", made=3.0)
    put(kept, walk_plan(), "model", made=4.0)
    usual = kept.simulated(walk_plan())
    assert [one and one.problem.physics.name for one in (newest, usual)] == ["model", "scales"]


@pytest.mark.parametrize(("name", "other"), [("VERSION", "0.0.1"), ("FORM", 1)])
def test_what_another_program_computed_is_no_simulation_of_today(
    kept: SimulationRepository, monkeypatch: pytest.MonkeyPatch, name: str, other: object
) -> None:
    with monkeypatch.context() as before:
        before.setattr(f"app.simulation.problem.{name}", other)
        put(kept, walk_plan())
    assert kept.simulated(walk_plan()) is None
    standing = kept.standing(GAIT, walk_plan())
    assert standing is not None
    assert not standing["fresh"]


def with_noise(plan: Plan, amount: float) -> Plan:
    """The plan with other last digits, as another computer makes it."""
    assert plan.way is not None
    assert plan.trajectory is not None
    trajectory = replace(plan.trajectory, body_world=plan.trajectory.body_world + amount)
    waypoints = replace(plan.way.waypoints, strokes=plan.way.waypoints.strokes + amount)
    way = replace(plan.way, waypoints=waypoints, times=plan.way.times + amount)
    return replace(plan, trajectory=trajectory, way=way)


def test_a_simulation_is_found_on_a_computer_whose_last_digits_are_others(
    kept: SimulationRepository,
) -> None:
    key = put(kept, walk_plan())
    other = with_noise(walk_plan(), 1e-12)
    assert other.session_hash != walk_plan().session_hash
    assert kept.is_fresh(GAIT, key, other)
    assert kept.simulated(other) is not None
    assert not kept.is_fresh(GAIT, key, with_noise(walk_plan(), 1e-6))


def test_a_simulation_is_of_the_feet_that_stand_and_of_where_the_walk_begins() -> None:
    plan = walk_plan()
    assert plan.way is not None
    assert plan.trajectory is not None
    ways = [replace(plan.way, **{name: ~getattr(plan.way, name)}) for name in ("contact", "standing")]
    turned = replace(plan.trajectory, heading=plan.trajectory.heading + 0.1)
    plans = (plan, *(replace(plan, way=way) for way in ways), replace(plan, trajectory=turned))
    assert len({simulation_key(one, physics_set()) for one in plans}) == 4


def test_a_simulation_that_an_earlier_program_kept_is_found_by_the_key_that_it_had(
    kept: SimulationRepository,
) -> None:
    old = replace(row_of(walk_plan(), physics_set()), key=key_before(walk_plan(), physics_set()))
    kept.put(old, {**stored_contents.simulation(old.key), "report": report_content(walk_report())})
    assert kept.is_fresh(GAIT, old.key, walk_plan())
    assert kept.simulated(walk_plan()) is not None
    assert not kept.is_fresh(GAIT, old.key, shorter_plan())


def test_variations_stay_where_the_same_is_simulated_without_them(kept: SimulationRepository) -> None:
    key = put(kept, walk_plan(), variations={"walks": 3})
    put(kept, walk_plan())
    assert kept.content(key)["variations"] == {"walks": 3}


def test_a_simulation_that_is_not_kept_is_named_with_the_remedy(kept: SimulationRepository) -> None:
    with pytest.raises(NotFoundError, match="Simulate again"):
        kept.content("none")


def test_the_oldest_simulations_go(database: Database) -> None:
    log = SimulationStore(database)
    for number in range(MOST_KEPT + 1):
        content = stored_contents.simulation(f"key {number}")
        log.put(SimulationRow(GAIT, f"key {number}", "w", "scales", float(number)), content)
    rows = log.of_gait(GAIT)
    assert (len(rows), rows[0].key) == (MOST_KEPT, f"key {MOST_KEPT}")
    assert log.content("key 0") is None


def test_each_set_of_parameters_has_a_key_of_its_own() -> None:
    keys = {simulation_key(walk_plan(), physics) for physics in physics_sets().values()}
    assert len(keys) == len(physics_sets())


def test_a_plan_without_waypoints_is_refused_with_its_reason() -> None:
    with pytest.raises(CheckError, match="no plan to simulate"):
        simulation_problem(replace(walk_plan(), way=None), physics_set())


def test_a_report_survives_the_way_through_json() -> None:
    report = walk_report(saturation=np.full((4, 3), 0.25))
    again = report_from_content(report_content(report))
    assert report_content(again) == report_content(report)
