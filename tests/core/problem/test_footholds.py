"""Where feet rest between their swings: evenly where all step equally often, else where the walk is."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.gait.gait import motion_problem
from core.gait.held_feet import HeldFeet
from core.library.library import Group, group_ids, library, library_patterns
from core.motion.contact_timeline import timeline_from_rows
from core.problem.footholds import way_shares
from core.problem.initial_guess import initial_guess, problem_swings
from core.problem.motion_problem import MotionProblem
from core.robot.model import load_robot
from solver_jobs import SolveStatus, solve_live

WALK = library()["walk"].gait


def drawn(*rows: str, held: HeldFeet | None = None) -> MotionProblem:
    timeline = timeline_from_rows(rows, 0.4)
    gait = replace(WALK.with_options(margin=0.003), timeline=timeline, held=held or HeldFeet())
    return motion_problem(gait, load_robot("deltawalker"))


def shares(problem: MotionProblem) -> list[list[float]]:
    return [found.tolist() for found in way_shares(problem, problem_swings(problem))]


@pytest.mark.parametrize("gait_id", [*group_ids(Group.OPTIMISED), *group_ids(Group.PATTERNS)])
def test_where_all_feet_step_equally_often_ways_are_shared_evenly(gait_id: str) -> None:
    gait = library_patterns()[gait_id].used(3) if gait_id in library_patterns() else library()[gait_id].gait
    problem = motion_problem(gait, load_robot(gait.robot))
    for found in shares(problem):
        assert found == pytest.approx(np.linspace(0, 1, len(found)).tolist())


def test_a_foot_that_steps_once_more_rests_where_the_walk_is() -> None:
    problem = drawn(
        "1001111111111001111",
        "1111001111111111111",
        "1111111001111111111",
        "1111111111001111111",
    )
    found = shares(problem)
    assert found[1:] == [[0.0, 1.0]] * 3
    # In the middle of foot 1's inner stance the third of five swings has just ended its first half.
    assert found[0] == pytest.approx([0.0, 0.5, 1.0])


def test_what_a_foot_held_in_the_air_does_is_no_step() -> None:
    held = HeldFeet(start=(1,))
    problem = drawn(
        "0000000000000000111100111111",
        "1110011111111111111111111111",
        "1111110011111111001111111111",
        "1111111110011111111100111111",
        held=held,
    )
    found = shares(problem)
    # Three of the six steps are before foot 1 comes down, a third of the walk each with three feet in it; it
    # lands where the walk is in its stance.
    assert found[0][0] == 0.0
    assert found[0][1] == pytest.approx((1.0 + 1.0 / 4) / (1.0 + 3.0 / 4), abs=0.05)
    assert found[0][2] == 1.0


def test_shares_rise_and_a_foot_without_a_swing_stays() -> None:
    problem = drawn("1111111111111", "1001100110011", "1111111111111", "1001110011111")
    found = shares(problem)
    assert found[0] == found[2] == [0.0]
    for row in found:
        assert row == sorted(row)


def test_a_drawing_of_unequal_steps_reaches_its_goal_and_the_live_tier_solves_it() -> None:
    problem = drawn(
        "1111100000111111111111111111111000001111111111",
        "1111111111111110000011111111111111111111111111",
        "1111111111000001111111111111111111111111111111",
        "1111111111111111111100000111111111111111111111",
    )
    motion = initial_guess(problem)
    assert motion.feet_world[-1] == pytest.approx(problem.goal.feet_world)
    assert np.ptp(motion.feet_world[24:30, 0], axis=0).max() < 1e-12
    assert solve_live(problem).status is SolveStatus.SOLVED
