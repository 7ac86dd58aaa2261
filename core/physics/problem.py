"""What a physics simulation is asked: exactly the waypoints that would be sent, on stated ground."""

from dataclasses import dataclass
from enum import StrEnum

from core.arrays import Bools, Floats, frozen_bools, frozen_floats
from core.errors import InputError
from core.motion.trajectory import Trajectory
from core.physics.parameters import PhysicsSet
from core.robot.model import RobotModel
from core.wire.waypoints import Waypoints


class Rig(StrEnum):
    """How the robot is held; a model is found to be right from the simple rigs up (thesis 4.1.1)."""

    WALKING = "walking"
    """Free, on the ground."""
    FLOATING = "floating"
    """Free, without gravity and ground."""
    CLAMPED = "clamped"
    """The body is held in the air, so that each leg and motor moves by itself."""


@dataclass(frozen=True, eq=False)
class SimulationProblem:
    """One run of a plan's waypoints through the physics.

    Args:
        model: the robot.
        waypoints: exactly what would be sent.
        plan: the motion that they were made from, for comparison and for the start pose.
        times: (count,) the plan's time of each waypoint, s.
        contact: (count, legs) feet that should be on the ground at each waypoint.
        standing: (count, legs) feet that should be on the ground all along the move to each waypoint.
        physics: the parameters of robot, motors and ground.
        rig: how the robot is held.
    """

    model: RobotModel
    waypoints: Waypoints
    plan: Trajectory
    times: Floats
    contact: Bools
    standing: Bools
    physics: PhysicsSet
    rig: Rig = Rig.WALKING

    def __post_init__(self) -> None:
        count, legs = self.waypoints.count, self.model.leg_count
        if self.waypoints.strokes.shape[1] != legs or self.plan.leg_count != legs:
            raise InputError(f"Waypoints and plan must have {legs} feet, as the robot has.", "waypoints")
        object.__setattr__(self, "times", frozen_floats(self.times, (count,), "times"))
        object.__setattr__(self, "contact", frozen_bools(self.contact, (count, legs), "contact"))
        object.__setattr__(self, "standing", frozen_bools(self.standing, (count, legs), "standing"))
