"""Row constraints on contact forces: torque about the body, friction cones."""

import numpy as np
from casadi import SX, vertcat

from core.arrays import Floats
from core.motion.support_polygon import GRAVITY
from core.robot.model import RobotModel
from solver_jobs.nlp.constraint import Family, RowConstraint, Situation, outside
from solver_jobs.nlp.variables import Symbols, axes_of


class BodyTorque(RowConstraint):
    """No torque about the body's point, (3.15): Σ λ^(i) × (p^(i) − p^(b)) = 0 at every knot but the last.

    The rows are divided by the robot's weight: mm by which the centre of pressure is off.
    """

    family = Family.BODY_TORQUE

    def rows(self, symbols: Symbols, model: RobotModel) -> SX:
        """Three rows an interval, mm."""
        body = symbols.position[0][:, :-1]
        torque = SX.zeros(*body.shape)
        for force, foot in zip(symbols.force, symbols.position[1:], strict=True):
            fx, fy, fz = axes_of(force[:, :-1])
            rx, ry, rz = axes_of(foot[:, :-1] - body)
            torque += vertcat(fy * rz - fz * ry, fz * rx - fx * rz, fx * ry - fy * rx)
        return torque / (model.total_model_mass * GRAVITY)

    def bounds(self, situation: Situation) -> tuple[Floats, Floats]:
        """Equality."""
        return np.zeros(1), np.zeros(1)


class Friction(RowConstraint):
    """Friction cone of every foot: ‖s‖² ≤ μ² for the slopes s = λ_xy/λ_z; λ_z ≥ 0 is a bound.

    With forces as unknowns, ‖λ_xy‖² ≤ μ² λ_z², the cone's tip has no derivative; feet that carry nothing
    stand there, and IPOPT needed 35 to 200 iterations or failed.
    """

    family = Family.FRICTION
    unit = "of the foot's load"
    rows_per_foot = 1

    def rows(self, symbols: Symbols, model: RobotModel) -> SX:
        """A row a foot and interval."""
        return vertcat(*(s[0, :-1] ** 2 + s[1, :-1] ** 2 for s in symbols.slope)) - symbols.friction**2

    def bounds(self, situation: Situation) -> tuple[Floats, Floats]:
        """At most 0 after μ² was taken off."""
        return np.array([-np.inf]), np.zeros(1)

    def excess(self, values: Floats, lower: Floats, upper: Floats) -> Floats:
        """At most so much of the slope is beyond the cone."""
        return np.asarray(np.sqrt(outside(values, lower, upper)))
