"""One convex step of a gait: the quadratic program of its linearised limits, solved by DAQP."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from casadi import Sparsity, conic

from core.arrays import Bools, Floats

PRICE = 1e3
"""Price of a mm by which limits are missed; high enough that none is missed where none has to be."""
MOST_ROWS = 160
"""Rows that a program has: those with the least room for how fast it changes."""
MOST_PASSES = 8
"""Programs that are solved for a step: rows that the last one left out and missed take part in the next."""
URGENCY_DECIMALS = 6
"""Decimals to which rows are compared for that."""
ACCURACY = 1e-5
"""A row that is missed by less counts as kept, mm."""
PRESSES = 1e-6


@dataclass(frozen=True, eq=False)
class Step:
    """A step's answer.

    Args:
        change: (unknowns,) mm.
        missed: by how much the linearised limits are missed at the least, mm; the worse of both kinds.
        pressures: (rows,) how hard each row presses, in the order of the rows that were given.
    """

    change: Floats
    missed: float
    pressures: Floats


class ConvexStep:
    """Solves programs of one size; not for several threads at once.

    Args:
        unknowns: how many.
        rows: how many rows are given.
    """

    def __init__(self, unknowns: int, rows: int) -> None:
        self.given = rows
        self._rows = min(rows, MOST_ROWS)
        # The last two unknowns are by how much limits are missed, collisions apart from the others.
        size = unknowns + 2
        pattern = {"h": Sparsity.dense(size, size), "a": Sparsity.dense(self._rows, size)}
        function = conic("step", "daqp", pattern, {"error_on_fail": False})
        self._hessian = np.eye(size)
        self._gradient = np.full(size, PRICE)
        self._matrix = np.zeros((size, self._rows))
        self._least = np.zeros(self._rows)
        self._lower, self._upper = np.zeros(size), np.full(size, np.inf)
        self._values, self._multipliers = np.zeros(size), np.zeros(self._rows)
        given = {
            "h": self._hessian.reshape(-1),
            "g": self._gradient,
            "a": self._matrix.reshape(-1),  # CasADi holds a matrix column by column
            "lba": self._least,
            "uba": np.full(self._rows, np.inf),
            "lbx": self._lower,
            "ubx": self._upper,
        }
        buffer: Any
        buffer, self._evaluate = function.buffer()
        self._held: list[Any] = [function, buffer]  # a buffer does not keep its arrays
        for place in range(function.n_in()):
            values = given.get(function.name_in(place), np.zeros(function.nnz_in(place)))
            self._held.append(values)
            buffer.set_arg(place, values.data)
        results = {"x": self._values, "lam_a": self._multipliers}
        for place in range(function.n_out()):
            values = results.get(function.name_out(place), np.zeros(function.nnz_out(place)))
            self._held.append(values)
            buffer.set_res(place, values.data)

    def solve(
        self,
        curvature: Floats,
        gradient: Floats,
        room: Floats,
        slopes: Floats,
        collides: Bools,
        farthest: float,
    ) -> Step | None:
        """The change with the least cost that keeps all rows, or misses them by the least.

        Args:
            curvature: (unknowns, unknowns) of the cost.
            gradient: (unknowns,) of the cost.
            room: (rows,) mm.
            slopes: (rows, unknowns).
            collides: (rows,) whether a row keeps parts from colliding; these are missed together, and the
                others together.
            farthest: largest change of an unknown, mm.

        Returns:
            None where no answer of the solver keeps the program.
        """
        self._hessian[:-2, :-2], self._gradient[:-2] = curvature, gradient
        self._lower[:-2], self._upper[:-2] = -farthest, farthest
        steepness = np.abs(slopes).sum(axis=1)
        # Symmetric gaits have equal rows; rounded, the same ones are chosen on every processor.
        urgency = np.round(room / np.maximum(steepness, 1e-9), URGENCY_DECIMALS)
        pressures = np.zeros(len(room))
        for _ in range(MOST_PASSES):
            chosen = np.argpartition(urgency, self._rows - 1)[: self._rows]
            chosen.sort()
            self._matrix[:-2] = slopes[chosen].T
            self._matrix[-2], self._matrix[-1] = ~collides[chosen], collides[chosen]
            self._least[:] = -room[chosen]
            self._evaluate()
            values = self._values
            if not np.isfinite(values).all() or (np.abs(values[:-2]) > farthest + ACCURACY).any():
                return None
            left = room + slopes @ values[:-2] + np.where(collides, values[-1], values[-2])
            if left[chosen].min() < -ACCURACY:
                return None
            missed = left < -ACCURACY
            if not missed.any():
                pressures[chosen] = np.abs(self._multipliers)
                return Step(values[:-2].copy(), float(values[-2:].max()), pressures)
            urgency[chosen[np.abs(self._multipliers) > PRESSES]] = -np.inf
            urgency[missed] = -np.inf
        return None
