"""A pose gait: poses, the strokes that they ask for, and how long the robot takes from one to the next."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from core.arrays import Floats, frozen_floats
from core.motion.trajectory import Trajectory
from core.pose_gaits.pose_problem import PoseProblem
from core.wire.robot_time import ARRIVAL_THRESHOLD, deaf_seconds, far_motors
from core.wire.waypoints import Waypoints

FIRST_SECONDS = 1.0
"""Duration that a waypoint file gives its first pose, s; the firmware ignores durations."""


@dataclass(frozen=True, eq=False)
class PoseGait:
    """Poses of a robot, as a solver has found them.

    Args:
        problem: that they answer.
        step: travel of the body a cycle, m.
        bodies: (poses, 3) point of the body axis in the actuator plane, m; z above standing feet's platforms.
        headings: (poses,) turn of the body from its first direction, rad; even but for the problem's sway.
        feet: (poses, legs, 3) platform centres, m.
        strokes: (poses, legs, 3) motor strokes, m.
    """

    problem: PoseProblem
    step: float
    bodies: Floats
    headings: Floats
    feet: Floats
    strokes: Floats

    def __post_init__(self) -> None:
        poses, legs = self.problem.airborne.shape
        for name, shape in (
            ("bodies", (poses, 3)),
            ("headings", (poses,)),
            ("feet", (poses, legs, 3)),
            ("strokes", (poses, legs, 3)),
        ):
            object.__setattr__(self, name, frozen_floats(getattr(self, name), shape, name))

    @cached_property
    def moves(self) -> Floats:
        """(moves,) largest move of any motor, m."""
        return np.asarray(self._changes.max(axis=1))

    @cached_property
    def _changes(self) -> Floats:
        """(moves, motors) how far each motor goes, m."""
        return np.asarray(np.abs(np.diff(self.strokes.reshape(len(self.strokes), -1), axis=0)))

    @cached_property
    def move_seconds(self) -> Floats:
        """(moves,) seconds of the robot's time, by the problem's law."""
        return np.asarray(self.problem.law.move_seconds(self.moves, far_motors(self._changes)))

    @property
    def seconds(self) -> float:
        """Robot seconds of all moves."""
        return float(self.move_seconds.sum())

    @property
    def distance(self) -> float:
        """How far the body goes in all cycles, m; in a curve along the chord of each."""
        return self.step * self.problem.all_cycles

    @property
    def speed(self) -> float:
        """Travel a robot second, m/s."""
        return self.distance / self.seconds

    @property
    def turn(self) -> float:
        """Turn of the body a cycle, rad."""
        return float(self.headings[-1] - self.headings[0]) / self.problem.all_cycles

    @property
    def turn_rate(self) -> float:
        """Turn a robot second, rad/s."""
        return float(self.headings[-1] - self.headings[0]) / self.seconds

    @property
    def pace(self) -> float:
        """Speed, m/s; for a turn on the spot the turn rate, rad/s."""
        return abs(self.turn_rate) if self.problem.on_the_spot else self.speed

    @cached_property
    def waypoints(self) -> Waypoints:
        """The poses as they are sent."""
        return Waypoints(self.strokes, np.append(FIRST_SECONDS, self.move_seconds))

    @cached_property
    def trajectory(self) -> Trajectory:
        """The poses over the robot's time."""
        body = self.bodies + np.array([0.0, 0.0, self.problem.model.com_height])
        times = np.append(0.0, np.cumsum(self.move_seconds))
        return Trajectory(times, body, self.headings, self.feet, ~self.problem.airborne)


def heard_times(gait: PoseGait) -> Floats:
    """(moves,) from when the robot hears a Stop in each move at the latest, s from the first pose.

    It reads its line again when the move's first ramp has ended.
    """
    begins = gait.trajectory.times[:-1]
    deaf = [deaf_seconds(float(move), off=ARRIVAL_THRESHOLD) for move in gait.moves]
    return np.asarray(np.minimum(begins + deaf, gait.trajectory.times[1:]))
