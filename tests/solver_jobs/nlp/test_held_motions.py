"""Motions with feet held up, by both tiers, and why there is none."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.checks.checked_plan import Asked, CheckedPlan
from core.checks.rules import check_plan
from core.gait.gait import Gait, motion_problem, travel_world
from core.gait.held_feet import HeldFeet
from core.motion.trajectory import Trajectory, turn_trajectory
from core.problem.motion_check import check_motion
from core.problem.motion_problem import Boundary, MotionProblem, Workspace
from core.problem.swing_height import held_knots
from core.robot.model import load_robot
from core.wire.waypoint_path import waypoints_from_trajectory
from solver_jobs import SolveStatus, solve_exact, solve_live
from solver_jobs.nlp.constraint import situation_of
from solver_jobs.nlp.timing import SMALLEST_PHASE, fastest_timing, rounded_timeline
from solver_jobs.remedies.search import find_remedies
from tests.support.held_gaits import DOWN, UP, drawn, lifting, lowering, wave

LONG = "1" * 15


def problem_of(gait: Gait) -> MotionProblem:
    return motion_problem(gait, load_robot(gait.robot))


def stepping(held: HeldFeet) -> Gait:
    """A hexapod that steps 10 mm; feet 1 and 4 are lifted, or come down, in their turn."""
    rows = [list("1" * 65) for _ in range(6)]
    for turn, foot in enumerate((2, 3, 1, 4, 5, 6)):
        first = 10 * turn + 5
        begin = 0 if foot in held.start else first
        end = 65 if foot in held.end else first + 5
        rows[foot - 1][begin:end] = "0" * (end - begin)
    return drawn("hexapod", ["".join(row) for row in rows], held, step=0.010)


LIVE = {
    "hexapod, one up": wave("hexapod", (3,)),
    "hexapod, two up": wave("hexapod", (1, 4)),
    "hexapod, two up, no margin": wave("hexapod", (1, 4), margin=0.0),
    "hexapod, two up, turning": replace(wave("hexapod", (1, 4)), step=(0.0, 0.0, 0.2)),
    "hexapod, two up, cycle": wave("hexapod", (1, 4), phase_knots=3, boundary=Boundary.PERIODIC),
    "hexapod, two up, motors": wave("hexapod", (1, 4), motor_speed=0.015, motor_acceleration=0.05),
    "hexapod, two up, friction": wave("hexapod", (1, 4), friction=0.3),
    "hexapod, two up, cylinder": wave("hexapod", (2, 5), workspace=Workspace.CYLINDER),
    "dodecapod, three up": wave("dodecapod", (3, 7, 11), phase_knots=3),
    "6 to 4": lifting("hexapod", (1, 4)),
    "4 to 6": lowering("hexapod", (1, 4)),
    "6 to 4, stepping": stepping(HeldFeet(end=(1, 4))),
    "4 to 6, stepping": stepping(HeldFeet(start=(1, 4))),
    "6 to 4, adjacent feet": lifting("hexapod", (1, 2)),
    "quadruped, one up": drawn("deltawalker", [LONG, LONG, LONG, "1" * 5 + "0" * 10], HeldFeet(end=(4,))),
}


def require_held(problem: MotionProblem, motion: Trajectory) -> None:
    """Held feet are in the air at their end, carry nothing, and stay up until they come down."""
    assert motion.contact_forces is not None
    for held, knot in ((problem.held_start, 0), (problem.held_end, -1)):
        assert not motion.contact[knot, held].any()
        assert (motion.feet_world[knot, held, 2] >= 0.003 - 1e-9).all()
        assert not motion.contact_forces[knot, held].any()
    for swing in situation_of(problem).swings:
        if problem.held_start[swing.foot] or problem.held_end[swing.foot]:
            knots, height = held_knots(problem, swing)
            assert (motion.feet_world[knots, swing.foot, 2] >= height - 1e-6).all()


@pytest.mark.parametrize("name", LIVE)
def test_the_live_tier_solves_it_and_every_rule_passes(name: str) -> None:
    gait = LIVE[name]
    problem = problem_of(gait)
    result = solve_live(problem)
    assert result.status is SolveStatus.SOLVED, result.explanation
    assert check_motion(problem, result.trajectory).confirmed
    require_held(problem, result.trajectory)
    waypoints = waypoints_from_trajectory(problem.model, result.trajectory)
    travel = travel_world(gait, problem.model)
    asked = Asked(held=gait.held)
    verdict = check_plan(CheckedPlan(problem.model, result.trajectory, waypoints, travel, asked=asked))
    rules = {finding.rule for finding in verdict.findings} - {"move_size"}
    assert rules <= ({"balance"} if gait.options.margin == 0.0 else set())
    assert verdict.passed


@pytest.mark.heavy
@pytest.mark.parametrize("name", ["hexapod, two up, cycle", "6 to 4", "4 to 6", "quadruped, one up"])
def test_the_exact_tier_solves_it_too(name: str) -> None:
    problem = problem_of(LIVE[name])
    result = solve_exact(problem)
    assert result.status is SolveStatus.SOLVED, result.explanation
    assert check_motion(problem, result.trajectory).confirmed
    require_held(problem, result.trajectory)


@pytest.mark.parametrize("held", [(1, 7), (2, 5, 9)])
def test_every_direction_has_the_same_motion_with_its_own_feet_up(held: tuple[int, ...]) -> None:
    gait = wave("dodecapod", held, phase_knots=3)
    first = solve_live(problem_of(gait)).trajectory
    for direction in (2, 3, 4):
        turned = replace(
            gait,
            direction=direction,
            timeline=gait.timeline.turned(direction - 1),
            held=gait.held.turned(3 * (direction - 1), 12),
        )
        result = solve_live(problem_of(turned))
        assert result.status is SolveStatus.SOLVED
        same = turn_trajectory(first, direction - 1)
        np.testing.assert_allclose(result.trajectory.feet_world, same.feet_world, atol=1e-9)
        np.testing.assert_allclose(result.trajectory.body_world, same.body_world, atol=1e-9)


NARROW = drawn("deltawalker", [LONG, "1" * 5 + "0" * 10, LONG, "1" * 5 + "0" * 10], HeldFeet(end=(2, 4)))
WIDE = lifting("hexapod", (1, 4), margin=0.030)
HIGH = lifting("hexapod", (2,), clearance=0.006)
QUICK = replace(
    drawn("hexapod", ["1" * 10 + "00", *[DOWN] * 5], HeldFeet(end=(1,))),
    timeline=replace(
        drawn("hexapod", ["1" * 10 + "00", *[DOWN] * 5], HeldFeet(end=(1,))).timeline, sample_time=0.1
    ),
)


@pytest.mark.parametrize(
    ("gait", "sentence"),
    [
        (NARROW, "Feet 2, 4 are in the air together at samples 6 to 15"),
        (WIDE, "With feet 1 and 4 held up at the last sample the robot rests on feet 2, 3, 5 and 6: its"),
        (HIGH, "Foot 2 is held 6.0 mm up at the last sample, which is 1.0 mm more than its leg can draw in"),
        (QUICK, "Foot 1 is in the air at sample 11: too short to go 3.0 mm up to where it is held"),
    ],
)
def test_what_held_feet_rule_out_is_proven_and_named_by_both_tiers(gait: Gait, sentence: str) -> None:
    for solve in (solve_live, solve_exact):
        result = solve(problem_of(gait))
        assert result.status is SolveStatus.INFEASIBLE
        assert result.explanation[0].startswith(sentence)
        assert "proven" in result.explanation[-1]


def test_what_is_missing_names_the_feet_that_are_up() -> None:
    result = solve_live(problem_of(wave("hexapod", (3, 5))))
    assert result.status is SolveStatus.INFEASIBLE
    assert any("with feet 3, 4 and 5 in the air" in sentence for sentence in result.explanation)


def test_a_remedy_leaves_held_feet_where_they_are() -> None:
    gait = stepping(HeldFeet(end=(1, 4)))
    search = find_remedies(replace(gait, step=(0.040, 0.0, 0.0)), load_robot("hexapod"), lambda: True)
    assert any(remedy.label.startswith("Step") for remedy in search.remedies)
    for remedy in search.remedies:
        problem = problem_of(remedy.gait)
        assert np.nonzero(problem.held_end)[0].tolist() == [0, 3]


def test_the_shortest_timing_ends_with_the_same_feet_up() -> None:
    gait = drawn("hexapod", [UP, *[DOWN] * 5], HeldFeet(end=(1,)), motor_speed=0.015)
    timing = fastest_timing(problem_of(gait), SMALLEST_PHASE)
    assert timing.status is SolveStatus.SOLVED
    assert timing.total_seconds < timing.drawn_seconds
    assert rounded_timeline(timing, 0.4).stance[:, -1].tolist() == [False, *[True] * 5]
