"""Every figure of the robot bridge."""

from app.bench.common.measure import Row
from app.bench.robot.soak import bench_soak
from app.bench.robot.standstill import bench_still
from app.bench.robot.stop import bench_kill, bench_stop


def bench_bridge() -> list[Row]:
    """The fault soak, stops and kills; ten minutes."""
    return [*bench_soak(), *bench_still(), *bench_stop(), *bench_kill()]
