"""The fastest walk in mid-walk over a grid: foot orders and directions, steps, margins and stop bounds."""

from collections.abc import Callable
from contextlib import closing
from dataclasses import dataclass, replace
from itertools import product
from time import perf_counter

import numpy as np

from app.bench.common.measure import EndedEarly, Row
from app.common.signals import Interrupted
from core.errors import InputError
from core.library.library import library, order_name
from core.pose_gaits.choices import Choice, choices
from core.pose_gaits.pose_check import check_poses
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import PoseBounds, PoseProblem
from core.robot.model import RobotModel, load_robot
from solver_jobs import FastestSearch, SearchStep, TriedGait

ROBOT = "deltawalker"
STEPS: tuple[float | None, ...] = (None, 0.020, 0.030, 0.040)
"""Steps of the grid without options, m; None for the step of the fastest walk."""
MARGINS = (0.006,)
STOP_BOUNDS = (1.0, 1.5)
"""Margins and stop bounds of the grid without options, m and s."""
MOST_PROBLEMS = 2000
SAMPLES = 81
"""Places along each move at which an answer is checked once more; the search itself looks at 41."""
MM = 1000.0


@dataclass(frozen=True)
class Grid:
    """The problems of a grid are all combinations of these.

    Args:
        orders: foot orders, each in every direction that differs; empty for every order and direction that
            differ.
        steps: m a cycle; None for the step of the fastest walk.
        margins: stability margins, m.
        stop_bounds: s.
    """

    orders: tuple[tuple[int, ...], ...] = ()
    steps: tuple[float | None, ...] = STEPS
    margins: tuple[float, ...] = MARGINS
    stop_bounds: tuple[float, ...] = STOP_BOUNDS

    def problems(self) -> list[PoseProblem]:
        """Every problem once, by order and direction, then step, margin and stop bound.

        Raises:
            InputError: there are more than `MOST_PROBLEMS`, or an order does not name each foot once.
        """
        model = load_robot(ROBOT)
        asked = product(
            _choices(model, self.orders),
            dict.fromkeys(self.steps),
            dict.fromkeys(self.margins),
            dict.fromkeys(self.stop_bounds),
        )
        plain = PoseProblem(model, library()["walk"].gait.order, 0.0)
        problems = [
            choice.of(replace(plain, step=step, bounds=PoseBounds(margin=margin, stop_bound=bound)))
            for choice, step, margin, bound in asked
        ]
        if len(problems) > MOST_PROBLEMS:
            raise InputError(
                f"The grid has {len(problems):,} problems; at most {MOST_PROBLEMS:,} are tried. Give fewer "
                "--orders, --steps, --margins or --stop-bounds.",
                "--grid",
            )
        return problems


@dataclass(frozen=True, eq=False)
class _Answer:
    """A problem that is answered, and its row of the table."""

    tried: TriedGait
    row: Row


def _choices(model: RobotModel, orders: tuple[tuple[int, ...], ...]) -> list[Choice]:
    """Orders and directions that lead to different gaits."""
    if not orders:
        return list(choices(PoseProblem(model, library()["walk"].gait.order, 0.0)).tried)
    tried = [choice for order in orders for choice in choices(PoseProblem(model, order, 0.0), order).tried]
    return list(dict.fromkeys(tried))


def bench_fastest_grid(grid: Grid, report: Callable[[SearchStep], object] = lambda step: None) -> list[Row]:
    """Solves every problem of a grid, as many at a time as there are cores.

    Args:
        grid: the problems.
        report: told after each answer.

    Returns:
        A row of each problem; of each order and direction the fastest gait of all its problems; the whole.

    Raises:
        EndedEarly: Ctrl-C or another signal ended it; its rows are those of what was answered by then.
    """
    problems = grid.problems()
    answered: dict[PoseProblem, _Answer] = {}

    def keep(step: SearchStep) -> None:
        answered[step.newest.problem] = _Answer(step.newest, _row(step.newest))
        report(step)

    began = perf_counter()
    cause: BaseException | None = None
    try:
        with closing(FastestSearch(niceness=0)) as search:
            search.solve(problems, keep)
    except (KeyboardInterrupt, Interrupted) as signal:
        cause = signal
    seconds = perf_counter() - began
    answers = [answered[problem] for problem in problems if problem in answered]
    rows = [answer.row for answer in answers]
    table = [*rows, *_fastest_rows(answers), _whole(rows, problems, seconds)]
    if cause is not None:
        raise EndedEarly(table) from cause
    return table


def _row(tried: TriedGait) -> Row:
    problem, result = tried.problem, tried.result
    return {
        "order": "-".join(map(str, problem.order)),
        "gait": order_name(problem.order),
        "heading_deg": round(float(np.degrees(problem.heading))),
        "asked_step_mm": "free" if problem.step is None else _mm(problem.step),
        "asked_margin_mm": _mm(problem.bounds.margin),
        "stop_bound_s": problem.bounds.stop_bound,
        "status": result.status.value,
        **_gait_cells(result.gait),
        "solve_s": round(result.seconds, 1),
    }


def _gait_cells(gait: PoseGait | None) -> Row:
    """Figures of a gait, and whether the check confirms it; None everywhere where there is none."""
    if gait is None:
        return dict.fromkeys(
            ("moves", "step_mm", "robot_s", "mm_s", "least_margin_mm", "stop_s", "check"), None
        )
    check = check_poses(gait, samples=SAMPLES)
    return {
        "moves": gait.problem.move_count,
        "step_mm": _mm(gait.step),
        "robot_s": round(gait.seconds, 2),
        "mm_s": round(gait.speed * MM, 2),
        "least_margin_mm": round(check.figures.margin * MM, 2),
        "stop_s": round(check.figures.stop_seconds, 2),
        "check": "confirmed" if check.confirmed else f"refused: {check.findings[0].sentence}",
    }


def _fastest_rows(answers: list[_Answer]) -> list[Row]:
    """The fastest gait of each order and direction, the fastest first."""
    groups: dict[tuple[tuple[int, ...], float], list[_Answer]] = {}
    for one in answers:
        problem = one.tried.problem
        groups.setdefault((problem.order, problem.heading), []).append(one)
    best = [(max(group, key=_pace), group) for group in groups.values()]
    best.sort(key=lambda pair: -_pace(pair[0]))
    return [
        {
            "fastest_of": f"{one.row['order']} ({one.row['gait']}), {one.row['heading_deg']}°",
            "solved": f"{sum(each.tried.result.gait is not None for each in group)} of {len(group)}",
            **{key: one.row[key] for key in ("moves", "step_mm", "mm_s", "asked_margin_mm", "stop_bound_s")},
        }
        for one, group in best
    ]


def _pace(answer: _Answer) -> float:
    return answer.tried.pace


def _whole(rows: list[Row], problems: list[PoseProblem], seconds: float) -> Row:
    """How many were answered, solved and confirmed, the limits that hold for all, and the time it took."""
    bounds = problems[0].bounds
    low, high = bounds.plane_height
    return {
        "problems": len(problems),
        "answered": len(rows),
        "solved": sum(row["moves"] is not None for row in rows),
        "confirmed": sum(row["check"] == "confirmed" for row in rows),
        "clearance_mm": _mm(bounds.clearance),
        "slip_mm": _mm(bounds.slip),
        "shoes_mm": _mm(bounds.shoe_distance),
        "arms_mm": _mm(bounds.arm_distance),
        "plane_mm": f"{_mm(low)} to {_mm(high)}",
        "all_s": round(seconds, 1),
    }


def _mm(metres: float) -> float:
    return round(metres * MM, 1)
