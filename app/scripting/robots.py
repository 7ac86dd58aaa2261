"""Robots for scripts: sizes and limits, and the kinematics of all legs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from app.scripting.arrays import array_of
from app.scripting.html import Cell, table
from core.arrays import Floats
from core.robot.kinematics import BodyPose, walker_feet, walker_strokes
from core.robot.model import ROBOT_NAMES, RobotModel, load_robot


@dataclass(frozen=True, eq=False, repr=False)
class Robot:
    """A robot: its sizes and limits in SI, and its kinematics. `footfall.robot` gives one.

    Args:
        model: the robot's parameters in full.

    Raises:
        InputError: by its methods, where an array has another shape or a foot is out of reach.

    Example:
        >>> import footfall as ff
        >>> robot = ff.robot("deltawalker")
        >>> robot.legs, robot.stroke
        (4, (0.0005, 0.0195))
    """

    model: RobotModel

    @property
    def name(self) -> str:
        """What commands and documents call it."""
        return self.model.name

    @property
    def title(self) -> str:
        """What people call it."""
        return self.model.title

    @property
    def legs(self) -> int:
        """Number of legs; three motors each."""
        return self.model.leg_count

    @property
    def stroke(self) -> tuple[float, float]:
        """Shortest and longest stroke of a motor, m."""
        return self.model.stroke.lower, self.model.stroke.upper

    @property
    def margin(self) -> float:
        """Stability margin that new gaits of it ask for, m."""
        return self.model.margin

    def feet(self, strokes: ArrayLike) -> Floats:
        """Where the feet are: forward kinematics.

        Args:
            strokes: (n, legs, 3) or (legs, 3) strokes of the motors in wire order, m.

        Returns:
            Array of the same shape: x, y, z of each foot in the robot's frame, m; the origin is on the body's
            axis in the plane of the actuators, z upwards.

        Raises:
            InputError: the array has another shape, or holds no finite numbers.

        Example:
            >>> import footfall as ff
            >>> ff.robot("deltawalker").feet([[0.0055] * 3] * 4).shape
            (4, 3)
        """
        values = array_of(strokes, (self.legs, 3), "strokes", "m")
        return walker_feet(self.model, values, _at_home(values))

    def strokes(self, feet: ArrayLike) -> Floats:
        """What the motors have to do: inverse kinematics.

        Args:
            feet: (n, legs, 3) or (legs, 3) x, y, z of each foot in the robot's frame, m (see `feet`).

        Returns:
            Array of the same shape: strokes of the motors in wire order, m.

        Raises:
            InputError: the array has another shape, or holds no finite numbers.
            FootfallError: a foot is out of reach; the sentence says which and by how much.

        Example:
            >>> import footfall as ff
            >>> robot = ff.robot("deltawalker")
            >>> robot.strokes(robot.feet([[0.0055] * 3] * 4)).round(6).tolist()[0]
            [0.0055, 0.0055, 0.0055]
        """
        values = array_of(feet, (self.legs, 3), "feet", "m")
        return walker_strokes(self.model, values, _at_home(values))

    def __repr__(self) -> str:
        lower, upper = (value * 1000 for value in self.stroke)
        return f"Robot {self.name}: {self.title}, {self.legs} legs, strokes {lower:g} to {upper:g} mm"

    def _repr_html_(self) -> str:
        lower, upper = (value * 1000 for value in self.stroke)
        rows: list[list[Cell]] = [
            ["legs", self.legs],
            ["motors", self.model.motor_count],
            ["stroke, mm", f"{lower:g} to {upper:g}"],
            ["margin of new gaits, mm", self.margin * 1000],
            ["mass of the model, kg", self.model.total_model_mass],
        ]
        return table(["", ""], rows, self.title)


def _at_home(values: Floats) -> BodyPose:
    """The pose of a body whose frame is the world's, for each row of (…, legs, 3) values."""
    rows = values.shape[:-2]
    return BodyPose(np.zeros((*rows, 3)), np.zeros(rows))


def robot(name: str = "deltawalker") -> Robot:
    """A robot by its name.

    Args:
        name: one of `footfall.robots()`.

    Returns:
        The robot; lengths are in m.

    Raises:
        InputError: there is none of that name; the sentence lists them.

    Example:
        >>> import footfall as ff
        >>> ff.robot("hexapod").legs
        6
    """
    return Robot(load_robot(name))


def robots() -> tuple[str, ...]:
    """The names of the robots that can be designed for.

    Returns:
        Names, for `footfall.robot` and for the option `robot`; no units and no arrays.

    Raises:
        InputError: never; `footfall.robot` refuses a name that is not among these.

    Example:
        >>> import footfall as ff
        >>> "deltawalker" in ff.robots()
        True
    """
    return ROBOT_NAMES
