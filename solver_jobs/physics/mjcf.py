"""The robot as MJCF text, out of the same parameters as its URDF; frames are the plan's.

Each motor is a slide from the body to its knee, each foot three slides from the body to its platform, which
keeps the body's attitude as a delta's does. A leg's chains are closed by keeping each arm's length: the
distance from knee to platform vertex, one constraint for both rods of its parallelogram. The plan's z = 0 is
the platform height of a standing foot, so the floor lies `sole_depth` lower.
"""

from collections.abc import Iterable
from xml.etree import ElementTree

import numpy as np

from core.arrays import Floats
from core.physics.masses import part_masses
from core.physics.motors import motor_force_limits
from core.physics.parameters import PhysicsSet
from core.physics.problem import Rig
from core.robot.closed_chain import BODY, foot_joints, foot_link, knee_link, motor_joint
from core.robot.kinematics import BodyPose
from core.robot.leg import foot_from_strokes, vertex_directions
from core.robot.model import RobotModel
from core.robot.shoes import neighbour_pairs

REFLECTED_MASS = 0.1
"""Of a motor's rotor, seen at its knee, kg: inertia without weight. A real 63:1 gear with its screw has more;
at the ramp's 0.2 m/s² it takes 0.02 N."""
LINK_RELAXATION = 0.002
"""Time in which a soft link settles, s: damping over stiffness."""
CHAIN_SOLREF = "0.002 1"
CONTACT_SOLREF = "0.004 1"
HARDNESS = "0.999 0.999 0.001"
"""Constraints' time constant in s, damping ratio and impedance: the chains keep their length to some µm, and
the ground yields by less than 1 µm."""
SOLE_RADIUS = 0.003
"""Of the ball by which a sole touches the ground, m: half of the foot's own 6 mm in the soft shoe (T 2.1.1).

A shoe's rim bears nothing here, so that the robot tips over the feet's middles as the plan's margins say;
chosen by measurement, see docs/physics.md."""
TWIST_RADIUS = 0.002
"""Friction against a foot's turning about the vertical, as a lever, m: two thirds of `SOLE_RADIUS`."""
POINT_MASS = 1e-6
"""What the engine needs where a set of masses gives a part none, kg."""

Element = ElementTree.Element


def mjcf_text(model: RobotModel, physics: PhysicsSet, rig: Rig, pose: BodyPose, time_step: float) -> str:
    """The whole model.

    Args:
        model: the robot.
        physics: masses, friction, stiffness, limits, ground.
        rig: how the robot is held.
        pose: where the body is; matters where it is clamped.
        time_step: s.
    """
    root = Element("mujoco", model=model.name)
    ElementTree.SubElement(root, "compiler", angle="radian", autolimits="true")
    option = ElementTree.SubElement(
        root,
        "option",
        timestep=repr(time_step),
        integrator="implicitfast",
        cone="elliptic",
        impratio="10",
        tolerance="1e-10",
        gravity=_numbers(np.zeros(3) if rig is Rig.FLOATING else gravity_vector(physics)),
    )
    # One robot is one island; looking for more only takes time.
    ElementTree.SubElement(option, "flag", island="disable")
    world = ElementTree.SubElement(root, "worldbody")
    place = (0.0, 0.0, -model.sole_depth)
    _touchless(world, "floor", type="plane", size="1 1 0.1", pos=_numbers(place))
    body = _add_body(world, model, physics, rig, pose)
    for leg in range(model.leg_count):
        _add_leg(body, model, physics, leg)
    _add_chains(root, model)
    contact = ElementTree.SubElement(root, "contact")
    if rig is Rig.WALKING:
        _add_ground_contacts(contact, model, physics)
    _add_shoe_contacts(contact, model)
    _add_motors(root, model, physics)
    _add_sensors(root, model)
    return ElementTree.tostring(root, encoding="unicode")


def gravity_vector(physics: PhysicsSet) -> Floats:
    """(3,) gravity in a world whose z is the ground's normal, m/s²."""
    about_x, about_y = physics.ground_tilt
    lean = np.cos(about_x)
    down = np.array([lean * np.sin(about_y), -np.sin(about_x), -lean * np.cos(about_y)])
    return np.asarray(physics.gravity * down)


