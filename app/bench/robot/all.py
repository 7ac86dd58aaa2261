"""Every figure of the robot bridge."""

from app.bench.common.measure import Row
from app.bench.robot.soak import bench_soak
from app.bench.robot.standstill import bench_still
from app.bench.robot.stop import bench_kill, bench_stop
from app.bench.robot.walk import bench_walk


def bench_bridge() -> list[Row]:
    """Time on the robot, the fault soak, stops and kills; ten minutes."""
    return [*bench_walk(), *bench_soak(), *bench_still(), *bench_stop(), *bench_kill()]
