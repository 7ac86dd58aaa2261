"""What a simulated robot did, sample by sample, in the same world frame as the plan."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from core.arrays import Floats, frozen_floats
from core.physics.problem import SimulationProblem


@dataclass(frozen=True, eq=False)
class SimulatedMotion:
    """The states of one simulated run.

    The frame is the plan's: z = 0 is the platform height of a standing foot, the body's position is the
    centre-of-mass point `com_height` above its actuator plane, and at the start both lie where the plan's do.

    Args:
        times: (n,) simulated time, s; 0 where the first waypoint has been reached and the robot stands still.
        body_world: (n, 3) m.
        attitude: (n, 4) unit quaternion w, x, y, z of the body in the world.
        feet_world: (n, legs, 3) platform centres, m.
        strokes: (n, legs, 3) motors' real strokes, m.
        targets: (n, legs, 3) where the firmware's ramp wants them, m.
        motor_forces: (n, legs, 3) force along the stroke, positive pushes the foot down, N.
        ground_forces: (n, legs, 3) force of the ground on each foot, world axes, N.
        centre_world: (n, 3) the whole robot's centre of mass, m.
        arrivals: (count,) sample at which each waypoint's move had ended.
        loop_error: largest violation of a rod's length at any time step, m.
        seconds: computing time, s.
        ended_early: why it ended before the last waypoint, or "".
    """

    times: Floats
    body_world: Floats
    attitude: Floats
    feet_world: Floats
    strokes: Floats
    targets: Floats
    motor_forces: Floats
    ground_forces: Floats
    centre_world: Floats
    arrivals: NDArray[np.int64]
    loop_error: float
    seconds: float
    ended_early: str = ""

    def __post_init__(self) -> None:
        n, legs = self.times.shape[0], self.feet_world.shape[1]
        shapes: dict[str, tuple[int | None, ...]] = {
            "times": (n,),
            "body_world": (n, 3),
            "attitude": (n, 4),
            "centre_world": (n, 3),
        }
        for name in ("feet_world", "strokes", "targets", "motor_forces", "ground_forces"):
            shapes[name] = (n, legs, 3)
        for name, shape in shapes.items():
            object.__setattr__(self, name, frozen_floats(getattr(self, name), shape, name))

    @property
    def realtime_factor(self) -> float:
        """Simulated seconds a second of computing."""
        return float(self.times[-1] - self.times[0]) / self.seconds


def plan_times(problem: SimulationProblem, motion: SimulatedMotion) -> Floats:
    """(n,) the plan's time at each sample of a simulated run, s.

    Linear between arrivals: where waypoint k has been reached the plan's time of it stands, whatever the
    firmware took for the move. Before the first arrival the plan's time is that of the first waypoint. A move
    that broke off leads to the time of its waypoint, after the last one the time stands.

    Args:
        problem: that was simulated.
        motion: what came of it.
    """
    reached = len(motion.arrivals)
    robot, planned = motion.times[motion.arrivals], problem.times[:reached]
    if reached < problem.waypoints.count and motion.times[-1] > robot[-1]:
        robot = np.append(robot, motion.times[-1])
        planned = problem.times[: reached + 1]
    # Of waypoints that are reached at one sample, as within the firmware's threshold, the last one counts.
    last = np.append(np.diff(robot) > 0, True)
    return np.asarray(np.interp(motion.times, robot[last], planned[last]))
