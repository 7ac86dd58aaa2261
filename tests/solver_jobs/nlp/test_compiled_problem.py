"""Rows and cost of the assembled problem: derivatives, and what the numbers mean."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from casadi import Function, vertcat

from core.arrays import Floats
from core.motion.contact_timeline import timeline_from_order
from core.problem.initial_guess import initial_guess
from core.problem.motion_check import check_motion
from core.problem.motion_problem import Boundary, Cost, MotionProblem, Workspace
from core.robot.kinematics import feet_in_modules
from core.robot.leg import strokes_from_foot
from solver_jobs.nlp.compiled_problem import (
    CompiledProblem,
    CompiledProblemCache,
    assembled_rows,
    compile_problem,
    shape_of,
)
from solver_jobs.nlp.constraint import Family, situation_of
from solver_jobs.nlp.variables import (
    MM,
    MotionVector,
    forces_of_slopes,
    make_symbols,
    parameter_values,
    slopes_of_forces,
    stretched,
    unpacked,
    vector_of_trajectory,
)
from tests.support.solvers.cases import gait_problem

PROBLEM = gait_problem("walk", 0.010, Workspace.STROKE)


LIMITS = replace(PROBLEM.limits, margin=0.002, friction=0.4, motor_speed=0.015, motor_acceleration=0.02)
SHORT = timeline_from_order(4, (3, 2, 4, 1), phase_knots=2, closing_knots=2)
EVERYTHING = replace(
    PROBLEM,
    timeline=SHORT,
    limits=LIMITS,
    boundary=Boundary.PERIODIC,
    heading_profile=np.linspace(0.0, 0.2, SHORT.sample_count) ** 2,
    durations=np.linspace(0.3, 0.5, SHORT.sample_count - 1),
    cost=Cost.GOAL_EFFORT,
)
"""Every optional row, turning, uneven knots; few of them."""


@pytest.fixture(scope="module", params=list(Workspace))
def everything(request: pytest.FixtureRequest) -> tuple[CompiledProblem, MotionProblem]:
    problem = replace(EVERYTHING, limits=replace(LIMITS, workspace=request.param))
    return compile_problem(problem.model, shape_of(problem)), problem


def shaken_start(problem: MotionProblem) -> tuple[Floats, Floats]:
    """A point near the drawing, and the parameters."""
    start = slopes_of_forces(vector_of_trajectory(initial_guess(problem))).packed()
    noise = np.random.default_rng(7).normal(0.0, 0.3, start.shape)
    return start + noise, parameter_values(problem, situation_of(problem).successor)


def expect_slopes(value: Callable[[Floats], Floats], slope: Floats, point: Floats) -> None:
    """Compares a Jacobian with central differences along a few directions."""
    rng = np.random.default_rng(8)
    for _ in range(6):
        direction = rng.normal(size=point.shape)
        along = (value(point + 1e-5 * direction) - value(point - 1e-5 * direction)) / 2e-5
        analytic = (slope @ direction).ravel()
        scale = np.maximum(1.0, np.abs(analytic))
        np.testing.assert_allclose(along / scale, analytic / scale, atol=2e-5)


@pytest.mark.parametrize("part", ["rows", "cost"])
def test_derivatives_agree_with_finite_differences(
    everything: tuple[CompiledProblem, MotionProblem], part: str
) -> None:
    compiled, problem = everything
    function: Function = getattr(compiled, part)
    point, parameters = shaken_start(problem)
    slope = function.factory("slope", ["i0", "i1"], ["jac:o0:i0"])(point, parameters).full()
    expect_slopes(lambda x: np.array(function(x, parameters)).ravel(), slope, point)


@pytest.mark.heavy
@pytest.mark.parametrize("elastic", [False, True])
def test_the_solvers_own_derivatives_agree_with_finite_differences(elastic: bool) -> None:
    compiled = compile_problem(EVERYTHING.model, shape_of(EVERYTHING, elastic=elastic))
    point, parameters = shaken_start(EVERYTHING)
    rows = np.array(compiled.rows(point, parameters)).ravel()
    lower, upper_bound = compiled.row_bounds(situation_of(EVERYTHING))
    point = np.append(point, compiled.misses_of(rows, lower, upper_bound))
    function = compiled.solver.function
    parts = {name: function.get_function(f"nlp_{name}") for name in ("grad_f", "jac_g")}
    hessian = function.get_function("nlp_hess_l")
    weights = np.random.default_rng(9).normal(size=len(rows))
    values = function.get_function("nlp_g")
    slope = parts["jac_g"](point, parameters)[1].full()
    expect_slopes(lambda x: np.array(values(x, parameters)).ravel(), slope, point)

    def gradient(x: Floats) -> Floats:
        slope = np.array(parts["grad_f"](x, parameters)[1]).ravel()
        return np.asarray(slope + parts["jac_g"](x, parameters)[1].T @ weights).ravel()

    upper = hessian(point, parameters, 1.0, weights).full()
    expect_slopes(gradient, upper + np.triu(upper, 1).T, point)


def test_stretched_intervals_have_right_derivatives() -> None:
    phases = tuple(k // 4 for k in range(EVERYTHING.knot_count - 1))
    symbols = stretched(make_symbols(4, EVERYTHING.knot_count, slopes=True), phases)
    _, rows = assembled_rows(symbols, EVERYTHING.model, shape_of(EVERYTHING))
    function = Function("rows", [symbols.vector, symbols.parameters], [vertcat(*rows)])
    point, parameters = shaken_start(EVERYTHING)
    point = np.append(point, np.linspace(0.7, 1.3, max(phases) + 1))
    slope = function.factory("slope", ["i0", "i1"], ["jac:o0:i0"])(point, parameters).full()
    expect_slopes(lambda x: np.array(function(x, parameters)).ravel(), slope, point)


def test_a_stretch_of_its_intervals_is_what_a_problem_with_longer_ones_has() -> None:
    phases = tuple(k // 4 for k in range(EVERYTHING.knot_count - 1))
    symbols = stretched(make_symbols(4, EVERYTHING.knot_count, slopes=True), phases)
    _, rows = assembled_rows(symbols, EVERYTHING.model, shape_of(EVERYTHING))
    function = Function("rows", [symbols.vector, symbols.parameters], [vertcat(*rows)])
    point, parameters = shaken_start(EVERYTHING)
    stretch = np.linspace(0.7, 1.3, max(phases) + 1)
    longer = replace(EVERYTHING, durations=EVERYTHING.intervals * stretch[list(phases)])
    plain = compile_problem(longer.model, shape_of(longer)).rows(point, shaken_start(longer)[1])
    found = function(np.append(point, stretch), parameters)
    np.testing.assert_allclose(np.array(found), np.array(plain), atol=1e-9)


def test_rows_mean_what_the_checker_measures() -> None:
    compiled = compile_problem(EVERYTHING.model, shape_of(EVERYTHING))
    motion = initial_guess(EVERYTHING)
    feet_velocity = np.random.default_rng(5).normal(0.0, 0.01, motion.feet_world.shape)
    motion = replace(motion, feet_velocity=feet_velocity)
    vector = slopes_of_forces(vector_of_trajectory(motion)).packed()
    situation = situation_of(EVERYTHING)
    parameters = parameter_values(EVERYTHING, situation.successor)
    rows = np.array(compiled.rows(vector, parameters)).ravel()
    measured = check_motion(EVERYTHING, motion).violations
    lower, upper = compiled.row_bounds(situation)
    for block in compiled.blocks:
        if block.constraint.family in (Family.MOTOR_SPEED, Family.MOTOR_ACCELERATION):
            excess = block.constraint.excess(block.of(rows), block.of(lower), block.of(upper))
            assert excess.max() / MM == pytest.approx(measured[block.constraint.family], abs=1e-12)


def test_packing_is_undone_by_unpacking() -> None:
    rng = np.random.default_rng(9)
    motion = MotionVector(rng.normal(size=(7, 5, 3)), rng.normal(size=(7, 5, 3)), rng.normal(size=(7, 4, 3)))
    back = unpacked(motion.packed(), 7, 4)
    for name in ("position", "velocity", "force"):
        np.testing.assert_allclose(getattr(back, name), getattr(motion, name), rtol=1e-14)


def test_slopes_are_undone_by_forces() -> None:
    rng = np.random.default_rng(12)
    force = rng.normal(size=(7, 4, 3))
    force[2, 1] = 0.0
    motion = MotionVector(np.zeros((7, 5, 3)), np.zeros((7, 5, 3)), force)
    np.testing.assert_allclose(forces_of_slopes(slopes_of_forces(motion)).force, force, rtol=1e-12)


def test_the_form_without_roots_is_the_stroke_limit_of_inverse_kinematics() -> None:
    turned = replace(PROBLEM, heading_profile=np.linspace(0.0, 0.3, PROBLEM.knot_count))
    compiled = compile_problem(turned.model, shape_of(turned))
    upper, lower = (block for block in compiled.blocks if block.constraint.family is Family.WORKSPACE)
    parameters = parameter_values(turned, situation_of(turned).successor)
    motion = initial_guess(turned)
    n, legs = PROBLEM.knot_count, PROBLEM.model.leg_count
    rng = np.random.default_rng(10)
    feet = motion.feet_world + rng.uniform(-0.02, 0.02, motion.feet_world.shape)
    vector = MotionVector(
        np.concatenate([motion.body_world[:, None], feet], axis=1),
        np.zeros((n, legs + 1, 3)),
        np.zeros((n, legs, 3)),
    ).packed()
    rows = np.array(compiled.rows(vector, parameters)).ravel()
    strokes = strokes_from_foot(
        PROBLEM.model.leg, feet_in_modules(PROBLEM.model, feet, motion.pose(PROBLEM.model))
    ).reshape(n, -1)
    limits = PROBLEM.model.stroke
    np.testing.assert_array_equal(upper.of(rows) <= 0, strokes <= limits.upper)
    np.testing.assert_array_equal(lower.of(rows) >= 0, strokes >= limits.lower)


def test_one_structure_serves_every_timeline_of_its_shape() -> None:
    cache = CompiledProblemCache()
    first, build_seconds = cache.get(gait_problem("walk", 0.010, Workspace.STROKE))
    second, again = cache.get(gait_problem("s-gait", 0.015, Workspace.STROKE))
    assert first is second
    assert build_seconds > 0
    assert again == 0.0
