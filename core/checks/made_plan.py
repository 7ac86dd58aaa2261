"""What motors that share actuators make of a plan.

Strokes are made as h = C·u (`core.robot.coupled_strokes`), the robot rests on the feet that then reach the
ground, and friction moves its body (`core.physics.quasi_static`).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from core.arrays import Bools, Floats, first_highest, interpolated, stretches
from core.checks.ground import CLEARANCE_LIMIT, SLIP_LIMIT
from core.findings import TOLERANCE
from core.gait.held_feet import feet_words
from core.motion.trajectory import Trajectory
from core.motion.way_made import WayMade, way_made
from core.physics.quasi_static import QuasiStaticMotion, quasi_static_motion
from core.robot.coupled_strokes import real_strokes
from core.robot.kinematics import free_strokes
from core.robot.model import RobotModel
from core.wire.waypoint_path import waypoints_from_trajectory
from core.wire.waypoints import Waypoints

RULE = "coupling"
"""The name of what shared motors forbid."""


@dataclass(frozen=True)
class RealSwing:
    """How high a foot really rises in one of its swings.

    Args:
        foot: 0-based.
        first: pose with which it begins, 0-based.
        highest: pose at which it is highest.
        rise: height there over the ground, m.
    """

    foot: int
    first: int
    highest: int
    rise: float


@dataclass(frozen=True, eq=False)
class MadePoses:
    """The motion that is made, and where its poses are in a plan.

    Args:
        motion: what is made, in m poses.
        knots: (m,) knot of the plan, or waypoint, to which each pose leads, 0-based.
        times: (m,) the plan's time of each pose, s.
    """

    motion: QuasiStaticMotion
    knots: NDArray[np.int64]
    times: Floats

    def place(self, pose: int) -> dict[str, int | float]:
        """Sample and time of a pose, as a finding names them."""
        return {"sample": int(self.knots[pose]), "time": float(self.times[pose])}

    def at(self, times: Floats, values: Floats) -> Floats:
        """(n, …) of (m, …) values of the poses: those at the plan's times, s."""
        return interpolated(times, self.times, values)


def made_poses(model: RobotModel, waypoints: Waypoints, ends: NDArray[np.int64], times: Floats) -> MadePoses:
    """What is made of waypoints that are at given knots and times of a plan."""
    motion = quasi_static_motion(model, waypoints)
    places = np.interp(np.arange(len(motion.moves)), motion.reached, times)
    return MadePoses(motion, ends[motion.moves], places)


@dataclass(frozen=True, eq=False)
class MadePlan:
    """A plan beside what the robot's motors make of it.

    Args:
        model: the robot.
        trajectory: what is planned.
        poses: what is made.
        contact: (m, legs) feet that should stand.
    """

    model: RobotModel
    trajectory: Trajectory
    poses: MadePoses
    contact: Bools

    @cached_property
    def residual(self) -> Floats:
        """(n, legs, 3) h − C·u: by how much each planned stroke is longer than the one that is made, m."""
        t = self.trajectory
        wanted = free_strokes(self.model, t.feet_world, t.pose(self.model))
        return wanted - real_strokes(self.model, wanted)

    @property
    def is_planned(self) -> bool:
        """Whether what is made is what is planned."""
        return float(np.abs(self.residual).max()) <= TOLERANCE

    @cached_property
    def swings(self) -> tuple[RealSwing, ...]:
        """Every swing with its real height, by foot and then by time."""
        found = []
        for foot in range(self.model.leg_count):
            for first, last in stretches(np.asarray(~self.contact[:, foot])):
                rises = np.nan_to_num(self.poses.motion.heights[first : last + 1, foot])
                highest = int(first_highest(rises))
                found.append(RealSwing(foot, first, first + highest, float(rises[highest])))
        return tuple(found)

    @property
    def dragged(self) -> tuple[RealSwing, ...]:
        """Swings in which a foot does not lift."""
        return tuple(swing for swing in self.swings if swing.rise < CLEARANCE_LIMIT - TOLERANCE)

    @cached_property
    def slides(self) -> tuple[Floats, list[int]]:
        """(legs,) longest way that each foot slides in one stance, m, and the pose after most of it."""
        legs = self.model.leg_count
        longest, worst = np.zeros(legs), [0] * legs
        for foot in range(legs):
            for first, last in stretches(self.contact[:, foot]):
                slid = self.poses.motion.slides[first : last + 1, foot]
                if slid.sum() > longest[foot]:
                    longest[foot], worst[foot] = slid.sum(), first + int(first_highest(slid))
        return longest, worst

    @cached_property
    def way(self) -> WayMade:
        """How much of way and turn is made."""
        t, motion = self.trajectory, self.poses.motion
        columns = np.concatenate([t.feet_world[..., :2].mean(axis=1), t.heading[:, None]], axis=1)
        planned = interpolated(self.poses.times, t.times, columns)
        heading = planned[:, 2]
        cosine, sine = np.cos(heading[0]), np.sin(heading[0])
        middles = motion.middles @ np.array([[cosine, sine], [-sine, cosine]])
        return way_made((planned[:, :2], heading), (middles, motion.headings))


