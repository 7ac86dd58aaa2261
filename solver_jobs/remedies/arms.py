"""Whether the arms of neighbouring legs keep clear in a remedy's motion, as the check looks at it."""

from core.checks.arms import least_arm_gap
from core.errors import FootfallError
from core.findings import TOLERANCE
from core.gait.gait import Gait
from core.robot.arms import ARM_GAP
from core.robot.model import RobotModel
from core.wire.waypoint_merging import plan_waypoints
from solver_jobs.results.motion import MotionResult


def arm_room(gait: Gait, model: RobotModel, motion: MotionResult) -> float:
    """By how much the arms of neighbouring legs keep further apart than the check asks, m.

    Args:
        gait: with its options for the waypoints.
        model: its robot.
        motion: of the gait.

    Returns:
        Below 0 where the check warns; inf where it has nothing to say.
    """
    least = _least(gait, model, motion)
    return float("inf") if least is None else least[1] - (ARM_GAP - TOLERANCE)


def arm_caution(gait: Gait, model: RobotModel, motion: MotionResult) -> str:
    """The caution of a remedy whose arms do not keep clear; empty where they do (see `arm_room`)."""
    least = _least(gait, model, motion)
    if least is None or least[1] >= ARM_GAP - TOLERANCE:
        return ""
    (first, second), gap = least
    names = f"The arms of legs {first + 1} and {second + 1}"
    if gap < -TOLERANCE:
        return f"{names} touch: {-gap * 1000:.1f} mm in one another."
    return f"{names} come within {gap * 1000:.1f} mm of each other."


def _least(gait: Gait, model: RobotModel, motion: MotionResult) -> tuple[tuple[int, int], float] | None:
    try:
        way = plan_waypoints(model, motion.trajectory, gait.options.merge, gait.options.stop_bound)
    except FootfallError:
        return None
    return least_arm_gap(model, way.waypoints)
