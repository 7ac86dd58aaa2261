"""Every published trajectory, solved anew by both tiers in four directions and checked."""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from app.bench.common.cases import Case, all_cases
from app.bench.common.measure import Row, milliseconds
from app.plans.verified_result import VerifiedResult, verify
from core.gait.gait import Gait, drawn_timeline, motion_problem
from core.motion.trajectory import Trajectory, turn_trajectory
from core.robot.model import load_robot
from solver_jobs import Evidence, SolveStatus, solve_exact, solve_live

DIRECTIONS = (1, 2, 3, 4)


@dataclass(frozen=True, eq=False)
class Solved:
    """Both tiers' answers to a case in one direction."""

    direction: int
    live: VerifiedResult
    exact: VerifiedResult


def bench_trajectories(cases: Iterable[Case] | None = None) -> list[Row]:
    """A row a case; times are medians over four directions, those of the exact tier with its convex start."""
    return [row_of(case) for case in (all_cases() if cases is None else cases)]


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
    """The stronger of both tiers' evidence; the live tier proves for its own model."""
    if solved.exact.status is SolveStatus.SOLVED:
        return None
    if solved.exact.result.evidence is Evidence.PROVEN:
        return "proven"
    proven = solved.live.result.evidence is Evidence.PROVEN
    return "proven for given heights" if proven else "diagnosed"


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
