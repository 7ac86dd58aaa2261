"""Unknown heights: what is ruled out is ruled out at every height, and heights that help are found."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from app.bench.common.edited_gaits import edited_gait
from core.arrays import Floats
from core.gait.gait import drawn_timeline, heading_step, motion_problem
from core.library.library import library
from core.motion.trajectory import Trajectory, turn_trajectory
from core.problem.footholds import are_footholds_given
from core.problem.motion_check import check_motion
from core.problem.motion_problem import MotionProblem, Workspace
from core.robot.leg import foot_from_strokes
from core.robot.model import load_robot
from solver_jobs.live.assembly import natural_linearisation, outer_rows
from solver_jobs.live.elastic import PROOF_MM, nearest
from solver_jobs.live.free_heights import with_free_heights
from solver_jobs.live.linearisation import MM, Linearisation, ranges
from solver_jobs.live.qp import Solver
from solver_jobs.live.reach import top_of_reach
from solver_jobs.live.solve import quick_motion, solve_live
from solver_jobs.nlp.motion_nlp import solve_motion
from solver_jobs.results.motion import Evidence, SolveStatus
from tests.solver_jobs.live.test_live import asked, expect_solved

OVERLOOKED_MM = 2e-3
"""Twice the checker's tolerance."""


def free_heights(problem: MotionProblem) -> Linearisation:
    return with_free_heights(natural_linearisation(problem.turned(-problem.quarter_turns)))


def unknowns_of(linearisation: Linearisation, motion: Trajectory) -> Floats:
    """The unknowns of a motion that somebody else found, mm and mm/s."""
    assert linearisation.vertical is not None
    assert motion.body_velocity is not None
    assert motion.feet_velocity is not None
    x = np.zeros(linearisation.size)
    places = np.concatenate([motion.body_world[:, None], motion.feet_world], axis=1)
    speeds = np.concatenate([motion.body_velocity[:, None], motion.feet_velocity], axis=1)
    for kind, values in enumerate((places * MM, speeds * MM)):
        ground, heights = linearisation.index[kind], linearisation.vertical[kind]
        x[ground[ground >= 0]] = values[..., :2][ground >= 0]
        x[heights[heights >= 0]] = values[..., 2][heights >= 0]
    return x


@pytest.mark.heavy
@pytest.mark.parametrize("number", range(24))
def test_motions_of_the_exact_tier_lie_within_the_rows_around_the_discs(number: int) -> None:
    gait = edited_gait(3, number).gait
    problem = motion_problem(gait, load_robot(gait.robot))
    result = solve_motion(problem)
    if result.status is not SolveStatus.SOLVED:
        pytest.skip("no motion")
    if not are_footholds_given(problem):
        pytest.skip("the exact tier chooses footholds")
    linearisation = free_heights(problem)
    x = unknowns_of(linearisation, turn_trajectory(result.trajectory, -problem.quarter_turns))
    for rows in outer_rows(linearisation, 32):
        assert rows.excess(x).max(initial=0.0) < OVERLOOKED_MM, rows.family
    centre, reach = ranges(linearisation)
    assert (np.abs(x - centre) <= reach + OVERLOOKED_MM).all()
    found = nearest(Solver(), linearisation, outer_rows(linearisation, 32))
    assert found is not None
    assert found.proven < PROOF_MM


@pytest.mark.parametrize(
    ("gait", "step", "height"),
    [("amble", 0.024, 0.0605), ("s-gait", 0.020, 0.0605), ("s-gait", 0.024, 0.053), ("c-gait", 0.024, 0.057)],
)
def test_heights_between_start_and_goal_are_found(gait: str, step: float, height: float) -> None:
    problem = asked(gait, step, plane_height=height, margin=0.003)
    assert quick_motion(problem, 64) is None
    motion = expect_solved(problem).trajectory
    assert np.ptp(motion.body_world[:, 2]) > 1e-4


@pytest.mark.parametrize(
    ("iterations", "sentence"),
    [
        (1, "This is proven: no motion of the model can do it."),
        (2, "Proven for evenly spread footholds, at every body height."),
    ],
)
def test_a_proof_says_what_it_takes_as_given(iterations: int, sentence: str) -> None:
    chosen = library()["s-gait"].gait.with_options(margin=0.010)
    gait = replace(chosen, step=heading_step(chosen.orientation, 0.020), iterations=iterations)
    result = solve_live(motion_problem(replace(gait, timeline=drawn_timeline(gait)), load_robot(gait.robot)))
    assert result.evidence is Evidence.PROVEN
    assert "Balance is" in result.explanation[0]
    assert result.explanation[-1] == sentence


@pytest.mark.parametrize("robot", ["deltawalker", "hexapod"])
def test_no_foot_is_above_the_top_of_reach(robot: str) -> None:
    model = load_robot(robot)
    grid = np.linspace(model.stroke.lower, model.stroke.upper, 20)
    strokes = np.stack(np.meshgrid(grid, grid, grid), axis=-1).reshape(-1, 3)
    highest = float(foot_from_strokes(model.leg, strokes)[:, 2].max()) * MM
    assert highest <= top_of_reach(model) <= highest + 0.5


@pytest.mark.parametrize("workspace", list(Workspace))
def test_a_swing_too_short_for_the_clearance_is_named(workspace: Workspace) -> None:
    problem = asked("walk", 0.010, workspace=workspace, clearance=0.0069, phase_knots=3)
    result = solve_live(problem)
    assert (result.status, result.evidence) == (SolveStatus.INFEASIBLE, Evidence.PROVEN)
    assert {lack.family for lack in result.lacks} == {"clearance"}
    assert not check_motion(problem, result.trajectory).confirmed
    assert "would have to rise to 6.9 mm" in result.explanation[0]
