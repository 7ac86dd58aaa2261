"""Joint values of the drawn robot, whose rods close every leg's chain.

A leg's tree hangs in two branches from the body: motor slider → knee → rods, and three sliders → foot. The
rods' far ends lie on the foot's platform for the right angles only; this is where those angles come from.
Names of links and joints are those of the URDF files in `robot_description`.
"""

import numpy as np

from core.arrays import Floats
from core.robot.leg import vertex_directions
from core.robot.model import LegGeometry, RobotModel

BODY = "body"
"""Link that carries everything else."""

TWINS = ("a", "b")
"""Names of the two parallel rods of an arm: a at −y, b at +y of its knee."""


def knee_link(leg: int, motor: int) -> str:
    """Name of the link that motor `motor` of leg `leg` moves (both 0-based; names count from 1)."""
    return f"leg{leg + 1}_knee{motor + 1}"


def rod_link(leg: int, motor: int, twin: str) -> str:
    """Name of one of the two rods below a knee."""
    return f"leg{leg + 1}_rod{motor + 1}{twin}"


def foot_link(leg: int) -> str:
    """Name of a foot's link, whose origin is the platform's centre."""
    return f"leg{leg + 1}_foot"


def motor_joint(leg: int, motor: int) -> str:
    """Name of a motor's slider; its value is the stroke, m."""
    return f"leg{leg + 1}_motor{motor + 1}"


def rod_joints(leg: int, motor: int, twin: str) -> tuple[str, str]:
    """Names of a rod's two hinges in order: lean about the knee's y, then sway about the turned x; rad."""
    return f"leg{leg + 1}_lean{motor + 1}{twin}", f"leg{leg + 1}_sway{motor + 1}{twin}"


def foot_joints(leg: int) -> tuple[str, str, str]:
    """Names of the sliders that place a foot in its module's frame, m."""
    return f"leg{leg + 1}_foot_x", f"leg{leg + 1}_foot_y", f"leg{leg + 1}_foot_z"


def knee_yaws() -> Floats:
    """(3,) angle of each knee's x axis, which points away from the module's centre, in the module, rad."""
    directions = vertex_directions()
    return np.asarray(np.arctan2(directions[:, 1], directions[:, 0]))


def rod_angles(leg: LegGeometry, strokes: Floats, feet_module: Floats) -> Floats:
    """Lean α and sway β of each arm's rods in its knee's frame.

    A rod hangs along −z of its own frame, so in the knee's frame (x outwards, y tangential, z up)
    R_y(α) R_x(β) (0, 0, −1) = (−sin α cos β, sin β, −cos α cos β) is the unit vector from knee to platform.

    Args:
        leg: geometry.
        strokes: (..., 3) m.
        feet_module: (..., 3) platform centre in the module's frame, m.

    Returns:
        (..., 3, 2) α and β, rad; arm by arm.
    """
    outwards = vertex_directions()
    tangential = np.stack([-outwards[:, 1], outwards[:, 0]], axis=-1)
    across = feet_module[..., None, :2] - leg.reach_radius * outwards
    along_x = (across * outwards).sum(axis=-1)
    along_y = (across * tangential).sum(axis=-1)
    along_z = feet_module[..., 2:3] + strokes
    lean = np.arctan2(-along_x, -along_z)
    sway = np.arctan2(along_y, np.hypot(along_x, along_z))
    return np.stack([lean, sway], axis=-1)


def joint_values(model: RobotModel, strokes: Floats, feet_module: Floats) -> dict[str, Floats]:
    """Value of every joint of the robot's URDF.

    Args:
        model: the robot.
        strokes: (n, legs, 3) m.
        feet_module: (n, legs, 3) platform centres in their modules' frames, m.

    Returns:
        Joint name to (n,) values: m for sliders, rad for hinges.
    """
    angles = rod_angles(model.leg, strokes, feet_module)
    values: dict[str, Floats] = {}
    for leg in range(model.leg_count):
        for motor in range(3):
            values[motor_joint(leg, motor)] = strokes[:, leg, motor]
            for twin in TWINS:
                lean, sway = rod_joints(leg, motor, twin)
                values[lean] = angles[:, leg, motor, 0]
                values[sway] = angles[:, leg, motor, 1]
        for axis, name in enumerate(foot_joints(leg)):
            values[name] = feet_module[:, leg, axis]
    return values
