"""The row of a drawn gait: its motion by the live tier, and what the robot makes of its waypoints."""

import numpy as np

from core.atlas.documents import drawn_document
from core.atlas.point import AtlasPoint
from core.atlas.row import AtlasRow, RowStatus
from core.checks.made_plan import unmade_words
from core.errors import FootfallError
from core.gait.gait import motion_problem
from core.motion.balance import balance_margins
from core.motion.trajectory import Trajectory
from core.problem.motion_check import check_motion
from core.robot.model import RobotModel
from core.wire.robot_time import estimate_seconds, largest_moves, stop_seconds
from core.wire.waypoint_merging import WaypointPlan, plan_waypoints
from solver_jobs.live.solve import quick_motion

SIDES = 32
"""Edges of the polygons that stand for discs; the error is below half a per cent."""


def drawn_row(point: AtlasPoint, model: RobotModel) -> AtlasRow:
    """The row of one drawn gait.

    Args:
        point: its parameters.
        model: its robot.
    """
    try:
        drawn = drawn_plan(point, model)
        return drawn if isinstance(drawn, AtlasRow) else planned_row(point.number, model, *drawn)
    except FootfallError as error:
        return AtlasRow(point.number, RowStatus.INFEASIBLE, error.sentence)


def drawn_plan(point: AtlasPoint, model: RobotModel) -> tuple[Trajectory, WaypointPlan] | AtlasRow:
    """The motion of one drawn gait with what is sent of it; its row where it has none.

    Args:
        point: its parameters.
        model: its robot.

    Raises:
        FootfallError: a parameter is none that a drawn gait can have.
    """
    gait = drawn_document(point, model, "drawn")
    problem = motion_problem(gait, model)
    motion = quick_motion(problem, SIDES)
    if motion is None:
        return AtlasRow(point.number, RowStatus.INFEASIBLE, "The live tier found no motion.")
    check = check_motion(problem, motion)
    if not check.confirmed:
        return AtlasRow(point.number, RowStatus.FAILED, "The check does not confirm the motion.")
    if unmade := unmade_words(model, motion):
        return AtlasRow(point.number, RowStatus.FAILED, unmade)
    return motion, plan_waypoints(model, motion, gait.options.merge, gait.options.stop_bound)


def planned_row(number: int, model: RobotModel, motion: Trajectory, plan: WaypointPlan) -> AtlasRow:
    """The row of a motion that the check confirms, by what is sent of it."""
    waypoints, body = plan.waypoints, motion.body_world
    seconds = estimate_seconds(waypoints)
    way = float(np.hypot(*(body[-1, :2] - body[0, :2])))
    strokes, limits = waypoints.strokes, model.stroke
    return AtlasRow(
        number,
        RowStatus.SOLVED,
        seconds=seconds,
        speed=way / seconds,
        turn_rate=float(motion.heading[-1] - motion.heading[0]) / seconds,
        least_margin=float(balance_margins(model, motion)[0].min()),
        body_move=float(np.linalg.norm(np.diff(body, axis=0), axis=1).max()),
        stroke_use=float(strokes.max() - strokes.min()) / (limits.upper - limits.lower),
        stop_seconds=stop_seconds(float(largest_moves(waypoints).max(initial=0.0))),
    )
