"""The robot's URDF as text: a tree of links that looks closed when its joints have the right values.

`core.robot.closed_chain.joint_values` gives those values.
"""

from collections.abc import Sequence
from xml.etree import ElementTree

import numpy as np

from core.arrays import Floats
from core.robot.closed_chain import (
    BODY,
    TWINS,
    foot_joints,
    foot_link,
    knee_link,
    motor_joint,
    rod_joints,
    rod_link,
)
from core.robot.model import FootEnd, RobotModel
from robot_description.drive import actuator_places, actuator_yaws, motor_places, motor_yaws, yoke

PAINT = {
    "plate": "#e4eaf26e",
    "plate_rim": "#c3ccd9",
    "board": "#2f7d55",
    "board_parts": "#2b3440",
    "motor": "#8d99a8",
    "knee": "#566273",
}
"""Colour of each part but rods and feet, which the model has; frames are clear acrylic (thesis 2.1.1)."""

PLATE_PARTS = ("plate", "plate_rim")

Element = ElementTree.Element
Place = Sequence[float] | Floats


def urdf_text(model: RobotModel) -> str:
    """The whole file, the same for the same model.

    Args:
        model: the robot.

    Returns:
        URDF with mesh paths relative to the file.
    """
    robot = Element("robot", name=model.name)
    robot.append(ElementTree.Comment(f" Made by robot_description.builder; edit {model.name}.toml. "))
    _add_body(robot, model)
    for leg in range(model.leg_count):
        for motor in range(3):
            _add_arm(robot, model, leg, motor)
        _add_foot(robot, model, leg)
    ElementTree.indent(robot)
    return ElementTree.tostring(robot, encoding="unicode") + "\n"


def module_yaw(model: RobotModel, leg: int) -> float:
    """Turn of a module's frame in the robot's, rad."""
    return float(model.azimuths[leg] - np.pi / 2)


def plate_mesh(model: RobotModel, part: str) -> str:
    """Name of a plate's mesh: the one part whose size differs between the robots."""
    return f"{part}_{model.name}"


def foot_mesh(model: RobotModel) -> str:
    """Name of the mesh of platform and foot, by what the leg ends in."""
    end = model.shape.foot_end
    return "foot" if end is FootEnd.SHOE else f"foot_{end}"


def _add_body(robot: Element, model: RobotModel) -> None:
    shape = model.shape
    body = ElementTree.SubElement(robot, "link", name=BODY)
    for height in (shape.lower_plate_height, shape.upper_plate_height):
        for part in PLATE_PARTS:
            _add_visual(body, plate_mesh(model, part), PAINT[part], (0, 0, height))
    for part in ("board", "board_parts"):
        _add_visual(body, part, PAINT[part], (0, 0, shape.board_height))
    for place, yaw in zip(actuator_places(model), actuator_yaws(model), strict=True):
        _add_visual(body, "motor", PAINT["motor"], place, float(yaw))


def _add_knee(robot: Element, model: RobotModel, leg: int, motor: int) -> None:
    """A knee with its shaft, or on the yoke of the actuator that it shares."""
    knee = ElementTree.SubElement(robot, "link", name=knee_link(leg, motor))
    arm, paint = yoke(model, 3 * leg + motor), PAINT["knee"]
    if arm is None:
        _add_visual(knee, "knee", paint)
        return
    _add_visual(knee, "knee_bar", paint)
    _add_visual(knee, arm.mesh, paint, (0, 0, 0), arm.yaw)
    if arm.carries_shaft:
        _add_visual(knee, "shaft", paint, arm.end)


