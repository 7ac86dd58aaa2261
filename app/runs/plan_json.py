"""What a run was to do, as JSON content that stays readable when its gait has changed or gone."""

from dataclasses import asdict

import numpy as np

from app.bridge.states import RunPlan
from app.common.json import Json
from app.documents.trajectory_json import trajectory_content, trajectory_from_content
from app.plans.plan import Plan
from core.arrays import Floats
from core.errors import InputError, StateError
from core.findings import Approval
from core.motion.trajectory import Trajectory
from core.recorded.waypoint_motion import motion_of_waypoints
from core.robot.model import RobotModel, load_robot
from core.runs.pose import RanPlan
from core.wire.waypoint_merging import WaypointPlan
from core.wire.waypoints import Waypoints


def run_plan_content(plan: Plan, way: WaypointPlan, approval: Approval) -> Json:
    """What is kept of a plan with a run of it.

    Args:
        plan: with a trajectory.
        way: exactly what is sent.
        approval: by whom and of what.

    Raises:
        StateError: the plan has no motion.
    """
    if plan.trajectory is None:
        raise StateError("A plan without a motion cannot be sent.", "plan")
    sent = sent_content(plan.model, way.waypoints, way.times, plan.trajectory)
    return sent | {"approval": asdict(approval), "merge": way.merge, "stop_bound": way.stop_bound}


def file_plan_content(model: RobotModel, plan: RunPlan) -> Json | None:
    """What is kept of a file's waypoints with a run of them; None where they make no motion of a gait.

    Args:
        model: the robot.
        plan: the waypoints, approved.
    """
    try:
        trajectory = motion_of_waypoints(model, plan.waypoints).trajectory
    except InputError:  # a single pose, say: it is sent, and there is nothing to lay it over
        return None
    sent = sent_content(model, plan.waypoints, trajectory.times, trajectory)
    return sent | {"approval": asdict(plan.approval)}


def sent_content(model: RobotModel, waypoints: Waypoints, times: Floats, trajectory: Trajectory) -> Json:
    """Waypoints with the motion that they were made from.

    Args:
        model: the robot.
        waypoints: exactly what is sent.
        times: (count,) the motion's time of each waypoint, s.
        trajectory: the motion.
    """
    return {
        "robot": model.name,
        "durations": waypoints.durations.tolist(),
        "strokes_mm": waypoints.strokes_mm.tolist(),
        "times": times.tolist(),
        "trajectory": trajectory_content(trajectory),
    }


def ran_plan(content: Json) -> RanPlan:
    """Inverse of `sent_content`, for comparing what was done with the plan."""
    model = load_robot(content["robot"])
    rows_mm = np.array(content["strokes_mm"])
    waypoints = Waypoints(rows_mm.reshape(len(rows_mm), model.leg_count, 3) / 1000.0, content["durations"])
    trajectory = trajectory_from_content(content["trajectory"])
    return RanPlan(model, waypoints, np.array(content["times"]), trajectory)
