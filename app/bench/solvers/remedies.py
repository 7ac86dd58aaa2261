"""Remedies of random drawings that cannot walk: how soon they come, and whether they walk in physics."""

import time

import numpy as np

from app.bench.common.measure import Row, milliseconds
from app.bench.common.random_drawings import random_drawing
from app.plans.plan import make_plan
from app.simulation.problem import simulation_problem
from core.findings import Severity
from core.gait.gait import Gait
from core.physics.findings import physics_outcomes
from core.physics.masses import default_physics
from core.physics.metrics import report
from core.robot.model import load_robot
from solver_jobs import Remedy, find_remedies, simulate, solve_live

COUNT = 60
SEED = 2


def bench_remedies(count: int = COUNT, seed: int = SEED) -> list[Row]:
    """A row a drawing, and the figures of all before them."""
    rows, seconds, walking = [], [], []
    for number in range(count):
        drawing = random_drawing(seed, number)
        begin = time.perf_counter()
        found = find_remedies(drawing.gait, load_robot(drawing.gait.robot)).remedies
        seconds.append(time.perf_counter() - begin)
        walks = [walks_in_physics(remedy.gait) for remedy in found if not remedy.caution]
        walking.append(walks)
        rows.append(
            {
                "drawing": f"{seed}/{number}: {drawing.words}{' (refused)' if drawing.refused else ''}",
                "ms": milliseconds(seconds[-1]),
                "remedies": "; ".join(_words(remedy) for remedy in found),
                "walk": ", ".join("yes" if one else "no" for one in walks),
            }
        )
    offered = sum(len(walks) for walks in walking)
    figures = {
        "with a remedy that walks": f"{sum(any(walks) for walks in walking)} of {count}",
        "whose first remedy walks": f"{sum(bool(walks) and walks[0] for walks in walking)} of {count}",
        "remedies that walk": f"{sum(sum(walks) for walks in walking)} of {offered}",
        "search, median and p95, ms": (
            f"{milliseconds(float(np.median(seconds)))}, {milliseconds(float(np.percentile(seconds, 95)))}"
        ),
    }
    return [
        {"drawing": name, "ms": None, "remedies": text, "walk": ""} for name, text in figures.items()
    ] + rows


def walks_in_physics(gait: Gait) -> bool:
    """Whether a gait's plan, as it would be sent, has no error in the default physics."""
    plan = make_plan(gait, None, solve_live)
    problem = simulation_problem(plan, default_physics(plan.model))
    outcomes = physics_outcomes(report(problem, simulate(problem)), problem)
    return not any(finding.severity is Severity.ERROR for one in outcomes for finding in one.findings)


def _words(remedy: Remedy) -> str:
    return f"{remedy.label}, caution" if remedy.caution else remedy.label