def _add_arm(robot: Element, model: RobotModel, leg: int, motor: int) -> None:
    knee, index = knee_link(leg, motor), 3 * leg + motor
    _add_knee(robot, model, leg, motor)
    place, yaw = motor_places(model)[index], float(motor_yaws(model)[index])
    slider = _add_joint(robot, motor_joint(leg, motor), "prismatic", BODY, knee, place, yaw)
    _add_limit(slider, (0, 0, -1), 0, model.stroke.travel, model.stroke.speed)
    for twin, side in zip(TWINS, (-0.5, 0.5), strict=True):
        lean_joint, sway_joint = rod_joints(leg, motor, twin)
        rod = rod_link(leg, motor, twin)
        hinge = f"{rod}_hinge"
        ElementTree.SubElement(robot, "link", name=hinge)
        _add_visual(ElementTree.SubElement(robot, "link", name=rod), "rod", model.shape.rod_colour)
        at = (0, side * model.shape.rod_spacing, 0)
        lean = _add_joint(robot, lean_joint, "revolute", knee, hinge, at)
        _add_limit(lean, (0, 1, 0), -np.pi / 2, np.pi / 2, np.pi)
        sway = _add_joint(robot, sway_joint, "revolute", hinge, rod)
        _add_limit(sway, (1, 0, 0), -np.pi / 2, np.pi / 2, np.pi)


def _add_foot(robot: Element, model: RobotModel, leg: int) -> None:
    foot, length = foot_link(leg), model.leg.link_length
    names = foot_joints(leg)
    links = [BODY, f"{names[0]}_slide", f"{names[1]}_slide", foot]
    x, y, _ = model.module_centres_robot[leg]
    for axis, name in enumerate(names):
        link = ElementTree.SubElement(robot, "link", name=links[axis + 1])
        if axis == 2:
            _add_visual(link, foot_mesh(model), model.colours[leg])
        at, yaw = ((float(x), float(y), 0.0), module_yaw(model, leg)) if axis == 0 else ((0, 0, 0), 0.0)
        joint = _add_joint(robot, name, "prismatic", links[axis], links[axis + 1], at, yaw)
        low, high = (-length - model.stroke.travel, 0) if axis == 2 else (-length, length)
        direction = [0, 0, 0]
        direction[axis] = 1
        _add_limit(joint, direction, low, high, model.stroke.speed)


def _add_visual(link: Element, mesh: str, colour: str, at: Place = (0, 0, 0), yaw: float = 0.0) -> None:
    visual = ElementTree.SubElement(link, "visual")
    ElementTree.SubElement(visual, "origin", xyz=_numbers(at), rpy=_numbers((0, 0, yaw)))
    geometry = ElementTree.SubElement(visual, "geometry")
    ElementTree.SubElement(geometry, "mesh", filename=f"meshes/{mesh}.stl")
    material = ElementTree.SubElement(visual, "material", name=colour)
    channels = [int(colour[i : i + 2], 16) / 255 for i in range(1, len(colour), 2)]
    ElementTree.SubElement(material, "color", rgba=_numbers([*channels, 1.0][:4]))


def _add_joint(
    robot: Element,
    name: str,
    kind: str,
    parent: str,
    child: str,
    at: Place = (0, 0, 0),
    yaw: float = 0.0,
) -> Element:
    joint = ElementTree.SubElement(robot, "joint", name=name, type=kind)
    ElementTree.SubElement(joint, "parent", link=parent)
    ElementTree.SubElement(joint, "child", link=child)
    ElementTree.SubElement(joint, "origin", xyz=_numbers(at), rpy=_numbers((0, 0, yaw)))
    return joint


def _add_limit(joint: Element, axis: Sequence[float], lower: float, upper: float, speed: float) -> None:
    ElementTree.SubElement(joint, "axis", xyz=_numbers(axis))
    ElementTree.SubElement(
        joint, "limit", lower=_number(lower), upper=_number(upper), effort="1", velocity=_number(speed)
    )


def _numbers(values: Place) -> str:
    return " ".join(_number(value) for value in values)


def _number(value: float) -> str:
    # Twelve decimals: a picometre, and no rounding noise of one machine or another.
    text = f"{float(value):.12f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text
