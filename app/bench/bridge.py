"""Every figure of the robot bridge."""

from __future__ import annotations

from app.bench.bridge_soak import bench_soak
from app.bench.bridge_still import bench_still
from app.bench.bridge_stop import bench_kill, bench_stop
from app.bench.bridge_walk import bench_walk
from app.bench.measure import Row


def bench_bridge() -> list[Row]:
    """Time on the robot, the fault soak, stops and kills; ten minutes."""
    return [*bench_walk(), *bench_soak(), *bench_still(), *bench_stop(), *bench_kill()]
