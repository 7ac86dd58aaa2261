"""A nonlinear program that is put together row by row and solved by IPOPT, as often as one likes."""

import itertools
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from casadi import SX, Function, nlpsol, vec, vertcat

from core.arrays import Floats
from solver_jobs.nlp.monitor import Monitor

MOST_ITERATIONS = 300
ACCEPTED = frozenset({"Solve_Succeeded", "Solved_To_Acceptable_Level"})
"""Return statuses of IPOPT that give an answer; the independent checker says what it is worth."""
DIVERGED = 1e14
"""Dual infeasibility of a run that leads nowhere: runs that converged came to 4e12, most stayed below 1e6. A
few steps later a factorisation of such numbers may take minutes, in which nothing can end it."""
CHECK_EVERY = 2
"""Iterations between two questions whether to stop."""


@dataclass(frozen=True)
class Row:
    """What a row of the program is about.

    Args:
        limit: which limit, as the checker calls it; "" for a row that only defines something.
        move: counted from 0; None where it is about a pose.
        foot: counted from 0, or None.
    """

    limit: str = ""
    move: int | None = None
    foot: int | None = None


@dataclass(frozen=True, eq=False)
class Attempt:
    """One run of IPOPT.

    Args:
        converged: whether it ended at a solution.
        status: IPOPT's own word.
        values: (variables,) where it ended.
        pressures: (rows,) multipliers of the rows: how much each of them holds the solution back.
        iterations: how many it took.
        seconds: time in the solver.
    """

    converged: bool
    status: str
    values: Floats
    pressures: Floats
    iterations: int
    seconds: float


class Program:
    """Collects variables with a start, and rows with their bounds; lengths are in mm."""

    def __init__(self) -> None:
        self.rows: list[Row] = []
        self._symbols: list[SX] = []
        self._lower: list[float] = []
        self._upper: list[float] = []
        self._start: list[float] = []
        self._expressions: list[SX] = []
        self._row_lower: list[float] = []
        self._row_upper: list[float] = []
        self._solver: Function | None = None
        self._monitor: Monitor | None = None

    def variable(
        self, name: str, lower: Sequence[float], upper: Sequence[float], start: Sequence[float]
    ) -> SX:
        """A vector of unknowns."""
        symbol = SX.sym(name, len(start))
        self._symbols.append(symbol)
        self._lower += list(lower)
        self._upper += list(upper)
        self._start += list(start)
        return symbol

    def bound(self, expression: SX, lower: float, upper: float = np.inf, row: Row | None = None) -> slice:
        """Demands lower ≤ expression ≤ upper of each element; gives the places of these rows."""
        column = vec(SX(expression))
        first, count = len(self._row_lower), column.numel()
        self._expressions.append(column)
        self._row_lower += [lower] * count
        self._row_upper += [upper] * count
        self.rows += [row or Row()] * count
        return slice(first, first + count)

    @property
    def variable_count(self) -> int:
        """Unknowns so far."""
        return len(self._start)

    @property
    def unknowns(self) -> SX:
        """Every unknown in one vector."""
        return vertcat(*self._symbols)

    @property
    def start(self) -> Floats:
        """(variables,) the start that came with the variables."""
        return np.array(self._start)

    @property
    def variable_bounds(self) -> tuple[Floats, Floats]:
        """(variables,) lower and upper bounds, as copies."""
        return np.array(self._lower), np.array(self._upper)

    @property
    def row_bounds(self) -> tuple[Floats, Floats]:
        """(rows,) lower and upper bounds, as copies."""
        return np.array(self._row_lower), np.array(self._row_upper)

    def compile(self, cost: SX, parameters: SX) -> None:
        """Builds the solver; nothing can be added any more."""
        unknowns, rows = self.unknowns, vertcat(*self._expressions)
        self._monitor = Monitor(unknowns.numel(), rows.numel(), parameters.numel())
        options: dict[str, Any] = {
            "print_time": 0,
            "iteration_callback": self._monitor,
            "iteration_callback_step": CHECK_EVERY,
            "ipopt.print_level": 0,
            "ipopt.sb": "yes",
            "ipopt.max_iter": MOST_ITERATIONS,
            "ipopt.tol": 1e-8,
            "ipopt.mu_strategy": "adaptive",
        }
        problem = {"x": unknowns, "f": cost, "g": rows, "p": parameters}
        self._solver = nlpsol("pose_gait", "ipopt", problem, options)
        self._monitor.solver = self._solver

    def run(
        self,
        parameters: Floats,
        start: Floats,
        variable_bounds: tuple[Floats, Floats],
        row_bounds: tuple[Floats, Floats],
        keep_on: Callable[[], bool],
        most_iterations: int = MOST_ITERATIONS,
    ) -> Attempt:
        """Calls IPOPT once; a run that diverges is ended.

        Args:
            parameters: of the cost.
            start: (variables,).
            variable_bounds: (variables,) each.
            row_bounds: (rows,) each.
            keep_on: asked now and then; false ends the run.
            most_iterations: a run that takes more is ended; iterations and not seconds, so that an answer
                does not depend on what else the computer does.
        """
        if self._solver is None or self._monitor is None:
            raise RuntimeError("The program is not compiled.")
        begin, looks = time.perf_counter(), itertools.count(1)
        self._monitor.listener = lambda values, figures: (
            keep_on() and figures["inf_du"] < DIVERGED and next(looks) * CHECK_EVERY < most_iterations
        )
        lower, upper = variable_bounds
        result = self._solver(
            x0=np.clip(start, lower, upper),
            lbx=lower,
            ubx=upper,
            lbg=row_bounds[0],
            ubg=row_bounds[1],
            p=parameters,
        )
        seconds = time.perf_counter() - begin
        if self._monitor.error is not None:
            raise self._monitor.error
        stats = self._solver.stats()
        status = str(stats["return_status"])
        values, pressures = (np.array(result[name]).ravel() for name in ("x", "lam_g"))
        return Attempt(status in ACCEPTED, status, values, pressures, int(stats["iter_count"]), seconds)
