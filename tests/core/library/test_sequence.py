"""Sequences: chained motions, the moves between them, and the document that follows from its parts."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core.errors import InfeasibleError, InputError
from core.gait.chain import Chain, Piece, chain
from core.gait.gait import Gait, SequencePart, motion_problem
from core.gait.manual_motion import manual_motion
from core.gait.options import GaitOptions
from core.gait.transition import feet_transition
from core.library.library import library, optimised_entry
from core.library.sequence import chain_runs, derived, ends_and_contact, run_of, sequence_gait
from core.motion.balance import balance_margins
from core.motion.speeds import motor_accelerations
from core.motion.support_polygon import stability_margins, trajectory_pressure
from core.motion.trajectory import Trajectory
from core.problem.body_move import BodyPlace, body_move
from core.problem.motion_check import TOLERANCE, check_motion
from core.problem.motion_problem import Boundary, MotionLimits, MotionProblem, standing_pose
from core.problem.start_footholds import placed_on
from core.robot.kinematics import feet_in_modules
from core.robot.model import RobotModel, load_robot
from solver_jobs import solve_live

MODEL = load_robot("deltawalker")


def gait(name: str) -> Gait:
    return library()[name].gait


def part(name: str, times: int = 1) -> SequencePart:
    return SequencePart(gait(name), times, name)


def chained(*motions: Trajectory) -> Chain:
    pieces = [Piece(f"Part {index + 1}", index, motion) for index, motion in enumerate(motions)]
    return chain(MODEL, pieces, GaitOptions(), no_steps)


def no_steps(before: Piece, piece: Piece, problem: MotionProblem) -> Trajectory:
    raise AssertionError(f"no foot has to step between {before.name} and {piece.name}")


def standing(travel: float, turn: float, height: float = 0.0535, knots: int = 6) -> Trajectory:
    """A gait's ends: from standing at the origin to standing elsewhere, with everything straight between."""
    start = standing_pose(MODEL, height, (0.0, 0.0))
    goal = standing_pose(MODEL, height, (travel, 0.0), turn)
    share = np.linspace(0.0, 1.0, knots)
    feet = start.feet_world + share[:, None, None] * (goal.feet_world - start.feet_world)
    return Trajectory(
        times=np.asarray(np.arange(knots) * 0.4, dtype=np.float64),
        body_world=start.body_world + share[:, None] * (goal.body_world - start.body_world),
        heading=share * turn,
        feet_world=feet,
        contact=np.ones((knots, 4), dtype=np.bool_),
    )


def feet_in_body(model: RobotModel, motion: Trajectory) -> np.ndarray:
    return feet_in_modules(model, motion.feet_world, motion.pose(model))


FIELDS = ("times", "body_world", "heading", "feet_world", "contact")


@pytest.mark.parametrize("name", ["walk", "rotate", "s-gait-manual-1"])
def test_a_chain_of_one_is_that_motion(name: str) -> None:
    motion = ends_and_contact(gait(name), MODEL)
    whole = chained(motion)
    for field in FIELDS:
        assert np.array_equal(getattr(whole.trajectory, field), getattr(motion, field))
    assert whole.spans[0].last == motion.knot_count - 1


@given(
    st.lists(
        st.tuples(st.floats(-0.02, 0.02), st.floats(-0.6, 0.6)),
        min_size=2,
        max_size=6,
    )
)
def test_headings_add_up_and_travel_turns_with_them(moves: list[tuple[float, float]]) -> None:
    whole = chained(*(standing(travel, turn) for travel, turn in moves))
    expected, heading = np.zeros(2), 0.0
    for travel, turn in moves:
        expected += travel * np.array([np.cos(heading), np.sin(heading)])
        heading += turn
    assert whole.turn == pytest.approx(heading, abs=1e-12)
    assert whole.travel == pytest.approx(expected, abs=1e-12)