def rest_height(model: RobotModel) -> float:
    """Height of a platform under the actuator plane where all strokes are 0, m; every slide is 0 there."""
    return float(foot_from_strokes(model.leg, np.zeros(3))[2])


def arm_name(leg: int, motor: int) -> str:
    """Name of the constraint that keeps an arm's length (both 0-based; names count from 1)."""
    return f"leg{leg + 1}_arm{motor + 1}"


def shoe_name(leg: int) -> str:
    """Name of the shape of a foot's shoe (0-based; names count from 1)."""
    return f"leg{leg + 1}_shoe"


def ground_sensor(leg: int) -> str:
    """Name of the sensor of the ground's force on a foot."""
    return f"leg{leg + 1}_ground"


def _motors(model: RobotModel) -> Iterable[tuple[int, int]]:
    return ((leg, motor) for leg in range(model.leg_count) for motor in range(3))


def _add_body(world: Element, model: RobotModel, physics: PhysicsSet, rig: Rig, pose: BodyPose) -> Element:
    """The body as a solid cylinder as wide as its plate and as tall as its motors."""
    half = float(pose.heading) / 2
    body = ElementTree.SubElement(
        world,
        "body",
        name=BODY,
        pos=_numbers(pose.position_world),
        quat=_numbers((np.cos(half), 0.0, 0.0, np.sin(half))),
    )
    if rig is not Rig.CLAMPED:
        ElementTree.SubElement(body, "freejoint", name=BODY)
    mass = part_masses(model, physics).body
    radius, height = model.shape.plate_across / 2, model.shape.motor_length
    across = mass * (3 * radius**2 + height**2) / 12
    centre = (*physics.centre_offset, model.com_height)
    _add_inertia(body, mass, centre, (across, across, mass * radius**2 / 2))
    return body


def _add_leg(body: Element, model: RobotModel, physics: PhysicsSet, leg: int) -> None:
    masses = part_masses(model, physics)
    outwards = np.column_stack([vertex_directions(), np.zeros(3)]) @ model.R_robot_from_module[leg].T
    centre = model.module_centres_robot[leg]
    for motor in range(3):
        place = centre + model.leg.base_radius * outwards[motor]
        knee = ElementTree.SubElement(body, "body", name=knee_link(leg, motor), pos=_numbers(place))
        _add_slide(knee, motor_joint(leg, motor), (0, 0, -1), REFLECTED_MASS)
        _add_point_mass(knee, masses.knee, (0.0, 0.0, 0.0))
        ElementTree.SubElement(knee, "site", name=knee_link(leg, motor))
    platform = centre + (0.0, 0.0, rest_height(model))
    foot = ElementTree.SubElement(body, "body", name=foot_link(leg), pos=_numbers(platform))
    for axis, name in zip(np.eye(3), foot_joints(leg), strict=True):
        _add_slide(foot, name, axis)
    _add_point_mass(foot, masses.foot, (0.0, 0.0, 0.0))
    for motor in range(3):
        vertex = model.leg.platform_radius * outwards[motor]
        ElementTree.SubElement(foot, "site", name=f"{foot_link(leg)}{motor + 1}", pos=_numbers(vertex))
    bottom = (0.0, 0.0, SOLE_RADIUS - model.sole_depth)
    _touchless(foot, foot_link(leg), type="sphere", size=repr(SOLE_RADIUS), pos=_numbers(bottom))
    if model.shoe_diameter is not None:
        _add_shoe(foot, model, leg, model.shoe_diameter)


def _add_shoe(foot: Element, model: RobotModel, leg: int, diameter: float) -> None:
    """An upright capsule whose straight part is the shoe: it touches other shoes with its side alone.

    Feet keep upright and rise by less than the shoe's height, so that the round ends meet nothing.
    """
    half = model.sole_depth / 2
    size, middle = _numbers((diameter / 2, half)), _numbers((0.0, 0.0, -half))
    _touchless(foot, shoe_name(leg), type="capsule", size=size, pos=middle)


def _touchless(parent: Element, name: str, **attributes: str) -> None:
    """A shape that touches nothing but what it is paired with."""
    alone = {"name": name, "contype": "0", "conaffinity": "0", "mass": "0"}
    ElementTree.SubElement(parent, "geom", alone | attributes)


