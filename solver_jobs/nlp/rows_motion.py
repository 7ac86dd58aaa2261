"""Row constraints of the motion itself: integration, balance of forces, speeds, closed cycles."""

import numpy as np
from casadi import SX, repmat, vertcat

from core.arrays import Floats
from core.motion.support_polygon import GRAVITY
from core.robot.model import RobotModel
from solver_jobs.nlp.constraint import Family, RowConstraint, Situation, SquaredRows
from solver_jobs.nlp.variables import MM, Symbols, axes_of, change_between_knots, per_interval


class Integration(RowConstraint):
    """Exact double integrator, accelerations constant between knots, (3.7).

    p_{k+1} = p_k + dt·(v_k + v_{k+1})/2; the acceleration a_k = (v_{k+1} − v_k)/dt is no unknown.
    """

    family = Family.DYNAMICS

    def rows(self, symbols: Symbols, model: RobotModel) -> SX:
        """Three rows a point and interval, mm."""
        rows = []
        for p, v in zip(symbols.position, symbols.velocity, strict=True):
            mean = (v[:, :-1] + v[:, 1:]) / 2
            rows.append(p[:, 1:] - p[:, :-1] - repmat(symbols.intervals, 3, 1) * mean)
        return vertcat(*rows)

    def bounds(self, situation: Situation) -> tuple[Floats, Floats]:
        """Equality."""
        return np.zeros(1), np.zeros(1)


class ForceBalance(RowConstraint):
    """The sum of (3.2) over body and feet, internal forces gone: Σ m_i (a_i + g) = Σ λ_i."""

    family = Family.DYNAMICS
    unit = "N"

    def rows(self, symbols: Symbols, model: RobotModel) -> SX:
        """Three rows an interval, N."""
        change = model.masses.body * change_between_knots(symbols.velocity[0])
        for velocity in symbols.velocity[1:]:
            change += model.masses.foot * change_between_knots(velocity)
        contact = symbols.force[0]
        for force in symbols.force[1:]:
            contact = contact + force
        return per_interval(change, symbols) / MM - contact[:, :-1]

    def bounds(self, situation: Situation) -> tuple[Floats, Floats]:
        """Equality to minus the weight."""
        weight = np.array([0.0, 0.0, situation.problem.model.total_model_mass * GRAVITY])
        return -weight, -weight


class ClosedCycle(RowConstraint):
    """The last knot is the first, moved on: x_N − x_1 = x_g − x_ic, the velocities equal."""

    family = Family.BOUNDARY

    def rows(self, symbols: Symbols, model: RobotModel) -> SX:
        """Positions and velocities of the last knot less those of the first, one column."""
        parts = (*symbols.position, *symbols.velocity)
        return vertcat(*(part[:, -1] - part[:, 0] for part in parts))

    def bounds(self, situation: Situation) -> tuple[Floats, Floats]:
        """Equality to the way from start to goal."""
        start, goal = situation.problem.start, situation.problem.goal
        ways = np.concatenate(
            [(goal.body_world - start.body_world)[None], goal.feet_world - start.feet_world]
        )
        values = np.concatenate([ways.reshape(-1) * MM, np.zeros(ways.size)])
        return values, values


class FootSpeed(SquaredRows):
    """Speed of every foot, (3.10), squared: ‖v‖² ≤ v_max²."""

    family = Family.FOOT_SPEED
    unit = "mm/s"
    per_unit = 30.0
    rows_per_foot = 1

    def rows(self, symbols: Symbols, model: RobotModel) -> SX:
        """A row a foot and knot, mm²/s²."""
        return vertcat(*(_squared(velocity) for velocity in symbols.velocity[1:]))

    def bounds(self, situation: Situation) -> tuple[Floats, Floats]:
        """At most the limit squared."""
        return _squared_limit(situation.problem.limits.foot_speed)


class BodySpeed(SquaredRows):
    """Speed of the body, squared; without it the optimum throws the body about."""

    family = Family.BODY_SPEED
    unit = "mm/s"
    per_unit = 30.0

    def rows(self, symbols: Symbols, model: RobotModel) -> SX:
        """A row a knot, mm²/s²."""
        return _squared(symbols.velocity[0])

    def bounds(self, situation: Situation) -> tuple[Floats, Floats]:
        """At most the limit squared."""
        return _squared_limit(situation.problem.limits.body_speed)


def _squared(vectors: SX) -> SX:
    x, y, z = axes_of(vectors)
    return x**2 + y**2 + z**2


def _squared_limit(speed: float) -> tuple[Floats, Floats]:
    return np.array([-np.inf]), np.array([(speed * MM) ** 2])