@given(st.floats(-0.6, 0.6), st.floats(-0.02, 0.02))
def test_where_two_motions_meet_the_robot_stands_as_the_later_one_begins(turn: float, travel: float) -> None:
    before, after = standing(travel, turn), standing(0.01, 0.0)
    whole = chained(before, after)
    knot = whole.spans[0].last
    own = feet_in_body(MODEL, whole.trajectory)
    assert own[knot] == pytest.approx(feet_in_body(MODEL, before)[-1], abs=1e-12)
    assert own[knot] == pytest.approx(feet_in_body(MODEL, after)[0], abs=1e-12)
    assert own[knot + 1 :] == pytest.approx(feet_in_body(MODEL, after)[1:], abs=1e-12)


def test_more_than_a_full_turn_is_kept() -> None:
    whole = chained(*[standing(0.0, 0.6)] * 12)
    assert whole.turn == pytest.approx(7.2, abs=1e-12)


def test_a_part_that_turns_runs_so_many_times_as_copies() -> None:
    sequence = sequence_gait("Turn", [part("rotate", 3)])
    copies = [ends_and_contact(gait("rotate"), MODEL)] * 3
    once = chained(*copies).trajectory
    whole = chain_runs(sequence, MODEL, copies[:1], no_steps).trajectory
    for field in FIELDS:
        assert np.array_equal(getattr(whole, field), getattr(once, field))
    assert sequence.step[2] == pytest.approx(np.pi / 4, abs=1e-12)


def test_a_part_that_walks_runs_through_its_iterations_without_a_pause() -> None:
    run = run_of(part("walk", 3))
    assert (run.gait.iterations, run.copies) == (3, 1)
    assert run.gait.timeline.sample_count == 3 * 40 + 5
    by_hand = run_of(part("walk-manual-0", 3)).gait
    assert manual_motion(by_hand, MODEL).trajectory.knot_count < 3 * 55


def test_a_hand_drawn_timeline_that_does_not_divide_is_repeated_as_a_whole() -> None:
    walk = gait("walk")
    stance = np.array(walk.timeline.stance)
    twice = replace(walk, iterations=2, timeline=replace(walk.timeline, stance=np.roll(stance, 1, axis=1)))
    assert run_of(SequencePart(twice, 2)).copies == 2


def test_the_body_moves_to_another_height_with_every_foot_standing() -> None:
    low, high = standing(0.01, 0.3, 0.0535), standing(0.01, 0.0, 0.0565)
    whole = chained(low, high)
    move = whole.spans[1]
    assert move.is_transition
    assert move.part == 1
    knots = slice(move.first, move.last + 1)
    t = whole.trajectory
    assert t.contact[knots].all()
    assert np.ptp(t.feet_world[knots], axis=0).max() < 1e-12
    assert t.body_world[move.last, 2] - t.body_world[move.first, 2] == pytest.approx(0.003, abs=1e-12)
    assert np.abs(np.diff(t.strokes(MODEL)[knots], axis=0)).max() / 0.4 <= MODEL.stroke.speed


@settings(max_examples=20, deadline=None)
@given(st.floats(0.0025, 0.006), st.floats(-0.1, 0.1), st.floats(0.002, 0.015))
def test_a_move_keeps_its_speeds_and_follows_from_its_velocities(
    rise: float, turn: float, speed: float
) -> None:
    start = standing_pose(MODEL, 0.0535, (0.0, 0.0))
    goal = BodyPlace(start.body_world + [0.0, 0.0, rise], turn)
    limits = GaitOptions(body_speed=speed).motion_limits()
    motion = body_move(MODEL, BodyPlace(start.body_world, 0.0), goal, start.feet_world, limits, 0.4)
    assert motion.body_world[-1] == pytest.approx(goal.body_world, abs=1e-12)
    assert motion.heading[-1] == pytest.approx(turn, abs=1e-12)
    assert motion.body_velocity is not None
    half = 0.2 * (motion.body_velocity[1:] + motion.body_velocity[:-1])
    assert np.diff(motion.body_world, axis=0) == pytest.approx(half, abs=1e-12)
    assert np.linalg.norm(np.diff(motion.body_world, axis=0), axis=1).max() / 0.4 <= speed + TOLERANCE
    assert balance_margins(MODEL, motion)[0].min() > 0.02


