"""Row constraints of reach and stability: workspace in its two forms, stability margin."""

from dataclasses import dataclass

import numpy as np
from casadi import SX, sqrt, vertcat

from core.arrays import Floats
from core.motion.support_polygon import GRAVITY
from core.problem.motion_problem import CYLINDER, CylinderWorkspace
from core.robot.model import RobotModel
from solver_jobs.nlp.constraint import Family, RowConstraint, Situation, SquaredRows, outside
from solver_jobs.nlp.leg_equations import VERTICES, Arms, squared_offsets
from solver_jobs.nlp.variables import MM, Symbols

_ROD_SLOPE = 90.0
"""d(d_i + (z + h)²)/dh at the middle of the workspace, mm, to speak of mm of stroke."""


def feet_from_body(symbols: Symbols) -> list[SX]:
    """(3, n) each foot from the body's point in the world's axes, mm."""
    return [foot - symbols.position[0] for foot in symbols.position[1:]]


def turned_with_body(symbols: Symbols, x: float, y: float) -> tuple[SX, SX]:
    """(1, n) world's axes of a horizontal vector that is fixed in the body's frame.

    Distances do not change when both of their ends turn. So feet stay in the world's axes and the module's
    points turn, which keeps x and y of the unknowns apart in second derivatives.
    """
    cosine, sine = symbols.turn
    return cosine * x - sine * y, sine * x + cosine * y


def motor_arms_world(symbols: Symbols, model: RobotModel) -> list[Arms]:
    """For each foot, `leg_equations.motor_arms` in the world's axes, mm."""
    reach = model.leg.reach_radius * MM
    vertices = [
        [R @ np.array([reach * ex, reach * ey, 0.0]) + centre * MM for ex, ey in VERTICES]
        for R, centre in zip(model.R_robot_from_module, model.module_centres_robot, strict=True)
    ]
    found: list[Arms] = []
    for foot, own in zip(feet_from_body(symbols), vertices, strict=True):
        anchors = [turned_with_body(symbols, float(v[0]), float(v[1])) for v in own]
        found.append([(foot[0, :] - x, foot[1, :] - y) for x, y in anchors])
    return found


@dataclass(frozen=True)
class CylinderDisc(SquaredRows):
    """Horizontal part of the cylinder, (3.16): squared distance to the module's centre ≤ radius²."""

    cylinder: CylinderWorkspace = CYLINDER
    family = Family.WORKSPACE
    per_unit = 27.0
    rows_per_foot = 1

    def rows(self, symbols: Symbols, model: RobotModel) -> SX:
        """A row a foot and knot, mm²."""
        rows = []
        for foot, centre in zip(feet_from_body(symbols), model.module_centres_robot * MM, strict=True):
            x, y = turned_with_body(symbols, float(centre[0]), float(centre[1]))
            rows.append((foot[0, :] - x) ** 2 + (foot[1, :] - y) ** 2)
        return vertcat(*rows)

    def bounds(self, situation: Situation) -> tuple[Floats, Floats]:
        """At most the radius squared."""
        return np.array([-np.inf]), np.array([(self.cylinder.radius * MM) ** 2])


@dataclass(frozen=True)
class CylinderHeight(RowConstraint):
    """Vertical part of the cylinder, P (13) and (14): −below ≤ z + depth ≤ above under the plane."""

    cylinder: CylinderWorkspace = CYLINDER
    family = Family.WORKSPACE
    rows_per_foot = 1

    def rows(self, symbols: Symbols, model: RobotModel) -> SX:
        """A row a foot and knot, mm."""
        return vertcat(*(foot[2, :] + model.com_height * MM for foot in feet_from_body(symbols)))

    def bounds(self, situation: Situation) -> tuple[Floats, Floats]:
        """Floor and lid under the actuator plane."""
        middle = -self.cylinder.depth
        low, high = middle - self.cylinder.below, middle + self.cylinder.above
        return np.array([low * MM]), np.array([high * MM])


