"""Problems for the engine: robots that stand, motors that move, walks that are known."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from core.arrays import Floats
from core.gait.gait import heading_step, motion_problem
from core.library.library import library
from core.motion.trajectory import Trajectory
from core.physics.masses import physics_for
from core.physics.parameters import PhysicsSet, physics_set
from core.physics.problem import Rig, SimulationProblem
from core.robot.kinematics import BodyPose, feet_in_robot, free_strokes
from core.robot.model import RobotModel, load_robot
from core.wire.waypoint_merging import WaypointPlan, plan_waypoints
from core.wire.waypoints import Waypoints
from solver_jobs import solve_live

MODEL = load_robot("deltawalker")
SCALES = physics_set("scales")
MIDDLE = 0.008
"""A stroke at which the feet stand in the middle of their reach, m."""


def strokes_of(feet_robot: Floats) -> Floats:
    """(legs, 3) strokes that put feet somewhere in the robot's frame, m."""
    return free_strokes(MODEL, feet_robot, BodyPose(np.zeros(3), np.asarray(0.0)))


def problem_of_strokes(
    strokes: Floats,
    rig: Rig = Rig.WALKING,
    *,
    model: RobotModel = MODEL,
    physics: PhysicsSet | None = None,
    heading: float = 0.0,
) -> SimulationProblem:
    """Waypoints as they are; the plan keeps the body where it begins, which serves as start pose."""
    count = len(strokes)
    waypoints = Waypoints(strokes, np.full(count, 0.4))
    feet = feet_in_robot(model, strokes)
    height = model.com_height - feet[0, :, 2].min()
    turn = np.array([[np.cos(heading), -np.sin(heading)], [np.sin(heading), np.cos(heading)]])
    feet[..., :2] = feet[..., :2] @ turn.T
    feet[..., 2] += height - model.com_height
    stands = np.ones(feet.shape[:2], dtype=np.bool_)
    body = np.tile([0.0, 0.0, height], (max(count, 2), 1))
    feet = np.concatenate([feet, feet])[: max(count, 2)]
    knots = 0.4 * np.arange(len(body), dtype=np.float64)
    contact = np.ones((len(body), model.leg_count), dtype=np.bool_)
    plan = Trajectory(knots, body, np.full(len(body), heading), feet, contact)
    chosen = physics_for(model) if physics is None else physics
    return SimulationProblem(model, waypoints, plan, knots[:count], stands, stands, chosen, rig)


def resting(count: int = 2, model: RobotModel = MODEL) -> Floats:
    """Strokes of a robot that stands still."""
    return np.full((count, model.leg_count, 3), MIDDLE)


@cache
def walk(gait: str = "walk", step: float = 0.010, **options: Any) -> SimulationProblem:
    """A library gait by the live tier, every knot sent."""
    chosen = library()[gait].gait
    asked = replace(
        chosen,
        step=heading_step(chosen.orientation, step),
        options=replace(chosen.options, **options),
    )
    model = load_robot(chosen.robot)
    result = solve_live(motion_problem(asked, model))
    assert result.trajectory is not None
    return planned(model, plan_waypoints(model, result.trajectory), result.trajectory)


def planned(model: RobotModel, plan: WaypointPlan, motion: Trajectory) -> SimulationProblem:
    """A plan's waypoints as they would be sent."""
    return SimulationProblem(
        model,
        plan.waypoints,
        motion,
        plan.times,
        plan.contact,
        plan.standing,
        physics_for(model),
    )