@pytest.mark.parametrize(
    "options",
    [
        GaitOptions(body_speed=0.1, motor_acceleration=0.02),
        GaitOptions(body_speed=0.1, friction=0.01),
        GaitOptions(body_speed=0.1, margin=0.0325),
        GaitOptions(body_speed=0.1, margin=0.05),
    ],
)
def test_a_move_keeps_acceleration_friction_and_as_much_of_the_margin_as_its_ends(
    options: GaitOptions,
) -> None:
    start = standing_pose(MODEL, 0.0535, (0.0, 0.0))
    goal = BodyPlace(start.body_world + [0.003, 0.002, 0.0], 0.0)

    def kept(limits: MotionLimits) -> list[bool]:
        motion = body_move(MODEL, BodyPlace(start.body_world, 0.0), goal, start.feet_world, limits, 0.02)
        pressure = trajectory_pressure(MODEL, motion)
        shift = np.linalg.norm(pressure - motion.body_world[:-1, :2], axis=1)
        margins, _ = balance_margins(MODEL, motion)
        rest = stability_margins(motion.body_world[:, :2], motion.feet_world, motion.contact)
        limit = options.motor_acceleration or np.inf
        return [
            motor_accelerations(MODEL, motion).max() <= limit + TOLERANCE,
            (shift / motion.body_world[:-1, 2]).max() <= (options.friction or np.inf) + TOLERANCE,
            margins.min() >= min(options.margin, rest[0], rest[-1]) - TOLERANCE,
        ]

    assert all(kept(options.motion_limits()))
    assert not all(kept(GaitOptions(body_speed=0.1).motion_limits()))


def test_a_move_that_no_rod_can_follow_is_refused() -> None:
    start = standing_pose(MODEL, 0.0535, (0.0, 0.0))
    goal = BodyPlace(start.body_world + [0.06, 0.0, 0.0], 0.0)
    limits = GaitOptions().motion_limits()
    with pytest.raises(InfeasibleError, match="out of reach on the way"):
        body_move(MODEL, BodyPlace(start.body_world, 0.0), goal, start.feet_world, limits, 0.4)


def test_a_move_takes_as_few_samples_as_its_speed_allows_and_is_refused_where_they_are_too_many() -> None:
    start = standing_pose(MODEL, 0.0535, (0.0, 0.0))
    goal = BodyPlace(start.body_world + [0.0, 0.0, 0.003], 0.0)

    def moved(sample_time: float) -> Trajectory:
        limits = GaitOptions(body_speed=0.001).motion_limits()
        return body_move(MODEL, BodyPlace(start.body_world, 0.0), goal, start.feet_world, limits, sample_time)

    # The fastest of K intervals goes 1.5/K of the way: 3 mm at 1 mm/s take 4.5 s.
    assert moved(0.01).knot_count == pytest.approx(450, abs=3)
    with pytest.raises(InfeasibleError, match=r"for more than 2000 samples of 0.001 s to keep"):
        moved(0.001)


def test_the_document_says_the_whole_way() -> None:
    sequence = sequence_gait("Tour", [part("walk", 3), part("rotate", 3), part("s-gait", 2)])
    root = np.sqrt(0.5)
    assert sequence.step == pytest.approx((0.03 * root + 0.02 * root, 0.03 * root + 0.02 * root, np.pi / 4))
    assert sequence.iterations == 1
    assert sequence.timeline.sample_count == 125 + 3 * 44 + 84
    assert derived(sequence) == sequence


