"""Outlines of a leg's workspace at a height, for drawing."""

import numpy as np

from core.arrays import Floats
from core.problem.motion_problem import CYLINDER, Workspace
from core.robot.leg import vertex_directions
from core.robot.model import RobotModel


def reach_radii(model: RobotModel, workspace: Workspace, heights: Floats, rays: int) -> Floats:
    """Distance from a module's axis to the edge of its workspace along evenly spread rays.

    A point ρ at height z is within every motor's stroke where, for each base vertex c_i,
    l² − (z + lower)² ≤ ‖ρ − c_i‖² ≤ l² − (z + upper)²: inside three discs and outside three smaller ones.

    Args:
        model: the robot.
        workspace: every motor within its stroke, or the paper's cylinder.
        heights: (...) m above the actuator plane, below 0.
        rays: how many; the first along x of the module's frame, then turning towards y.

    Returns:
        (..., rays) m; 0 where the axis itself is out of reach at that height.
    """
    z = np.asarray(heights, dtype=np.float64)[..., None]
    if workspace is Workspace.CYLINDER:
        above = z + CYLINDER.depth
        within = (above >= -CYLINDER.below) & (above <= CYLINDER.above)
        return np.where(within, CYLINDER.radius, 0.0) * np.ones(rays)
    angles = 2 * np.pi * np.arange(rays) / rays
    directions = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    # (rays, 3) how far each vertex lies along each ray; all are `offset` from the axis.
    offset = model.leg.reach_radius
    along = directions @ (offset * vertex_directions()).T
    retracted = _disc(model, z, model.stroke.upper)
    extended = _disc(model, z, model.stroke.lower)
    beyond = along**2 - offset**2
    leaves_outer = along + np.sqrt(np.maximum(retracted[..., None] + beyond, 0.0))
    meets_inner = extended[..., None] + beyond >= 0
    enters_inner = along - np.sqrt(np.maximum(extended[..., None] + beyond, 0.0))
    enters_inner = np.where(meets_inner & (enters_inner > 0), enters_inner, np.inf)
    radii = np.minimum(leaves_outer, enters_inner).min(axis=-1)
    return np.where((offset**2 <= retracted) & (offset**2 >= extended), radii, 0.0)


def _disc(model: RobotModel, z: Floats, stroke: float) -> Floats:
    """Squared radius of the disc at height z whose points have a motor at a stroke, m²."""
    return np.asarray(model.leg.link_length**2 - (z + stroke) ** 2)
