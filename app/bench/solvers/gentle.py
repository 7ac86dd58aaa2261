"""How evenly the body moves: its largest move between two knots under the gentle cost and the thesis's."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from app.bench.common.measure import Row, milliseconds
from core.gait.gait import heading_step, motion_problem
from core.library.library import library
from core.motion.trajectory import Trajectory
from core.problem.motion_check import check_motion
from core.problem.motion_problem import Cost, MotionProblem
from core.robot.model import load_robot
from solver_jobs import MotionResult, SolveStatus, solve_exact, solve_live

GAITS = ("walk", "amble", "s-gait", "c-gait")
STEPS = (0.010, 0.020)
MARGINS = (0.0, 0.003, 0.006)


def bench_gentle(
    gaits: tuple[str, ...] = GAITS, steps: tuple[float, ...] = STEPS, margins: tuple[float, ...] = MARGINS
) -> list[Row]:
    """Both costs and both tiers; each motion confirmed by the checker."""
    return [_row(name, step, margin) for name in gaits for step in steps for margin in margins]


def largest_move(motion: Trajectory) -> float:
    """Largest move of the body between two knots, m."""
    return float(np.linalg.norm(np.diff(motion.body_world, axis=0), axis=1).max())


def _row(name: str, step: float, margin: float) -> Row:
    goal, gentle = (_problem(name, step, margin, cost) for cost in (Cost.GOAL, Cost.GENTLE))
    results = [solve(problem) for solve in (solve_exact, solve_live) for problem in (goal, gentle)]
    problems = (goal, gentle, goal, gentle)
    exact_goal, exact_gentle, _, live_gentle = results
    return {
        "gait": name,
        "step_mm": step * 1000,
        "margin_mm": margin * 1000,
        "goal_mm": _move_mm(exact_goal),
        "gentle_mm": _move_mm(exact_gentle),
        "gentle_live_mm": _move_mm(live_gentle),
        "goal_ms": milliseconds(exact_goal.solve_seconds),
        "gentle_ms": milliseconds(exact_gentle.solve_seconds),
        "confirmed": f"{sum(map(_is_confirmed, problems, results))} of {len(results)}",
    }


def _problem(name: str, step: float, margin: float, cost: Cost) -> MotionProblem:
    gait = library()[name].gait
    asked = replace(gait, step=heading_step(gait.orientation, step)).with_options(margin=margin, cost=cost)
    return motion_problem(asked, load_robot(gait.robot))


def _move_mm(result: MotionResult) -> float | None:
    return round(largest_move(result.trajectory) * 1000, 2) if result.status is SolveStatus.SOLVED else None


def _is_confirmed(problem: MotionProblem, result: MotionResult) -> bool:
    return result.status is SolveStatus.SOLVED and check_motion(problem, result.trajectory).confirmed
