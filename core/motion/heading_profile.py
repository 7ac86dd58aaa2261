"""The heading profile: how the body turns about z during a gait. It is given, not optimised."""

from enum import StrEnum

import numpy as np

from core.arrays import Bools, Floats
from core.errors import InputError
from core.motion.contact_timeline import ContactTimeline
from core.robot.kinematics import BodyPose, UnreachableError, walker_strokes
from core.robot.model import RobotModel

MOST_RETURN_KNOTS = 60
"""More knots than any return within reach needs."""


class HeadingProfile(StrEnum):
    """When a gait with yaw turns the body."""

    STEADY = "steady"
    """From the first knot to the last, gently at both ends."""
    RETURN = "return"
    """After each iteration, while every foot stands (rotation in place, docs/sources.md) or is held up
    throughout."""


def heading_profile(
    timeline: ContactTimeline, yaw: float, iterations: int, turning: HeadingProfile
) -> Floats:
    """(n,) heading at each knot, rad.

    Args:
        timeline: contact of all iterations.
        yaw: turn an iteration, rad.
        iterations: how often every foot steps.
        turning: when the body turns.

    Raises:
        InputError: no stance of all feet follows the last swing, in which the body could turn.
    """
    n = timeline.sample_count
    if turning is HeadingProfile.STEADY:
        return yaw * iterations * eased(np.linspace(0.0, 1.0, n))
    heading = np.zeros(n)
    spans = _resting_spans(timeline, iterations)
    for first, last in spans:
        turn = yaw * iterations / len(spans)
        heading[first : last + 1] += turn * eased(np.linspace(0.0, 1.0, last - first + 1))
        heading[last + 1 :] += turn
    return heading


def return_knots(model: RobotModel, yaw: float, plane_height: float, sample_time: float, least: int) -> int:
    """Knots of the closing stance in which the body turns back over its feet as fast as the motors allow.

    Args:
        model: the robot, for the motors' speed.
        yaw: turn, rad.
        plane_height: actuator plane above the platforms of standing feet, m.
        sample_time: time between knots, s.
        least: fewest knots.
    """
    feet = model.module_centres_robot
    for knots in range(max(least, 3), MOST_RETURN_KNOTS):
        heading = yaw * (eased(np.linspace(0.0, 1.0, knots)) - 1.0)
        pose = BodyPose(np.tile([0.0, 0.0, plane_height], (knots, 1)), heading)
        try:
            strokes = walker_strokes(model, np.tile(feet, (knots, 1, 1)), pose)
        except UnreachableError:
            return least
        fastest = float(np.abs(np.diff(strokes, axis=0)).max()) / sample_time
        sideways = model.radius * float(np.abs(np.diff(heading)).max()) / sample_time
        if max(fastest, sideways) <= model.stroke.speed:
            return knots
    return least


def eased(share: Floats) -> Floats:
    """0 to 1 with no speed at either end: 3s² − 2s³."""
    return np.asarray(share**2 * (3.0 - 2.0 * share))


def _resting_spans(timeline: ContactTimeline, iterations: int) -> list[tuple[int, int]]:
    """First and last knot of the stance after each iteration, or after the last one only."""
    # Feet that are held up throughout take no part in it.
    walking: Bools = np.asarray(timeline.stance.any(axis=1), dtype=np.bool_)
    swings = [swing for swing in timeline.swings() if walking[swing.foot]]
    resting = np.append(timeline.stance[walking, :-1].all(axis=0), True)
    own = [[s.last for s in swings if s.foot == foot] for foot in np.nonzero(walking)[0]]
    counted = all(len(ends) == iterations for ends in own)
    groups = np.array(own).T if counted else np.array([[max((s.last for s in swings), default=-1)]])
    spans = []
    for ends in groups:
        first = int(ends.max()) + 1
        following = np.nonzero(~resting[first:])[0]
        last = first + int(following[0]) - 1 if len(following) else timeline.sample_count - 1
        if last - first < 2:
            raise InputError(
                "The body turns while every foot stands, but the stance after the last swing has "
                f"{max(last - first + 1, 0)} samples; it needs at least 3. Lengthen the final stance.",
                "closing_knots",
            )
        spans.append((first, last))
    return spans
