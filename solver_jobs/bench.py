"""The cases behind the README's figures of trajectory optimisation."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from statistics import median

from core.motion_problem import Cost, MotionLimits, MotionProblem, Workspace, standing_pose
from core.robot import load_robot
from core.timeline import timeline_from_order
from solver_jobs.results import MotionResult, SolveStatus

GAIT_ORDERS = {
    "walk": (3, 2, 4, 1),
    "amble": (3, 1, 4, 2),
    "s-gait": (1, 2, 4, 3),
    "c-gait": (1, 2, 3, 4),
}
"""Foot orders of the optimised gaits, direction 1."""

DIAGONAL = frozenset({"walk", "amble"})
"""Gaits that move along the quadrants' diagonals."""

PLANE_HEIGHT = 0.0535


@dataclass(frozen=True)
class TrajectoryRow:
    """One case: times are medians of the repetitions, s; the first solve of a shape pays `build_seconds`."""

    gait: str
    step: float
    workspace: Workspace
    status: SolveStatus
    solver_word: str
    iterations: int
    solve_seconds: float
    build_seconds: float


def gait_problem(
    gait: str, step: float, workspace: Workspace, *, closing_knots: int = 5, cost: Cost = Cost.GOAL
) -> MotionProblem:
    """The problem of one iteration of a built-in gait on the DeltaWalker, direction 1.

    Args:
        gait: a name of `GAIT_ORDERS`.
        step: travel of the body, m.
        workspace: form of reach.
        closing_knots: knots of the closing stance.
        cost: what is minimised.
    """
    model = load_robot("deltawalker")
    angle = math.pi / 4 if gait in DIAGONAL else 0.0
    timeline = timeline_from_order(model.leg_count, GAIT_ORDERS[gait], closing_knots=closing_knots)
    start = standing_pose(model, PLANE_HEIGHT, (0.0, 0.0))
    goal = standing_pose(model, PLANE_HEIGHT, (step * math.cos(angle), step * math.sin(angle)))
    return MotionProblem(model, timeline, start, goal, MotionLimits(workspace=workspace), cost)


def bench_trajectories(
    steps: Sequence[float] = (0.010, 0.015), repetitions: int = 3
) -> Iterator[TrajectoryRow]:
    """Solves every gait at every step in both workspaces, one row after the other.

    Args:
        steps: travels, m.
        repetitions: solves a case; an unsolved one is not repeated.
    """
    for workspace in Workspace:
        for gait in GAIT_ORDERS:
            for step in steps:
                yield _row(gait, step, workspace, repetitions)


def _row(gait: str, step: float, workspace: Workspace, repetitions: int) -> TrajectoryRow:
    from solver_jobs.motion_nlp import solve_motion

    problem = gait_problem(gait, step, workspace)
    results: list[MotionResult] = [solve_motion(problem)]
    while results[-1].status is SolveStatus.SOLVED and len(results) < repetitions:
        results.append(solve_motion(problem))
    first = results[0]
    return TrajectoryRow(
        gait=gait,
        step=step,
        workspace=workspace,
        status=first.status,
        solver_word=first.solver_word,
        iterations=first.iteration_count,
        solve_seconds=median(result.solve_seconds for result in results),
        build_seconds=first.build_seconds,
    )
