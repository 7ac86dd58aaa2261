"""The published optimised trajectories before the checker: none keeps the limits that it was made for.

docs/sources.md: start and goal lie 0.3 mm below the body's height bound, and the published
workspace contradicted it, so that feet rise out of the paper's cylinder; error 4: the torque was not held.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.gait.gait import heading_step, motion_problem
from core.gait.options import GaitOptions
from core.library.library import library
from core.motion.contact_timeline import timeline_from_order
from core.problem.motion_check import MotionCheck, check_motion
from core.problem.motion_problem import Workspace
from core.robot.model import load_robot
from core.wire.trajectory_csv import parse_trajectory_csv
from tests.support.reference import reference_path

MODEL = load_robot("deltawalker")
GAITS = {"walk": "walk", "ambl": "amble", "mtri": "s-gait", "adjs": "c-gait"}
STEPS = {"a": (0.010, 1), "b": (0.015, 1), "c": (0.020, 1), "d": (0.025, 1), "e": (0.060, 3)}
NAMES = [f"{gait}_{step}" for gait in GAITS for step in "abcd"] + ["walk_e", "mtri_e"]


def published_check(name: str, workspace: Workspace) -> MotionCheck:
    """The checker's view of one file; forces are not in it, so the families of forces say nothing."""
    path = reference_path(f"trajectories/direction1/{name}.csv")
    read = parse_trajectory_csv(path.read_text(), path.name).trajectory
    gait, (travel, iterations) = library()[GAITS[name[:4]]].gait, STEPS[name[-1]]
    timeline = timeline_from_order(4, gait.order, closing_knots=0, iterations=iterations)
    step = heading_step(gait.orientation, travel / iterations)
    problem = motion_problem(replace(gait, step=step, iterations=iterations, timeline=timeline), MODEL)
    motion = replace(read, contact_forces=np.zeros_like(read.feet_world))
    return check_motion(
        replace(problem, limits=GaitOptions(workspace=workspace).motion_limits()),
        motion,
    )


@pytest.mark.parametrize("name", NAMES)
def test_a_published_motion_breaks_height_and_reach(name: str) -> None:
    cylinder = published_check(name, Workspace.CYLINDER)
    assert cylinder.violations["body_height"] == pytest.approx(0.0003, abs=2e-5)
    assert cylinder.violations["boundary"] == pytest.approx(0.0008, abs=2e-5)
    assert 0.002375 < cylinder.violations["workspace"] < 0.006
    stroke = published_check(name, Workspace.STROKE)
    assert 0.001 < stroke.violations["workspace"] < 0.004


@pytest.mark.parametrize("name", NAMES)
def test_only_the_shorter_published_walks_keep_their_balance(name: str) -> None:
    margin = published_check(name, Workspace.STROKE).min_cop_margin
    assert (margin > 0) is (name in {"walk_a", "walk_b", "walk_c"})
    assert margin > -0.011
