"""The live tier as users feel it: from a changed gait to a checked trajectory, through its own process."""

import time
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from app.bench.common.measure import Row, milliseconds
from app.bench.common.random_gaits import grouped_gait
from app.plans.verified_result import verify
from core.gait.gait import Gait, drawn_timeline, motion_problem
from core.gait.options import GaitOptions
from core.library.library import library
from core.motion.contact_timeline import ContactTimeline
from core.problem.motion_problem import MotionProblem
from core.robot.model import RobotModel, load_robot
from solver_jobs import LiveSolver, SolveStatus

CHANGES = 240
"""Changed gaits a row."""

SLOWEST = 10.0
"""Longest wait for one answer, s."""


@dataclass(frozen=True, eq=False)
class _Timed:
    """Where the time of one change went, s."""

    whole: float
    problem: float
    solver: float
    around_solver: float
    check: float
    solved: bool


def bench_live(changes: int = CHANGES) -> list[Row]:
    """Times of each shape of problem: every gait is changed anew, so that nothing is answered from memory."""
    shapes = {
        "4 legs, 40 knots": _walk(1),
        "4 legs, 40 knots, motor speed": _walk(1).with_options(motor_speed=0.015),
        "4 legs, 120 knots": _walk(3),
        "6 legs, 42 knots": grouped_gait("hexapod", 2, 7),
        "6 legs, 60 knots": grouped_gait("hexapod", 1, 5),
        "12 legs, 40 knots": grouped_gait("dodecapod", 3, 5),
    }
    return [_row(name, gait, changes) for name, gait in shapes.items()]


def _walk(iterations: int) -> Gait:
    walk = library()["walk"].gait
    gait = replace(walk, iterations=iterations, options=GaitOptions(closing_knots=0))
    return replace(gait, timeline=drawn_timeline(gait))


def _changed(gait: Gait, count: int) -> Iterator[Gait]:
    """Steps, heights, clearances and swings changed at random, as a dragging finger does."""
    random = np.random.default_rng(1)
    for _ in range(count):
        share = float(random.uniform(0.5, 1.2))
        options = replace(
            gait.options,
            clearance=float(random.uniform(0.002, 0.004)),
            plane_height=float(random.uniform(0.0535, 0.055)),
        )
        dx, dy, yaw = gait.step
        yield replace(
            gait, step=(dx * share, dy * share, yaw), options=options, timeline=_moved(gait, random)
        )


def _moved(gait: Gait, random: np.random.Generator) -> ContactTimeline:
    """One swing a knot longer, shorter, or as it was."""
    stance = gait.timeline.stance.copy()
    swings = gait.timeline.swings()
    swing = swings[int(random.integers(len(swings)))]
    edge = (swing.first, swing.first - 1)[int(random.integers(2))]
    stance[swing.foot, edge] = not stance[swing.foot, edge]
    return ContactTimeline(stance, gait.timeline.locked, gait.timeline.sample_time)


def _row(name: str, gait: Gait, changes: int) -> Row:
    model = load_robot(gait.robot)
    solver = LiveSolver(warm_up=motion_problem(gait, model))
    try:
        solver.solve(motion_problem(gait, model), 60.0)
        times = [_timed(changed, model, solver) for changed in _changed(gait, changes)]
    finally:
        solver.close()
    whole = np.array([t.whole for t in times])
    part = {
        key: milliseconds(float(np.median([getattr(t, key) for t in times])))
        for key in ("problem", "solver", "around_solver", "check")
    }
    return {
        "shape": name,
        "changes": len(times),
        "solved": sum(t.solved for t in times),
        "median_ms": milliseconds(float(np.median(whole))),
        "p95_ms": milliseconds(float(np.percentile(whole, 95))),
        "max_ms": milliseconds(float(whole.max())),
        "problem_ms": part["problem"],
        "qp_ms": part["solver"],
        "rows_and_pipe_ms": part["around_solver"],
        "check_ms": part["check"],
        "whole_to_qp": round(float(np.median(whole)) * 1000 / max(part["solver"], 0.1), 1),
    }


def _timed(gait: Gait, model: RobotModel, solver: LiveSolver) -> _Timed:
    begin = time.perf_counter()
    problem: MotionProblem = motion_problem(gait, model)
    asked = time.perf_counter()
    result = solver.solve(problem, SLOWEST)
    answered = time.perf_counter()
    verified = verify(problem, result)
    end = time.perf_counter()
    return _Timed(
        whole=end - begin,
        problem=asked - begin,
        solver=result.solve_seconds,
        around_solver=answered - asked - result.solve_seconds,
        check=end - answered,
        solved=verified.status is SolveStatus.SOLVED,
    )
