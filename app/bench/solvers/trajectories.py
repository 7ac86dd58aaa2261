"""Every published trajectory, solved anew by both tiers in four directions and checked."""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from app.bench.common.cases import Case, all_cases
from app.bench.common.measure import Row, milliseconds
from app.plans.verified_result import VerifiedResult, verify
from core.gait.gait import Gait, drawn_timeline, motion_problem
from core.motion.trajectory import Trajectory, turn_trajectory
from core.problem.motion_problem import Cost
from core.robot.model import load_robot
from solver_jobs import Evidence, SolveStatus, solve_exact, solve_live, solve_motion

DIRECTIONS = (1, 2, 3, 4)


@dataclass(frozen=True, eq=False)
class Solved:
    """Both tiers' answers to a case in one direction."""

    direction: int
    live: VerifiedResult
    exact: VerifiedResult


def bench_trajectories(cases: Iterable[Case] | None = None) -> list[Row]:
    """A row a case; times are medians over four directions, those of the exact tier with its convex start.

    The last row compares both of the thesis's costs.
    """
    chosen = list(all_cases() if cases is None else cases)
    rows = [row_of(case) for case in chosen]
    return [*rows, _row_of_costs([case.gait for case in chosen if case.group == "steps"], rows[0])]


def _row_of_costs(gaits: list[Gait], columns: Row) -> Row:
    """How much longer IPOPT takes with cost (3.3) than with (3.4), from a drawing, where both are solved."""
    pairs = [tuple(_seconds(gait, cost) for cost in (Cost.GOAL_EFFORT, Cost.GOAL)) for gait in gaits]
    effort, goal = np.array([pair for pair in pairs if None not in pair], dtype=np.float64).reshape(-1, 2).T
    return {
        **dict.fromkeys(columns),
        "case": f"cost (3.3) against (3.4), {len(goal)} of {len(gaits)} cases",
        "exact": f"{np.median(effort / goal):.1f} times longer",
        "exact_ms": milliseconds(float(np.median(effort))),
        "published": "2.5 times longer",
    }


def _seconds(gait: Gait, cost: Cost) -> float | None:
    result = solve_motion(motion_problem(gait.with_options(cost=cost), load_robot(gait.robot)))
    return result.solve_seconds if result.status is SolveStatus.SOLVED else None


def row_of(case: Case) -> Row:
    """Solves one case in every direction."""
    answers = [_solve(case.gait, direction) for direction in DIRECTIONS]
    first = answers[0]
    check = first.exact.check
    is_solved = first.exact.status is SolveStatus.SOLVED
    return {
        "case": case.name,
        "workspace": case.gait.options.workspace.value,
        "closing": case.gait.options.closing_knots,
        "knots": case.gait.timeline.sample_count,
        "live": first.live.status.value,
        "exact": first.exact.status.value,
        "evidence": _evidence(first),
        "iterations": first.exact.result.iteration_count,
        "live_ms": milliseconds(_median(a.live.result.solve_seconds for a in answers)),
        "exact_ms": milliseconds(_median(a.exact.result.solve_seconds for a in answers)),
        "build_ms": milliseconds(max(a.exact.result.build_seconds for a in answers)),
        "violation": f"{check.max_violation:.0e}",
        "margin_mm": _mm(check.min_margin) if is_solved else None,
        "cop_margin_mm": _mm(check.min_cop_margin) if is_solved else None,
        "directions_differ_m": f"{_largest_difference(answers):.0e}",
        "lacks": "" if is_solved else lacks_of(first),
        "published_s": case.published.seconds,
        "published": case.published.outcome,
    }


def _solve(gait: Gait, direction: int) -> Solved:
    turned = replace(gait, direction=direction)
    turned = replace(turned, timeline=drawn_timeline(turned))
    problem = motion_problem(turned, load_robot(gait.robot))
    return Solved(direction, verify(problem, solve_live(problem)), verify(problem, solve_exact(problem)))


def _evidence(solved: Solved) -> str | None:
    """The stronger of both tiers' evidence; the live tier takes footholds between swings as given."""
    if solved.exact.status is SolveStatus.SOLVED:
        return None
    if solved.exact.result.evidence is Evidence.PROVEN:
        return "proven"
    proven = solved.live.result.evidence is Evidence.PROVEN
    return "proven for even footholds" if proven else "diagnosed"


def lacks_of(solved: Solved) -> str:
    """What is missing most of each family by the exact tier, or where it was not asked by the live one."""
    worst: dict[str, str] = {}
    for lack in solved.exact.result.lacks or solved.live.result.lacks:
        worst.setdefault(lack.family, f"{lack.family.replace('_', ' ')} {lack.amount:.1f} {lack.unit}")
    return ", ".join(worst.values()) or solved.exact.explanation[0]


def _median(seconds: Iterable[float]) -> float:
    return float(np.median(list(seconds)))


def _mm(metres: float) -> float:
    # Adding 0 turns −0.0 into 0.0.
    return round(metres * 1000, 2) + 0.0


def _largest_difference(answers: list[Solved]) -> float:
    """Between the answers of both tiers turned back to direction 1, m."""
    tiers = ([a.live.trajectory for a in answers], [a.exact.trajectory for a in answers])
    return max(
        _difference(motions[0], turn_trajectory(motion, 1 - answer.direction))
        for motions in tiers
        for answer, motion in zip(answers, motions, strict=True)
    )


def _difference(one: Trajectory, other: Trajectory) -> float:
    body = np.abs(one.body_world - other.body_world).max()
    return float(max(body, np.abs(one.feet_world - other.feet_world).max()))
