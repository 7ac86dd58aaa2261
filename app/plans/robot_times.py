"""How long a plan lasts, as planned and on the robot."""

from app.plans.plan import Plan
from core.library.robot_times import RobotTimes
from core.wire.robot_time import estimate_seconds


def robot_times(plan: Plan) -> RobotTimes | None:
    """A plan's times; None where it has no waypoints."""
    trajectory = plan.trajectory
    if plan.way is None or trajectory is None:
        return None
    seconds = estimate_seconds(plan.way.waypoints)
    way, turn = plan.advance
    if plan.poses is not None:
        way = plan.poses.distance
    return RobotTimes(
        plan_seconds=round(float(trajectory.times[-1] - trajectory.times[0]), 3),
        robot_seconds=round(seconds, 1),
        speed=round(way / seconds, 6),
        turn_rate=round(turn / seconds, 6),
    )
