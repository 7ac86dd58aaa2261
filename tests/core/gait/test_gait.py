"""The gait document: iterations of drawn and of hand-drawn timelines."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.errors import InputError
from core.gait.gait import drawn_timeline, is_drawn, motion_problem, with_iterations
from core.gait.motion_source import MotionSource, motion_source
from core.library.library import library
from core.motion.contact_timeline import MAX_SAMPLES, ContactTimeline, rows_from_bits, timeline_from_order
from core.robot.model import load_robot


def test_a_drawn_gait_is_drawn_anew_for_its_iterations() -> None:
    walk = library()["walk"].gait
    thrice = with_iterations(walk, 3)
    assert thrice.timeline == drawn_timeline(replace(walk, iterations=3))
    assert thrice.timeline.sample_count == 125
    assert with_iterations(thrice, 1).timeline == walk.timeline


def test_a_trot_stays_a_trot() -> None:
    trot = library()["textbook-trot"].gait
    rest = trot.options.closing_knots
    thrice = with_iterations(trot, 3)
    rows, once = rows_from_bits(thrice.timeline.stance), rows_from_bits(trot.timeline.stance)
    assert [row[:-rest] for row in rows] == [row[:-rest] * 3 for row in once]
    assert with_iterations(thrice, 1).timeline == trot.timeline


def test_locked_cells_are_repeated_with_their_samples() -> None:
    trot = library()["textbook-trot"].gait
    locked = np.array(trot.timeline.locked)
    locked[0, 3] = True
    marked = replace(trot, timeline=replace(trot.timeline, locked=locked))
    assert with_iterations(marked, 2).timeline.locked.sum() == 2


def test_iterations_of_unequal_length_cannot_be_repeated() -> None:
    walk = replace(library()["walk"].gait, iterations=2)
    stance = np.array(walk.timeline.stance)[:, 1:]
    uneven = replace(walk, timeline=ContactTimeline(stance, np.zeros_like(stance), 0.4))
    with pytest.raises(InputError, match="not equally long"):
        with_iterations(uneven, 3)


def test_a_swing_of_the_first_sample_alone_is_refused_and_a_longer_one_is_not() -> None:
    walk = library()["walk"].gait
    stance = np.array(walk.timeline.stance)
    stance[0, 0] = False
    alone = replace(walk, timeline=replace(walk.timeline, stance=stance))
    with pytest.raises(InputError, match="Foot 1 is in the air at the first sample alone"):
        motion_problem(alone, load_robot("deltawalker"))
    stance[0, 1] = False
    longer = replace(walk, timeline=replace(walk.timeline, stance=stance))
    assert not motion_problem(longer, load_robot("deltawalker")).timeline.stance[0, 1]


@pytest.mark.parametrize(
    ("option", "knots"),
    [("phase_knots", 1), ("phase_knots", 51), ("phase_knots", 10**9), ("closing_knots", 101)],
)
def test_phases_that_no_timeline_has_are_refused(option: str, knots: int) -> None:
    with pytest.raises(InputError) as refused:
        library()["walk"].gait.with_options(**{option: knots})
    assert refused.value.where == option
    assert str(knots) in refused.value.sentence


def test_a_timeline_that_is_too_long_to_be_drawn_is_refused_before_it_is_made() -> None:
    with pytest.raises(InputError) as refused:
        timeline_from_order(4, (1, 2, 3, 4), phase_knots=10**9)
    assert refused.value.where == "phase_knots"
    assert str(MAX_SAMPLES) in refused.value.sentence


def test_a_gait_drawn_by_hand_may_have_phases_that_would_be_too_long_to_draw() -> None:
    walk = library()["walk"].gait
    long = replace(walk, iterations=20).with_options(phase_knots=50)
    assert not is_drawn(long)
    assert motion_source(long) is MotionSource.DRAWN
    assert is_drawn(walk)
    with pytest.raises(InputError, match=str(MAX_SAMPLES)):
        drawn_timeline(long)


@pytest.mark.parametrize("name", ["", "   ", "\u200b\u2060", "\u3164", "\u2800", "\t\n", "\u202e"])
def test_a_name_that_shows_nothing_is_no_name(name: str) -> None:
    with pytest.raises(InputError) as refused:
        replace(library()["walk"].gait, name=name)
    assert refused.value.where == "name"
