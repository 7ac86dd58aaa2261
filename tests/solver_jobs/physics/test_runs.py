"""Motors against their limits, walks that are known, symmetry, repeatability."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.arrays import Floats
from core.errors import SimulationCancelledError
from core.gait.gait import motion_problem
from core.library.library import library
from core.motion.trajectory import quarter_turn, turn_trajectory
from core.physics.findings import TILT_LIMIT, physics_outcomes
from core.physics.metrics import FALL_TILT, report
from core.physics.problem import Rig, SimulationProblem
from core.physics.ramp import TURN
from core.physics.variations import variations, varied_problem
from core.problem.motion_problem import Cost
from core.robot.kinematics import feet_in_robot
from core.wire.robot_time import RAMP_SPEED, ramp_time
from core.wire.waypoint_merging import plan_waypoints
from core.wire.waypoints import Waypoints
from solver_jobs import simulate, simulate_variations, solve_live
from solver_jobs.physics.simulate import simulate as simulate_at
from solver_jobs.physics.simulate import simulate_together
from solver_jobs.physics.stepping import TIME_STEP, VARIED_STEP
from tests.support.solvers.rigs import (
    MIDDLE,
    MODEL,
    SCALES,
    planned,
    problem_of_strokes,
    resting,
    strokes_of,
    walk,
)


def one_motor(to: float) -> Floats:
    """One motor of a robot at rest goes somewhere."""
    strokes = resting()
    strokes[1, 0, 0] = to
    return strokes


def part_of(problem: SimulationProblem, first: int, last: int) -> SimulationProblem:
    """Some of a problem's waypoints; the plan begins where they do."""
    sent = slice(first, last)
    plan = problem.plan
    later = replace(
        plan,
        times=plan.times[first:],
        body_world=plan.body_world[first:],
        heading=plan.heading[first:],
        feet_world=plan.feet_world[first:],
        contact=plan.contact[first:],
        body_velocity=None,
        feet_velocity=None,
        contact_forces=None,
    )
    waypoints = Waypoints(problem.waypoints.strokes[sent], problem.waypoints.durations[sent])
    return replace(
        problem,
        waypoints=waypoints,
        plan=later,
        times=problem.times[sent],
        contact=problem.contact[sent],
        standing=problem.standing[sent],
    )


def test_a_motor_follows_its_ramp_within_its_speed() -> None:
    motion = simulate(problem_of_strokes(one_motor(0.018), Rig.CLAMPED))
    stroke, others = motion.strokes[:, 0, 0], motion.strokes.reshape(-1, 12)[:, 1:]
    speeds = np.diff(stroke) / TURN
    assert speeds.max() == pytest.approx(RAMP_SPEED, rel=0.03)
    assert stroke[-1] == pytest.approx(0.018, abs=1e-6)
    moving = TURN * np.count_nonzero(np.abs(speeds) > 1e-4)
    assert moving == pytest.approx(ramp_time(0.010), abs=0.05)
    assert np.abs(others - MIDDLE).max() < 1e-5


def test_a_slow_motor_arrives_late_and_never_faster_than_it_can() -> None:
    slow = replace(SCALES, weak_motor=0, weak_share=0.4)
    usual, late = (
        simulate(problem_of_strokes(one_motor(0.018), Rig.CLAMPED, physics=physics))
        for physics in (SCALES, slow)
    )
    speeds = np.diff(late.strokes[:, 0, 0]) / TURN
    assert speeds.max() == pytest.approx(0.4 * RAMP_SPEED, rel=0.03)
    assert late.times[late.arrivals[-1]] > usual.times[usual.arrivals[-1]] + 0.5
    assert abs(late.strokes[-1, 0, 0] - 0.018) <= 0.001 + 1e-9


def test_motors_too_weak_for_the_weight_give_way_at_their_limit() -> None:
    weak = replace(SCALES, motor_force=0.2)
    problem = problem_of_strokes(resting(3), physics=weak)
    motion = simulate(problem)
    assert np.abs(motion.motor_forces).max() <= 0.2 + 1e-12
    assert motion.body_world[-1, 2] < problem.plan.body_world[0, 2] - 0.001
    assert motion.strokes[-1].max() < MIDDLE - 0.001


def test_a_margin_keeps_the_walk_upright_and_near_its_plan() -> None:
    problem = walk("walk", 0.010, margin=0.003)
    found = report(problem, simulate(problem))
    assert not found.fell
    assert found.max_tilt < TILT_LIMIT
    assert found.feet_mean_error < 0.0005
    assert found.slip.max() < 0.0005
    assert found.loop_error < 2e-5