def _add_slide(parent: Element, name: str, axis: Iterable[float], armature: float = 0.0) -> None:
    ElementTree.SubElement(
        parent, "joint", name=name, type="slide", axis=_numbers(axis), armature=repr(armature)
    )


def _add_point_mass(parent: Element, mass: float, place: Iterable[float]) -> None:
    """A part that never turns against the body; its size adds next to nothing to the body's inertia."""
    mass = max(mass, POINT_MASS)
    _add_inertia(parent, mass, place, (mass * SOLE_RADIUS**2,) * 3)


def _add_inertia(parent: Element, mass: float, place: Iterable[float], inertia: Iterable[float]) -> None:
    numbers = {"mass": repr(mass), "pos": _numbers(place), "diaginertia": _numbers(inertia)}
    ElementTree.SubElement(parent, "inertial", numbers)


def _add_chains(root: Element, model: RobotModel) -> None:
    """Every arm keeps the length that it has where all strokes are 0, which is l."""
    tendons, constraints = (ElementTree.SubElement(root, part) for part in ("tendon", "equality"))
    for leg, motor in _motors(model):
        name = arm_name(leg, motor)
        arm = ElementTree.SubElement(tendons, "spatial", name=name)
        ElementTree.SubElement(arm, "site", site=knee_link(leg, motor))
        ElementTree.SubElement(arm, "site", site=f"{foot_link(leg)}{motor + 1}")
        ElementTree.SubElement(constraints, "tendon", tendon1=name, solref=CHAIN_SOLREF, solimp=HARDNESS)


def _add_ground_contacts(contact: Element, model: RobotModel, physics: PhysicsSet) -> None:
    friction = (physics.friction, physics.friction, physics.friction * TWIST_RADIUS, 1e-4, 1e-4)
    for leg in range(model.leg_count):
        ElementTree.SubElement(
            contact,
            "pair",
            geom1="floor",
            geom2=foot_link(leg),
            condim="4",
            friction=_numbers(friction),
            solref=CONTACT_SOLREF,
            solimp=HARDNESS,
        )


def _add_shoe_contacts(contact: Element, model: RobotModel) -> None:
    """Shoes of neighbouring feet push against each other, without friction."""
    pairs = neighbour_pairs(model.leg_count).tolist() if model.shoe_diameter is not None else []
    for first, second in pairs:
        ElementTree.SubElement(
            contact,
            "pair",
            geom1=shoe_name(first),
            geom2=shoe_name(second),
            condim="1",
            solref=CONTACT_SOLREF,
            solimp=HARDNESS,
        )


def _add_motors(root: Element, model: RobotModel, physics: PhysicsSet) -> None:
    """Position servos whose stiffness is the soft link's, with the motors' force limits."""
    actuators = ElementTree.SubElement(root, "actuator")
    limits, stiffness = motor_force_limits(model, physics), physics.link_stiffness
    for leg, motor in _motors(model):
        limit = float(limits[leg, motor])
        ElementTree.SubElement(
            actuators,
            "general",
            name=motor_joint(leg, motor),
            joint=motor_joint(leg, motor),
            biastype="affine",
            gainprm=repr(stiffness),
            biasprm=_numbers((0.0, -stiffness, -stiffness * LINK_RELAXATION)),
            forcerange=_numbers((-limit, limit)),
        )


def _add_sensors(root: Element, model: RobotModel) -> None:
    """Arms' lengths, motors' forces, ground's forces, centre of mass; `states` relies on this order."""
    sensors = ElementTree.SubElement(root, "sensor")
    for leg, motor in _motors(model):
        ElementTree.SubElement(sensors, "tendonpos", tendon=arm_name(leg, motor))
    for leg, motor in _motors(model):
        ElementTree.SubElement(sensors, "actuatorfrc", actuator=motor_joint(leg, motor))
    for leg in range(model.leg_count):
        ElementTree.SubElement(
            sensors,
            "contact",
            name=ground_sensor(leg),
            geom1="floor",
            geom2=foot_link(leg),
            data="force",
            reduce="netforce",
        )
    ElementTree.SubElement(sensors, "subtreecom", body=BODY)


def _numbers(values: Iterable[float]) -> str:
    return " ".join(repr(float(value)) for value in values)
