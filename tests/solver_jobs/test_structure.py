"""Rows and cost of the assembled problem: derivatives, and what the numbers mean."""

from __future__ import annotations

import numpy as np
import pytest
from casadi import Function

from core.arrays import Floats
from core.draft import initial_motion
from core.kinematics import feet_in_modules
from core.leg import strokes_from_foot
from core.motion_problem import Cost, Workspace
from core.robot import load_robot
from solver_jobs.constraint import situation_of
from solver_jobs.structure import Shape, Structure, StructureCache, build_structure
from solver_jobs.variables import MotionVector, parameter_values, unpacked, vector_of_trajectory
from tests.solver_jobs.cases import gait_problem

PROBLEM = gait_problem("walk", 0.010, Workspace.STROKE)


@pytest.fixture(scope="module", params=list(Workspace))
def structure(request: pytest.FixtureRequest) -> Structure:
    shape = Shape(PROBLEM.knot_count, request.param, Cost.GOAL_EFFORT, margin=True, elastic=False)
    return build_structure(load_robot("deltawalker"), shape)


def shaken_start() -> tuple[Floats, Floats]:
    """A point near the drawing, and the parameters."""
    start = vector_of_trajectory(initial_motion(PROBLEM)).packed()
    noise = np.random.default_rng(7).normal(0.0, 0.3, start.shape)
    return start + noise, parameter_values(PROBLEM, situation_of(PROBLEM).successor)


@pytest.mark.parametrize("part", ["rows", "cost"])
def test_derivatives_agree_with_finite_differences(structure: Structure, part: str) -> None:
    function: Function = getattr(structure, part)
    point, parameters = shaken_start()
    slope = function.factory("slope", ["i0", "i1"], ["jac:o0:i0"])(point, parameters)
    rng = np.random.default_rng(8)
    for _ in range(6):
        direction = rng.normal(size=point.shape)
        ahead = np.array(function(point + 1e-5 * direction, parameters)).ravel()
        behind = np.array(function(point - 1e-5 * direction, parameters)).ravel()
        analytic = np.array(slope @ direction).ravel()
        scale = np.maximum(1.0, np.abs(analytic))
        np.testing.assert_allclose((ahead - behind) / 2e-5 / scale, analytic / scale, atol=2e-5)


def test_packing_is_undone_by_unpacking() -> None:
    rng = np.random.default_rng(9)
    motion = MotionVector(rng.normal(size=(7, 5, 3)), rng.normal(size=(7, 5, 3)), rng.normal(size=(7, 4, 3)))
    back = unpacked(motion.packed(), 7, 4)
    for name in ("position", "velocity", "force"):
        np.testing.assert_allclose(getattr(back, name), getattr(motion, name), rtol=1e-14)


def test_the_form_without_roots_is_the_stroke_limit_of_inverse_kinematics() -> None:
    shape = Shape(PROBLEM.knot_count, Workspace.STROKE, Cost.GOAL, margin=False, elastic=False)
    structure = build_structure(PROBLEM.model, shape)
    upper, lower = structure.blocks[-2:]
    _, parameters = shaken_start()
    motion = initial_motion(PROBLEM)
    n, legs = PROBLEM.knot_count, PROBLEM.model.leg_count
    rng = np.random.default_rng(10)
    feet = motion.feet_world + rng.uniform(-0.02, 0.02, motion.feet_world.shape)
    vector = MotionVector(
        np.concatenate([motion.body_world[:, None], feet], axis=1),
        np.zeros((n, legs + 1, 3)),
        np.zeros((n, legs, 3)),
    ).packed()
    rows = np.array(structure.rows(vector, parameters)).ravel()
    strokes = strokes_from_foot(
        PROBLEM.model.leg, feet_in_modules(PROBLEM.model, feet, motion.pose(PROBLEM.model))
    ).reshape(n, -1)
    limits = PROBLEM.model.stroke
    np.testing.assert_array_equal(upper.of(rows) <= 0, strokes <= limits.upper)
    np.testing.assert_array_equal(lower.of(rows) >= 0, strokes >= limits.lower)


def test_one_structure_serves_every_timeline_of_its_shape() -> None:
    cache = StructureCache()
    first, build_seconds = cache.get(gait_problem("walk", 0.010, Workspace.STROKE))
    second, again = cache.get(gait_problem("s-gait", 0.015, Workspace.STROKE))
    assert first is second
    assert build_seconds > 0
    assert again == 0.0
