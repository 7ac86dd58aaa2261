"""Where each foot can be while a plan goes on, for the page to draw on demand."""

from typing import Any

import numpy as np

from core.motion.trajectory import Trajectory
from core.problem.motion_problem import Workspace
from core.problem.workspace_outline import reach_radii
from core.robot.model import RobotModel

LAYERS = (0.0, 0.006, 0.012)
"""How high a foot is lifted where its reach is outlined, m."""

RAYS = 18
"""Corners of an outline."""


def reach_table(model: RobotModel, trajectory: Trajectory, workspace: Workspace) -> dict[str, Any]:
    """Outlines of a leg's reach at each knot's body height, as JSON values (m, rad).

    Keys: layers, sole (depth below the platform), planes (n) height of the actuator plane, radii (n, layers,
    rays) from the module's axis, and what puts them into the robot's frame: azimuths, radius, colours.
    """
    planes = trajectory.body_world[:, 2] - model.com_height
    heights = np.array(LAYERS) - planes[:, None]
    colours = [[int(colour[at : at + 2], 16) for at in (1, 3, 5)] for colour in model.colours]
    return {
        "layers": list(LAYERS),
        "sole": model.sole_depth,
        "planes": np.round(planes, 6).tolist(),
        "radii": np.round(reach_radii(model, workspace, heights, RAYS), 5).tolist(),
        "azimuths": model.azimuths.tolist(),
        "radius": model.radius,
        "colours": colours,
    }
