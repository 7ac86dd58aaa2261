"""The assembled problem of one shape, built once: its constraints in one short list, and IPOPT over them."""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Hashable
from dataclasses import dataclass
from typing import Any

import numpy as np
from casadi import Function, jacobian_sparsity, nlpsol, vec, vertcat

from core.arrays import Bools, Floats
from core.draft import Indices
from core.motion_problem import Cost, MotionProblem, Workspace
from core.robot import RobotModel
from solver_jobs.bounds import (
    BodyHeight,
    Boundary,
    Clearance,
    ContactForce,
    FlatLanding,
    FloatingForce,
    FootHeight,
    GroundedHeight,
    GroundedVelocity,
)
from solver_jobs.constraint import BoundConstraint, Box, RowConstraint, Situation, open_box
from solver_jobs.costs import cost_of, force_preference
from solver_jobs.monitor import Monitor
from solver_jobs.rows_motion import BodySpeed, BodyTorque, FootSpeed, ForceBalance, Integration
from solver_jobs.rows_reach import CylinderDisc, CylinderHeight, StabilityMargin, StrokeLower, StrokeUpper
from solver_jobs.variables import make_symbols

MAX_ITERATIONS = 150
"""Feasible problems here take 9 to 30."""

IPOPT_OPTIONS: dict[str, int | float | str] = {
    "print_time": False,
    "ipopt.print_level": 0,
    "ipopt.sb": "yes",
    "ipopt.max_iter": MAX_ITERATIONS,
    "ipopt.tol": 1e-8,
    "ipopt.constr_viol_tol": 1e-8,
    "ipopt.acceptable_iter": 0,
    "ipopt.honor_original_bounds": "yes",
    "ipopt.mu_strategy": "adaptive",
    "ipopt.mu_init": 1.0,
    "ipopt.bound_mult_init_method": "mu-based",
    "ipopt.constr_mult_init_max": 0.0,
}
"""Tuning, by symptom. Tens of iterations with a strongly shifted Hessian at first: multipliers guessed by
least squares; they start at 0 instead. Slow last digits: the barrier starts at 1 with matching bound
multipliers. "Acceptable" answers are not wanted: acceptable_iter is 0."""

BOUND_CONSTRAINTS: tuple[BoundConstraint, ...] = (
    Boundary(),
    BodyHeight(),
    FootHeight(),
    GroundedVelocity(),
    GroundedHeight(),
    FlatLanding(),
    ContactForce(),
    FloatingForce(),
    Clearance(),
)


def row_constraints(workspace: Workspace, with_margin: bool) -> tuple[RowConstraint, ...]:
    """The row constraints of a shape."""
    reach: dict[Workspace, tuple[RowConstraint, ...]] = {
        Workspace.CYLINDER: (CylinderDisc(), CylinderHeight()),
        Workspace.STROKE: (StrokeUpper(), StrokeLower()),
    }
    always: tuple[RowConstraint, ...] = (
        Integration(),
        ForceBalance(),
        BodyTorque(),
        FootSpeed(),
        BodySpeed(),
    )
    margin: tuple[RowConstraint, ...] = (StabilityMargin(),) if with_margin else ()
    return always + reach[workspace] + margin


@dataclass(frozen=True)
class RowBlock:
    """Where a row constraint stands among all rows: `count` rows a knot over `knots` knots, from `first`."""

    constraint: RowConstraint
    first: int
    count: int
    knots: int

    def of(self, rows: Floats) -> Floats:
        """Its part of all rows as (knots, rows a knot)."""
        size = self.count * self.knots
        return rows[self.first : self.first + size].reshape(self.knots, self.count)


@dataclass(frozen=True, eq=False)
class Structure:
    """A problem's shape with its solver.

    Args:
        solver: IPOPT as a CasADi function.
        monitor: what the solver calls at each iteration.
        cost: reported cost of (unknowns, parameters), in the solver's scale.
        rows: every row of (unknowns, parameters).
        blocks: where each row constraint stands.
        row_of, column_of: places of the rows' Jacobian that can differ from 0.
    """

    solver: Function
    monitor: Monitor
    cost: Function
    rows: Function
    blocks: tuple[RowBlock, ...]
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


def box_of(situation: Situation) -> Box:
    """Bounds of every unknown."""
    box = open_box(situation.problem.knot_count, situation.problem.model.leg_count)
    for constraint in BOUND_CONSTRAINTS:
        constraint.tighten(box, situation)
        box.settle(constraint.family)
    return box


def build_structure(
    model: RobotModel, knots: int, workspace: Workspace, cost: Cost, with_margin: bool
) -> Structure:
    """Builds the solver of a shape (0.1 to 0.2 s at 45 knots)."""
    symbols = make_symbols(model.leg_count, knots)
    parameters = symbols.parameters
    blocks, expressions, first = [], [], 0
    for constraint in row_constraints(workspace, with_margin):
        expression = constraint.rows(symbols, model)
        blocks.append(RowBlock(constraint, first, *expression.shape))
        expressions.append(vec(expression))
        first += expression.numel()
    rows = vertcat(*expressions)
    value = cost_of(cost, symbols, model)
    nlp = {"x": symbols.vector, "p": parameters, "f": value + force_preference(symbols), "g": rows}
    monitor = Monitor(symbols.vector.numel(), rows.numel(), parameters.numel())
    options: dict[str, Any] = {**IPOPT_OPTIONS, "iteration_callback": monitor}
    solver = nlpsol("motion", "ipopt", nlp, options)
    monitor.solver = solver
    row_of, column_of = jacobian_sparsity(rows, symbols.vector).get_triplet()
    return Structure(
        solver,
        monitor,
        Function("cost", [symbols.vector, parameters], [value]),
        Function("rows", [symbols.vector, parameters], [rows]),
        tuple(blocks),
        np.array(row_of, dtype=np.intp),
        np.array(column_of, dtype=np.intp),
    )


class StructureCache:
    """The structures of the shapes used last. Not for several threads at once."""

    def __init__(self, capacity: int = 6) -> None:
        self._capacity = capacity
        self._known: OrderedDict[Hashable, Structure] = OrderedDict()

    def get(self, problem: MotionProblem) -> tuple[Structure, float]:
        """The structure of a problem's shape and the seconds it took to build, 0 where it was at hand."""
        limits, model = problem.limits, problem.model
        with_margin = limits.margin > 0
        key = (problem.knot_count, limits.workspace, problem.cost, with_margin, _fingerprint(model))
        if key in self._known:
            self._known.move_to_end(key)
            return self._known[key], 0.0
        begin = time.perf_counter()
        structure = build_structure(model, problem.knot_count, limits.workspace, problem.cost, with_margin)
        self._known[key] = structure
        if len(self._known) > self._capacity:
            self._known.popitem(last=False)
        return structure, time.perf_counter() - begin


def _fingerprint(model: RobotModel) -> Hashable:
    """Every number of the model that the structure holds."""
    ring = (model.radius, model.com_height, *model.azimuths.tolist())
    return (ring, model.leg, model.masses, model.stroke.lower, model.stroke.upper)
