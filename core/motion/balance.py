"""Balance of a motion: the point that it is judged by, and its distance to the support polygon's edge."""

import numpy as np

from core.arrays import Floats
from core.findings import TOLERANCE
from core.motion.support_polygon import stability_margins, trajectory_pressure
from core.motion.trajectory import Trajectory
from core.robot.model import RobotModel

BALANCE_RESERVE = 0.001
"""Below this distance to the polygon's edge the check warns, m."""
STANDING_DEPTH = 0.0005
"""Feet within this of the deepest one are taken to stand where only waypoints are known, m."""


def balance_margins(model: RobotModel, t: Trajectory) -> tuple[Floats, str]:
    """(n,) distance of the point that balance is judged by to the support polygon's edge, m; and its name."""
    pressure = pressure_points(model, t)
    if pressure is None:
        return stability_margins(t.body_world[:, :2], t.feet_world, t.contact), "centre of mass"
    return stability_margins(pressure, t.feet_world, t.contact), "centre of pressure"


def pressure_points(model: RobotModel, t: Trajectory) -> Floats | None:
    """(n, 2) centre of pressure from each knot on, m; None for a motion whose accelerations are unknown.

    At the last knot, where the robot stands, it is under the centre of mass.
    """
    if not _moves_as_planned(t):
        return None
    return np.concatenate([trajectory_pressure(model, t), t.body_world[-1:, :2]])


def _moves_as_planned(t: Trajectory) -> bool:
    """Whether velocities are those of constant accelerations between knots."""
    if t.body_velocity is None or t.feet_velocity is None:
        return False
    half = np.diff(t.times)[:, None] / 2
    body_gap = np.diff(t.body_world, axis=0) - half * (t.body_velocity[1:] + t.body_velocity[:-1])
    feet_gap = np.diff(t.feet_world, axis=0) - half[..., None] * (t.feet_velocity[1:] + t.feet_velocity[:-1])
    return max(float(np.abs(body_gap).max()), float(np.abs(feet_gap).max())) <= TOLERANCE
