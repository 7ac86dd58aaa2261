"""The transition between two motions whose feet differ: steps, as a motion problem of its own."""

from dataclasses import dataclass

import numpy as np

from core.arrays import Bools
from core.gait.options import GaitOptions
from core.motion.contact_timeline import ContactTimeline
from core.motion.heading_profile import eased
from core.motion.trajectory import Trajectory
from core.problem.initial_guess import closed_contact
from core.problem.motion_problem import MotionProblem, RestPose, raised_feet, turned_about_z
from core.problem.start_footholds import Placed, Placement
from core.robot.model import RobotModel


@dataclass(frozen=True, eq=False)
class FeetTransition:
    """Steps from where one motion ends to where the next begins.

    Args:
        problem: from the place where the body stands, at heading 0.
        placement: of that place in the world.
    """

    problem: MotionProblem
    placement: Placement


def feet_transition(
    model: RobotModel, standing: Trajectory, then: Placed, options: GaitOptions
) -> FeetTransition:
    """The feet that do not stand where the next motion begins step there, one after the other.

    Those that were held up and stand then come down first; those that are held up then are lifted last.

    Args:
        model: the robot.
        standing: the motion before.
        then: the motion that follows.
        options: limits and phase lengths of the steps.
    """
    angle, origin = float(standing.heading[-1]), np.append(standing.body_world[-1, :2], 0.0)
    here = RestPose(
        turned_about_z(standing.body_world[-1] - origin, -angle),
        turned_about_z(standing.feet_world[-1] - origin, -angle),
    )
    feet = turned_about_z(then.motion.feet_world[0] - origin, -angle)
    goal = RestPose(
        turned_about_z(then.motion.body_world[0] - origin, -angle),
        np.where(then.stays[:, None], here.feet_world, feet),
    )
    sample_time = float(standing.times[1] - standing.times[0])
    up = raised_feet(here.feet_world), raised_feet(goal.feet_world)
    timeline = _timeline(then.stays, up, options, sample_time)
    turn = float(then.motion.heading[0]) - angle
    problem = MotionProblem(
        model=model,
        timeline=timeline,
        start=here,
        goal=goal,
        limits=options.motion_limits(float(p.body_world[2]) - model.com_height for p in (here, goal)),
        cost=options.cost,
        heading_profile=turn * eased(np.linspace(0.0, 1.0, timeline.sample_count)),
    )
    return FeetTransition(problem, Placement(angle, origin))


def _timeline(
    stays: Bools, up: tuple[Bools, Bools], options: GaitOptions, sample_time: float
) -> ContactTimeline:
    """Before each step all feet stand that can, and after the last one.

    Args:
        stays: (legs,) feet that are where they have to be.
        up: (legs,) which are held up before the steps, and after them.
        options: phase lengths.
        sample_time: s.
    """
    before, after = up
    steps = ~stays & ~(before & after)
    # Feet come down, step, and are lifted in this order, so that most stand meanwhile.
    turns = np.lexsort((np.arange(len(stays)), after, ~before))
    turns = turns[steps[turns]]
    knots, closing = options.phase_knots, max(options.closing_knots, 1)
    stance = np.ones((len(stays), 2 * knots * max(len(turns), 1) + closing), dtype=np.bool_)
    stance[before & after] = False
    for turn, foot in enumerate(turns):
        first = (2 * turn + 1) * knots
        stance[foot, 0 if before[foot] else first : None if after[foot] else first + knots] = False
    return ContactTimeline(stance, np.zeros_like(stance), sample_time)


def straight(problem: MotionProblem) -> Trajectory:
    """The ends and the contact of a problem's motion without solving it: between them all goes straight."""
    share = np.linspace(0.0, 1.0, problem.knot_count)
    start, goal = problem.start, problem.goal
    return Trajectory(
        times=problem.times,
        body_world=start.body_world + share[:, None] * (goal.body_world - start.body_world),
        heading=problem.heading,
        feet_world=start.feet_world + share[:, None, None] * (goal.feet_world - start.feet_world),
        contact=closed_contact(problem),
    )
