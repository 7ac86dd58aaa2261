"""The world motion that waypoints stand for: feet by forward kinematics, the body so that they slip least."""

from dataclasses import dataclass

import numpy as np

from core.arrays import Bools, Floats
from core.checks.ground import SLIP_LIMIT
from core.errors import InputError
from core.gait.manual_motion import body_advances, stance_slip
from core.motion.balance import STANDING_DEPTH
from core.motion.contact_timeline import MAX_SAMPLES
from core.motion.trajectory import Trajectory, difference_velocities
from core.robot.kinematics import feet_in_robot
from core.robot.model import RobotModel
from core.wire.waypoints import Waypoints

SAME_DURATION = 1e-4
"""Durations in files have 4 decimals; those that differ by no more are the same, s."""
USUAL_INTERVAL = 0.4
"""Time between waypoints where none is given, s."""


@dataclass(frozen=True, eq=False)
class WaypointMotion:
    """A motion made from waypoints, and what had to be assumed.

    Args:
        trajectory: in the world frame.
        assumptions: sentences.
    """

    trajectory: Trajectory
    assumptions: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class _Ground:
    """The body's way over the ground: (n, 2) positions in m and (n,) headings in rad."""

    positions: Floats
    headings: Floats

    def feet(self, feet_robot: Floats) -> Floats:
        """(n, legs, 3) feet of the robot's axes over the ground, heights as they are, m."""
        cosine, sine = np.cos(self.headings)[:, None], np.sin(self.headings)[:, None]
        x, y, z = np.moveaxis(feet_robot, -1, 0)
        east = cosine * x - sine * y + self.positions[:, :1]
        north = sine * x + cosine * y + self.positions[:, 1:]
        return np.stack([east, north, z], axis=-1)


def motion_of_waypoints(model: RobotModel, waypoints: Waypoints) -> WaypointMotion:
    """Forward kinematics of every waypoint, and the body's motion over the ground.

    Feet within STANDING_DEPTH of the deepest one stand, and the body is as high as puts them midway about
    z = 0. Between waypoints the body moves as the standing feet say (see `_ground`).

    Args:
        model: the robot.
        waypoints: one a knot.

    Raises:
        InputError: there is one waypoint or far too many, a stroke is none of a motor, or a leg cannot be
            assembled.
    """
    if not 2 <= waypoints.count <= MAX_SAMPLES:
        raise InputError(
            f"A motion of a gait has 2 to {MAX_SAMPLES} waypoints; the file has {waypoints.count}. Leave "
            "some out, or cut the file into several.",
            "waypoints",
        )
    feet_robot = feet_in_robot(model, waypoints.strokes)
    _require_assembled(feet_robot)
    heights = feet_robot[..., 2]
    deepest = heights.min(axis=1, keepdims=True)
    standing = np.asarray(heights - deepest <= STANDING_DEPTH)
    middle = (deepest[:, 0] + np.where(standing, heights, -np.inf).max(axis=1)) / 2
    ground, how = _ground(feet_robot, standing)
    feet = ground.feet(feet_robot)
    feet[..., 2] -= middle[:, None]
    body = np.concatenate([ground.positions, (model.com_height - middle)[:, None]], axis=1)
    interval, timing = _interval(waypoints.durations[1:])
    times = np.asarray(np.arange(waypoints.count) * interval, dtype=np.float64)
    velocities = (difference_velocities(times, body), difference_velocities(times, feet))
    trajectory = Trajectory(times, body, ground.headings, feet, standing, *velocities)
    stands = f"A foot stands where it is within {STANDING_DEPTH * 1000:.1f} mm of the deepest one."
    return WaypointMotion(trajectory, (stands, how, *timing))


def _require_assembled(feet_module: Floats) -> None:
    apart = np.argwhere(~np.isfinite(feet_module).all(axis=-1))
    if apart.size:
        row, foot = (int(i) for i in apart[0])
        raise InputError(
            f"Waypoint {row + 1}, foot {foot + 1}: its three rods do not meet at these strokes. Change them.",
            f"waypoint {row + 1}",
        )


def _ground(feet_robot: Floats, standing: Bools) -> tuple[_Ground, str]:
    """The body's way, and in a sentence how it was found.

    First a body of constant heading, then one that turns, moves between waypoints so that its standing
    feet slip least in the sense of least squares. Where they slip further than SLIP_LIMIT both times, feet
    were meant to slip, as in gaits made by hand, whose body moves as `core.gait.manual_motion` says.
    """
    for turns in (False, True):
        ground = _least_slip(feet_robot, standing, turns)
        slip = float(stance_slip(ground.feet(feet_robot), standing).max())
        if slip <= SLIP_LIMIT:
            degrees = float(np.degrees(ground.headings[-1]))
            heading = f"the body turns, by {degrees:.1f}° in all" if turns else "the body keeps its heading"
            return ground, (
                f"The body moves so that standing feet slip least, up to {slip * 1000:.2f} mm; {heading}."
            )
    way = np.cumsum(body_advances(feet_robot, standing), axis=0)
    ground = _Ground(np.concatenate([np.zeros((1, 2)), way]), np.zeros(len(feet_robot)))
    slip = float(stance_slip(ground.feet(feet_robot), standing).max())
    return ground, (
        "The body moves as in gaits made by hand, by the mean way of all feet with those in the air taken as "
        f"still, and keeps its heading; standing feet slip up to {slip * 1000:.1f} mm."
    )


def _least_slip(feet_robot: Floats, standing: Bools, turns: bool) -> _Ground:
    """Fits each waypoint's standing feet to where they stood at the one before, by least squares.

    With a = R(ψ_k)·foot_k over the ground and b = foot_{k+1} in the robot's axes, both about their means,
    the turn is ψ_{k+1} = atan2(Σ b_x·a_y − b_y·a_x, Σ a·b) (Kabsch in the plane), and the means coincide.
    """
    positions, headings = [np.zeros(2)], [0.0]
    for k in range(len(feet_robot) - 1):
        both = standing[k] & standing[k + 1]
        position, heading = positions[-1], headings[-1]
        if both.any():
            here = _Ground(position[None], np.array([heading])).feet(feet_robot[k : k + 1, both])[0, :, :2]
            there = feet_robot[k + 1, both, :2]
            if turns and both.sum() > 1:
                heading = _turn(here - here.mean(axis=0), there - there.mean(axis=0))
            position = here.mean(axis=0) - _rotated(there.mean(axis=0), heading)
        positions.append(position)
        headings.append(heading)
    return _Ground(np.array(positions), np.unwrap(np.array(headings)))


def _turn(here: Floats, there: Floats) -> float:
    across = float((there[:, 0] * here[:, 1] - there[:, 1] * here[:, 0]).sum())
    return float(np.arctan2(across, float((here * there).sum())))


def _rotated(vector: Floats, heading: float) -> Floats:
    cosine, sine = np.cos(heading), np.sin(heading)
    return np.array([cosine * vector[0] - sine * vector[1], sine * vector[0] + cosine * vector[1]])


def _interval(durations: Floats) -> tuple[float, tuple[str, ...]]:
    """Time between waypoints, and what had to be assumed: the robot ignores durations, a timeline is even."""
    longest, shortest = float(durations.max()), float(durations.min())
    if shortest > 0 and longest - shortest <= SAME_DURATION:
        return float(durations[0]), ()
    given = durations[durations > 0]
    interval = float(np.median(given)) if given.size else USUAL_INTERVAL
    return interval, (
        f"The durations are {shortest:g} to {longest:g} s, and a timeline is even: each waypoint takes "
        f"{interval:g} s here. The robot ignores durations anyway.",
    )
