"""Row constraints of shoes: those of neighbouring feet keep clear of each other."""

import numpy as np
from casadi import SX, vertcat

from core.arrays import Floats
from core.robot.model import RobotModel
from core.robot.shoes import least_distance, neighbour_pairs
from solver_jobs.nlp.constraint import Family, RowConstraint, Situation, outside
from solver_jobs.nlp.variables import MM, Symbols


class ShoeDistance(RowConstraint):
    """Neighbouring feet p, q of a robot with shoes: |p_xy − q_xy|² ≥ d², which has no root.

    Other feet stand too far apart for a walking robot to bring them together; the checker looks at every two.
    """

    family = Family.SHOE_DISTANCE
    per_unit = 60.0

    def rows(self, symbols: Symbols, model: RobotModel) -> SX:
        """A row a pair of neighbours and knot, mm²."""
        feet = symbols.position[1:]
        rows: list[SX] = []
        for first, second in neighbour_pairs(model.leg_count).tolist():
            apart = feet[first] - feet[second]
            rows.append(apart[0, :] ** 2 + apart[1, :] ** 2)
        return vertcat(*rows)

    def bounds(self, situation: Situation) -> tuple[Floats, Floats]:
        """At least the distance squared."""
        least = (least_distance(situation.problem.model) or 0.0) * MM
        return np.array([least**2]), np.array([np.inf])

    def excess(self, values: Floats, lower: Floats, upper: Floats) -> Floats:
        """How much nearer than their distance two feet are, mm."""
        return outside(np.sqrt(np.maximum(values, 0.0)), np.sqrt(lower), upper)
