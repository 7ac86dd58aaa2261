"""The trajectories that were published or asked for, as gaits."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from core.gait.gait import Gait, drawn_timeline, heading_step, with_return
from core.gait.options import GaitOptions
from core.library.library import appendix_orders, library
from core.problem.motion_problem import Workspace
from core.robot.model import load_robot

STEPS = (0.010, 0.015, 0.020, 0.025)
"""Published steps, m."""

TURNS_DEG = (15, 20, 30, 40, -15)
"""Published turns."""

CLOSINGS = (5, 0)
"""Knots of the closing stance: ours, and as published."""

PAPER_ORDER = (3, 2, 4, 1)


@dataclass(frozen=True)
class Published:
    """What the thesis, the paper or the solver's published logs say of a case.

    Args:
        seconds: solver time.
        outcome: how it ended.
    """

    seconds: str
    outcome: str


WALKING = Published("1,629 to 4,634", "never converged")
ROTATING = Published("449 to 1,475", "never converged")
THREE_ITERATIONS = Published("50,728 to 55,084", "never converged")
NOTHING = Published("–", "–")


@dataclass(frozen=True)
class Case:
    """One case.

    Args:
        group: which part of the table.
        name: what a person calls it.
        gait: at direction 1.
        published: what is known of it from elsewhere.
    """

    group: str
    name: str
    gait: Gait
    published: Published


def all_cases() -> Iterator[Case]:
    """Every case in both workspaces, with the closing stance and without; rotations end with their return."""
    for group in (_steps, _orders, _three_iterations, _paper):
        for workspace, closing in product(Workspace, CLOSINGS):
            yield from group(workspace, closing)
    for workspace in Workspace:
        yield from _rotations(workspace)


def _gait(name: str, workspace: Workspace, closing: int, iterations: int = 1) -> Gait:
    options = GaitOptions(workspace=workspace, closing_knots=closing)
    gait = replace(library()[name].gait, options=options, iterations=iterations)
    return replace(gait, timeline=drawn_timeline(gait))


def _stepping(gait: Gait, step: float) -> Gait:
    return replace(gait, step=heading_step(gait.orientation, step))


def _steps(workspace: Workspace, closing: int) -> Iterator[Case]:
    for name in appendix_orders():
        for step in STEPS:
            gait = _stepping(_gait(name, workspace, closing), step)
            yield Case("steps", f"{name} {step * 1000:.0f} mm", gait, WALKING)


def _orders(workspace: Workspace, closing: int) -> Iterator[Case]:
    for name, orders in appendix_orders().items():
        for order in orders:
            gait = replace(_stepping(_gait(name, workspace, closing), STEPS[0]), order=order)
            gait = replace(gait, timeline=drawn_timeline(gait))
            yield Case("orders", f"{name} {'-'.join(map(str, order))}", gait, NOTHING)


def _three_iterations(workspace: Workspace, closing: int) -> Iterator[Case]:
    for name in ("walk", "s-gait"):
        gait = _stepping(_gait(name, workspace, closing, iterations=3), 0.020)
        yield Case("iterations", f"{name} 3 × 20 mm", gait, THREE_ITERATIONS)


def _paper(workspace: Workspace, closing: int) -> Iterator[Case]:
    quarter, longer = Published("about 1,500", ""), Published("about 4,500", "")
    table = {
        "A": (0.020, 1, replace(quarter, outcome="tips over a foot in simulation")),
        "B": (0.010, 1, replace(quarter, outcome="stable in simulation")),
        "C": (0.020, 2, replace(longer, outcome="two feet do not lift in simulation")),
    }
    for name, (travel, iterations, published) in table.items():
        gait = replace(_gait("walk", workspace, closing, iterations), order=PAPER_ORDER)
        gait = replace(gait, step=(travel / iterations, travel / iterations, 0.0))
        words = f"paper {name}, ({travel * 1000:.0f}, {travel * 1000:.0f}) mm"
        yield Case("paper", words, replace(gait, timeline=drawn_timeline(gait)), published)


def _rotations(workspace: Workspace) -> Iterator[Case]:
    rotate = library()["rotate"].gait
    options = replace(rotate.options, workspace=workspace, margin=GaitOptions.margin)
    for degrees in TURNS_DEG:
        gait = replace(rotate, step=(0.0, 0.0, float(np.radians(degrees))), options=options)
        gait = with_return(gait, load_robot(gait.robot))
        published = ROTATING if degrees == TURNS_DEG[0] else NOTHING
        yield Case("rotation", f"rotate {degrees}°", gait, published)
