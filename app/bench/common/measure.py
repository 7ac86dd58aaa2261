"""How benchmarks measure, and on what."""

import os
import platform
import time
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from app.common.version import VERSION

Row = dict[str, Any]
"""A line of a benchmark's table; every row of a table has the same keys."""

REPEATS = 7


class EndedEarly(Exception):  # noqa: N818 - it is no error
    """Ctrl-C or another signal ended a benchmark that has rows by then.

    Args:
        rows: of what it has measured.
    """

    def __init__(self, rows: list[Row]) -> None:
        super().__init__("The benchmark was interrupted.")
        self.rows = rows


def conditions() -> dict[str, str]:
    """What the figures were measured on."""
    load = os.getloadavg()[0] if hasattr(os, "getloadavg") else float("nan")
    return {
        "footfall": VERSION,
        "machine": platform.machine(),
        "processor": _processor(),
        "cores": str(os.cpu_count()),
        "load": f"{load:.1f}",
        "python": platform.python_version(),
        "numpy": version("numpy"),
        "casadi": version("casadi"),
    }


def _processor() -> str:
    """The processor's name, where the system tells it."""
    listing = Path("/proc/cpuinfo")
    lines = listing.read_text().splitlines() if listing.exists() else []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or "unknown"


def median_seconds(action: Callable[[], object], repeats: int = REPEATS) -> float:
    """Median wall time of a call after one warm-up, s."""
    action()
    return float(np.median([seconds_of(action) for _ in range(repeats)]))


def seconds_of(action: Callable[[], object]) -> float:
    """Wall time of one call, s."""
    start = time.perf_counter()
    action()
    return time.perf_counter() - start


def milliseconds(seconds: float) -> float:
    """For tables: ms with one decimal."""
    return round(seconds * 1000, 1)
