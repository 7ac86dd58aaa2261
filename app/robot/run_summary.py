"""What a person should know of a run before they confirm it."""

import numpy as np

from app.bridge.run import start_targets
from app.bridge.run_range import RunRange, beginnings, why_not_repeated
from app.bridge.states import RobotSnapshot
from app.common.json import Json
from app.plans.plan import Plan
from app.robot.views import stop_seconds
from core.errors import StateError
from core.wire.robot_time import PUBLISHED, estimate_seconds, largest_moves, longest_start_move, stop_time
from core.wire.waypoint_merging import WaypointPlan
from core.wire.waypoints import Waypoints


def run_summary(plan: Plan, run_range: RunRange, snapshot: RobotSnapshot, reason: str | None) -> Json:
    """The run as JSON content.

    Args:
        plan: of the gait.
        run_range: from which waypoint on it is sent, and how many times over.
        snapshot: where the robot stands.
        reason: why it cannot be sent now; None where it can.

    Raises:
        StateError: the gait has no waypoints.
        InputError: the course does not fit it.
    """
    way = plan.way
    if way is None:
        raise StateError(
            "This gait has no waypoints." if plan.refusal is None else plan.refusal.sentence, "plan"
        )
    run_range.require_fit(way.waypoints, way.hold_ok)
    sent = sent_waypoints(way.waypoints, run_range)
    distance_mm, moves, start_seconds = _start(sent, snapshot, longest_start_move(way.waypoints) * 1000.0)
    return {
        "waypoints": sent.count,
        "waypoints_hash": way.waypoints.content_hash,
        "from": run_range.first,
        "iterations": run_range.iterations,
        "beginnings": _beginnings(way),
        "why_not_repeated": why_not_repeated(way.waypoints),
        "start_distance_mm": distance_mm,
        "start_moves": moves,
        "start_seconds": start_seconds,
        "estimated_seconds": estimate_seconds(sent),
        "largest_move_mm": float(largest_moves(sent).max(initial=0.0)) * 1000.0,
        "stop_seconds": round(stop_seconds(sent, snapshot, way.waypoints), 2),
        "checked_stop_seconds": round(stop_time(way.waypoints), 2),
        "scan_seconds": snapshot.measured_scan,
        "robot_ready": reason is None,
        "reason": reason,
        "unwired": unwired(plan),
    }


def sent_waypoints(waypoints: Waypoints, run_range: RunRange) -> Waypoints:
    """The waypoints in the order in which a run sends them.

    Args:
        waypoints: the approved ones.
        run_range: which of them are sent.
    """
    order = np.array(run_range.order(waypoints.count))
    return Waypoints(waypoints.strokes[order], waypoints.durations[order])


def unwired(plan: Plan) -> str | None:
    """Why this gait's robot cannot be driven, or None if it can."""
    if plan.model.wired:
        return None
    return (
        f"{plan.model.title}: this program can design for this robot but not drive it, so the gait "
        "cannot be sent. Choose "
        "“DeltaWalker, 12 motors” in the gait, and check it again."
    )


def _start(
    sent: Waypoints, snapshot: RobotSnapshot, longest_mm: float
) -> tuple[float | None, int | None, float | None]:
    """Farthest motor's way to the start pose in mm, its messages, and their expected seconds."""
    if snapshot.strokes is None:
        return None, None, None
    first_mm = tuple(float(h) for h in sent.strokes_mm[0])
    here_mm = tuple(h * 1000.0 for h in snapshot.strokes)
    distance_mm = max(abs(a - b) for a, b in zip(first_mm, here_mm, strict=False))
    if len(here_mm) != len(first_mm):
        return distance_mm, None, None
    moves = len(start_targets(here_mm, first_mm, longest_mm))
    seconds = moves * PUBLISHED.move_seconds(distance_mm / 1000.0 / moves) if moves else 0.0
    return distance_mm, moves, float(seconds)


def _beginnings(way: WaypointPlan) -> list[Json]:
    """Where a run may begin: waypoint and sample, 0-based, and the plan's time there in s."""
    return [
        {"waypoint": i, "sample": way.kept[i], "time": float(way.times[i])} for i in beginnings(way.hold_ok)
    ]