def made_plan(
    model: RobotModel,
    trajectory: Trajectory,
    waypoints: Waypoints | None = None,
    kept: Sequence[int] | None = None,
) -> MadePlan:
    """Sets a robot on the way of a plan.

    Args:
        model: the robot.
        trajectory: what is planned.
        waypoints: what is sent of it; None for one a knot.
        kept: (count,) the knot with which the move to each waypoint ends; None for every knot.

    Raises:
        UnreachableError: a foot lies outside the workspace.
    """
    if waypoints is None:
        waypoints = waypoints_from_trajectory(model, trajectory)
    ends = np.arange(trajectory.knot_count) if kept is None else np.asarray(kept)
    poses = made_poses(model, waypoints, ends, trajectory.times[ends])
    moves, planned = poses.motion.moves, trajectory.contact[ends]
    contact = planned[moves] & planned[np.maximum(moves - 1, 0)]
    contact[poses.motion.reached] = planned
    return MadePlan(model, trajectory, poses, np.asarray(contact))


def is_made(model: RobotModel, trajectory: Trajectory) -> bool:
    """Whether a robot's motors make a motion as it is; they do where none share an actuator."""
    return not model.is_coupled or made_plan(model, trajectory).is_planned


def unmade_words(model: RobotModel, trajectory: Trajectory) -> str:
    """Why a robot makes another motion than this, and which; nothing where it makes this one."""
    if not model.is_coupled:
        return ""
    made = made_plan(model, trajectory)
    return "" if made.is_planned else other_motion_words(made)


def other_motion_words(made: MadePlan) -> str:
    """Why a robot makes another motion than the planned one, and which, in two sentences."""
    model, off = made.model, float(np.abs(made.residual).max())
    return (
        f"Every stroke is free in this motion, but {model.actuator_count} motors drive the "
        f"{model.motor_count} strokes, which are up to {off * 1000:.1f} mm off. The robot makes another "
        f"motion: {made_words(made)}"
    )


def made_words(made: MadePlan) -> str:
    """How far the robot goes, and which feet slide and do not lift, in a sentence."""
    parts = [_way_words(made.way)]
    slides = made.slides[0]
    if sliding := tuple((np.nonzero(slides > SLIP_LIMIT + TOLERANCE)[0] + 1).tolist()):
        verb = "slide" if len(sliding) > 1 else "slides"
        parts.append(f"{feet_words(sliding)} {verb} by up to {slides.max() * 1000:.1f} mm while standing")
    if dragged := tuple(sorted({swing.foot + 1 for swing in made.dragged})):
        parts.append(f"{feet_words(dragged)} {'do' if len(dragged) > 1 else 'does'} not lift")
    elif made.swings:
        parts.append(f"every foot lifts, by {min(swing.rise for swing in made.swings) * 1000:.1f} mm or more")
    return f"{'; '.join(parts)}."


def _way_words(way: WayMade) -> str:
    words = []
    if way.asked:
        words.append(f"it goes {way.made * 1000:.1f} of {way.asked * 1000:.1f} mm")
    if way.asked_turn:
        words.append(f"it turns {np.degrees(way.made_turn):.1f} of {np.degrees(way.asked_turn):.1f}°")
    return " and ".join(words) or f"it ends {way.gap * 1000:.1f} mm from where it should"
