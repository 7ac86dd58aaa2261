"""From a recorded motion or a bare timeline to the gait document that describes it."""

from dataclasses import dataclass

import numpy as np

from core.arrays import Floats
from core.errors import InputError
from core.gait.gait import Gait, Orientation, is_drawn
from core.gait.held_feet import HeldFeet, held_sentence
from core.gait.options import LEAST_PHASE_KNOTS, MOST_CLOSING_KNOTS, MOST_PHASE_KNOTS
from core.gait.step import without_rounding
from core.motion.contact_timeline import SAME_INTERVAL, ContactTimeline
from core.motion.trajectory import Trajectory, quarter_turn
from core.robot.model import ROBOT_NAMES, load_robot

STANDING_STILL = 1e-4
"""A body that travels less than this goes nowhere, m."""
RAISED = 0.001
"""A foot that is higher at an end is held up there, m."""
STANDS_AT_LAST = "The last sample is the goal, where every foot stands; it was set to stance."
"""Said where a recorded motion ends with a foot that has just come down (the published ones do)."""


@dataclass(frozen=True)
class DescribedGait:
    """A gait made from something that says less or more than a document.

    Args:
        gait: the document.
        remarks: sentences on what was assumed and what is not part of it.
    """

    gait: Gait
    remarks: tuple[str, ...]


def gait_of_motion(trajectory: Trajectory, name: str, robot: str | None = None) -> DescribedGait:
    """The document of a recorded motion: timeline from its contact, order, direction, step and iterations.

    Args:
        trajectory: the motion, at even intervals.
        name: of the gait.
        robot: the robot of the motion; None for the first one with as many feet.

    Raises:
        InputError: its intervals differ, or no robot here has so many feet.
    """
    intervals = np.diff(trajectory.times)
    uneven = np.nonzero(np.abs(intervals - intervals[0]) > SAME_INTERVAL * intervals[0])[0]
    if uneven.size:
        knot = int(uneven[0])
        raise InputError(
            f"The time from sample {knot + 1} to {knot + 2} is {intervals[knot]:g} s, the first one "
            f"{intervals[0]:g} s; a timeline needs even intervals. Sample the motion evenly.",
            f"sample {knot + 1}",
        )
    stance = np.array(trajectory.contact.T)
    held = _held(trajectory)
    last = np.isin(np.arange(len(stance)) + 1, held.end)
    remarks = (STANDS_AT_LAST,) if (~stance[:, -1] & ~last).any() else ()
    if held.any:
        remarks = (*remarks, held_sentence(held))
    stance[:, -1] = ~last
    timeline = ContactTimeline(stance, np.zeros_like(stance), float(intervals[0]))
    travel = trajectory.body_world[-1] - trajectory.body_world[0]
    turn = float(trajectory.heading[-1] - trajectory.heading[0])
    robot = robot or robot_with(timeline.leg_count)
    return _describe(timeline, (name, robot), (travel[:2], turn), remarks, held)


def _held(trajectory: Trajectory) -> HeldFeet:
    """Feet that are well in the air where the motion begins or ends, and not for that one sample only."""
    floating, heights = ~trajectory.contact, trajectory.feet_world[..., 2]
    start = floating[:2].all(axis=0) & (heights[0] > RAISED)
    end = floating[-2:].all(axis=0) & (heights[-1] > RAISED)
    if start.all() or end.all():
        return HeldFeet()
    first, last = (tuple(int(foot) + 1 for foot in np.nonzero(feet)[0]) for feet in (start, end))
    return HeldFeet(first, last)


def gait_of_timeline(timeline: ContactTimeline, name: str) -> DescribedGait:
    """The document of a bare timeline: it steps on the spot until a person gives it a step.

    Raises:
        InputError: no robot here has so many feet.
    """
    remark = "A timeline does not contain the travel: the step is 0 until you set it."
    return _describe(timeline, (name, robot_with(timeline.leg_count)), (np.zeros(2), 0.0), (remark,))