class _StrokeRows(RowConstraint):
    """Rows of d_i + (z + h)² − l², 0 where motor i has the stroke h."""

    family = Family.WORKSPACE
    per_unit = _ROD_SLOPE
    rows_per_foot = 3

    def excess(self, values: Floats, lower: Floats, upper: Floats) -> Floats:
        """About how far the motor is out of its stroke, mm."""
        return outside(values, lower, upper) / _ROD_SLOPE


class StrokeUpper(_StrokeRows):
    """No motor beyond its upper stroke: d_i + (z + upper)² ≤ l², the form of h_i ≤ upper without a root."""

    def rows(self, symbols: Symbols, model: RobotModel) -> SX:
        """Three rows a foot and knot, mm²."""
        return _stroke_rows(symbols, model, model.stroke.upper)

    def bounds(self, situation: Situation) -> tuple[Floats, Floats]:
        """At most 0 after l² was taken off."""
        return np.array([-np.inf]), np.zeros(1)


class StrokeLower(_StrokeRows):
    """No motor below its lower stroke: d_i + (z + lower)² ≥ l², the form of h_i ≥ lower without a root."""

    def rows(self, symbols: Symbols, model: RobotModel) -> SX:
        """Three rows a foot and knot, mm²."""
        return _stroke_rows(symbols, model, model.stroke.lower)

    def bounds(self, situation: Situation) -> tuple[Floats, Floats]:
        """At least 0 after l² was taken off."""
        return np.zeros(1), np.array([np.inf])


def _stroke_rows(symbols: Symbols, model: RobotModel, stroke: float) -> SX:
    rows: list[SX] = []
    for foot, arms in zip(feet_from_body(symbols), motor_arms_world(symbols, model), strict=True):
        depth = foot[2, :] + (model.com_height + stroke) * MM
        height = depth**2 - (model.leg.link_length * MM) ** 2
        rows.extend(offset + height for offset in squared_offsets(arms))
    return vertcat(*rows)


class StabilityMargin(RowConstraint):
    """Centre of pressure inside every edge of the support polygon by the margin.

    The centre of pressure is that of flat ground at z = 0, `core.motion.support_polygon.centre_of_pressure`,
    with the forces of the balance in it: p_b,xy − p_b,z · Σ λ_xy / Σ λ_z. For the edge from a standing foot i
    to the next one round the ring, with its inward normal n, the row is
    n·(p_b,xy Σ λ_z − p_b,z Σ λ_xy) − (n·p_i + margin) Σ λ_z ≥ 0, divided by the robot's weight, mm.
    Which foot comes next is a parameter, and rows of swinging feet are unbounded, so that the structure does
    not know the timeline.
    """

    family = Family.MARGIN
    rows_per_foot = 1

    def rows(self, symbols: Symbols, model: RobotModel) -> SX:
        """A row a foot and interval, mm."""
        feet = [(p[0, :-1], p[1, :-1]) for p in symbols.position[1:]]
        body = symbols.position[0][:, :-1]
        force = sum((f[:, :-1] for f in symbols.force), SX(0)) / (model.total_model_mass * GRAVITY)
        moment_x = body[0, :] * force[2, :] - body[2, :] * force[0, :]
        moment_y = body[1, :] * force[2, :] - body[2, :] * force[1, :]
        rows: list[SX] = []
        for (x, y), successor in zip(feet, symbols.successor, strict=True):
            ahead = successor[:, :-1]
            edge_x = sum((ahead[j, :] * other[0] for j, other in enumerate(feet)), -x)
            edge_y = sum((ahead[j, :] * other[1] for j, other in enumerate(feet)), -y)
            lever = edge_x * (moment_y - y * force[2, :]) - edge_y * (moment_x - x * force[2, :])
            rows.append(lever / sqrt(edge_x**2 + edge_y**2) - symbols.margin * force[2, :])
        return vertcat(*rows)

    def bounds(self, situation: Situation) -> tuple[Floats, Floats]:
        """At least 0 where the edge's first foot stands."""
        return np.where(situation.contact[:-1], 0.0, -np.inf), np.array([np.inf])
