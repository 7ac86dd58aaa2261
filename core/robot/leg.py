"""Forward and inverse kinematics of one linear-delta leg in its module's frame.

Every function is pure and works over any leading axes. Thesis 2.3.1, with two corrections: the square root
of (2.6) is over l² − d_i, and motor 1 stands at −y.
"""

import numpy as np

from core.arrays import Floats
from core.robot.model import LegGeometry


def vertex_directions() -> Floats:
    """(3, 2) unit vectors to the three motors of a module, (2.2) to (2.4): motor 1 inwards, then turning."""
    half, root = 0.5, np.sqrt(3.0) / 2
    return np.array([[0.0, -1.0], [root, half], [-root, half]])


def squared_offsets(leg: LegGeometry, foot_module: Floats) -> Floats:
    """d_i of (2.5): squared horizontal distance between platform vertex and base vertex.

    Args:
        leg: geometry.
        foot_module: (..., 3) platform centre in the module's frame, m.

    Returns:
        (..., 3) m².
    """
    centres = leg.reach_radius * vertex_directions()
    return np.asarray(((foot_module[..., None, :2] - centres) ** 2).sum(axis=-1))


def strokes_from_foot(leg: LegGeometry, foot_module: Floats) -> Floats:
    """Inverse kinematics of one leg, h_i = −(z + √(l² − d_i)), without limits on h.

    Args:
        leg: geometry.
        foot_module: (..., 3) platform centre in the module's frame, m.

    Returns:
        (..., 3) strokes, m; nan where no rod is long enough.
    """
    below = leg.link_length**2 - squared_offsets(leg, foot_module)
    depth = np.sqrt(np.where(below >= 0, below, np.nan))
    return np.asarray(-(foot_module[..., 2:3] + depth))


def stroke_rates(leg: LegGeometry, foot_module: Floats, velocity_module: Floats) -> Floats:
    """Time derivative of the inverse kinematics: ḣ_i = −ż + (ρ − u_t e_i)·ρ̇ / √(l² − d_i), ρ = (x, y).

    Args:
        leg: geometry.
        foot_module: (..., 3) platform centre in the module's frame, m.
        velocity_module: (..., 3) its velocity there, m/s.

    Returns:
        (..., 3) m/s; nan where no rod is long enough.
    """
    arms = foot_module[..., None, :2] - leg.reach_radius * vertex_directions()
    below = leg.link_length**2 - squared_offsets(leg, foot_module)
    depth = np.sqrt(np.where(below > 0, below, np.nan))
    along = (arms * velocity_module[..., None, :2]).sum(axis=-1)
    return np.asarray(along / depth - velocity_module[..., 2:3])


def foot_from_strokes(leg: LegGeometry, strokes: Floats) -> Floats:
    """Forward kinematics of one leg: the lower intersection of three spheres, (2.8) to (2.19).

    The spheres' centres are c_i = (u_t·e_i, −h_i). Two differences of the sphere equations give the
    horizontal position as an affine function of z, (2.17) and (2.18); the third gives a quadratic in z.

    Args:
        leg: geometry.
        strokes: (..., 3) m.

    Returns:
        (..., 3) platform centre in the module's frame, m; nan where the spheres do not meet.
    """
    height = -np.asarray(strokes, dtype=np.float64)
    along_y = -(height[..., 1:].sum(axis=-1) - 2 * height[..., 0]) / (3 * leg.reach_radius)
    along_x = -(height[..., 1] - height[..., 2]) / (np.sqrt(3.0) * leg.reach_radius)
    squares = height**2
    start_y = (squares[..., 1:].sum(axis=-1) - 2 * squares[..., 0]) / (6 * leg.reach_radius)
    start_x = (squares[..., 1] - squares[..., 2]) / (2 * np.sqrt(3.0) * leg.reach_radius)
    offset_y = start_y + leg.reach_radius
    quadratic = along_x**2 + along_y**2 + 1
    half_linear = along_x * start_x + along_y * offset_y - height[..., 0]
    constant = start_x**2 + offset_y**2 + squares[..., 0] - leg.link_length**2
    discriminant = half_linear**2 - quadratic * constant
    root = np.sqrt(np.where(discriminant >= 0, discriminant, np.nan))
    z = (-half_linear - root) / quadratic
    return np.stack([along_x * z + start_x, along_y * z + start_y, z], axis=-1)


def foot_jacobian(leg: LegGeometry, strokes: Floats) -> Floats:
    """∂foot/∂strokes of one leg: with rods r_i = foot − c_i, r_iᵀ ∂foot = −r_{i,z} ∂h_i.

    Args:
        leg: geometry.
        strokes: (..., 3) m.

    Returns:
        (..., 3, 3) dimensionless.
    """
    foot = foot_from_strokes(leg, strokes)
    centres = np.broadcast_to(leg.reach_radius * vertex_directions(), (*strokes.shape, 2))
    rods = foot[..., None, :] - np.concatenate([centres, -strokes[..., None]], axis=-1)
    right = np.zeros_like(rods)
    index = np.arange(3)
    right[..., index, index] = -rods[..., 2]
    return np.asarray(np.linalg.solve(rods, right))
