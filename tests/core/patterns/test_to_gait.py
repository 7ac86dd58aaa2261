"""Patterns become gaits: documents that hold the pattern, pass validation and are problems to optimise."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from app.documents.gait_json import gait_content, gait_from_content
from core.arrays import Bools
from core.errors import InputError
from core.gait.gait import Gait, Orientation, heading_step, motion_problem
from core.gait.held_feet import HeldFeet
from core.gait.options import GaitOptions
from core.library.library import library, library_patterns
from core.motion.contact_timeline import bits_from_rows, rows_from_bits, timeline_from_rows
from core.patterns.to_gait import (
    CycleUse,
    completed_gait,
    cycle_view,
    joined_columns,
    order_of,
    periodic_gait,
    shared_options,
    transition_gait,
    unrolled,
    walking_limbs,
)
from core.problem.motion_problem import Workspace
from core.robot.model import load_robot

WALK, AMBLE = library()["walk"].gait, library()["amble"].gait
HEXAPOD = load_robot("hexapod")
PATTERNS = library_patterns()
FOUR_UP, FIVE, TRIPOD = (PATTERNS[f"hexapod-{name}"].gait for name in ("front-up", "five", "tripod"))
TRIPOD_CYCLE = PATTERNS["hexapod-tripod"].stance


def straight(first: Gait, at: int, second: Gait, to: int, samples: int = 12) -> Bools:
    """A transition in which each limb changes at most once, half way."""
    ends = [gait.timeline.stance[:, sample] for gait, sample in ((first, at), (second, to))]
    return np.repeat(np.stack(ends, axis=1), samples // 2, axis=1)


def use(name: str = "A cycle", **changes: object) -> CycleUse:
    return replace(CycleUse(name, Orientation.FB, heading_step(Orientation.FB, 0.010)), **changes)  # type: ignore[arg-type]


@given(st.sampled_from([(WALK, AMBLE), (FOUR_UP, FIVE), (FIVE, TRIPOD), (TRIPOD, FOUR_UP)]), st.data())
def test_a_transition_s_document_holds_both_gaits_and_the_pattern(
    pair: tuple[Gait, Gait], data: st.DataObject
) -> None:
    first, second = pair
    at = data.draw(st.integers(0, first.timeline.sample_count - 1))
    to = data.draw(st.integers(0, second.timeline.sample_count - 1))
    transition = straight(first, at, second, to)
    inner = data.draw(st.integers(0, 2**32 - 1))
    transition[:, 2:-2] = np.random.default_rng(inner).random(transition[:, 2:-2].shape) < 0.7
    made = transition_gait(first, at, second, to, transition)
    columns = joined_columns(first, at, second, to, transition)
    stance = made.timeline.stance
    assert (stance[:, columns.first : columns.last + 1] == transition).all()
    assert (stance[:, : columns.first] == first.timeline.stance[:, : columns.first]).all()
    after = stance.shape[1] - columns.last - 1
    assert (
        stance[:, columns.last + 1 :] == second.timeline.stance[:, second.timeline.sample_count - after :]
    ).all()
    assert made.iterations == 1
    assert not made.timeline.locked.any()
    assert gait_from_content(gait_content(made)) == made
    assert motion_problem(made, load_robot(made.robot)).knot_count == stance.shape[1]


def test_a_transition_says_what_it_came_from() -> None:
    made = transition_gait(WALK, 6, AMBLE, 17, straight(WALK, 6, AMBLE, 17))
    assert made.name == "Walk 10 mm to Amble 10 mm"
    assert made.notes == (
        "From “Walk 10 mm” at sample 7 to “Amble 10 mm” at sample 18 by a transition of 12 samples, 7 to 18 "
        "of this gait."
    )
    assert (made.provenance, made.segment_table, made.recorded) == (None, None, None)


def test_the_longest_names_still_make_a_name() -> None:
    long = [replace(gait, name="n" * 120) for gait in (WALK, AMBLE)]
    assert len(transition_gait(long[0], 0, long[1], 0, straight(WALK, 0, AMBLE, 0)).name) <= 120


def test_feet_held_in_both_gaits_stay_held_and_others_come_down() -> None:
    made = transition_gait(FOUR_UP, 8, FIVE, 8, straight(FOUR_UP, 8, FIVE, 8))
    assert made.held == HeldFeet((1, 2), (2,))
    assert not made.timeline.stance[1].any()


def test_a_foot_held_for_one_sample_at_an_end_is_held_for_two() -> None:
    transition = straight(FOUR_UP, 0, TRIPOD, 0)
    transition[:, 1:] = True
    made = transition_gait(FOUR_UP, 0, TRIPOD, 0, transition)
    assert rows_from_bits(made.timeline.stance)[0].startswith("001111")
    assert motion_problem(made, HEXAPOD).held_start.tolist() == [True, True, False, False, False, False]


def test_a_transition_from_standing_to_standing_goes_as_far_as_the_foot_that_swings_least() -> None:
    at, to = WALK.timeline.sample_count - 1, 0
    twice = transition_gait(WALK, at, AMBLE, to, np.ones((4, 10), dtype=np.bool_))
    assert twice.step == pytest.approx(tuple(2 * np.array(WALK.step)))
    longer = replace(AMBLE, step=heading_step(AMBLE.orientation, 0.020))
    assert transition_gait(WALK, at, longer, to, np.ones((4, 10), dtype=np.bool_)).step == pytest.approx(
        tuple(3 * np.array(WALK.step))
    )
    # Feet 3 and 2 step before the cursor, and feet 4 and 1 after it: none steps twice.
    half = transition_gait(WALK, 20, WALK, 20, np.ones((4, 10), dtype=np.bool_))
    assert half.step == pytest.approx(WALK.step)


def test_a_swing_of_the_transition_goes_half_of_each_gait_s_way() -> None:
    longer = replace(WALK, step=heading_step(WALK.orientation, 0.020))
    transition = bits_from_rows(["1100011111"] * 4, "rows")
    made = transition_gait(WALK, 0, longer, 44, transition)
    assert made.step == pytest.approx(tuple(1.5 * np.array(WALK.step)))


def test_iterations_are_counted_in_the_way_of_a_swing() -> None:
    twice = PATTERNS["hexapod-tripod"].used(2)
    at = twice.timeline.sample_count - 1
    made = transition_gait(twice, at, TRIPOD, 0, np.ones((6, 8), dtype=np.bool_))
    assert made.step == pytest.approx(tuple(3 * np.array(TRIPOD.step)))


def test_a_foot_that_stands_throughout_keeps_the_body_where_it_is() -> None:
    rows = ["111111111111", "111000111111", "111111111111", "111111000111"]
    gait = replace(WALK, timeline=timeline_from_rows(rows, 0.4))
    assert transition_gait(gait, 11, gait, 0, np.ones((4, 6), dtype=np.bool_)).step == (0.0, 0.0, 0.0)


def test_what_both_gaits_ask_of_a_motion_holds() -> None:
    first = GaitOptions(clearance=0.002, margin=0.003, body_speed=0.015, motor_speed=0.012, friction=None)
    second = GaitOptions(
        clearance=0.004,
        margin=0.001,
        body_speed=0.010,
        friction=0.6,
        plane_height=0.055,
        workspace=Workspace.CYLINDER,
        closing_knots=3,
    )
    both = shared_options(first, second)
    assert (both.clearance, both.margin, both.body_speed) == (0.004, 0.003, 0.010)
    assert (both.motor_speed, both.friction, both.workspace) == (0.012, 0.6, Workspace.CYLINDER)
    assert (both.plane_height, both.end_plane_height, both.closing_knots) == (0.0535, 0.055, 3)
    assert shared_options(first, first).end_plane_height is None


def test_a_pattern_for_another_cursor_is_refused() -> None:
    with pytest.raises(InputError, match="does not begin as “Walk 10 mm” is at sample 7"):
        transition_gait(WALK, 6, AMBLE, 17, straight(WALK, 0, AMBLE, 17))
    with pytest.raises(InputError, match="does not end as “Amble 10 mm” is at sample 18"):
        transition_gait(WALK, 6, AMBLE, 17, straight(WALK, 6, AMBLE, 0))


def cycles() -> st.SearchStrategy[Bools]:
    """One swing a walking limb anywhere round the cycle; the first two limbs may be up or stand."""

    def cycle(still: tuple[bool, bool], swings: list[tuple[int, int]]) -> Bools:
        stance = np.ones((6, 20), dtype=np.bool_)
        for limb, (first, length) in enumerate(swings):
            stance[limb, np.arange(first, first + length) % 20] = False
        if still[0]:
            stance[0] = False
        if still[1]:
            stance[1] = True
        return stance

    swing = st.tuples(st.integers(0, 19), st.integers(2, 12))
    return st.builds(cycle, st.tuples(st.booleans(), st.booleans()), st.lists(swing, min_size=6, max_size=6))


@given(cycles(), st.integers(1, 4), st.integers(1, 6))
def test_a_cycle_is_walked_from_standing_to_standing_with_one_swing_a_limb_each_time(
    cycle: Bools, iterations: int, stand: int
) -> None:
    walking = walking_limbs(cycle)
    assume(walking.any())
    columns = unrolled(cycle, iterations, stand)
    view = cycle_view(cycle)
    assert any((np.roll(cycle, shift, axis=1) == view).all() for shift in range(20))
    for number in range(1, iterations):
        first = stand + number * 20
        assert (columns[:, first : first + 20] == view).all()
    opening = columns[:, stand : stand + 20]
    # In the first cycle all is as it is, but for the swings that have begun before it.
    begun = np.logical_and.accumulate(~view, axis=1) & ~view[:, -1:] & walking[:, None]
    assert (opening == (view | begun)).all()
    for edge in (columns[:, :stand], columns[:, -stand:]):
        assert edge[walking].all()
    gait = periodic_gait(cycle, HEXAPOD, use(iterations=iterations, options=GaitOptions(closing_knots=stand)))
    assert (gait.timeline.stance == columns).all()
    whole = cycle.all(axis=1)
    lengths = np.bincount([swing.foot for swing in gait.timeline.swings()], minlength=6)
    assert (lengths[walking] == iterations).all()
    assert (lengths[whole] == 0).all()
    assert gait_from_content(gait_content(gait)) == gait
    assert motion_problem(gait, HEXAPOD).knot_count == columns.shape[1]


def test_a_cycle_is_cut_where_no_foot_is_in_the_air() -> None:
    cycle = bits_from_rows(["0011111100", "1111000111"], "rows")
    assert rows_from_bits(cycle_view(cycle)) == ("1111110000", "1100011111")


def test_a_swing_that_wraps_round_the_seam_is_completed_at_the_end() -> None:
    cycle = bits_from_rows(["0000111111", "1110000111", "1111110000", "0111111000", "1111111111"], "rows")
    # At every cut a foot is in the air: the first best one is taken.
    assert rows_from_bits(unrolled(cycle, 1, 2))[0].strip("1") == "0000"


@pytest.mark.parametrize("iterations", [1, 3])
def test_limbs_that_are_up_are_held(iterations: int) -> None:
    made = PATTERNS["hexapod-front-up"].used(iterations)
    assert made.held == HeldFeet((1, 2), (1, 2))
    assert made.iterations == iterations
    assert made.timeline.sample_count == 2 * 5 + iterations * 32


def test_a_cycle_for_another_robot_or_without_end_is_refused() -> None:
    with pytest.raises(InputError, match=r"has 6 limbs; .* has 4"):
        periodic_gait(TRIPOD_CYCLE, load_robot("deltawalker"), use())
    with pytest.raises(InputError, match="iterations is 21"):
        periodic_gait(TRIPOD_CYCLE, HEXAPOD, use(iterations=21))


def test_without_a_closing_stance_there_is_still_one_sample_to_stand_at_either_end() -> None:
    made = periodic_gait(TRIPOD_CYCLE, HEXAPOD, use(options=GaitOptions(closing_knots=0)))
    assert made.timeline.stance[:, [0, -1]].all()
    assert made.timeline.sample_count == 22


def test_a_completed_drawing_is_the_same_document_with_another_timeline() -> None:
    locked = np.zeros((4, 45), dtype=np.bool_)
    locked[1, 10:20] = True
    gait = replace(WALK, timeline=replace(WALK.timeline, locked=locked))
    stance = AMBLE.timeline.stance.copy()
    stance[1] = WALK.timeline.stance[1]
    made = completed_gait(gait, stance)
    assert made == replace(gait, timeline=replace(gait.timeline, stance=stance))
    with pytest.raises(InputError, match="changes foot 2 at sample 16, which is locked"):
        completed_gait(gait, np.ones((4, 45), dtype=np.bool_))
    with pytest.raises(InputError, match="is 4 × 44, the timeline 4 × 45"):
        completed_gait(gait, stance[:, :44])
    with pytest.raises(InputError, match="cannot be drawn anew"):
        completed_gait(library()["walk-manual-0"].gait, stance)


@pytest.mark.parametrize("direction", [1, 2, 3, 4])
def test_the_order_of_steps_is_that_at_direction_1(direction: int) -> None:
    turned = WALK.timeline.turned(direction - 1)
    assert order_of(turned.stance, direction - 1) == WALK.order


@pytest.mark.parametrize("direction", [2, 3, 4])
def test_a_transition_goes_where_its_gaits_go(direction: int) -> None:
    turned = [
        replace(gait, direction=direction, timeline=gait.timeline.turned(direction - 1))
        for gait in (WALK, AMBLE)
    ]
    made = transition_gait(turned[0], 6, turned[1], 17, straight(turned[0], 6, turned[1], 17))
    straight_on = transition_gait(WALK, 6, AMBLE, 17, straight(WALK, 6, AMBLE, 17))
    assert made.timeline == straight_on.timeline.turned(direction - 1)
    assert (made.order, made.step, made.direction) == (straight_on.order, straight_on.step, direction)
