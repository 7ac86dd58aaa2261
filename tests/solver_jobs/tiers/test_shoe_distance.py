"""Both tiers keep shoes apart, exactly and only where they would meet, and explain where they cannot."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from core.gait.gait import motion_problem
from core.gait.options import GaitOptions
from core.library.library import library
from core.motion.contact_timeline import ContactTimeline
from core.problem.motion_check import check_motion
from core.problem.motion_problem import Boundary, Cost, MotionProblem, RestPose
from core.robot.model import RobotModel, load_robot
from core.robot.shoes import foot_distances, least_distance
from solver_jobs import Evidence, MotionResult, SolveStatus, solve_live
from solver_jobs.live.linearisation import linearise
from solver_jobs.live.shoes import shoe_rows, shoes_meet
from solver_jobs.nlp.motion_nlp import solve_motion
from tests.support.solvers.cases import BARE

MODEL = load_robot("deltawalker")
LEAST = 0.028
TIERS = {"live": solve_live, "exact": solve_motion}

Tier = Callable[[MotionProblem], MotionResult]
each_tier = pytest.mark.parametrize("solve", TIERS.values(), ids=TIERS)


def passing(
    model: RobotModel, near: float = 0.027, aside: float = 0.008, motor_speed: float | None = None
) -> MotionProblem:
    """Foot 1 goes past foot 2, which stands so near to its straight way."""
    centres = model.module_centres_robot
    between = centres[1] - centres[0]
    along = between / np.linalg.norm(between)
    across = np.array([-along[1], along[0], 0.0])
    inwards = (np.linalg.norm(between) - near) / 2 * along
    feet = np.tile(centres, (2, 1, 1))
    feet[:, 0] += inwards
    feet[:, 1] -= inwards
    feet[0, 0] += aside * across
    feet[1, 0] -= aside * across
    stance = np.ones((4, 30), dtype=np.bool_)
    stance[0, 10:20] = False
    timeline = ContactTimeline(stance, np.zeros_like(stance), 0.4)
    body = np.array([0.0, 0.0, 0.056 + model.com_height])
    start, goal = (RestPose(body, place) for place in feet)
    return MotionProblem(
        model, timeline, start, goal, GaitOptions(motor_speed=motor_speed).motion_limits(), Cost.GOAL
    )


def walk(sole: float) -> MotionProblem:
    """The walk of a robot with other shoes; its feet come within 46.6 mm of each other."""
    wide = replace(MODEL, shape=replace(MODEL.shape, sole_diameter=sole))
    return motion_problem(library()["walk"].gait, wide)


def nearest(result: MotionResult) -> float:
    return float(foot_distances(result.trajectory.feet_world).min())


@each_tier
@pytest.mark.parametrize("speed", [None, 0.0149])
def test_a_foot_swings_round_the_shoe_that_is_in_its_way(solve: Tier, speed: float | None) -> None:
    problem = passing(MODEL, motor_speed=speed)
    free, kept = solve(replace(problem, model=BARE)), solve(problem)
    assert free.status is kept.status is SolveStatus.SOLVED
    assert nearest(free) < 0.0271
    assert nearest(kept) == pytest.approx(LEAST, abs=1e-6)
    check = check_motion(problem, kept.trajectory)
    assert check.confirmed, check.violations
    assert check_motion(passing(MODEL), free.trajectory).violations["shoe_distance"] > 0.0009


@each_tier
@pytest.mark.parametrize("turns", [1, 2, 3])
def test_it_does_so_in_every_direction(solve: Tier, turns: int) -> None:
    result = solve(passing(MODEL).turned(turns))
    assert result.status is SolveStatus.SOLVED
    assert nearest(result) == pytest.approx(LEAST, abs=1e-6)


@each_tier
@pytest.mark.parametrize("sole", [0.025, 0.043])
def test_a_motion_that_keeps_clear_is_the_same_with_shoes_of_any_size(solve: Tier, sole: float) -> None:
    bare = solve(motion_problem(library()["walk"].gait, BARE))
    shod = solve(walk(sole))
    assert shod.status is SolveStatus.SOLVED
    np.testing.assert_allclose(shod.trajectory.feet_world, bare.trajectory.feet_world, atol=1e-6)


@each_tier
def test_footholds_that_bring_shoes_together_are_explained_by_feet_and_millimetres(solve: Tier) -> None:
    result = solve(walk(0.046))
    # The live tier knows at once that two feet stand too near each other; IPOPT searches.
    evidence = Evidence.PROVEN if solve is solve_live else Evidence.DIAGNOSED
    assert (result.status, result.evidence) == (SolveStatus.INFEASIBLE, evidence)
    worst = result.lacks[0]
    assert (worst.family, worst.feet, worst.unit) == ("shoe_distance", (1, 2), "mm")
    assert worst.amount == pytest.approx(2.43, abs=0.01)
    assert "feet 2 and 3" in worst.sentence
    assert "shoes" in worst.sentence.lower()


@each_tier
def test_given_footholds_without_room_are_ruled_out_before_any_search(solve: Tier) -> None:
    result = solve(passing(MODEL, near=0.027, aside=0.002))
    assert (result.status, result.evidence) == (SolveStatus.INFEASIBLE, Evidence.PROVEN)
    assert result.explanation[0] == (
        "Feet 1 and 2 are given 27.1 mm apart at the start, and their shoes need 28.0 mm. Move their "
        "footholds apart."
    )


def test_a_cycle_s_places_are_not_given() -> None:
    cycle = replace(passing(MODEL, near=0.0275, aside=0.0), boundary=Boundary.PERIODIC)
    sentences = " ".join(solve_motion(cycle).explanation)
    assert "are given" not in sentences


@pytest.mark.parametrize("name", ["deltawalker9", "deltawalker5"])
def test_robots_without_shoes_have_no_such_rows(name: str) -> None:
    bare = load_robot(name)
    problem = motion_problem(library()["walk"].gait, bare)
    motion = solve_live(problem).trajectory
    assert least_distance(bare) is None
    assert not shoes_meet(problem, motion, room=1.0)
    assert shoe_rows(linearise(problem), motion) == []
    assert "shoe_distance" not in check_motion(problem, motion).violations


def test_rows_between_shoes_mean_what_is_left_of_their_distance() -> None:
    problem = passing(MODEL)
    motion = solve_live(replace(problem, model=BARE)).trajectory
    linearisation = linearise(problem)
    (rows,) = shoe_rows(linearisation, motion)
    x = np.zeros(linearisation.size)
    for kind, values in enumerate((motion.feet_world, motion.feet_velocity)):
        index = linearisation.index[kind, :, 1:]
        x[index[index >= 0]] = np.asarray(values)[..., :2][index >= 0] * 1000
    distances = foot_distances(motion.feet_world)[:, [0, 3, 5, 2]] * 1000
    np.testing.assert_allclose(rows.excess(x).reshape(distances.shape), 28.0 - distances, atol=1e-6)
