"""Where actuators stand, and how motors that share one hang on it; drawn, not measured."""

from dataclasses import dataclass

import numpy as np

from core.arrays import Floats
from core.robot.closed_chain import knee_yaws
from core.robot.leg import vertex_directions
from core.robot.model import RobotModel


@dataclass(frozen=True)
class Yoke:
    """The arm from a shared motor's knee to its actuator's shaft, in the knee's frame.

    Args:
        length: m.
        yaw: of the arm, rad.
        carries_shaft: whether the shaft is drawn with this knee; with one of each actuator's.
    """

    length: float
    yaw: float
    carries_shaft: bool

    @property
    def mesh(self) -> str:
        """Name of the arm's mesh, by its length in tenths of a millimetre."""
        return f"yoke_{round(self.length * 1e4)}"

    @property
    def end(self) -> tuple[float, float, float]:
        """Where the shaft stands in the knee's frame, m."""
        return self.length * float(np.cos(self.yaw)), self.length * float(np.sin(self.yaw)), 0.0


def motor_places(model: RobotModel) -> Floats:
    """(motors, 3) where each motor meets the actuator plane, in the robot's frame, m; wire order."""
    in_module = np.column_stack([model.leg.base_radius * vertex_directions(), np.zeros(3)])
    turned = np.einsum("lij,mj->lmi", model.R_robot_from_module, in_module)
    return np.asarray((turned + model.module_centres_robot[:, None]).reshape(-1, 3))


def motor_yaws(model: RobotModel) -> Floats:
    """(motors,) turn of each knee's frame in the robot's, rad; wire order."""
    return np.asarray((model.azimuths[:, None] - np.pi / 2 + knee_yaws()).ravel())


def actuator_places(model: RobotModel) -> Floats:
    """(actuators, 3) amid the motors that each one drives, m."""
    shares = model.coupling / model.coupling.sum(axis=0)
    return np.asarray(shares.T @ motor_places(model))


def actuator_yaws(model: RobotModel) -> Floats:
    """(actuators,) turn of each actuator's body: its motor's, or where it drives several, outwards; rad."""
    places = actuator_places(model)
    outwards = np.where(np.hypot(*places[:, :2].T) < 1e-9, 0.0, np.arctan2(places[:, 1], places[:, 0]))
    alone = model.coupling.sum(axis=0) == 1
    return np.asarray(np.where(alone, model.coupling.T @ motor_yaws(model), outwards))


def yoke(model: RobotModel, motor: int) -> Yoke | None:
    """The arm of a motor, counted from 0 in wire order; None where it has an actuator of its own."""
    actuator = int(model.coupling[motor].argmax())
    drives = np.nonzero(model.coupling[:, actuator])[0]
    if len(drives) == 1:
        return None
    way = actuator_places(model)[actuator] - motor_places(model)[motor]
    yaw = float(np.arctan2(way[1], way[0]) - motor_yaws(model)[motor])
    return Yoke(float(np.hypot(way[0], way[1])), yaw, motor == drives[0])
