"""A compiled problem: the assembled problem of one shape with its IPOPT solver, built once and kept."""

import time
from collections import OrderedDict
from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from casadi import (
    SX,
    Function,
    diagcat,
    hessian,
    horzcat,
    jacobian,
    nlpsol,
    substitute,
    sum1,
    triu,
    vec,
    vertcat,
)

from core.arrays import Bools, Floats
from core.problem.initial_guess import Indices
from core.problem.motion_problem import Cost, MotionProblem, Workspace
from core.robot.model import RobotModel
from solver_jobs.nlp.assembly import ELASTIC_FAMILIES, asked_families, row_constraints
from solver_jobs.nlp.block_jacobian import RowBlock, rows_derivatives
from solver_jobs.nlp.constraint import Family, Situation
from solver_jobs.nlp.costs import cost_of, price_of
from solver_jobs.nlp.monitor import Monitor
from solver_jobs.nlp.variables import Symbols, make_symbols

IPOPT_OPTIONS: dict[str, int | float | str] = {
    "print_time": False,
    "no_nlp_grad": True,
    "calc_lam_p": False,
    "ipopt.print_level": 0,
    "ipopt.sb": "yes",
    "ipopt.max_iter": 50,
    "ipopt.tol": 1e-8,
    "ipopt.constr_viol_tol": 1e-8,
    "ipopt.acceptable_iter": 0,
    "ipopt.bound_relax_factor": 1e-10,
    "ipopt.honor_original_bounds": "yes",
    "ipopt.mu_strategy": "adaptive",
    "ipopt.mu_init": 1.0,
    "ipopt.bound_mult_init_method": "mu-based",
    "ipopt.constr_mult_init_max": 0.0,
}
"""Tuning, by symptom. Tens of iterations with a strongly shifted Hessian at first: multipliers guessed by
least squares; they start at 0 instead. Slow last digits: the barrier starts at 1 with matching bound
multipliers. "Acceptable" answers are not wanted: acceptable_iter is 0. Feasible problems take 9 to 30
iterations; one that has not converged in 50 goes to the search for the nearest motion."""

ELASTIC_OPTIONS: dict[str, int | float | str] = {"ipopt.max_iter": 200}
"""What differs in the search for the nearest motion, which takes 18 to 40 iterations."""

MISS_ROOM = 1.0
"""How much larger misses are at the start of that search than they need be (mm, mm/s, N). From 0 it took up
to 180 iterations, since there every row and every miss is at its bound at once."""

WARM_OPTIONS: dict[str, int | float | str] = {
    "ipopt.max_iter": 25,
    "ipopt.mu_strategy": "monotone",
    "ipopt.mu_init": 1e-4,
    "ipopt.warm_start_init_point": "yes",
    "ipopt.warm_start_bound_push": 1e-6,
    "ipopt.warm_start_bound_frac": 1e-6,
    "ipopt.warm_start_slack_bound_push": 1e-6,
    "ipopt.warm_start_slack_bound_frac": 1e-6,
    "ipopt.warm_start_mult_bound_push": 1e-6,
}
"""What differs where IPOPT goes on from a solution of nearly the same problem. If it has not converged in 25
iterations, it would be quicker from the drawing."""

ELASTIC_COST_WEIGHT = 1e-4
"""Weight of the cost beside the sum of all misses (mm, mm/s) in the search for the nearest motion."""


@dataclass(frozen=True)
class Shape:
    """What the structure depends on; everything else enters as bounds and parameters.

    Args:
        knots: number of knots.
        workspace: form of reach.
        cost: what is minimised.
        asked: families of the optional rows that are there.
        elastic: whether some demands may be missed at a price.
    """

    knots: int
    workspace: Workspace
    cost: Cost
    asked: frozenset[Family]
    elastic: bool


class Ipopt(NamedTuple):
    """IPOPT as a CasADi function, and what it calls at each iteration."""

    function: Function
    monitor: Monitor