def test_the_timeline_is_the_contact_of_the_chained_motion() -> None:
    parts = [part("walk-manual-0", 2), part("rotate", 2), part("amble-manual-1")]
    sequence = sequence_gait("By hand", parts)
    runs = [run_of(one).gait for one in parts]
    whole = chain_runs(sequence, MODEL, [ends_and_contact(run, MODEL) for run in runs], no_steps)
    assert np.array_equal(whole.trajectory.contact.T, sequence.timeline.stance)
    assert [span.is_transition for span in whole.spans] == [False, True, False, False, True, False]


def test_roles_are_told_where_all_parts_share_them() -> None:
    assert sequence_gait("x", [part("walk"), part("rotate")]).roles == gait("walk").roles
    assert sequence_gait("x", [part("walk"), part("s-gait")]).roles == ("",) * 4


def shortened(segments: int) -> SequencePart:
    """The amble by hand up to a segment, after which a foot has stepped and is not home again."""
    made = gait("amble-manual-0")
    table = made.segment_table
    assert table is not None
    rows = tuple(row[:segments] for row in table.rows)
    return SequencePart(
        replace(made, segment_table=replace(table, rows=rows, repeat_to=None, repeat_from=1, link=()))
    )


def test_a_foot_that_stands_elsewhere_steps_and_the_others_stay() -> None:
    odd = shortened(4)
    sequence = sequence_gait("x", [odd, part("walk")])
    first = manual_motion(odd.gait, MODEL).trajectory
    assert sequence.timeline.sample_count == first.knot_count + 14 + 44
    between = sequence.timeline.stance[:, first.knot_count - 1 : first.knot_count + 14]
    assert (~between).sum(axis=1).tolist() == [5, 0, 0, 0]
    then = placed_on(first, ends_and_contact(gait("walk"), MODEL))
    assert then.stays.tolist() == [False, True, True, True]


def test_the_steps_between_are_a_problem_from_where_the_robot_stands() -> None:
    first = standing(0.01, 0.4)
    feet = np.array(first.feet_world)
    feet[-1, 2, 0] += 0.006
    moved = replace(first, feet_world=feet)
    then = placed_on(moved, standing(0.0, 0.0))
    way = feet_transition(MODEL, moved, then, GaitOptions(margin=0.003))
    solved = way.placement.motion(solve_live(way.problem).trajectory)
    assert check_motion(way.problem, solve_live(way.problem).trajectory).confirmed
    assert solved.feet_world[0] == pytest.approx(moved.feet_world[-1], abs=1e-9)
    assert solved.feet_world[-1] == pytest.approx(then.motion.feet_world[0], abs=1e-6)
    assert solved.heading[[0, -1]] == pytest.approx([0.4, then.motion.heading[0]], abs=1e-12)
    assert [swing.foot for swing in way.problem.timeline.swings()] == [2]


@pytest.mark.parametrize(
    ("sample_time", "family", "options"),
    [
        (0.4, "motor_acceleration", GaitOptions(motor_acceleration=0.01, margin=0.003)),
        (0.05, "friction", GaitOptions(friction=0.01, margin=0.003, body_speed=0.1, foot_speed=0.1)),
    ],
)
def test_the_steps_between_keep_every_limit_of_the_sequence(
    sample_time: float, family: str, options: GaitOptions
) -> None:
    times = np.arange(6, dtype=np.float64) * sample_time
    first, second = (replace(standing(travel, 0.4), times=times) for travel in (0.01, 0.0))
    feet = np.array(first.feet_world)
    feet[-1, 2, 0] += 0.006
    moved = replace(first, feet_world=feet)
    problem = feet_transition(MODEL, moved, placed_on(moved, second), options).problem
    free = replace(problem, limits=replace(problem.limits, friction=None, motor_acceleration=None))
    assert check_motion(problem, solve_live(free).trajectory).violations[family] > 0.001
    assert check_motion(problem, solve_live(problem).trajectory).confirmed