def tipping_walk(clearance: float) -> SimulationProblem:
    """A walk whose centre of pressure may leave the support by 5 mm, which no document can ask for."""
    gait = library()["walk"].gait.with_options(margin=0.0, clearance=clearance, cost=Cost.GOAL)
    asked = motion_problem(gait, MODEL)
    motion = solve_live(replace(asked, limits=replace(asked.limits, margin=-0.005))).trajectory
    return planned(MODEL, plan_waypoints(MODEL, motion), motion)


@pytest.mark.heavy
@pytest.mark.parametrize(("clearance", "rule"), [(0.003, "simulated_tilt"), (0.001, "simulated_swing")])
def test_a_margin_of_5_mm_too_little_is_reported_however_low_feet_are(clearance: float, rule: str) -> None:
    problem = tipping_walk(clearance)
    outcomes = physics_outcomes(report(problem, simulate(problem)), problem)
    assert rule in [finding.rule for outcome in outcomes for finding in outcome.findings]


def test_a_robot_that_leans_downhill_falls_and_the_run_ends_there() -> None:
    steep = replace(SCALES, ground_tilt=(0.0, 0.45), friction=5.0)
    strokes = resting(10)
    strokes[2:] = strokes_of(feet_in_robot(MODEL, resting(1))[0] - np.array([0.010, 0.0, 0.0]))
    problem = problem_of_strokes(strokes, physics=steep)
    motion = simulate(problem)
    found = report(problem, motion)
    assert motion.ended_early.startswith("It fell over at")
    assert found.fell
    assert found.max_tilt > FALL_TILT
    assert 2 <= len(motion.arrivals) < 10


def test_a_robot_that_cannot_stand_falls_before_its_first_move() -> None:
    wall = replace(SCALES, ground_tilt=(0.0, 1.2), friction=5.0)
    problem = problem_of_strokes(resting(), physics=wall)
    motion = simulate(problem)
    assert motion.ended_early == "It fell over before its first move."
    assert report(problem, motion).fell


def test_a_quarter_turn_turns_the_run_with_it() -> None:
    straight = part_of(walk("s-gait", 0.010, margin=0.003), 0, 12)
    turned = replace(
        straight,
        plan=turn_trajectory(straight.plan, 1),
        waypoints=Waypoints(np.roll(straight.waypoints.strokes, 1, axis=1), straight.waypoints.durations),
        contact=np.roll(straight.contact, 1, axis=1),
        standing=np.roll(straight.standing, 1, axis=1),
    )
    before, after = simulate(straight), simulate(turned)
    expected = np.roll(before.feet_world, 1, axis=1) @ quarter_turn(1).T
    np.testing.assert_allclose(after.feet_world, expected, atol=2e-5)


def test_the_same_run_gives_the_same_bits_alone_and_beside_others() -> None:
    problem = part_of(walk("walk", 0.010, margin=0.003), 0, 8)
    others = [varied_problem(problem, one) for one in variations(SCALES, 2, 5, 12)]
    first = simulate(problem)
    together = simulate_together([others[0], problem, others[1]], threads=2)
    for again in (simulate(problem), together[1]):
        assert again.feet_world.tobytes() == first.feet_world.tobytes()
        assert again.ground_forces.tobytes() == first.ground_forces.tobytes()
    assert together[0].feet_world.tobytes() != first.feet_world.tobytes()


@pytest.mark.heavy
def test_halving_the_step_moves_the_feet_by_less_than_half_a_millimetre() -> None:
    problem = part_of(tipping_walk(clearance=0.003), 0, 16)
    whole, half = simulate(problem), simulate_at(problem, time_step=TIME_STEP / 2)
    assert np.abs(whole.feet_world - half.feet_world).max() < 0.0005


def test_variations_are_reported_one_by_one_with_progress() -> None:
    problem, told = problem_of_strokes(resting()), list[float]()

    def tell(share: float) -> bool:
        told.append(share)
        return True

    runs = simulate_variations(problem, 10, 1, tell)
    assert [run.walks for run in runs] == [True] * 10
    assert len({run.variation.words for run in runs}) == 10
    assert told == sorted(told)
    assert told[-1] == 1.0


def test_a_refused_progress_cancels() -> None:
    with pytest.raises(SimulationCancelledError):
        simulate(problem_of_strokes(resting()), lambda share: False)


def test_a_robot_whose_cable_drags_and_whose_mass_lies_aside_walks_otherwise() -> None:
    usual = part_of(walk(), 0, 12)
    plain = simulate_at(usual, time_step=VARIED_STEP)
    for change in ({"cable_drag": 1.0}, {"centre_offset": (0.004, 0.0)}, {"backlash": 0.001}):
        changed = replace(usual, physics=replace(SCALES, **change))
        moved = simulate_at(changed, time_step=VARIED_STEP)
        rows = min(len(plain.times), len(moved.times))
        assert np.abs(plain.feet_world[:rows] - moved.feet_world[:rows]).max() > 1e-5