@dataclass(frozen=True, eq=False)
class CompiledProblem:
    """A problem's shape with its solver.

    Args:
        solver: of the unknowns, followed by the misses of an elastic shape.
        problem: what the solver was made of, for a second one with other options.
        cost: reported cost of (unknowns, parameters), in the solver's scale.
        rows: every row of (unknowns, parameters), misses left out.
        blocks: where each row constraint stands.
        elastic: whether misses follow the unknowns.
        row_of, column_of: places of the rows' Jacobian that can differ from 0.
    """

    solver: Ipopt
    problem: dict[str, SX]
    cost: Function
    rows: Function
    blocks: tuple[RowBlock, ...]
    elastic: bool
    row_of: Indices
    column_of: Indices

    @cached_property
    def warm_solver(self) -> Ipopt:
        """Goes on from a solution with its multipliers; shares the derivatives of `solver`."""
        function = self.solver.function
        shared = {
            "grad_f": function.get_function("nlp_grad_f"),
            "jac_g": function.get_function("nlp_jac_g"),
            "hess_lag": function.get_function("nlp_hess_l"),
        }
        return ipopt(self.problem, {**IPOPT_OPTIONS, **WARM_OPTIONS, **shared})

    def row_bounds(self, situation: Situation) -> tuple[Floats, Floats]:
        """Lower and upper bounds of every row."""
        return bounds_of(self.blocks, situation)

    def misses_of(self, rows: Floats, lower: Floats, upper: Floats) -> Floats:
        """Misses to start from: what the rows miss their bounds by, and `MISS_ROOM`; none if not elastic."""
        parts = [np.zeros(0)]
        for block in self.blocks if self.elastic else ():
            if block.constraint.family in ELASTIC_FAMILIES:
                part = slice(block.first, block.first + block.size)
                for excess in (rows[part] - upper[part], lower[part] - rows[part]):
                    parts.append(np.maximum(excess / block.constraint.per_unit, 0.0) + MISS_ROOM)
        return np.concatenate(parts)

    def constant_rows(self, free: Bools) -> Bools:
        """Which rows depend on no free unknown."""
        touched = np.zeros(self.rows.numel_out(0), dtype=np.bool_)
        touched[self.row_of[free[self.column_of]]] = True
        return ~touched


def bounds_of(blocks: Sequence[RowBlock], situation: Situation) -> tuple[Floats, Floats]:
    """Lower and upper bounds of every row of these blocks."""
    lower, upper = [], []
    for block in blocks:
        shape = (block.knots, block.count)
        low, high = block.constraint.bounds(situation)
        lower.append(np.broadcast_to(low, shape).reshape(-1))
        upper.append(np.broadcast_to(high, shape).reshape(-1))
    return np.concatenate(lower), np.concatenate(upper)


def compile_problem(model: RobotModel, shape: Shape) -> CompiledProblem:
    """Builds the solver of a shape (0.1 s at 45 knots, 0.4 s with motor limits)."""
    symbols = make_symbols(model.leg_count, shape.knots, slopes=Family.FRICTION in shape.asked)
    vector, parameters = symbols.vector, symbols.parameters
    blocks, expressions = assembled_rows(symbols, model, shape)
    rows = vertcat(*expressions)
    cost = cost_of(shape.cost, symbols, model)
    price = price_of(shape.cost, cost, symbols)
    nlp = {"x": vector, "p": parameters, "f": price, "g": rows}
    weight, multipliers = SX.sym("weight"), SX.sym("multipliers", rows.numel())
    slope, curvature = rows_derivatives(symbols, model, blocks, rows, multipliers)
    row_of, column_of = slope.sparsity().get_triplet()
    curvature += weight * triu(hessian(price, vector)[0])
    if shape.elastic:
        nlp = _elastic(nlp, expressions, blocks)
        missed = nlp["x"][vector.numel() :]
        slope = horzcat(slope, jacobian(nlp["g"], missed))
        curvature = substitute(curvature, weight, ELASTIC_COST_WEIGHT * weight)
        curvature = diagcat(curvature, SX(missed.numel(), missed.numel()))
    given = [nlp["x"], parameters]
    derivatives = {
        "jac_g": Function("nlp_jac_g", given, [nlp["g"], slope]),
        "hess_lag": Function("nlp_hess_l", [*given, weight, multipliers], [curvature]),
    }
    return CompiledProblem(
        solver=ipopt(nlp, {**IPOPT_OPTIONS, **(ELASTIC_OPTIONS if shape.elastic else {}), **derivatives}),
        problem=nlp,
        cost=Function("cost", [vector, parameters], [cost]),
        rows=Function("rows", [vector, parameters], [rows]),
        blocks=blocks,
        elastic=shape.elastic,
        row_of=np.array(row_of, dtype=np.intp),
        column_of=np.array(column_of, dtype=np.intp),
    )


