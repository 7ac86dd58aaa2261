"""Rows of the live tier against the functions of core that they stand for."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.motion.support_polygon import centre_of_pressure, stability_margins, trajectory_pressure
from core.problem.motion_problem import CYLINDER, MotionProblem, Workspace
from core.robot.kinematics import BodyPose, feet_in_modules
from core.robot.leg import strokes_from_foot
from solver_jobs.live.assembly import inner_rows, natural_linearisation, outer_rows
from solver_jobs.live.elastic import nearest
from solver_jobs.live.linearisation import MM, Linearisation, linearise
from solver_jobs.live.motion import trajectory_of, vertical_shares
from solver_jobs.live.qp import Solver
from solver_jobs.live.reach import reach_of
from solver_jobs.live.rows import DiscPolygon, Rows, balance, integration
from tests.support.solvers.cases import gait_problem

PROBLEM = gait_problem("walk", 0.012, Workspace.STROKE)


def values(rows: Rows, x: np.ndarray) -> np.ndarray:
    """A x of rows."""
    total = np.zeros(rows.count)
    np.add.at(total, rows.row, rows.value * x[rows.column])
    return total


def some_point(linearisation: Linearisation, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).normal(0.0, 5.0, linearisation.size)


def test_integration_rows_are_the_double_integrator() -> None:
    linearisation = linearise(PROBLEM)
    x = some_point(linearisation, 1)
    motion = trajectory_of(linearisation, x)
    rows = integration(linearisation)
    missing = values(rows, x) - rows.lower
    gaps = [
        np.diff(p, axis=0) - 0.2 * (v[1:] + v[:-1])
        for p, v in ((motion.body_world, motion.body_velocity), (motion.feet_world, motion.feet_velocity))
        if v is not None
    ]
    largest = max(float(np.abs(gap[..., :2]).max()) for gap in gaps) * MM
    assert np.abs(missing).max() == pytest.approx(largest)


@pytest.mark.parametrize("margin", [0.0, 0.004])
def test_balance_rows_are_the_margin_of_the_centre_of_pressure(margin: float) -> None:
    problem = replace(PROBLEM, limits=replace(PROBLEM.limits, margin=margin))
    linearisation = linearise(problem)
    x = some_point(linearisation, 2)
    motion = trajectory_of(linearisation, x)
    rows = balance(linearisation, np.zeros(problem.knot_count - 1))
    slack = values(rows, x) - rows.lower
    pressure = trajectory_pressure(problem.model, motion)
    wanted = stability_margins(pressure, motion.feet_world[:-1], linearisation.contact[:-1]) - margin
    least = np.full(len(wanted), np.inf)
    np.minimum.at(least, rows.knot, slack)
    inside = wanted > -margin
    assert inside.any()
    np.testing.assert_allclose(least[inside] / MM, wanted[inside], atol=1e-9)
    assert (least[~inside] < -margin * MM).all()


def turned(problem: MotionProblem, angle: float) -> MotionProblem:
    return replace(problem, heading_profile=np.full(problem.knot_count, angle))


@given(
    angle=st.floats(-1.0, 1.0),
    way=st.floats(0.0, 2 * np.pi),
    height=st.floats(0.053, 0.0605),
    foot=st.integers(0, 3),
    workspace=st.sampled_from(list(Workspace)),
)
def test_inner_polygons_are_within_reach_and_outer_ones_around_it(
    angle: float, way: float, height: float, foot: int, workspace: Workspace
) -> None:
    problem = turned(PROBLEM, angle)
    lifted = replace(problem.start, body_world=np.array([0.0, 0.0, height + 0.020]))
    limits = replace(problem.limits, workspace=workspace)
    linearisation = linearise(replace(problem, start=lifted, goal=lifted, limits=limits))
    direction = np.array([np.cos(way), np.sin(way)])
    cosine, sine = np.cos(angle), np.sin(angle)
    centre = np.array([[cosine, -sine], [sine, cosine]]) @ problem.model.module_centres_robot[foot, :2]

    def edge(inner: bool) -> np.ndarray:
        """Where a ray from the module's centre leaves the polygon, m."""
        reach = reach_of(linearisation, DiscPolygon(16, inner))
        along = reach.directions @ direction
        room = reach.bound[0, foot] - reach.directions @ centre * MM
        return centre + direction * float((room[along > 1e-9] / along[along > 1e-9]).min()) / MM

    def excess(point: np.ndarray) -> float:
        """How far out of reach a standing foot there is, m."""
        feet = np.zeros((4, 3))
        feet[foot, :2] = point
        module = feet_in_modules(problem.model, feet, BodyPose(np.array([0.0, 0.0, height]), np.array(angle)))
        if workspace is Workspace.CYLINDER:
            return float(np.linalg.norm(module[foot, :2])) - CYLINDER.radius
        strokes = strokes_from_foot(problem.model.leg, module[foot])
        limit = problem.model.stroke
        return float(np.maximum(limit.lower - strokes, strokes - limit.upper).max())

    assert excess(edge(inner=True)) <= 1e-9
    assert not excess(edge(inner=False)) < -1e-9


