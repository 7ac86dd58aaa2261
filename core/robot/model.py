"""The robot's parameters as one frozen value, read from one file a variant."""

import hashlib
import json
import tomllib
from dataclasses import asdict, dataclass, fields, is_dataclass
from enum import StrEnum
from functools import cache
from typing import Any

import numpy as np

from core.arrays import Floats, frozen_floats
from core.data.tables import package_files
from core.errors import InputError
from core.robot.coupling import coupling_matrix
from core.text.numbers import shortened


@dataclass(frozen=True)
class LegGeometry:
    """A linear-delta leg (thesis Table 2.1), m.

    Args:
        base_radius: u_b, distance of a motor from the module's centre.
        platform_radius: u_p, distance of a rod's end from the platform's centre.
        link_length: l, length of a rod.
    """

    base_radius: float
    platform_radius: float
    link_length: float

    @property
    def reach_radius(self) -> float:
        """u_t = u_b − u_p of (2.7), the radius of the spheres' centres, m."""
        return self.base_radius - self.platform_radius


@dataclass(frozen=True)
class StrokeLimits:
    """What a motor can do: m, m/s, m/s²."""

    travel: float
    lower: float
    upper: float
    speed: float
    acceleration: float


@dataclass(frozen=True)
class ModelMasses:
    """Point masses of the optimisation's model, kg."""

    body: float
    foot: float


class FootEnd(StrEnum):
    """What a leg ends in (thesis 2.1.1 and 2.1.2)."""

    SHOE = "shoe"
    BARE = "bare"
    """The foot without its shoe."""
    FINGERTIP = "fingertip"
    """The round tip of the DeltaHands."""


@dataclass(frozen=True)
class BodyShape:
    """Sizes for pictures, m; heights are of undersides above the actuator plane.

    Of these a plan depends on `RobotModel.shoe_diameter`, `rod_diameter` and `rod_spacing` alone.
    """

    plate_across: float
    plate_thickness: float
    lower_plate_height: float
    upper_plate_height: float
    board_height: float
    motor_width: float
    motor_length: float
    rod_diameter: float
    rod_spacing: float
    foot_diameter: float
    sole_diameter: float
    foot_end: FootEnd
    rod_colour: str
    board: tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class RobotModel:
    """n linear-delta modules in a ring.

    The robot's frame has its origin on the body axis in the actuator plane, z up; module i stands at
    `azimuths[i]` and its own frame has y pointing outwards.

    Args:
        name: the parameters file's name.
        title: what a person reads.
        wired: whether the real robot's cable carries these motors.
        azimuths: (legs,) rad.
        radius: distance of a module's centre from the body axis, m.
        leg: geometry of every leg.
        stroke: limits of every motor.
        com_height: centre of mass above the actuator plane, m.
        sole_depth: floor below the platform of a standing foot, m.
        margin: stability margin that new gaits ask for, m: the least at which gaits walk in physics as sent.
        coupling: (motors, actuators) C of h = C·u, motors in wire order; the identity where none is shared.
        masses: point masses of the optimisation's model.
        mass_sets: every named set of masses as it stands in the file, kg.
        shape: sizes for pictures, and those of shoes and arms.
        colours: a colour a foot, `#rrggbb`.
    """

    name: str
    title: str
    wired: bool
    azimuths: Floats
    radius: float
    leg: LegGeometry
    stroke: StrokeLimits
    com_height: float
    sole_depth: float
    margin: float
    coupling: Floats
    masses: ModelMasses
    mass_sets: dict[str, dict[str, float]]
    shape: BodyShape
    colours: tuple[str, ...]

    @property
    def leg_count(self) -> int:
        """Number of legs."""
        return int(self.azimuths.shape[0])

    @property
    def motor_count(self) -> int:
        """Number of motors, three a leg."""
        return 3 * self.leg_count

    @property
    def actuator_count(self) -> int:
        """Number of actuators that drive the motors; fewer where motors share one."""
        return int(self.coupling.shape[1])

    @property
    def is_coupled(self) -> bool:
        """Whether motors share an actuator, so that not every set of strokes can be made."""
        return self.actuator_count < self.motor_count

    @property
    def total_model_mass(self) -> float:
        """Body and feet of the optimisation's model, kg."""
        return self.masses.body + self.leg_count * self.masses.foot

    @property
    def shoe_diameter(self) -> float | None:
        """How wide a shoe is, m; None where the feet wear none."""
        return self.shape.sole_diameter if self.shape.foot_end is FootEnd.SHOE else None

    @property
    def parameters_hash(self) -> str:
        """SHA-256 of everything that a plan or a verdict depends on: all but title, looks and defaults."""
        looks = {"title", "shape", "colours", "margin"}
        values = {field.name: getattr(self, field.name) for field in fields(self) if field.name not in looks}
        content = {name: _plain(value) for name, value in values.items()}
        content["shoe_diameter"] = self.shoe_diameter
        content["arms"] = [self.shape.rod_diameter, self.shape.rod_spacing]
        return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()

    @property
    def R_robot_from_module(self) -> Floats:
        """(legs, 3, 3) rotation from each module's frame (y outwards) into the robot's."""
        outwards_angle = self.azimuths - np.pi / 2
        cosine, sine = np.cos(outwards_angle), np.sin(outwards_angle)
        rotation = np.zeros((self.leg_count, 3, 3))
        rotation[:, 0, 0], rotation[:, 0, 1] = cosine, -sine
        rotation[:, 1, 0], rotation[:, 1, 1] = sine, cosine
        rotation[:, 2, 2] = 1.0
        return rotation

    @property
    def module_centres_robot(self) -> Floats:
        """(legs, 3) centre of each module in the robot's frame, m.

        A module on an axis stands exactly there, so that a robot turned by 90° is the same to the last bit.
        """
        zeros = np.zeros(self.leg_count)
        outwards = np.stack([np.cos(self.azimuths), np.sin(self.azimuths), zeros], axis=-1)
        return self.radius * np.where(np.abs(outwards) < ROUNDING, 0.0, outwards)


