"""Derivatives of a whole motion's rows from those of two neighbouring knots.

Every row of a knot or an interval has the same formula everywhere. So the formulas are differentiated once,
over two knots, and written out for one interval after the other, each value at its place in the whole
Jacobian and Hessian. A solver is then built in a half to a third of the time that differentiating the whole
takes.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from casadi import SX, Function, Sparsity, cse, horzcat, jacobian, triu, vec, vertcat

from core.arrays import Floats
from core.problem.initial_guess import Indices
from core.robot.model import RobotModel
from solver_jobs.nlp.constraint import RowConstraint
from solver_jobs.nlp.variables import Symbols, make_symbols


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


def rows_derivatives(
    symbols: Symbols, model: RobotModel, blocks: Sequence[RowBlock], rows: SX, multipliers: SX
) -> tuple[SX, SX]:
    """Jacobian of the rows, and the upper half of the Hessian of multipliers·rows.

    Args:
        symbols: of the whole motion, whose intervals are given.
        model: the robot.
        blocks: where each constraint's rows stand.
        rows: all of them.
        multipliers: a symbol for each row.
    """
    knots = symbols.heading.shape[1]
    pair, inputs = _pair(model.leg_count, bool(symbols.slope))
    columns = symbols.vector.reshape((-1, knots))
    whole = _inputs_of_intervals(symbols)
    ends = vertcat(columns[:, :-1], columns[:, 1:])
    jacobian_parts, hessian_parts = [], []
    regular = [block for block in blocks if block.knots in (knots, knots - 1)]
    for last in (False, True):
        pieces = [(block, block.constraint.rows(pair, model)) for block in regular]
        if last:
            pieces = [(block, piece[:, 1]) for block, piece in pieces if block.knots == knots]
        else:
            pieces = [(block, piece[:, 0]) for block, piece in pieces]
        intervals = np.array([knots - 2]) if last else np.arange(knots - 1)
        own = _row_places([block for block, _ in pieces], intervals + last)
        part = _Part(pair, inputs, vertcat(*(piece for _, piece in pieces)), intervals, own)
        jacobian_parts.append(part.jacobian(ends, whole, rows.shape[0], columns.numel()))
        hessian_parts += part.hessian(ends, whole, multipliers, columns.numel())
    for block in blocks:
        if block not in regular:
            single = SX(rows.shape[0], columns.numel())
            span = slice(block.first, block.first + block.size)
            single[span, :] = jacobian(rows[span], symbols.vector)
            jacobian_parts.append(single)
    return sum(jacobian_parts[1:], jacobian_parts[0]), sum(hessian_parts[1:], hessian_parts[0])


def _pair(legs: int, slopes: bool) -> tuple[Symbols, SX]:
    """Symbols of two neighbouring knots, with their speeds of turning as inputs; and all inputs."""
    pair = replace(make_symbols(legs, 2, slopes=slopes), heading_rate=SX.sym("rate", 1, 2))
    return pair, vertcat(pair.parameters, pair.heading_rate.T)


def _inputs_of_intervals(symbols: Symbols) -> SX:
    """(inputs, n − 1) what `_pair` has as inputs, for each interval."""
    count = symbols.intervals.shape[1]

    def both(values: SX) -> SX:
        return vertcat(values[:, :-1], values[:, 1:])

    numbers = vertcat(symbols.goal, symbols.margin, symbols.friction)
    fixed = horzcat(*([numbers] * count))
    successors = [both(part) for part in symbols.successor]
    return vertcat(symbols.intervals, both(symbols.heading), fixed, *successors, both(symbols.heading_rate))


def _row_places(blocks: Sequence[RowBlock], knots: Indices) -> Indices:
    """(rows, intervals) place of each row of a pair among all rows."""
    places = [
        block.first + np.arange(block.count)[:, None] + block.count * knots[None, :] for block in blocks
    ]
    return np.concatenate(places)


@dataclass(frozen=True, eq=False)
class _Part:
    """Rows of a pair of knots that are written out for some intervals."""

    pair: Symbols
    inputs: SX
    rows: SX
    intervals: Indices
    places: Indices

    def jacobian(self, ends: SX, whole: SX, height: int, width: int) -> SX:
        slope = jacobian(self.rows, self.pair.vector)
        row, column = (np.array(index, dtype=np.intp) for index in slope.sparsity().get_triplet())
        function = Function("slope", [self.pair.vector, self.inputs], [cse(_values(slope))])
        values = self._written_out(function, ends, whole)
        return _placed(values, self.places[row], self._columns(column), (height, width))

    def hessian(self, ends: SX, whole: SX, multipliers: SX, width: int) -> list[SX]:
        weights = SX.sym("weights", self.rows.shape[0])
        slope = jacobian(self.rows, self.pair.vector).T @ weights
        curvature = triu(jacobian(slope, self.pair.vector))
        row, column = (np.array(index, dtype=np.intp) for index in curvature.sparsity().get_triplet())
        inputs = vertcat(self.inputs, weights)
        function = Function("curvature", [self.pair.vector, inputs], [cse(_values(curvature))])
        own = multipliers[self.places.T.reshape(-1).tolist()].reshape(self.places.shape)
        values = self._written_out(function, ends, whole, own)
        rows, columns = self._columns(row), self._columns(column)
        # Knots within the whole belong to two intervals, whose shares are added.
        second = row >= self.pair.vector.shape[0] // 2
        found = []
        for chosen in (np.nonzero(second)[0], np.nonzero(~second)[0]):
            if len(chosen):
                share = values[chosen.tolist(), :]
                found.append(_placed(share, rows[chosen], columns[chosen], (width, width)))
        return found

    def _columns(self, of_pair: Indices) -> Indices:
        """(entries, intervals) place of the pair's unknowns among all."""
        return np.asarray(of_pair[:, None] + self.pair.vector.shape[0] // 2 * self.intervals[None, :])

    def _written_out(self, function: Function, ends: SX, whole: SX, more: SX | None = None) -> SX:
        chosen = self.intervals.tolist()
        inputs = whole[:, chosen] if more is None else vertcat(whole[:, chosen], more)
        return function.map(len(chosen))(ends[:, chosen], inputs)


def _values(matrix: SX) -> SX:
    """The entries that can differ from 0, one column."""
    values: SX = matrix.nz[:]
    return values


def _placed(values: SX, rows: Indices, columns: Indices, shape: tuple[int, int]) -> SX:
    """A sparse matrix of values (entries, intervals) at their places."""
    order = np.lexsort((rows.T.reshape(-1), columns.T.reshape(-1)))
    sparsity = Sparsity.triplet(
        *shape, rows.T.reshape(-1)[order].tolist(), columns.T.reshape(-1)[order].tolist()
    )
    return SX(sparsity, vec(values)[order.tolist()])