@given(
    weights=st.lists(st.floats(0.0, 1.0), min_size=4, max_size=4).filter(lambda w: sum(w) > 0.1),
    standing=st.lists(st.booleans(), min_size=4, max_size=4).filter(lambda s: sum(s) >= 2),
)
def test_shares_push_and_put_the_centre_of_pressure_in_its_place(
    weights: list[float], standing: list[bool]
) -> None:
    contact = np.array(standing)
    wanted = np.where(contact, np.array(weights) + 1e-3, 0.0)
    wanted /= wanted.sum()
    feet = PROBLEM.model.module_centres_robot[:, :2]
    pressure = wanted @ feet
    shares = vertical_shares(feet[None], contact[None], pressure[None])[0]
    assert shares.sum() == pytest.approx(1.0)
    np.testing.assert_allclose(shares @ feet, pressure, atol=1e-12)
    assert (shares >= -1e-9).all()
    assert not shares[~contact].any()


def test_a_share_outside_the_polygon_pulls() -> None:
    feet = PROBLEM.model.module_centres_robot[:, :2]
    shares = vertical_shares(feet[None], np.array([[True, True, True, False]]), np.array([[0.0, -0.01]]))
    assert shares.min() < 0


@pytest.mark.parametrize(("step", "feasible"), [(0.010, True), (0.020, False)])
def test_the_bound_of_weak_duality_lies_below_the_least_miss(step: float, feasible: bool) -> None:
    linearisation = natural_linearisation(gait_problem("amble", step, Workspace.CYLINDER))
    for rows in (inner_rows(linearisation, 16), outer_rows(linearisation, 32)):
        found = nearest(Solver(), linearisation, rows)
        assert found is not None
        assert found.proven <= found.total + 1e-9
        assert (found.proven > 1.0) is not feasible
        assert (found.total < 1e-3) is feasible


def test_the_centre_of_pressure_uses_the_same_heights() -> None:
    linearisation = linearise(PROBLEM)
    motion = trajectory_of(linearisation, some_point(linearisation, 3))
    assert motion.body_velocity is not None
    assert motion.feet_velocity is not None
    masses = PROBLEM.model.masses
    pressure = centre_of_pressure(
        motion.body_world[:-1],
        np.diff(motion.body_velocity, axis=0) / 0.4,
        np.diff(motion.feet_velocity, axis=0) / 0.4,
        masses.body,
        masses.foot,
    )
    np.testing.assert_allclose(pressure, trajectory_pressure(PROBLEM.model, motion), atol=1e-12)


@given(way=st.floats(0.0, 2 * np.pi))
def test_polygons_with_more_edges_hold_those_with_fewer(way: float) -> None:
    def radius(disc: DiscPolygon) -> float:
        along = disc.normals @ np.array([np.cos(way), np.sin(way)])
        return float((disc.apothem / along[along > 1e-9]).min())

    inner = [radius(DiscPolygon(sides, inner=True)) for sides in (16, 32, 64)]
    assert inner[0] <= inner[1] + 1e-12
    assert inner[1] <= inner[2] + 1e-12
    assert inner[2] <= 1.0 + 1e-12 <= radius(DiscPolygon(32, inner=False)) + 2e-12
