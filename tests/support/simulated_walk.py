"""A walk by hand, and what a simulation of it could say, made without any physics."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from app.plans.make_plan import make_plan
from app.plans.plan import Plan
from app.simulation.problem import simulation_problem
from core.arrays import Floats
from core.library.library import library
from core.physics.metrics import report
from core.physics.motion import SimulatedMotion
from core.physics.parameters import physics_set
from core.physics.problem import SimulationProblem
from core.physics.report import SimulationReport
from core.problem.motion_problem import MotionProblem
from solver_jobs import MotionResult

GAIT = "walk-manual-0"
SECONDS_A_MOVE = 0.5
SAMPLES_A_MOVE = 50
BEHIND = 0.002
"""How far body and feet stay behind the plan, m."""


def no_solver(problem: MotionProblem) -> MotionResult:
    raise AssertionError(f"A gait by hand needs no solver, and one was asked for {problem}.")


@cache
def walk_plan() -> Plan:
    return make_plan(library()[GAIT].gait, None, no_solver)


@cache
def walk_problem() -> SimulationProblem:
    return simulation_problem(walk_plan(), physics_set())


def followed(problem: SimulationProblem, moves: int | None = None) -> SimulatedMotion:
    """A robot that goes the plan's way in its own time, always `BEHIND` to one side of it.

    Args:
        problem: what is simulated.
        moves: after how many it ends; None for all.
    """
    count, plan = problem.waypoints.count, problem.plan
    done = count - 1 if moves is None else moves
    arrivals = np.arange(done + 1) * SAMPLES_A_MOVE
    share = np.arange(arrivals[-1] + 1) / SAMPLES_A_MOVE
    times = np.interp(share, np.arange(count), problem.times)

    def along(knots: Floats, values: Floats, at: Floats) -> Floats:
        columns = values.reshape(len(knots), -1).T
        rows = np.stack([np.interp(at, knots, column) for column in columns], axis=-1)
        return rows.reshape(len(at), *values.shape[1:])

    aside = np.array([0.0, BEHIND, 0.0])
    feet = along(plan.times, plan.feet_world, times) + aside
    strokes = along(np.arange(count, dtype=float), problem.waypoints.strokes, share)
    forces = np.zeros_like(feet)
    down = problem.standing[np.clip(np.ceil(share).astype(int), 0, count - 1)]
    forces[..., 2] = np.where(down, 1.9, 0.0)
    body = along(plan.times, plan.body_world, times) + aside
    n = len(share)
    return SimulatedMotion(
        times=share * SECONDS_A_MOVE,
        body_world=body,
        attitude=np.tile([1.0, 0.0, 0.0, 0.0], (n, 1)),
        feet_world=feet,
        strokes=strokes,
        targets=strokes,
        motor_forces=np.zeros_like(strokes),
        ground_forces=forces,
        centre_world=body,
        arrivals=arrivals,
        loop_error=0.0,
        seconds=0.5,
    )


def walk_report(**other: Any) -> SimulationReport:
    """The figures of `followed`, some of them otherwise."""
    problem = walk_problem()
    return replace(report(problem, followed(problem)), **other)
