"""A motion over time in the world frame."""

from dataclasses import dataclass, replace

import numpy as np

from core.arrays import FARTHEST, Bools, Floats, frozen_bools, frozen_floats
from core.errors import InputError
from core.robot.kinematics import BodyPose, actuator_plane_pose, walker_strokes
from core.robot.model import RobotModel

LONGEST, SHORTEST_INTERVAL = 1e6, 1e-6
"""A motion's last time is no later, and its samples are no nearer to each other, s."""
FASTEST = FARTHEST / SHORTEST_INTERVAL
"""Speeds beyond this are none between two samples, m/s."""
STRONGEST = 1e10
"""Contact forces are below this, N: a search that finds no motion ends at one with forces of no robot."""


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Body and feet at each knot.

    The world's z = 0 is the platform height of a standing foot (the floor lies `sole_depth` lower), and the
    body's position is its centre of mass.

    Args:
        times: (n,) s, increasing.
        body_world: (n, 3) centre of mass, m.
        heading: (n,) turn of the body about z, rad.
        feet_world: (n, legs, 3) platform centres, m.
        contact: (n, legs) true where a foot stands.
        body_velocity: (n, 3) m/s, or None where unknown.
        feet_velocity: (n, legs, 3) m/s, or None where unknown.
        contact_forces: (n, legs, 3) force of the ground on each foot, N, or None where unknown.
    """

    times: Floats
    body_world: Floats
    heading: Floats
    feet_world: Floats
    contact: Bools
    body_velocity: Floats | None = None
    feet_velocity: Floats | None = None
    contact_forces: Floats | None = None

    def __post_init__(self) -> None:
        times = frozen_floats(self.times, (None,), "times", LONGEST)
        n = times.shape[0]
        if n < 2 or (np.diff(times) < SHORTEST_INTERVAL).any():
            raise InputError(
                "A trajectory needs at least two samples with increasing times, at least "
                f"{SHORTEST_INTERVAL:g} s apart.",
                "times",
            )
        feet = frozen_floats(self.feet_world, (n, None, 3), "feet", FARTHEST)
        legs = feet.shape[1]
        shapes = {
            "body_world": (n, 3),
            "heading": (n,),
            "body_velocity": (n, 3),
            "feet_velocity": (n, legs, 3),
            "contact_forces": (n, legs, 3),
        }
        mosts = {"body_velocity": FASTEST, "feet_velocity": FASTEST, "contact_forces": STRONGEST}
        object.__setattr__(self, "times", times)
        object.__setattr__(self, "feet_world", feet)
        object.__setattr__(self, "contact", frozen_bools(self.contact, (n, legs), "contact"))
        for name, shape in shapes.items():
            values = getattr(self, name)
            if values is not None:
                most = mosts.get(name, FARTHEST)
                object.__setattr__(self, name, frozen_floats(values, shape, name, most))

    @property
    def knot_count(self) -> int:
        """Number of knots."""
        return int(self.times.shape[0])

    @property
    def leg_count(self) -> int:
        """Number of feet."""
        return int(self.feet_world.shape[1])

    def pose(self, model: RobotModel) -> BodyPose:
        """The robot's frame at each knot."""
        return actuator_plane_pose(model, self.body_world, self.heading)

    def strokes(self, model: RobotModel) -> Floats:
        """(n, legs, 3) motor strokes, m.

        Raises:
            UnreachableError: a foot lies outside the workspace.
        """
        self.require_feet_of(model)
        return walker_strokes(model, self.feet_world, self.pose(model))

    def require_feet_of(self, model: RobotModel) -> None:
        """The motion is of a robot with as many feet.

        Raises:
            InputError: it is not.
        """
        if self.leg_count != model.leg_count:
            raise InputError(
                f"The trajectory has {self.leg_count} feet, the robot {model.leg_count}.", "trajectory"
            )


def difference_velocities(times: Floats, positions: Floats) -> Floats:
    """Velocities by central differences, one-sided at the ends.

    Args:
        times: (n,) s.
        positions: (n, ...) m.

    Returns:
        (n, ...) m/s.
    """
    return np.asarray(np.gradient(positions, times, axis=0))


def turned_about_body(trajectory: Trajectory, angle: Floats) -> Trajectory:
    """The body where it is, with its heading and its feet turned about it; the strokes stay the same.

    With p the place of a foot and v its speed, b and u those of the body, R the turn by the angle a:
    p' = b + R (p - b), v' = u + R (v - u) + da/dt z x (p' - b).

    Args:
        trajectory: the motion.
        angle: (n,) turn at each knot, rad; where it is 0 the feet's places stay the same to the last bit.
    """
    body, rate = trajectory.body_world[:, None], np.gradient(angle, trajectory.times)[:, None, None]

    def turned(vectors: Floats) -> Floats:
        x, y, z = np.moveaxis(vectors, -1, 0)
        cosine, sine = np.cos(angle)[:, None], np.sin(angle)[:, None]
        return np.stack([cosine * x - sine * y, sine * x + cosine * y, z], axis=-1)

    def where_turned(after: Floats, before: Floats, changes: Bools) -> Floats:
        return np.where(changes[:, None, None], after, before)

    is_turned = np.asarray(angle != 0.0)
    arms = turned(trajectory.feet_world - body)
    velocity, forces = trajectory.feet_velocity, trajectory.contact_forces
    if velocity is not None:
        along = trajectory.body_velocity
        if along is None:
            along = difference_velocities(trajectory.times, trajectory.body_world)
        along = along[:, None]
        across = np.stack([-arms[..., 1], arms[..., 0], np.zeros_like(arms[..., 0])], axis=-1)
        moved = along + turned(velocity - along) + rate * across
        velocity = where_turned(moved, velocity, is_turned | (rate[:, 0, 0] != 0.0))
    return replace(
        trajectory,
        heading=trajectory.heading + angle,
        feet_world=where_turned(body + arms, trajectory.feet_world, is_turned),
        feet_velocity=velocity,
        contact_forces=None if forces is None else where_turned(turned(forces), forces, is_turned),
    )


def quarter_turn(quarter_turns: int) -> Floats:
    """(3, 3) rotation about z by 90° a turn, without rounding."""
    cosine, sine = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)][quarter_turns % 4]
    return np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])


def turn_trajectory(trajectory: Trajectory, quarter_turns: int) -> Trajectory:
    """The same motion turned about the world's z by 90° a turn, its feet handed on to the next legs.

    A robot with a multiple of four legs in an even ring maps onto itself under such a turn.
    """
    rotation = quarter_turn(quarter_turns)
    shift = (quarter_turns % 4) * trajectory.leg_count // 4

    def turned(vectors: Floats | None) -> Floats | None:
        return None if vectors is None else np.asarray(vectors @ rotation.T)

    def handed_on(vectors: Floats | None) -> Floats | None:
        rotated = turned(vectors)
        return None if rotated is None else np.roll(rotated, shift, axis=1)

    return Trajectory(
        times=trajectory.times,
        body_world=trajectory.body_world @ rotation.T,
        heading=trajectory.heading,
        feet_world=np.roll(trajectory.feet_world @ rotation.T, shift, axis=1),
        contact=np.roll(trajectory.contact, shift, axis=1),
        body_velocity=turned(trajectory.body_velocity),
        feet_velocity=handed_on(trajectory.feet_velocity),
        contact_forces=handed_on(trajectory.contact_forces),
    )
