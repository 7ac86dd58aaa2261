"""The assembled problem of one shape with IPOPT over it, built once and kept."""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from casadi import SX, Function, jacobian_sparsity, nlpsol, sum1, vec, vertcat

from core.arrays import Bools, Floats
from core.draft import Indices
from core.motion_problem import Cost, MotionProblem, Workspace
from core.robot import RobotModel
from solver_jobs.assembly import ELASTIC_FAMILIES, row_constraints
from solver_jobs.constraint import RowConstraint, Situation
from solver_jobs.costs import cost_of, force_preference
from solver_jobs.monitor import Monitor
from solver_jobs.variables import make_symbols

IPOPT_OPTIONS: dict[str, int | float | str] = {
    "print_time": False,
    "ipopt.print_level": 0,
    "ipopt.sb": "yes",
    "ipopt.max_iter": 100,
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
iterations; one that has not converged in 100 goes to the search for the nearest motion."""

LEVEL = 1e-9
"""Feet below this, m, stand level. Feet that do not could push against each other to shift the torque, since
friction has no limit in the model."""

ELASTIC_COST_WEIGHT = 1e-4
"""Weight of the cost beside the sum of all misses (mm, mm/s) in the search for the nearest motion."""


@dataclass(frozen=True)
class Shape:
    """What the structure depends on; everything else enters as bounds and parameters.

    Args:
        knots: number of knots.
        workspace: form of reach.
        cost: what is minimised.
        margin: whether the centre of pressure is bounded by itself; without a margin and with every foot at
            z = 0 at both ends, contact forces keep it inside the support polygon.
        elastic: whether some demands may be missed at a price.
    """

    knots: int
    workspace: Workspace
    cost: Cost
    margin: bool
    elastic: bool


@dataclass(frozen=True)
class RowBlock:
    """Where a row constraint stands among all rows: `count` rows a knot over `knots` knots, from `first`."""

    constraint: RowConstraint
    first: int
    count: int
    knots: int

    @property
    def size(self) -> int:
        """Number of its rows."""
        return self.count * self.knots

    def of(self, rows: Floats) -> Floats:
        """Its part of all rows as (knots, rows a knot)."""
        return rows[self.first : self.first + self.size].reshape(self.knots, self.count)


@dataclass(frozen=True, eq=False)
class Structure:
    """A problem's shape with its solver.

    Args:
        solver: IPOPT as a CasADi function of the unknowns, followed by the misses of an elastic shape.
        monitor: what the solver calls at each iteration.
        cost: reported cost of (unknowns, parameters), in the solver's scale.
        rows: every row of (unknowns, parameters), misses left out.
        blocks: where each row constraint stands.
        misses: number of misses, 0 where the shape is not elastic.
        row_of, column_of: places of the rows' Jacobian that can differ from 0.
    """

    solver: Function
    monitor: Monitor
    cost: Function
    rows: Function
    blocks: tuple[RowBlock, ...]
    misses: int
    row_of: Indices
    column_of: Indices

    def row_bounds(self, situation: Situation) -> tuple[Floats, Floats]:
        """Lower and upper bounds of every row."""
        lower, upper = [], []
        for block in self.blocks:
            shape = (block.knots, block.count)
            low, high = block.constraint.bounds(situation)
            lower.append(np.broadcast_to(low, shape).reshape(-1))
            upper.append(np.broadcast_to(high, shape).reshape(-1))
        return np.concatenate(lower), np.concatenate(upper)

    def constant_rows(self, free: Bools) -> Bools:
        """Which rows depend on no free unknown."""
        touched = np.zeros(self.rows.numel_out(0), dtype=np.bool_)
        touched[self.row_of[free[self.column_of]]] = True
        return ~touched


def build_structure(model: RobotModel, shape: Shape) -> Structure:
    """Builds the solver of a shape (0.1 to 0.25 s at 45 knots)."""
    symbols = make_symbols(model.leg_count, shape.knots)
    vector, parameters = symbols.vector, symbols.parameters
    blocks, expressions, first = [], [], 0
    for constraint in row_constraints(shape.workspace, shape.margin):
        expression = constraint.rows(symbols, model)
        blocks.append(RowBlock(constraint, first, *expression.shape))
        expressions.append(vec(expression))
        first += expression.numel()
    rows = vertcat(*expressions)
    cost = cost_of(shape.cost, symbols, model)
    price = cost + force_preference(symbols)
    nlp = {"x": vector, "p": parameters, "f": price, "g": rows}
    if shape.elastic:
        nlp = _elastic(nlp, expressions, blocks)
    solver, monitor = _ipopt(nlp)
    row_of, column_of = jacobian_sparsity(rows, vector).get_triplet()
    return Structure(
        solver=solver,
        monitor=monitor,
        cost=Function("cost", [vector, parameters], [cost]),
        rows=Function("rows", [vector, parameters], [rows]),
        blocks=tuple(blocks),
        misses=nlp["x"].numel() - vector.numel(),
        row_of=np.array(row_of, dtype=np.intp),
        column_of=np.array(column_of, dtype=np.intp),
    )


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


def _ipopt(nlp: dict[str, SX]) -> tuple[Function, Monitor]:
    monitor = Monitor(nlp["x"].numel(), nlp["g"].numel(), nlp["p"].numel())
    options: dict[str, Any] = {**IPOPT_OPTIONS, "iteration_callback": monitor}
    solver = nlpsol("motion", "ipopt", nlp, options)
    monitor.solver = solver
    return solver, monitor


class StructureCache:
    """The structures of the shapes used last. Not for several threads at once."""

    def __init__(self, capacity: int = 8) -> None:
        self._capacity = capacity
        self._known: OrderedDict[Hashable, Structure] = OrderedDict()

    def get(self, problem: MotionProblem, *, elastic: bool = False) -> tuple[Structure, float]:
        """The structure of a problem's shape and the seconds it took to build, 0 where it was at hand."""
        limits = problem.limits
        margin = limits.margin > 0 or bool((_end_heights(problem) > LEVEL).any())
        shape = Shape(problem.knot_count, limits.workspace, problem.cost, margin, elastic)
        key = (shape, _fingerprint(problem.model))
        if key in self._known:
            self._known.move_to_end(key)
            return self._known[key], 0.0
        begin = time.perf_counter()
        structure = build_structure(problem.model, shape)
        self._known[key] = structure
        if len(self._known) > self._capacity:
            self._known.popitem(last=False)
        return structure, time.perf_counter() - begin


def _end_heights(problem: MotionProblem) -> Floats:
    return np.concatenate([problem.start.feet_world[:, 2], problem.goal.feet_world[:, 2]])


def _fingerprint(model: RobotModel) -> Hashable:
    """Every number of the model that the structure holds."""
    ring = (model.radius, model.com_height, *model.azimuths.tolist())
    return (ring, model.leg, model.masses, model.stroke.lower, model.stroke.upper)
