"""Row constraints on the motors: speed and acceleration by the derivative of the inverse kinematics."""

import numpy as np
from casadi import SX, vertcat

from core.arrays import Floats
from core.robot.model import RobotModel
from solver_jobs.nlp.constraint import Family, RowConstraint, Situation
from solver_jobs.nlp.leg_equations import stroke_rates
from solver_jobs.nlp.rows_reach import feet_from_body, motor_arms_world
from solver_jobs.nlp.variables import MM, Symbols, change_between_knots, per_interval


def motor_rates(symbols: Symbols, model: RobotModel) -> SX:
    """(3·legs, n) speed of every motor, mm/s: each foot's velocity as seen from the turning body."""
    rate, body = symbols.heading_rate, symbols.velocity[0]
    rows: list[SX] = []
    arms_of_feet = motor_arms_world(symbols, model)
    feet = feet_from_body(symbols)
    for foot, velocity, arms in zip(feet, symbols.velocity[1:], arms_of_feet, strict=True):
        relative = velocity - body
        seen = [relative[0, :] + rate * foot[1, :], relative[1, :] - rate * foot[0, :], relative[2, :]]
        rows.extend(stroke_rates(model.leg.link_length * MM, arms, seen))
    return vertcat(*rows)


class MotorSpeed(RowConstraint):
    """No motor faster than its limit: |ḣ| ≤ v."""

    family = Family.MOTOR_SPEED
    unit = "mm/s"
    rows_per_foot = 3

    def rows(self, symbols: Symbols, model: RobotModel) -> SX:
        """Three rows a foot and knot, mm/s."""
        return motor_rates(symbols, model)

    def bounds(self, situation: Situation) -> tuple[Floats, Floats]:
        """The limit both ways."""
        return _both_ways(situation.problem.limits.motor_speed)


class MotorAcceleration(RowConstraint):
    """No motor's speed changes faster than its limit from sample to sample: |ḣ_{k+1} − ḣ_k| / dt ≤ a."""

    family = Family.MOTOR_ACCELERATION
    unit = "mm/s²"
    rows_per_foot = 3

    def rows(self, symbols: Symbols, model: RobotModel) -> SX:
        """Three rows a foot and interval, mm/s²."""
        return per_interval(change_between_knots(motor_rates(symbols, model)), symbols)

    def bounds(self, situation: Situation) -> tuple[Floats, Floats]:
        """The limit both ways."""
        return _both_ways(situation.problem.limits.motor_acceleration)


def _both_ways(limit: float | None) -> tuple[Floats, Floats]:
    reach = np.array([np.inf if limit is None else limit * MM])
    return -reach, reach