def _plain(value: Any) -> Any:
    """A parameter as JSON content."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    return asdict(value) if is_dataclass(value) and not isinstance(value, type) else value


ROUNDING = 1e-15
"""Cosines and sines below this are what rounding leaves of 0."""

ROBOT_NAMES = ("deltawalker", "deltawalker9", "deltawalker5", "hexapod", "dodecapod")
"""Parameter files that come with the program."""


@cache
def load_robot(name: str) -> RobotModel:
    """Reads a robot's parameters file; once, since every document asks for it.

    Raises:
        InputError: there is no robot of that name, or its file lacks something.
    """
    return robot_from_table(robot_table(name), f"{name}.toml")


@cache
def robot_table(name: str) -> dict[str, Any]:
    """A robot's parameters file as it stands; the content is shared, so nobody changes it.

    Raises:
        InputError: there is no robot of that name.
    """
    if name not in ROBOT_NAMES:
        raise InputError(
            f"There is no robot “{shortened(str(name))}”; choose one of {', '.join(ROBOT_NAMES)}.", "robot"
        )
    return tomllib.loads(package_files("robot_description").joinpath(f"{name}.toml").read_text("utf-8"))


def robot_from_table(table: dict[str, Any], where: str) -> RobotModel:
    """Builds the model from a parsed parameters file.

    Raises:
        InputError: a section or number is missing or does not fit.
    """
    try:
        shape = dict(table["shape"])
        colours = tuple(shape.pop("colours"))
        board = tuple(shape.pop("board"))
        foot_end = FootEnd(shape.pop("foot_end"))
        azimuths = np.radians(frozen_floats(table["ring"]["azimuths_deg"], (None,), "azimuths_deg"))
        azimuths.setflags(write=False)
        model = RobotModel(
            name=table["name"],
            title=table["title"],
            wired=bool(table["wired"]),
            azimuths=azimuths,
            radius=float(table["ring"]["radius"]),
            leg=LegGeometry(**table["leg"]),
            stroke=StrokeLimits(**table["stroke"]),
            com_height=float(table["body"]["com_height"]),
            sole_depth=float(table["body"]["sole_depth"]),
            margin=float(table["gait"]["margin"]),
            coupling=coupling_matrix(
                table.get("coupling", {}).get("shared", ()), 3 * len(azimuths), f"{where}, coupling"
            ),
            masses=ModelMasses(**table["mass"]["model"]),
            mass_sets={key: dict(value) for key, value in table["mass"].items()},
            shape=BodyShape(board=board, foot_end=foot_end, **shape),
            colours=colours,
        )
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(
            f"{where} does not describe a robot: {error} is missing or unknown.", where
        ) from error
    if len(colours) != model.leg_count:
        raise InputError(f"{where}: {len(colours)} colours for {model.leg_count} legs.", where)
    return model
