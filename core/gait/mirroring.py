"""Which foot is each foot's mirror image about the gait's heading."""

import numpy as np

from core.arrays import Floats
from core.gait.gait import Gait, heading_angle
from core.robot.model import RobotModel

SAME = 1e-6
"""Azimuths nearer to each other than this are the same, rad."""


def mirrored_feet(azimuths: Floats, heading: float) -> tuple[int, ...] | None:
    """Each foot's counterpart on the other side of the heading: ψ′ = 2θ − ψ.

    Args:
        azimuths: (legs,) ψ of each module, rad.
        heading: θ, rad.

    Returns:
        A foot a foot, 0-based (itself where it stands on the heading); None where the ring is not its own
        mirror image about it.
    """
    apart = np.mod(2 * heading - azimuths[:, None] - azimuths[None, :] + np.pi, 2 * np.pi) - np.pi
    nearest = np.argmin(np.abs(apart), axis=1)
    if np.abs(apart).min(axis=1).max() > SAME:
        return None
    return tuple(int(foot) for foot in nearest)


def mirror_of(gait: Gait, model: RobotModel) -> tuple[int, ...] | None:
    """The same for a gait and its robot (see `mirrored_feet`)."""
    return mirrored_feet(model.azimuths, heading_angle(gait.orientation) + gait.quarter_turns * np.pi / 2)
