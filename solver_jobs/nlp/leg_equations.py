"""The leg's kinematics in CasADi: the same equations as `core.robot.leg`, to which a test ties them.

Every function takes a foot or strokes as a list of three expressions of equal shape, so that one call covers
all knots. Units are the caller's (m or mm), the same throughout.
"""

import math
from collections.abc import Sequence

from casadi import SX, sqrt

VERTICES = ((0.0, -1.0), (math.sqrt(3.0) / 2, 0.5), (-math.sqrt(3.0) / 2, 0.5))
"""Unit vectors to the three motors of a module, (2.2) to (2.4)."""


Arms = Sequence[tuple[SX, SX]]
"""Three horizontal vectors, one a motor: what the platform's vertex is off the base's vertex by."""


def motor_arms(reach_radius: float, foot_module: Sequence[SX]) -> Arms:
    """ρ − u_t e_i, horizontally from the base's vertex to the platform's, in the module's axes."""
    x, y, _ = foot_module
    return [(x - reach_radius * ex, y - reach_radius * ey) for ex, ey in VERTICES]


def squared_offsets(arms: Arms) -> list[SX]:
    """d_i of (2.5), the squared horizontal distance between platform vertex and base vertex."""
    return [x**2 + y**2 for x, y in arms]


def stroke_rates(link_length: float, arms: Arms, velocity: Sequence[SX]) -> list[SX]:
    """Derivative of the inverse kinematics, ḣ_i = (ρ − u_t e_i)·ρ̇ / √(l² − d_i) − ż.

    Args:
        link_length: l.
        arms: ρ − u_t e_i.
        velocity: of the foot as seen from the module, in the arms' axes.
    """
    depths = [sqrt(link_length**2 - d) for d in squared_offsets(arms)]
    along = [x * velocity[0] + y * velocity[1] for x, y in arms]
    return [way / depth - velocity[2] for way, depth in zip(along, depths, strict=True)]


def strokes_from_foot(reach_radius: float, link_length: float, foot_module: Sequence[SX]) -> list[SX]:
    """Inverse kinematics, h_i = −(z + √(l² − d_i)), (2.6) corrected."""
    offsets = squared_offsets(motor_arms(reach_radius, foot_module))
    return [-(foot_module[2] + sqrt(link_length**2 - d)) for d in offsets]


def foot_from_strokes(reach_radius: float, link_length: float, strokes: Sequence[SX]) -> list[SX]:
    """Forward kinematics: the lower meeting of three spheres, (2.8) to (2.19) with b_1's sign corrected."""
    first, second, third = (-h for h in strokes)
    slope_x = -(second - third) / (math.sqrt(3.0) * reach_radius)
    slope_y = -(second + third - 2 * first) / (3 * reach_radius)
    start_x = (second**2 - third**2) / (2 * math.sqrt(3.0) * reach_radius)
    start_y = (second**2 + third**2 - 2 * first**2) / (6 * reach_radius)
    quadratic = slope_x**2 + slope_y**2 + 1
    half_linear = slope_x * start_x + slope_y * (start_y + reach_radius) - first
    constant = start_x**2 + (start_y + reach_radius) ** 2 + first**2 - link_length**2
    z = (-half_linear - sqrt(half_linear**2 - quadratic * constant)) / quadratic
    return [slope_x * z + start_x, slope_y * z + start_y, z]
