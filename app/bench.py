"""Benchmarks behind the figures in the documentation; they measure and never judge."""

from __future__ import annotations

import os
import platform
import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from importlib.metadata import version
from typing import Any

import numpy as np

from core.gait import Gait, GaitOptions, heading_step, motion_problem
from core.kinematics import BodyPose, walker_feet, walker_strokes
from core.leg import foot_from_strokes
from core.library import library
from core.motion_check import check_motion
from core.motion_problem import Workspace
from core.robot import RobotModel, load_robot
from solver_jobs import solve_motion

Row = dict[str, Any]
REPEATS = 7
POSES = 100_000


def conditions() -> dict[str, str]:
    """What the figures were measured on."""
    load = os.getloadavg()[0] if hasattr(os, "getloadavg") else float("nan")
    return {
        "machine": platform.machine(),
        "cores": str(os.cpu_count()),
        "load": f"{load:.1f}",
        "python": platform.python_version(),
        "numpy": version("numpy"),
        "casadi": version("casadi"),
    }


def median_seconds(action: Callable[[], object], repeats: int = REPEATS) -> float:
    """Median wall time of a call after one warm-up, s."""
    action()
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        action()
        times.append(time.perf_counter() - start)
    return float(np.median(times))


def bench_kinematics() -> list[Row]:
    """Walker poses a second, forward and inverse, for each robot."""
    rows: list[Row] = []
    for name in ("deltawalker", "hexapod", "dodecapod"):
        model = load_robot(name)
        random = np.random.default_rng(0)
        count = POSES * 4 // model.leg_count
        strokes = random.uniform(0.0005, 0.0195, (count, model.leg_count, 3))
        strokes = strokes[np.isfinite(foot_from_strokes(model.leg, strokes)).all(axis=(1, 2))]
        pose = BodyPose(np.zeros((len(strokes), 3)), np.zeros(len(strokes)))
        feet = walker_feet(model, strokes, pose)
        forward = median_seconds(partial(walker_feet, model, strokes, pose))
        inverse = median_seconds(partial(walker_strokes, model, feet, pose))
        rows.append(
            {
                "robot": name,
                "poses": len(strokes),
                "forward_per_second": round(len(strokes) / forward),
                "inverse_per_second": round(len(strokes) / inverse),
            }
        )
    return rows


def bench_trajectories() -> list[Row]:
    """Every built-in gait for the optimiser, at two steps in both workspaces, solved and checked."""
    model = load_robot("deltawalker")
    entries = [entry for entry in library().values() if entry.manual is None]
    return [
        _solved_row(replace(entry.gait, step=heading_step(entry.gait.orientation, step)), workspace, model)
        for workspace in Workspace
        for entry in entries
        for step in (0.010, 0.015)
    ]


def _solved_row(gait: Gait, workspace: Workspace, model: RobotModel) -> Row:
    problem = motion_problem(replace(gait, options=GaitOptions(workspace=workspace)), model)
    results = [solve_motion(problem) for _ in range(3)]
    first = results[0]
    check = check_motion(problem, first.trajectory)
    return {
        "gait": gait.name.removesuffix(" 10 mm"),
        "step_mm": round(float(np.hypot(*gait.step[:2])) * 1000, 1),
        "workspace": workspace.value,
        "status": first.status.value,
        "iterations": first.iteration_count,
        "solve_ms": round(float(np.median([result.solve_seconds for result in results])) * 1000),
        "build_ms": round(first.build_seconds * 1000),
        "max_violation": f"{check.max_violation:.0e}",
    }


BENCHMARKS: dict[str, Callable[[], list[Row]]] = {
    "kinematics": bench_kinematics,
    "trajectories": bench_trajectories,
}
"""Every benchmark by its name."""
