"""The short lists that make up the problem."""

from core.problem.footholds import is_level
from core.problem.motion_problem import Boundary as Ends
from core.problem.motion_problem import MotionProblem, Workspace
from core.robot.shoes import least_distance
from solver_jobs.nlp.bounds import (
    BodyHeight,
    Boundary,
    Clearance,
    ContactForce,
    FlatLanding,
    FloatingForce,
    FootHeight,
    GroundedHeight,
    GroundedVelocity,
)
from solver_jobs.nlp.constraint import BoundConstraint, Box, Family, RowConstraint, Situation, open_box
from solver_jobs.nlp.rows_forces import BodyTorque, Friction
from solver_jobs.nlp.rows_motion import BodySpeed, ClosedCycle, FootSpeed, ForceBalance, Integration
from solver_jobs.nlp.rows_motors import MotorAcceleration, MotorSpeed
from solver_jobs.nlp.rows_reach import CylinderDisc, CylinderHeight, StabilityMargin, StrokeLower, StrokeUpper
from solver_jobs.nlp.rows_shoes import ShoeDistance

BOUND_CONSTRAINTS: tuple[BoundConstraint, ...] = (
    Boundary(),
    BodyHeight(),
    FootHeight(),
    GroundedVelocity(),
    GroundedHeight(),
    FlatLanding(),
    ContactForce(),
    FloatingForce(),
    Clearance(),
)

MOTION_ROWS: tuple[RowConstraint, ...] = (
    Integration(),
    ForceBalance(),
    BodyTorque(),
    FootSpeed(),
    BodySpeed(),
)

REACH_ROWS: dict[Workspace, tuple[RowConstraint, ...]] = {
    Workspace.CYLINDER: (CylinderDisc(), CylinderHeight()),
    Workspace.STROKE: (StrokeUpper(), StrokeLower()),
}

OPTIONAL_ROWS: tuple[RowConstraint, ...] = (
    ClosedCycle(),
    StabilityMargin(),
    Friction(),
    MotorSpeed(),
    MotorAcceleration(),
    ShoeDistance(),
)
"""Rows that are there only where a problem asks for their family."""

ELASTIC_FAMILIES = frozenset(
    {
        Family.BODY_TORQUE,
        Family.FOOT_SPEED,
        Family.BODY_SPEED,
        Family.WORKSPACE,
        Family.MARGIN,
        Family.FRICTION,
        Family.MOTOR_SPEED,
        Family.MOTOR_ACCELERATION,
        Family.SHOE_DISTANCE,
    }
)
"""What the search for the nearest motion may miss. It keeps everything else, which a robot without limits
can: the equations of motion, the contact sequence, start and goal, heights and clearance."""


def asked_families(problem: MotionProblem) -> frozenset[Family]:
    """Families of `OPTIONAL_ROWS` that a problem asks for.

    The centre of pressure is bounded by itself only for a margin or where feet do not stand level: otherwise
    contact forces keep it inside the support polygon.
    """
    limits = problem.limits
    asked = {
        Family.BOUNDARY: problem.boundary is Ends.PERIODIC,
        Family.MARGIN: limits.margin > 0 or not is_level(problem),
        Family.FRICTION: limits.friction is not None,
        Family.MOTOR_SPEED: limits.motor_speed is not None,
        Family.MOTOR_ACCELERATION: limits.motor_acceleration is not None,
        Family.SHOE_DISTANCE: least_distance(problem.model) is not None,
    }
    return frozenset(family for family, wanted in asked.items() if wanted)


def row_constraints(workspace: Workspace, asked: frozenset[Family]) -> tuple[RowConstraint, ...]:
    """The row constraints of a shape."""
    optional = tuple(constraint for constraint in OPTIONAL_ROWS if constraint.family in asked)
    return MOTION_ROWS + REACH_ROWS[workspace] + optional


def box_of(situation: Situation) -> Box:
    """Bounds of every unknown."""
    box = open_box(situation.problem.knot_count, situation.problem.model.leg_count)
    for constraint in BOUND_CONSTRAINTS:
        constraint.tighten(box, situation)
        box.meet_crossed_bounds(constraint.family)
    return box
