"""The robot in a run, its body and feet computed from the measured strokes."""

from dataclasses import dataclass

import numpy as np

from app.bridge.states import RobotSnapshot
from app.robot.views import RUNNING, RunOrigin
from core.arrays import Floats
from core.errors import StateError
from core.robot.model import RobotModel
from core.runs.pose import measured_motion


@dataclass(frozen=True, eq=False)
class MeasuredRobot:
    """Where body and feet are by the measured strokes.

    Args:
        model: the robot.
        com_world: (3,) centre of mass, m.
        heading: rad.
        feet_world: (legs, 3) platform centres, m.
    """

    model: RobotModel
    com_world: Floats
    heading: float
    feet_world: Floats


def measured_robot(snapshot: RobotSnapshot, origin: RunOrigin | None) -> MeasuredRobot:
    """The robot by its last strokes, with the plan's standing feet on the ground.

    Args:
        snapshot: with strokes and a run that is on.
        origin: of that run.

    Raises:
        StateError: no run of a gait is known, or no strokes are.
    """
    run, strokes = snapshot.run, snapshot.strokes
    plan = None if origin is None else origin.plan
    is_on = snapshot.robot in RUNNING
    if (
        not is_on
        or run is None
        or strokes is None
        or origin is None
        or plan is None
        or origin.run_id != run.run_id
    ):
        raise StateError("No run of a gait is on, so there is no measured robot to show.", "run")
    times = origin.times[[run.waypoint_reached]]
    motion = measured_motion(plan, np.reshape(strokes, (1, -1, 3)), times, times)
    com = np.array(motion.pose.position_world[0])
    com[2] += plan.model.com_height
    return MeasuredRobot(plan.model, com, float(motion.pose.heading[0]), motion.feet_world[0])
