"""Sequences of gaits that hold feet up: they stay up from part to part, come down or are lifted between."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from core.errors import InputError
from core.gait.chain import Chain, Piece, chain
from core.gait.gait import Gait, SequencePart, motion_problem
from core.gait.held_feet import HeldFeet
from core.gait.options import GaitOptions
from core.library.sequence import run_of, sequence_gait
from core.motion.trajectory import Trajectory
from core.problem.motion_check import check_motion
from core.problem.motion_problem import MotionProblem
from core.problem.start_footholds import placed_on
from core.robot.model import load_robot
from solver_jobs import solve_live
from tests.support.held_gaits import lifting, lowering, wave

HEXAPOD = load_robot("hexapod")
SHORT = {"phase_knots": 3, "closing_knots": 3}
SIX, FOUR = wave("hexapod", (), **SHORT), wave("hexapod", (1, 4), **SHORT)
OTHER = wave("hexapod", (2, 5), **SHORT)
UP, DOWN = lifting("hexapod", (1, 4)), lowering("hexapod", (1, 4))


def motion_of(gait: Gait) -> Trajectory:
    problem = motion_problem(gait, HEXAPOD)
    motion = solve_live(problem).trajectory
    assert check_motion(problem, motion).confirmed
    return motion


def chained(gaits: Sequence[Gait]) -> tuple[Chain, list[MotionProblem]]:
    """The motions one after the other, and the problems of the steps between them."""
    asked: list[MotionProblem] = []

    def cross(before: Piece, piece: Piece, problem: MotionProblem) -> Trajectory:
        asked.append(problem)
        motion = solve_live(problem).trajectory
        assert check_motion(problem, motion).confirmed, (before.name, piece.name)
        return motion

    pieces = [Piece(f"Part {number + 1}", number, motion_of(gait)) for number, gait in enumerate(gaits)]
    return chain(HEXAPOD, pieces, GaitOptions(margin=0.003), cross), asked


def steps_in(problem: MotionProblem) -> list[str]:
    return ["".join("1" if cell else "0" for cell in row) for row in problem.timeline.stance]


def test_feet_that_are_held_on_both_sides_stay_up_without_a_transition() -> None:
    whole, asked = chained([UP, FOUR, FOUR, DOWN])
    assert asked == []
    assert not any(span.is_transition for span in whole.spans)
    feet, contact = whole.trajectory.feet_world, whole.trajectory.contact
    between = slice(whole.spans[0].last, whole.spans[-1].first + 1)
    assert not contact[between][:, [0, 3]].any()
    np.testing.assert_allclose(feet[between][:, [0, 3], 2], 0.003, atol=1e-9)
    assert contact[whole.spans[1].last, [1, 2, 4, 5]].all()
    assert whole.travel == pytest.approx([0.020, 0.0], abs=1e-6)


def test_feet_are_lifted_or_come_down_between_gaits_that_hold_others() -> None:
    whole, (lifted, lowered) = chained([SIX, FOUR, SIX])
    assert np.nonzero(lifted.held_end)[0].tolist() == [0, 3]
    assert np.nonzero(lowered.held_start)[0].tolist() == [0, 3]
    assert steps_in(lifted)[0] == "1" * 5 + "0" * 20
    assert steps_in(lifted)[3] == "1" * 15 + "0" * 10
    assert steps_in(lowered)[0] == "0" * 10 + "1" * 15
    assert [span.is_transition for span in whole.spans] == [False, True, False, True, False]


def test_feet_come_down_before_others_are_lifted() -> None:
    _, (swapped,) = chained([FOUR, OTHER])
    rows = steps_in(swapped)
    assert rows[3].rindex("0") < rows[1].index("0")
    assert swapped.timeline.stance.sum(axis=0).min() == 4


def test_feet_that_are_held_higher_stay_in_the_air_on_their_way() -> None:
    higher = wave("hexapod", (1, 4), clearance=0.004, **SHORT)
    whole, (raised,) = chained([FOUR, higher])
    assert not raised.timeline.stance[[0, 3]].any()
    assert raised.timeline.stance[[1, 2, 4, 5]].all()
    assert whole.trajectory.feet_world[-1, 0, 2] == pytest.approx(0.004)


def test_the_body_moves_over_standing_feet_while_others_are_held() -> None:
    whole, asked = chained([FOUR, wave("hexapod", (1, 4), plane_height=0.055, **SHORT)])
    move = whole.spans[1]
    assert asked == []
    assert move.is_transition
    t = whole.trajectory
    assert not t.contact[move.first : move.last + 1, [0, 3]].any()
    assert t.contact_forces is not None
    assert not t.contact_forces[move.first : move.last, [0, 3]].any()
    np.testing.assert_allclose(np.ptp(t.feet_world[move.first : move.last + 1], axis=0), 0.0, atol=1e-12)


def test_a_gait_that_turns_is_placed_by_the_feet_that_stand() -> None:
    turning = motion_of(replace(FOUR, step=(0.0, 0.0, 0.2)))
    placed = placed_on(turning, motion_of(FOUR))
    assert placed.stays.all()
    assert placed.motion.heading[0] == pytest.approx(0.2)


def test_a_foot_that_is_on_its_way_where_two_gaits_meet_is_refused_with_a_way_out() -> None:
    motion = motion_of(UP)
    assert motion.feet_velocity is not None
    velocity = np.array(motion.feet_velocity)
    velocity[-1, 0, 2] = 0.001
    pieces = [
        Piece("Part 1", 0, replace(motion, feet_velocity=velocity)),
        Piece("Part 2", 1, motion_of(FOUR)),
    ]
    with pytest.raises(InputError, match=r"foot 1 3\.0 mm above the ground, and on its way.*or hold it up"):
        chain(HEXAPOD, pieces, GaitOptions(), lambda before, piece, problem: motion)


def test_a_sequence_holds_what_its_first_part_begins_and_its_last_one_ends_with() -> None:
    parts = [SequencePart(FOUR, 2), SequencePart(DOWN), SequencePart(SIX), SequencePart(UP)]
    made = sequence_gait("tour", parts)
    assert made.held == HeldFeet((1, 4), (1, 4))
    assert not made.timeline.stance[[0, 3], 0].any()
    assert not made.timeline.stance[[0, 3], -1].any()


def test_a_part_is_repeated_as_iterations_only_where_it_can_follow_itself() -> None:
    assert run_of(SequencePart(FOUR, 3)).gait.iterations == 3
    lifted = run_of(SequencePart(UP, 2))
    assert (lifted.gait.iterations, lifted.copies) == (1, 2)
