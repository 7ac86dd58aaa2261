"""A slow move of the body between two poses while every foot stands still, or is held in the air."""

from bisect import bisect_left
from dataclasses import dataclass, replace

import numpy as np

from core.arrays import Bools, Floats
from core.errors import InfeasibleError
from core.motion.contact_timeline import MAX_SAMPLES
from core.motion.speeds import motor_accelerations
from core.motion.support_polygon import polygon_margin, support_polygon, trajectory_pressure
from core.motion.trajectory import Trajectory
from core.problem.initial_guess import standing_forces
from core.problem.motion_check import TOLERANCE
from core.problem.motion_problem import MotionLimits, raised_feet
from core.robot.kinematics import actuator_plane_pose, free_strokes
from core.robot.model import RobotModel


@dataclass(frozen=True, eq=False)
class BodyPlace:
    """Where the body is: centre of mass (3,) in the world, m, and heading, rad."""

    body_world: Floats
    heading: float


def body_move(
    model: RobotModel,
    start: BodyPlace,
    goal: BodyPlace,
    feet_world: Floats,
    limits: MotionLimits,
    sample_time: float,
) -> Trajectory:
    """Moves the body from rest to rest on standing feet in as few knots as the limits allow.

    The way is a straight line with speeds v(k) ∝ u(1 − u), u = k/K, and positions that follow from them by
    p(k+1) = p(k) + dt·(v(k) + v(k+1))/2, as in every motion that is solved.

    Args:
        model: the robot.
        start: of the body.
        goal: of the body.
        feet_world: (legs, 3) platforms, which stay where they are, on the ground or held above it, m.
        limits: of which those on speeds, motor acceleration, friction and margin are kept.
        sample_time: between knots, s.

    Raises:
        InfeasibleError: a foot is out of reach on the way, or the move would take too long.
    """
    counts = range(2, MAX_SAMPLES)

    def with_intervals(intervals: int) -> Trajectory:
        return _move(start, goal, feet_world, intervals, sample_time)

    slowest = with_intervals(counts[-1])
    way = (
        f"{(goal.body_world[2] - start.body_world[2]) * 1000:+.1f} mm in height and turn "
        f"{np.degrees(goal.heading - start.heading):+.1f}° over its standing feet"
    )
    if np.isnan(_strokes(model, slowest)).any():
        raise InfeasibleError(
            f"The body cannot move {way}: a foot is out of reach on the way. Bring both body heights closer "
            "together.",
            "sequence",
        )
    if not _keeps(model, slowest, limits):
        raise InfeasibleError(
            f"The body would move {way} for more than {MAX_SAMPLES} samples of {sample_time:g} s to keep the "
            "limits of the sequence. Allow more speed or acceleration or less margin between its parts, or "
            "bring both body heights closer together.",
            "sequence",
        )
    # The more intervals, the slower: the fewest are found by halving.
    fewest = bisect_left(counts, True, key=lambda count: _keeps(model, with_intervals(count), limits))
    found = with_intervals(counts[fewest])
    forces = standing_forces(model, found.body_world, found.feet_world, found.contact)
    return replace(found, contact_forces=forces)


def _move(start: BodyPlace, goal: BodyPlace, feet: Floats, intervals: int, sample_time: float) -> Trajectory:
    u = np.linspace(0.0, 1.0, intervals + 1)
    speed = u * (1.0 - u)
    speed /= sample_time * speed.sum()
    share = np.append(0.0, np.cumsum(sample_time * (speed[1:] + speed[:-1]) / 2))
    way = goal.body_world - start.body_world
    body = start.body_world + share[:, None] * way
    standing = np.repeat(feet[None], intervals + 1, axis=0)
    contact: Bools = np.tile(~raised_feet(feet), (intervals + 1, 1))
    return Trajectory(
        times=np.asarray(np.arange(intervals + 1) * sample_time, dtype=np.float64),
        body_world=body,
        heading=start.heading + share * (goal.heading - start.heading),
        feet_world=standing,
        contact=contact,
        body_velocity=speed[:, None] * way,
        feet_velocity=np.zeros_like(standing),
    )


def _strokes(model: RobotModel, motion: Trajectory) -> Floats:
    """(n, legs, 3) strokes, limits left aside, m; nan where no rod is that long."""
    pose = actuator_plane_pose(model, motion.body_world, motion.heading)
    return free_strokes(model, motion.feet_world, pose)


def _keeps(model: RobotModel, motion: Trajectory, limits: MotionLimits) -> bool:
    """Whether a move keeps the limits; no larger margin is asked than its ends have."""
    places, seconds = motion.body_world, motion.times[1]
    motor = np.abs(np.diff(_strokes(model, motion), axis=0)).max() / seconds
    body = np.linalg.norm(np.diff(places, axis=0), axis=1).max() / seconds
    pressure = trajectory_pressure(model, motion)
    # Sideways force by load, which all feet can share alike: it shifts the centre of pressure by this much
    # of the body's height.
    friction = (np.linalg.norm(pressure - places[:-1, :2], axis=1) / places[:-1, 2]).max()
    held = [
        (motor, min(model.stroke.speed, limits.motor_speed or np.inf)),
        (body, limits.body_speed),
        (friction, limits.friction or np.inf),
    ]
    if limits.motor_acceleration is not None:
        held.append((motor_accelerations(model, motion).max(), limits.motor_acceleration))
    # The centre of pressure stays on a line and the polygon is convex: the ends of that line are nearest to
    # its edge.
    along = pressure @ (places[-1] - places[0])[:2]
    polygon = support_polygon(motion.feet_world[0, motion.contact[0], :2])
    points = pressure[along.argmin()], pressure[along.argmax()], *places[[0, -1], :2]
    first, last, *at_rest = (polygon_margin(polygon, point) for point in points)
    held.append((min(limits.margin, *at_rest), min(first, last)))
    return all(value <= limit + TOLERANCE for value, limit in held)
