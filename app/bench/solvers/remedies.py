"""Remedies of random drawings that cannot walk: how soon they come, and whether they walk in physics."""

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from app.bench.common.measure import Row, milliseconds
from app.bench.common.random_drawings import Drawing, Family, is_refused, random_drawing
from app.plans.make_plan import make_plan
from app.simulation.problem import simulation_problem
from core.errors import FootfallError
from core.findings import Severity
from core.gait.gait import Gait, motion_problem
from core.physics.findings import physics_outcomes
from core.physics.masses import default_physics
from core.physics.metrics import report
from core.robot.model import RobotModel, load_robot
from solver_jobs import (
    Remedy,
    completed_drawing,
    completion_question,
    find_remedies,
    nothing_words,
    simulate,
    solve_exact,
    solve_live,
    solve_pattern,
)

COUNT = 60
SEED = 2

PATTERN_SECONDS = 10.0
"""Longest search for footfalls near a drawing without a remedy, s."""

SMALL_SHARE = 0.05
"""Of the step that the exact tier tries for it."""


@dataclass(frozen=True, eq=False)
class Tried:
    """A drawing, and what was found for it.

    Args:
        drawing: which cannot walk.
        seconds: that the search took.
        remedies: best first.
        walks: whether each remedy without a caution walks in physics.
        why: of a drawing without a remedy: the sentence that is given, and whether anything could help.
    """

    drawing: Drawing
    seconds: float
    remedies: tuple[Remedy, ...]
    walks: tuple[bool, ...]
    why: str


def bench_remedies(count: int = COUNT, seed: int = SEED) -> list[Row]:
    """For each family of drawings its figures, and a row a drawing."""
    return [row for family in Family for row in family_rows(family, count, seed)]


def family_rows(family: Family, count: int, seed: int) -> list[Row]:
    """The figures of one family of drawings, and a row a drawing."""
    tried = [_tried(random_drawing(seed, number, family)) for number in range(count)]
    figures = [_row(family, name, None, text, "") for name, text in _figures(tried).items()]
    return figures + [
        _row(
            family,
            f"{seed}/{one.drawing.number}: {one.drawing.words}{' (refused)' if one.drawing.refused else ''}",
            one.seconds,
            "; ".join(_words(remedy) for remedy in one.remedies) or f"none: {one.why}",
            ", ".join("yes" if walks else "no" for walks in one.walks),
        )
        for one in tried
    ]


def _row(family: Family, drawing: str, seconds: float | None, remedies: str, walk: str) -> Row:
    ms = None if seconds is None else milliseconds(seconds)
    return {"family": family.value, "drawing": drawing, "ms": ms, "remedies": remedies, "walk": walk}


def _tried(drawing: Drawing) -> Tried:
    begin = time.perf_counter()
    found = find_remedies(drawing.gait, load_robot(drawing.gait.robot)).remedies
    seconds = time.perf_counter() - begin
    walks = tuple(walks_in_physics(remedy.gait) for remedy in found if not remedy.caution)
    return Tried(drawing, seconds, found, walks, "" if found else why_none(drawing.gait))


def _figures(tried: Sequence[Tried]) -> dict[str, str]:
    count = len(tried)
    walks = [one.walks for one in tried]
    seconds = [one.seconds for one in tried]
    return {
        "with a remedy that walks": f"{sum(any(one) for one in walks)} of {count}",
        "whose first remedy walks": f"{sum(bool(one) and one[0] for one in walks)} of {count}",
        "remedies that walk": f"{sum(map(sum, walks))} of {sum(map(len, walks))}",
        "without any remedy": f"{sum(not one.remedies for one in tried)} of {count}",
        "search, median and p95, ms": (
            f"{milliseconds(float(np.median(seconds)))}, {milliseconds(float(np.percentile(seconds, 95)))}"
        ),
    }


def why_none(gait: Gait) -> str:
    """The sentence that the page gives for a drawing without a remedy, and whether anything could help it.

    The pattern search finishes the drawing, or proves that no footfalls fit its locked cells; where it finds
    none, the exact tier tries the drawing with next to no step and no margin.
    """
    model = load_robot(gait.robot)
    finished = _finished(gait, model)
    if finished is not None:
        return f"{nothing_words(gait)} ({finished})"
    small = replace(gait, step=_small(gait.step)).with_options(margin=0.0)
    try:
        exact = solve_exact(motion_problem(small, model)).status.value
    except FootfallError:
        exact = "refused"
    text = "no footfalls near it were found; with next to no step and no margin the exact tier calls it"
    return f"{nothing_words(gait)} ({text} {exact})"


def _finished(gait: Gait, model: RobotModel) -> str | None:
    """What comes of the pattern search's finished drawing; None where it finds no footfalls."""
    question = completion_question(gait, model)
    patterns = () if question is None else solve_pattern(question, seconds=PATTERN_SECONDS).patterns
    if not patterns:
        return None
    try:
        finished = completed_drawing(gait, model, patterns[0].stance)
    except FootfallError as error:
        return f"finished by the pattern search it is refused: {error.sentence}"
    if is_refused(finished) is not None:
        return "finished by the pattern search it has no motion"
    return f"finished by the pattern search it {'walks' if walks_in_physics(finished) else 'tips'}"


def _small(step: tuple[float, float, float]) -> tuple[float, float, float]:
    dx, dy, yaw = (SMALL_SHARE * part for part in step)
    return dx, dy, yaw


def walks_in_physics(gait: Gait) -> bool:
    """Whether a gait's plan, as it would be sent, has no error in the default physics."""
    plan = make_plan(gait, None, solve_live)
    problem = simulation_problem(plan, default_physics(plan.model))
    outcomes = physics_outcomes(report(problem, simulate(problem)), problem)
    return not any(finding.severity is Severity.ERROR for one in outcomes for finding in one.findings)


def _words(remedy: Remedy) -> str:
    return f"{remedy.label}, caution" if remedy.caution else remedy.label