def _describe(
    timeline: ContactTimeline,
    names: tuple[str, str],
    way: tuple[Floats, float],
    remarks: tuple[str, ...],
    held: HeldFeet | None = None,
) -> DescribedGait:
    """The document of a timeline; `names` are the gait's and the robot's, `way` is travel and turn."""
    travel, turn = way
    held = held or HeldFeet()
    orientation, direction = _heading(travel)
    own_order, iterations, remark = _order(timeline, tuple(foot - 1 for foot in held.both))
    legs = timeline.leg_count
    shift = (direction - 1) * legs // 4
    dx, dy = quarter_turn(1 - direction)[:2, :2] @ travel / iterations
    gait = Gait(
        name=names[0],
        robot=names[1],
        orientation=orientation,
        direction=direction,
        order=tuple((foot - shift) % legs + 1 for foot in own_order),
        step=without_rounding((float(dx), float(dy), turn / iterations)),
        iterations=iterations,
        timeline=timeline,
        notes=" ".join((*remarks, *remark)),
        held=held,
    )
    return DescribedGait(_with_phases(gait), (*remarks, *remark))


def _with_phases(gait: Gait) -> Gait:
    """The gait with the phase lengths by which its timeline is drawn from its order, where it is."""
    held = gait.held.both
    phase = min((swing.first for swing in gait.timeline.swings() if swing.foot + 1 not in held), default=0)
    steps = gait.iterations * (gait.timeline.leg_count - len(held))
    closing = gait.timeline.sample_count - 2 * phase * steps
    if not (LEAST_PHASE_KNOTS <= phase <= MOST_PHASE_KNOTS and 0 <= closing <= MOST_CLOSING_KNOTS):
        return gait
    drawn = gait.with_options(phase_knots=phase, closing_knots=closing)
    return drawn if is_drawn(drawn) else gait


def _heading(travel: Floats) -> tuple[Orientation, int]:
    """Orientation and direction from where the body goes: FB along a diagonal, FBS along an axis."""
    if np.hypot(*travel) < STANDING_STILL:
        return Orientation.FBS, 1
    eighth = round(float(np.arctan2(travel[1], travel[0])) / (np.pi / 4)) % 8
    return (Orientation.FB if eighth % 2 else Orientation.FBS), eighth // 2 + 1


def _order(timeline: ContactTimeline, held: tuple[int, ...]) -> tuple[tuple[int, ...], int, tuple[str, ...]]:
    """Own feet, 0-based, in the order of their first steps; iterations; what had to be assumed.

    Feet that are held up at both ends and never stand come last.
    """
    held = tuple(foot for foot in held if not timeline.stance[foot].any())
    swings = sorted(timeline.swings(), key=lambda swing: (swing.first, swing.foot))
    sequence = [swing.foot for swing in swings if swing.foot not in held]
    order = tuple(dict.fromkeys(sequence))
    still = tuple(foot for foot in range(timeline.leg_count) if foot not in (*order, *held))
    repeats = len(sequence) // len(order) if order else 1
    if still:
        feet = ", ".join(str(foot + 1) for foot in still)
        return order + still + held, 1, (f"Foot {feet} never steps and stands last in the order.",)
    if sequence != list(order) * repeats or repeats > 20:
        return (
            order + held,
            1,
            ("The feet do not step in one order again and again; it is taken as one iteration.",),
        )
    return order + held, repeats, ()


def robot_with(legs: int) -> str:
    """Name of the first robot with so many legs.

    Raises:
        InputError: there is none.
    """
    for robot in ROBOT_NAMES:
        if load_robot(robot).leg_count == legs:
            return robot
    counts = sorted({load_robot(robot).leg_count for robot in ROBOT_NAMES})
    raise InputError(
        f"The motion has {legs} feet; the robots here have {', '.join(map(str, counts))}.", "feet"
    )