@pytest.mark.parametrize("moved", [(), (4,), (0, 3, 7), tuple(range(9))])
def test_of_many_feet_all_stay_that_can(moved: tuple[int, ...]) -> None:
    model = load_robot("dodecapod")
    place = standing_pose(model, 0.0535, (0.0, 0.0))
    feet = np.array([place.feet_world, place.feet_world])
    contact = np.ones((2, 12), dtype=np.bool_)
    motion = Trajectory(np.array([0.0, 0.4]), np.tile(place.body_world, (2, 1)), np.zeros(2), feet, contact)
    elsewhere = feet.copy()
    for foot in moved:
        elsewhere[:, foot, :2] += [0.001 * (foot + 1), 0.002 - 0.0003 * foot**2]
    then = placed_on(replace(motion, feet_world=elsewhere), motion)
    assert then.stays.tolist() == [foot not in moved for foot in range(12)]


def test_where_no_three_feet_could_stay_all_are_placed_as_near_as_can_be() -> None:
    first = standing(0.0, 0.0)
    feet = np.array(first.feet_world)
    feet[-1] += np.array([[0.004, 0, 0], [0, 0.003, 0], [0.001, 0.002, 0], [0, 0, 0]])
    then = placed_on(replace(first, feet_world=feet), standing(0.0, 0.0))
    assert not then.stays.any()
    apart = then.motion.feet_world[0] - feet[-1]
    assert apart.sum(axis=0) == pytest.approx([0.0, 0.0, 0.0], abs=1e-12)


def test_a_foot_in_the_air_where_parts_meet_is_refused() -> None:
    with pytest.raises(InputError, match=r"Part 1, “Manual amble, v0” ends with foot 2 4.5 mm above"):
        sequence_gait("x", [shortened(7), part("walk")])


def test_a_body_that_cannot_go_there_is_refused_with_both_names() -> None:
    beside = standing(0.0, 0.0)
    beside = replace(beside, body_world=beside.body_world + [0.06, 0.0, 0.0])
    with pytest.raises(InfeasibleError, match="Between Part 1 and Part 2: The body cannot move"):
        chained(standing(0.0, 0.0), beside)


@pytest.mark.parametrize(
    ("parts", "words"),
    [
        ([], "no part"),
        ([part("walk"), SequencePart(replace(gait("walk"), name="A" * 3, iterations=4), 6)], "24 iterations"),
        ([part("walk", 20)] * 3, "2413 samples"),
        (
            [
                part("walk"),
                SequencePart(replace(gait("walk"), timeline=replace(gait("walk").timeline, sample_time=0.2))),
            ],
            "a sample every 0.2 s",
        ),
        (
            [SequencePart(gait("walk").with_options(boundary=Boundary.PERIODIC))],
            "cycle",
        ),
    ],
)
def test_what_cannot_be_chained_is_refused_with_the_remedy(parts: list[SequencePart], words: str) -> None:
    with pytest.raises(InputError, match=words):
        sequence_gait("x", parts)


def test_a_sequence_is_no_part_of_another() -> None:
    with pytest.raises(InputError, match="is a sequence"):
        SequencePart(sequence_gait("x", [part("walk")]))


@pytest.mark.parametrize("times", [0, -1, 21])
def test_a_part_runs_one_to_twenty_times(times: int) -> None:
    with pytest.raises(InputError, match="1 to 20"):
        SequencePart(gait("walk"), times)


def test_a_sequence_itself_is_not_optimised() -> None:
    with pytest.raises(InputError, match="is a sequence"):
        motion_problem(sequence_gait("x", [part("walk")]), MODEL)


def test_the_library_has_a_sequence_of_its_own_gaits() -> None:
    entry = library()["walk-turn-s-gait"]
    assert entry.gait == derived(entry.gait)
    assert all(one.gait == library()[str(one.source)].gait for one in entry.gait.sequence)
    with pytest.raises(InputError, match="nor a sequence"):
        optimised_entry("walk-turn-s-gait")
