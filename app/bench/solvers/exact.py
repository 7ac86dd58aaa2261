"""The exact tier in a warm process: cold, after one edit, long; and how both tiers grow with the knots."""

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from app.bench.common.measure import REPEATS, Row, milliseconds, seconds_of
from app.bench.common.random_gaits import grouped_gait
from core.gait.gait import Gait, drawn_timeline, heading_step, motion_problem
from core.gait.options import GaitOptions
from core.library.library import library
from core.motion.contact_timeline import ContactTimeline
from core.problem.motion_problem import MotionProblem
from core.robot.model import load_robot
from solver_jobs import MotionResult, SolveStatus, solve_exact, solve_live, solve_motion

ITERATIONS = (1, 2, 3, 6, 9, 12)
"""Iterations of the growth: 40 to 480 knots."""

EDITED = 24
"""Edits that go on from the last solution."""


def bench_exact() -> list[Row]:
    """Wall time of whole calls; the structures of each shape are built before."""
    rows = []
    for name in ("walk", "amble", "s-gait", "c-gait", "rotate"):
        gait = library()[name].gait
        rows.append(_cold(f"{name}, 45 knots, cold", gait))
    rows += [
        _cold("walk, 40 knots, no margin, no closing stance, cold", _walk(1)),
        _cold("walk, 120 knots, cold", _walk(3)),
        _cold("6 legs, 42 knots, cold", grouped_gait("hexapod", 2, 7)),
        _cold("12 legs, 40 knots, cold", grouped_gait("dodecapod", 3, 5)),
        _after_edits("walk, 45 knots, after one edit", library()["walk"].gait),
    ]
    return rows


def _walk(iterations: int, step: float = 0.010) -> Gait:
    walk = library()["walk"].gait
    options = GaitOptions(closing_knots=0)
    gait = replace(walk, iterations=iterations, options=options, step=heading_step(walk.orientation, step))
    return replace(gait, timeline=drawn_timeline(gait))


def _problem(gait: Gait) -> MotionProblem:
    return motion_problem(gait, load_robot(gait.robot))


def _cold(name: str, gait: Gait) -> Row:
    """The same problem again and again, from the live tier's motion and from nothing."""
    problem = _problem(gait)
    results: list[MotionResult] = [solve_exact(problem)]
    whole = [seconds_of(partial(_ask, problem, results)) for _ in range(REPEATS)]
    alone = [solve_motion(problem) for _ in range(REPEATS)]
    return _row(name, whole, results[1:], float(np.median([r.solve_seconds for r in alone])))


def _ask(problem: MotionProblem, results: list[MotionResult]) -> None:
    results.append(solve_exact(problem))


def _after_edits(name: str, gait: Gait) -> Row:
    """One edit of the gait at a time, each going on from the gait's own solution."""
    base = _problem(gait)
    results: list[MotionResult] = []
    whole = []
    for problem in [base, *(_problem(edited) for edited in _edits(gait))]:
        solve_motion(base, resume=True)
        whole.append(seconds_of(partial(_ask_on, problem, results)))
    # The first one builds the solver that goes on.
    return _row(name, whole[1:], results[1:], None)


def _ask_on(problem: MotionProblem, results: list[MotionResult]) -> None:
    results.append(solve_motion(problem, resume=True))


def _edits(gait: Gait) -> Iterator[Gait]:
    """Single edits: step, clearance, height, margin, or a swing that begins a knot earlier."""
    random = np.random.default_rng(2)
    for number in range(EDITED):
        options = gait.options
        changed = [
            replace(gait, step=heading_step(gait.orientation, float(random.uniform(0.008, 0.014)))),
            replace(gait, options=replace(options, clearance=float(random.uniform(0.002, 0.004)))),
            replace(gait, options=replace(options, plane_height=float(random.uniform(0.0532, 0.055)))),
            replace(gait, options=replace(options, margin=float(random.uniform(0.002, 0.004)))),
            replace(gait, timeline=_begun_earlier(gait, int(random.integers(4)))),
        ]
        yield changed[number % len(changed)]


def _begun_earlier(gait: Gait, number: int) -> ContactTimeline:
    swing = gait.timeline.swings()[number]
    stance = gait.timeline.stance.copy()
    stance[swing.foot, swing.first - 1] = False
    return replace(gait.timeline, stance=stance)


def _row(name: str, whole: list[float], results: list[MotionResult], drawing: float | None) -> Row:
    solver = [result.solve_seconds for result in results]
    return {
        "what": name,
        "solved": f"{sum(r.status is SolveStatus.SOLVED for r in results)} of {len(results)}",
        "median_ms": milliseconds(float(np.median(whole))),
        "max_ms": milliseconds(max(whole)),
        "solver_ms": milliseconds(float(np.median(solver))),
        "from_a_drawing_ms": None if drawing is None else milliseconds(drawing),
        "iterations": int(np.median([result.iteration_count for result in results])),
    }


def bench_growth() -> list[Row]:
    """Seconds an iteration of the solver at 40 to 480 knots, and the exponent that fits them."""
    rows, knots, live_each, exact_each = [], [], [], []
    for iterations in ITERATIONS:
        problem = _problem(_walk(iterations))
        solve_live(problem)
        live = [solve_live(problem).solve_seconds for _ in range(REPEATS)]
        exact = [solve_motion(problem) for _ in range(3)][1:]
        each = float(np.median([r.solve_seconds / max(r.iteration_count, 1) for r in exact]))
        knots.append(problem.knot_count)
        live_each.append(float(np.median(live)))
        exact_each.append(each)
        rows.append(
            {
                "knots": str(problem.knot_count),
                "live_ms": milliseconds(live_each[-1]),
                "exact_ms": milliseconds(exact[-1].solve_seconds),
                "exact_iterations": exact[-1].iteration_count,
                "exact_ms_an_iteration": round(each * 1000, 2),
            }
        )
    rows.append(
        {
            "knots": "exponent",
            "live_ms": _exponent(knots, live_each),
            "exact_ms": None,
            "exact_iterations": None,
            "exact_ms_an_iteration": _exponent(knots, exact_each),
        }
    )
    return rows


def _exponent(knots: list[int], seconds: list[float]) -> float:
    """Least squares fit of seconds ∝ knots^e."""
    slope = np.polyfit(np.log(knots), np.log(seconds), 1)[0]
    return round(float(slope), 2)
