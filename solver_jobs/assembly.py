"""The short lists that make up the problem."""

from __future__ import annotations

from core.motion_problem import Workspace
from solver_jobs.bounds import (
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
from solver_jobs.constraint import BoundConstraint, Box, Family, RowConstraint, Situation, open_box
from solver_jobs.rows_motion import BodySpeed, BodyTorque, FootSpeed, ForceBalance, Integration
from solver_jobs.rows_reach import CylinderDisc, CylinderHeight, StabilityMargin, StrokeLower, StrokeUpper

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

ELASTIC_FAMILIES = frozenset({Family.BODY_TORQUE, Family.BODY_SPEED, Family.WORKSPACE, Family.MARGIN})
"""What the search for the nearest motion may miss; everything else it keeps."""


def row_constraints(workspace: Workspace, with_margin: bool) -> tuple[RowConstraint, ...]:
    """The row constraints of a shape."""
    margin: tuple[RowConstraint, ...] = (StabilityMargin(),) if with_margin else ()
    return MOTION_ROWS + REACH_ROWS[workspace] + margin


def box_of(situation: Situation) -> Box:
    """Bounds of every unknown."""
    box = open_box(situation.problem.knot_count, situation.problem.model.leg_count)
    for constraint in BOUND_CONSTRAINTS:
        constraint.tighten(box, situation)
        box.settle(constraint.family)
    return box