def assembled_rows(
    symbols: Symbols, model: RobotModel, shape: Shape
) -> tuple[tuple[RowBlock, ...], list[SX]]:
    """Every row of a shape, a column a row constraint, and where each stands."""
    blocks, expressions, first = [], [], 0
    for constraint in row_constraints(shape.workspace, shape.asked):
        expression = constraint.rows(symbols, model)
        blocks.append(RowBlock(constraint, first, *expression.shape))
        expressions.append(vec(expression))
        first += expression.numel()
    return tuple(blocks), expressions


def _elastic(nlp: dict[str, SX], expressions: Sequence[SX], blocks: Sequence[RowBlock]) -> dict[str, SX]:
    """The same problem where some rows may miss their bounds by m⁺ − m⁻ at the price Σ (m⁺ + m⁻)."""
    rows, misses = [], []
    for expression, block in zip(expressions, blocks, strict=True):
        if block.constraint.family not in ELASTIC_FAMILIES:
            rows.append(expression)
            continue
        above, below = SX.sym("above", block.size), SX.sym("below", block.size)
        rows.append(expression + block.constraint.per_unit * (below - above))
        misses += [above, below]
    missed = vertcat(*misses)
    return {
        "x": vertcat(nlp["x"], missed),
        "p": nlp["p"],
        "f": ELASTIC_COST_WEIGHT * nlp["f"] + sum1(missed),
        "g": vertcat(*rows),
    }


def ipopt(nlp: dict[str, SX], options: dict[str, Any]) -> Ipopt:
    """IPOPT over a problem, with its own monitor."""
    monitor = Monitor(nlp["x"].numel(), nlp["g"].numel(), nlp["p"].numel())
    function = nlpsol("motion", "ipopt", nlp, {**options, "iteration_callback": monitor})
    monitor.solver = function
    return Ipopt(function, monitor)


class CompiledProblemCache:
    """The structures of the shapes used last. Not for several threads at once."""

    def __init__(self, capacity: int = 8) -> None:
        self._capacity = capacity
        self._known: OrderedDict[Hashable, CompiledProblem] = OrderedDict()

    def get(self, problem: MotionProblem, *, elastic: bool = False) -> tuple[CompiledProblem, float]:
        """The structure of a problem's shape and the seconds it took to build, 0 where it was at hand."""
        shape = shape_of(problem, elastic=elastic)
        key = (shape, fingerprint(problem.model))
        if key in self._known:
            self._known.move_to_end(key)
            return self._known[key], 0.0
        begin = time.perf_counter()
        compiled = compile_problem(problem.model, shape)
        self._known[key] = compiled
        if len(self._known) > self._capacity:
            self._known.popitem(last=False)
        return compiled, time.perf_counter() - begin


def shape_of(problem: MotionProblem, *, elastic: bool = False) -> Shape:
    """The shape of a problem."""
    workspace, asked = problem.limits.workspace, asked_families(problem)
    return Shape(problem.knot_count, workspace, problem.cost, asked, elastic)


def fingerprint(model: RobotModel) -> Hashable:
    """Every number of the model that the structure holds."""
    ring = (model.radius, model.com_height, *model.azimuths.tolist())
    return (ring, model.leg, model.masses, model.stroke.lower, model.stroke.upper)
