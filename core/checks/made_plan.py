"""The motion that a robot with shared motors makes where another one is planned.

Strokes are made as h = C·u (`core.robot.coupled_strokes`), the robot rests on the feet that then reach the
ground, and friction moves its body (`core.physics.quasi_static`).
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from core.arrays import Bools, Floats, first_highest, interpolated, stretches
from core.checks.ground import CLEARANCE_LIMIT, SLIP_LIMIT
from core.findings import TOLERANCE
from core.gait.held_feet import feet_words
from core.gait.options import GaitOptions
from core.motion.trajectory import Trajectory
from core.motion.way_made import WayMade, way_made
from core.physics.quasi_static import QuasiStaticMotion, quasi_static_motion
from core.problem.motion_check import check_motion
from core.problem.motion_problem import MotionProblem
from core.robot.coupled_strokes import real_strokes
from core.robot.kinematics import free_strokes
from core.robot.model import RobotModel
from core.wire.waypoint_merging import WaypointPlan, plan_waypoints
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


def made_poses(model: RobotModel, waypoints: Waypoints, knots: NDArray[np.int64], times: Floats) -> MadePoses:
    """What is made of waypoints (count,) that are at knots and times of a plan."""
    motion = quasi_static_motion(model, waypoints)
    places = np.interp(np.arange(len(motion.moves)), motion.reached, times)
    return MadePoses(motion, knots[motion.moves], places)


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


def made_plan(model: RobotModel, trajectory: Trajectory, way: WaypointPlan | None = None) -> MadePlan:
    """Sets a robot on the way of a plan.

    Args:
        model: the robot.
        trajectory: what is planned.
        way: what is sent of it; None for what a new gait sends.

    Raises:
        UnreachableError: a foot lies outside the workspace.
    """
    if way is None:
        way = plan_waypoints(model, trajectory, GaitOptions.merge, GaitOptions.stop_bound)
    knots = np.array(way.kept)
    poses = made_poses(model, way.waypoints, knots, way.times)
    at_end, on_way = _planned_contact(trajectory.contact, knots)
    contact = on_way[poses.motion.moves]
    contact[poses.motion.reached] = at_end
    return MadePlan(model, trajectory, poses, contact)


def _planned_contact(planned: Bools, knots: NDArray[np.int64]) -> tuple[Bools, Bools]:
    """(count, legs) feet that should stand at each waypoint, and all along the move to it.

    Args:
        planned: (n, legs) at each knot.
        knots: (count,) with which each waypoint's move ends; the same for all parts of a cut move.
    """
    distinct = np.unique(knots)
    starts = distinct[np.maximum(np.searchsorted(distinct, knots) - 1, 0)]
    ways = zip(starts.tolist(), knots.tolist(), strict=True)
    on_way = np.array([planned[start : end + 1].all(axis=0) for start, end in ways])
    is_last = np.append(knots[1:] != knots[:-1], True)
    return np.where(is_last[:, None], planned[knots], on_way), on_way


def missed_strokes(model: RobotModel, trajectory: Trajectory) -> Floats:
    """(n, legs, 3) h − C·u: by how much each planned stroke is longer than the one that is made, m."""
    wanted = free_strokes(model, trajectory.feet_world, trajectory.pose(model))
    return wanted - real_strokes(model, wanted)


def is_made(model: RobotModel, trajectory: Trajectory) -> bool:
    """Whether a robot's motors make a motion as it is; they do where none share an actuator."""
    return not model.is_coupled or _most_missed(model, trajectory) <= TOLERANCE


def is_confirmed(problem: MotionProblem, motion: Trajectory) -> bool:
    """Whether the checker confirms a motion, and the robot's motors make it."""
    return check_motion(problem, motion).confirmed and is_made(problem.model, motion)


def unmade_words(model: RobotModel, trajectory: Trajectory) -> str:
    """Why a robot makes another motion than this, and which; nothing where it makes this one."""
    return "" if is_made(model, trajectory) else other_motion_words(made_plan(model, trajectory))


def other_motion_words(made: MadePlan) -> str:
    """Why a robot makes another motion than the planned one, and which."""
    missed = _most_missed(made.model, made.trajectory) * 1000
    return (
        f"This motion needs {made.model.motor_count} independent motors. The robot has "
        f"{made.model.actuator_count}, and misses strokes by up to {missed:.1f} mm. The robot makes another "
        f"motion: {made_words(made)}"
    )


def _most_missed(model: RobotModel, trajectory: Trajectory) -> float:
    return float(np.abs(np.nan_to_num(missed_strokes(model, trajectory))).max())


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
