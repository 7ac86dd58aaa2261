"""How long gaits last as they are planned and on the robot, and how fast it goes; stored for the library."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from types import MappingProxyType

from core.data.tables import data_table


@dataclass(frozen=True)
class RobotTimes:
    """How long a gait lasts.

    Args:
        plan_seconds: of its motion as planned, s.
        robot_seconds: that the robot's firmware takes for the waypoints, s (docs/firmware.md).
        speed: way of the body, from its first place to its last, a robot second, m/s.
        turn_rate: turn of the body, from first to last, a robot second, rad/s; above 0 to the left.
    """

    plan_seconds: float
    robot_seconds: float
    speed: float
    turn_rate: float


@cache
def library_times() -> Mapping[str, RobotTimes]:
    """Times of the built-in gaits by id, as `python -m app.plans.library_times` found them.

    A gait of which no motion keeps every limit has none.
    """
    return MappingProxyType(
        {gait_id: RobotTimes(**values) for gait_id, values in data_table("times.toml").items()}
    )
