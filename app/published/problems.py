"""Simulation problems of the published gaits: ours one waypoint a sample, theirs as they were sent."""

from dataclasses import replace

from app.learning.published_trials import problem_within_range
from app.published.reference import Reference, read_published
from app.simulation.problem import way_problem
from core.errors import InputError
from core.library.library import library
from core.motion.contact_timeline import timeline_from_order
from core.motion.trajectory import Trajectory
from core.physics.parameters import PhysicsSet
from core.physics.problem import SimulationProblem
from core.robot.model import RobotModel, load_robot
from core.wire.trajectory_csv import parse_trajectory_csv
from core.wire.waypoint_merging import plan_waypoints


def walker() -> RobotModel:
    """The published robot."""
    return load_robot("deltawalker")


def own_problem(motion: Trajectory, physics: PhysicsSet) -> SimulationProblem:
    """A motion with one waypoint a sample, as the published ones were run."""
    model = walker()
    return way_problem(model, motion, plan_waypoints(model, motion), physics)


def published_problem(
    reference: Reference, gait: str, step: float, physics: PhysicsSet, iterations: int = 1
) -> tuple[SimulationProblem, float]:
    """A published trajectory as the published program sent it, and the most that it cut off a stroke, m.

    Args:
        reference: the published data.
        gait: name of a gait of the library.
        step: m.
        physics: the parameters.
        iterations: of the trajectory itself; 3 for the motions of T Table 6.1.

    Raises:
        InputError: the file is missing or is no such trajectory.
        UnreachableError: a foot cannot go where the file wants it.
    """
    model = walker()
    path = reference.trajectory_path(gait, step, iterations)
    motion = parse_trajectory_csv(read_published(path), str(path)).trajectory
    order = library()[gait].gait.order
    timeline = timeline_from_order(model.leg_count, order, closing_knots=0, iterations=iterations)
    if motion.contact.shape != timeline.stance.T.shape:
        count, legs = motion.contact.shape
        raise InputError(
            f"{path} has {count} columns and {legs} feet; {timeline.stance.shape[1]} columns and "
            f"{model.leg_count} feet are expected. Take the file from the published data.",
            str(path),
        )
    motion = replace(motion, contact=timeline.stance.T)
    return problem_within_range(model, motion, physics)
