"""Constraints on single unknowns: boundary, heights, standing feet, contact forces, clearance."""

from dataclasses import dataclass

import numpy as np

from core.problem.initial_guess import clearance_knot, standing_forces
from core.problem.motion_problem import GROUNDED_HEIGHT, RestPose
from core.problem.motion_problem import Boundary as Ends
from core.problem.swing_height import held_knots, is_held, rest_heights
from solver_jobs.nlp.constraint import Box, Family, Situation


@dataclass(frozen=True)
class Boundary:
    """Start and goal: x_1 = x_ic, x_N = x_g, both at rest, (3.5) and (3.6).

    The forces of the last knot act on no interval; they are those of resting at the goal. Of a cycle's states
    only the body's first place on the ground and the height of held feet are fixed here;
    `rows_motion.ClosedCycle` ties the ends together.
    """

    family: Family = Family.BOUNDARY

    def tighten(self, box: Box, situation: Situation) -> None:
        """Fixes the first and the last knot."""
        problem = situation.problem
        last = standing_forces(
            problem.model,
            problem.goal.body_world[None],
            problem.goal.feet_world[None],
            situation.contact[-1:],
        )
        for side in (box.lower, box.upper):
            side.force[-1] = last[0]
            if problem.boundary is Ends.PERIODIC:
                side.position[0, 0, :2] = problem.start.body_world[:2]
                held = problem.held_start
                side.position[0, 1:, 2][held] = problem.start.feet_world[held, 2]
                continue
            side.position[0] = _points(problem.start)
            side.position[-1] = _points(problem.goal)
            side.velocity[[0, -1]] = 0.0


def _points(pose: RestPose) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    return np.concatenate([pose.body_world[None], pose.feet_world])


@dataclass(frozen=True)
class BodyHeight:
    """Actuator plane between its bounds, (3.8): 0.053 ≤ p_z^(b) − com_height ≤ 0.0605 m."""

    family: Family = Family.BODY_HEIGHT

    def tighten(self, box: Box, situation: Situation) -> None:
        """Bounds the body's z at every knot."""
        lowest, highest = situation.problem.limits.plane_height
        com = situation.problem.model.com_height
        _at_least(box.lower.position[:, 0, 2], lowest + com)
        _at_most(box.upper.position[:, 0, 2], highest + com)


@dataclass(frozen=True)
class FootHeight:
    """No foot below the ground, (3.9): p_z^(i) ≥ 0."""

    family: Family = Family.FOOT_HEIGHT

    def tighten(self, box: Box, situation: Situation) -> None:
        """Bounds every foot's z from below."""
        _at_least(box.lower.position[:, 1:, 2], 0.0)


@dataclass(frozen=True)
class GroundedVelocity:
    """Standing feet do not move, (3.11)."""

    family: Family = Family.GROUNDED_VELOCITY

    def tighten(self, box: Box, situation: Situation) -> None:
        """Fixes the velocity of standing feet to 0."""
        standing = situation.contact[..., None]
        _at_least(box.lower.velocity[:, 1:], np.where(standing, 0.0, -np.inf))
        _at_most(box.upper.velocity[:, 1:], np.where(standing, 0.0, np.inf))


@dataclass(frozen=True)
class GroundedHeight:
    """Standing feet stay low, (3.12): p_z^(i) ≤ 0.25 mm."""

    family: Family = Family.GROUNDED_HEIGHT

    def tighten(self, box: Box, situation: Situation) -> None:
        """Bounds the z of standing feet from above."""
        _at_most(box.upper.position[:, 1:, 2], np.where(situation.contact, GROUNDED_HEIGHT, np.inf))


@dataclass(frozen=True)
class FlatLanding:
    """Feet land between swings no higher than they start or end.

    The tolerance of (3.12) is there for numbers' sake. Used to the full, feet of unequal height that push
    against each other without limit would carry a body that hangs outside its support polygon by millimetres
    (2.3 mm in an S-gait of 60 mm), since the model has no friction limit.
    """

    family: Family = Family.GROUNDED_HEIGHT

    def tighten(self, box: Box, situation: Situation) -> None:
        """Bounds the z of each landing but the last, which the goal fixes; of a cycle all, and the start."""
        problem = situation.problem
        ends = ((problem.start, problem.held_start), (problem.goal, problem.held_end))
        highest = np.maximum(*(np.where(held, 0.0, pose.feet_world[:, 2]) for pose, held in ends))
        cycle = problem.boundary is Ends.PERIODIC
        if cycle:
            _at_most(box.upper.position[0, 1:, 2], np.where(problem.held_start, np.inf, highest))
        for swing in situation.swings:
            landing = swing.last + 1
            lands = not rest_heights(problem, swing)[1]
            if lands and (cycle or not situation.contact[landing:, swing.foot].all()):
                _at_most(box.upper.position[landing, 1 + swing.foot, 2:], highest[swing.foot])


@dataclass(frozen=True)
class ContactForce:
    """The ground only pushes, (3.13): λ_z ≥ 0."""

    family: Family = Family.CONTACT_FORCE

    def tighten(self, box: Box, situation: Situation) -> None:
        """Bounds the vertical force of every foot from below at every knot but the last."""
        _at_least(box.lower.force[:-1, :, 2], 0.0)


@dataclass(frozen=True)
class FloatingForce:
    """No ground under a lifted foot, (3.14): λ = 0."""

    family: Family = Family.FLOATING_FORCE

    def tighten(self, box: Box, situation: Situation) -> None:
        """Fixes the force on swinging feet to 0 at every knot but the last."""
        floating = ~situation.contact[:-1, :, None]
        _at_least(box.lower.force[:-1], np.where(floating, 0.0, -np.inf))
        _at_most(box.upper.force[:-1], np.where(floating, 0.0, np.inf))


@dataclass(frozen=True)
class Clearance:
    """The middle knot of each swing is lifted; without it the optimum drags its feet.

    A foot that is held up at an end is as high as that up to where it comes down, or from where it has risen.
    """

    family: Family = Family.CLEARANCE

    def tighten(self, box: Box, situation: Situation) -> None:
        """Bounds the z of each swing's middle knot from below, and of a held foot's knots."""
        problem = situation.problem
        for swing in situation.swings:
            if is_held(problem, swing):
                knots, height = held_knots(problem, swing)
            else:
                knot, height = clearance_knot(swing, problem.intervals), problem.limits.clearance
                knots = range(knot, knot + 1)
            _at_least(box.lower.position[knots.start : knots.stop, 1 + swing.foot, 2], height)


Values = np.ndarray[tuple[int, ...], np.dtype[np.float64]]


def _at_least(lower: Values, values: Values | float) -> None:
    np.maximum(lower, values, out=lower)


def _at_most(upper: Values, values: Values | float) -> None:
    np.minimum(upper, values, out=upper)
