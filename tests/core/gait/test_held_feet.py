"""Feet held up: what a gait may say, its timeline, the drawing, the checker and the resting body."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.errors import InputError
from core.gait.gait import Gait, drawn_timeline, motion_problem, resting_poses, travel_world, with_iterations
from core.gait.held_feet import LEAST_HEIGHT, HeldFeet, held_height, held_sentence
from core.gait.motion_source import MotionSource, motion_source
from core.library.new_gait import with_robot
from core.motion.contact_timeline import Swing
from core.motion.heading_profile import HeadingProfile
from core.motion.support_polygon import stability_margins
from core.motion.trajectory import Trajectory
from core.problem.initial_guess import closed_contact, initial_guess, problem_swings
from core.problem.motion_check import check_motion
from core.problem.motion_problem import Boundary, MotionProblem, standing_pose
from core.problem.resting_pose import RESERVE, resting_body
from core.problem.swing_height import held_climb, held_knots
from core.recorded.recorded_gait import gait_of_motion
from core.robot.model import load_robot
from solver_jobs import solve_live
from tests.support.held_gaits import DOWN, drawn, lifting, lowering, wave

HEXAPOD = load_robot("hexapod")
WAVE = wave("hexapod", (1, 4))


def problem_of(gait: Gait) -> MotionProblem:
    return motion_problem(gait, load_robot(gait.robot))


@pytest.fixture(scope="module")
def solved() -> tuple[MotionProblem, Trajectory]:
    """Feet 1 and 4 lift to be held; a motion that the checker confirms."""
    problem = problem_of(lifting("hexapod", (1, 4)))
    motion = solve_live(problem).trajectory
    assert check_motion(problem, motion).confirmed
    return problem, motion


@pytest.mark.parametrize(
    ("held", "sentence"),
    [
        (HeldFeet(), ""),
        (HeldFeet((4, 1), (1, 4)), "Feet 1 and 4 are held up throughout."),
        (HeldFeet((2,), (2, 3)), "Foot 2 is held up throughout, foot 3 is held up at the end."),
        (HeldFeet(start=(1, 2, 3)), "Feet 1, 2 and 3 are held up at the start."),
    ],
)
def test_held_feet_are_told_in_a_sentence(held: HeldFeet, sentence: str) -> None:
    assert held_sentence(held) == sentence


@pytest.mark.parametrize(
    ("held", "message"),
    [
        (HeldFeet(start=(7,)), "held.start names foot 7; the gait has feet 1 to 6"),
        (HeldFeet(end=(0,)), "held.end names foot 0"),
        (HeldFeet(end=(1, 2, 3, 4, 5, 6)), "names every foot, and the robot would fall"),
    ],
)
def test_feet_that_no_gait_can_hold_are_refused(held: HeldFeet, message: str) -> None:
    with pytest.raises(InputError, match=message):
        replace(WAVE, held=held)


def test_a_foot_is_held_once() -> None:
    with pytest.raises(InputError, match="must name each foot once"):
        HeldFeet(start=(2, 2))


LIFTED = lifting("hexapod", (1,))
LATE, EARLY = "1" * 11 + "0", "0" + "1" * 11


@pytest.mark.parametrize(
    ("gait", "message"),
    [
        (
            replace(LIFTED, held=HeldFeet()),
            "Foot 1 is in the air at the last sample.*to stance, or hold it up",
        ),
        (replace(LIFTED, held=HeldFeet(end=(1, 2))), "Foot 2 is to be held up at the last sample but stands"),
        (replace(LIFTED, held=HeldFeet(start=(1,), end=(1,))), "Foot 1 is to be held up at the first sample"),
        (drawn("hexapod", [LATE, *[DOWN] * 5], HeldFeet(end=(1,))), "held up at the last sample alone"),
        (drawn("hexapod", [EARLY, *[DOWN] * 5], HeldFeet((1,))), "cannot come down from there in no time"),
        (LIFTED.with_options(boundary=Boundary.PERIODIC), "start it holds none up and at its end foot 1"),
    ],
)
def test_a_timeline_that_does_not_fit_is_refused_with_a_way_out(gait: Gait, message: str) -> None:
    with pytest.raises(InputError, match=message):
        problem_of(gait)


def test_a_swing_may_still_begin_with_the_first_sample_from_the_ground() -> None:
    problem = problem_of(drawn("hexapod", ["0" * 6 + "1" * 6, *[DOWN] * 5], HeldFeet()))
    assert not problem.held_start.any()
    assert check_motion(problem, solve_live(problem).trajectory).confirmed


def test_the_poses_carry_the_held_feet_and_every_other_one_stands() -> None:
    problem = problem_of(replace(lifting("hexapod", (1, 4)), step=(0.004, 0.0, 0.0)))
    assert problem.start.feet_world[:, 2].tolist() == [0.0] * 6
    assert problem.goal.feet_world[:, 2].tolist() == [0.003, 0, 0, 0.003, 0, 0]
    places = HEXAPOD.module_centres_robot[:, :2] + [0.004, 0.0]
    np.testing.assert_allclose(problem.goal.feet_world[:, :2], places)
    assert closed_contact(problem)[-1].tolist() == [False, True, True, False, True, True]


@pytest.mark.parametrize(
    ("clearance", "height"), [(0.0, LEAST_HEIGHT), (0.002, LEAST_HEIGHT), (0.004, 0.004)]
)
def test_feet_are_held_as_high_as_swings_rise_and_at_least_three_millimetres(
    clearance: float, height: float
) -> None:
    assert held_height(clearance) == height


def test_a_timeline_of_order_and_phases_keeps_held_feet_in_the_air() -> None:
    assert motion_source(WAVE) is MotionSource.OPTIMISED
    assert WAVE.timeline.sample_count == 4 * 10 + 5
    assert not WAVE.timeline.stance[[0, 3]].any()
    twice = with_iterations(WAVE, 2)
    assert not twice.timeline.stance[[0, 3]].any()
    assert np.array_equal(twice.timeline.stance, drawn_timeline(twice).stance)


def test_a_drawn_timeline_with_held_feet_is_repeated_with_its_closing_stance_once() -> None:
    stance = WAVE.timeline.stance.copy()
    stance[1, 5] = True
    twice = with_iterations(replace(WAVE, timeline=replace(WAVE.timeline, stance=stance)), 2)
    assert twice.timeline.sample_count == 2 * 40 + 5
    assert not twice.timeline.stance[[0, 3]].any()


def test_a_gait_that_ends_with_other_feet_up_is_not_repeated() -> None:
    with pytest.raises(InputError, match="holds none up and at its end feet 1 and 4"):
        with_iterations(lifting("hexapod", (1, 4)), 2)
    assert with_iterations(lifting("hexapod", (1, 4)), 1).held == HeldFeet(end=(1, 4))


def test_the_body_may_turn_back_while_feet_are_held_up() -> None:
    turned = replace(WAVE, step=(0.0, 0.0, 0.1)).with_options(turning=HeadingProfile.RETURN)
    heading = problem_of(turned).heading
    assert not heading[:40].any()
    assert heading[-1] == pytest.approx(0.1)


def test_a_robot_with_other_feet_holds_none() -> None:
    assert with_robot(WAVE, load_robot("dodecapod")).held == HeldFeet()
    assert with_robot(WAVE, HEXAPOD).held == WAVE.held


def test_turning_hands_the_raised_pose_on_with_the_timeline() -> None:
    problem = problem_of(lifting("dodecapod", (2, 8)))
    turned = problem.turned(1)
    assert np.nonzero(turned.held_end)[0].tolist() == [4, 10]
    assert np.array_equal(turned.turned(-1).goal.feet_world, problem.goal.feet_world)


@pytest.mark.parametrize("gait", [WAVE, lifting("hexapod", (1, 4)), lowering("hexapod", (2,))])
def test_the_drawing_keeps_the_ends_the_integrator_and_the_ground(gait: Gait) -> None:
    problem = problem_of(gait)
    motion = initial_guess(problem)
    assert motion.feet_velocity is not None
    for knot, pose in ((0, problem.start), (-1, problem.goal)):
        np.testing.assert_allclose(motion.feet_world[knot], pose.feet_world, atol=1e-15)
        assert not motion.feet_velocity[knot].any()
    ways = 0.2 * (motion.feet_velocity[1:] + motion.feet_velocity[:-1])
    np.testing.assert_allclose(np.diff(motion.feet_world, axis=0), ways, atol=1e-15)
    assert not motion.feet_world[motion.contact][:, 2].any()
    assert motion.feet_world[..., 2].min() >= -1e-15
    assert not motion.contact[-1, problem.held_end].any()


@given(st.floats(-0.02, 0.02), st.lists(st.floats(0.05, 1.0), min_size=2, max_size=20))
def test_a_climb_adds_up_to_its_rise_and_never_turns_back(rise: float, around: list[float]) -> None:
    intervals = np.array(around)
    speed = held_climb(rise, intervals, 0.015)
    resting = np.concatenate([[0.0], speed, [0.0]])
    assert (intervals * (resting[1:] + resting[:-1]) / 2).sum() == pytest.approx(rise, abs=1e-12)
    assert (speed * np.sign(rise) >= 0).all()


def test_a_foot_stays_up_until_it_comes_down_last_and_rises_first() -> None:
    up, down = (problem_of(make("hexapod", (1,))) for make in (lifting, lowering))
    (lift,), (land,) = problem_swings(up), problem_swings(down)
    assert (lift, land) == (Swing(0, 5, 10), Swing(0, 0, 6))
    assert held_knots(up, lift) == (range(8, 11), 0.003)
    assert held_knots(down, land) == (range(1, 4), 0.003)


def moved(motion: Trajectory, knot: int, foot: int, by: float) -> Trajectory:
    feet = np.array(motion.feet_world)
    feet[knot, foot, 2] += by
    return replace(motion, feet_world=feet)


def test_a_held_foot_that_ends_too_low_breaks_the_boundary(solved: tuple[MotionProblem, Trajectory]) -> None:
    problem, motion = solved
    check = check_motion(problem, moved(motion, -1, 0, -0.001))
    assert check.violations["boundary"] == pytest.approx(0.001)


def test_no_force_holds_a_foot_in_the_air(solved: tuple[MotionProblem, Trajectory]) -> None:
    problem, motion = solved
    forces = np.array(motion.contact_forces)
    forces[-2, 0, 2] = 0.1
    check = check_motion(problem, replace(motion, contact_forces=forces))
    assert check.violations["floating_force"] == pytest.approx(0.1)


def test_a_held_foot_may_not_be_said_to_stand_at_the_end(solved: tuple[MotionProblem, Trajectory]) -> None:
    problem, motion = solved
    contact = np.array(motion.contact)
    contact[-1] = True
    with pytest.raises(InputError, match="contact"):
        check_motion(problem, replace(motion, contact=contact))


def test_clearance_is_asked_of_feet_that_stand_before_and_after_only(
    solved: tuple[MotionProblem, Trajectory],
) -> None:
    problem, motion = solved
    higher = replace(problem, limits=replace(problem.limits, clearance=0.02))
    assert check_motion(higher, motion).violations["clearance"] == 0.0
    landed = problem.timeline.stance.copy()
    landed[0, -1] = True
    standing = replace(higher, timeline=replace(problem.timeline, stance=landed))
    assert check_motion(standing, motion).violations["clearance"] > 0.01


def test_a_body_that_rests_outside_the_standing_feet_is_found() -> None:
    problem = problem_of(lifting("hexapod", (1, 2), margin=0.0))
    centred = standing_pose(HEXAPOD, 0.0535, (0.0, 0.0)).raised((1, 2), 0.003)
    asked = replace(problem, goal=centred, limits=replace(problem.limits, margin=0.002))
    motion = solve_live(asked).trajectory
    assert check_motion(asked, motion).violations["body_torque"] >= 0.002 - 1e-9


@given(st.sets(st.integers(1, 12), min_size=1, max_size=9), st.floats(0.0, 0.01))
def test_a_leaning_body_is_balanced_or_cannot_be_and_takes_the_shortest_way(
    up: set[int], margin: float
) -> None:
    model = load_robot("dodecapod")
    held = tuple(sorted(up))
    natural = standing_pose(model, 0.0535, (0.0, 0.0)).raised(held, 0.003)
    pose = resting_body(natural, held, margin)
    standing = np.array([[foot + 1 not in held for foot in range(12)]])

    def margin_of(place: np.ndarray) -> float:
        return float(stability_margins(place[None, :2], pose.feet_world[None], standing)[0])

    assert np.array_equal(pose.feet_world[standing[0]], natural.feet_world[standing[0]])
    way = pose.body_world - natural.body_world
    np.testing.assert_allclose(
        pose.feet_world[~standing[0]] - natural.feet_world[~standing[0]], [way] * len(up), atol=1e-15
    )
    if way.any():
        assert margin_of(pose.body_world) == pytest.approx(margin + RESERVE, abs=1e-9)
        assert margin_of(natural.body_world + 0.99 * way) < margin + RESERVE
    elif margin_of(natural.body_world) < margin + RESERVE - 1e-9:
        # No place inside: the standing feet's polygon is too narrow.
        corners = pose.feet_world[standing[0], :2]
        grid = (np.random.default_rng(0).dirichlet(np.ones(len(corners)), 200) @ corners)[:, :2]
        assert max(margin_of(place) for place in grid) < margin + RESERVE


def test_a_gait_whose_body_rests_aside_says_how_far_it_goes() -> None:
    quadruped = lifting("deltawalker", (4,))
    start, goal = resting_poses(quadruped, load_robot("deltawalker"))
    np.testing.assert_allclose(start.body_world[:2], 0.0)
    np.testing.assert_allclose(goal.body_world[:2], [0.0, 0.004], atol=1e-12)
    np.testing.assert_allclose(travel_world(quadruped, load_robot("deltawalker")), [0.0, 0.004], atol=1e-12)
    assert travel_world(WAVE, HEXAPOD) == pytest.approx([0.010, 0.0])


@pytest.mark.parametrize("gait", [WAVE, lifting("hexapod", (1, 4)), lowering("hexapod", (1, 4))])
def test_a_recorded_motion_knows_which_feet_it_holds(gait: Gait) -> None:
    described = gait_of_motion(solve_live(problem_of(gait)).trajectory, "again", "hexapod")
    assert described.gait.held == gait.held
    assert np.array_equal(described.gait.timeline.stance, gait.timeline.stance)
    assert held_sentence(gait.held) in described.remarks
    problem_of(described.gait)


def test_a_motion_that_ends_with_a_foot_just_above_the_ground_holds_none() -> None:
    motion = solve_live(problem_of(lifting("hexapod", (1,)))).trajectory
    described = gait_of_motion(moved(motion, -1, 0, -0.0025), "low", "hexapod")
    assert described.gait.held == HeldFeet()
    assert described.gait.timeline.stance[:, -1].all()
