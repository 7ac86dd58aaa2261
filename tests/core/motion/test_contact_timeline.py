"""Timelines: drawing, editing, swings and turning."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.errors import InputError
from core.motion.contact_timeline import (
    Swing,
    bits_from_rows,
    rows_from_bits,
    timeline_from_order,
    timeline_from_rows,
)

rows = st.integers(2, 30).flatmap(
    lambda n: st.lists(st.text("01", min_size=n, max_size=n), min_size=1, max_size=12)
)


def test_the_published_timing_gives_each_foot_five_knots_down_and_five_up() -> None:
    timeline = timeline_from_order(4, [3, 2, 4, 1], closing_knots=0)
    assert timeline.sample_count == 40
    assert timeline.swings() == (Swing(0, 35, 38), Swing(1, 15, 19), Swing(2, 5, 9), Swing(3, 25, 29))
    assert timeline.stance[:, -1].all()


def test_a_closing_stance_is_appended_once() -> None:
    assert timeline_from_order(4, [1, 2, 3, 4], iterations=3).sample_count == 3 * 40 + 5


@given(rows)
def test_rows_of_bits_come_back(text: list[str]) -> None:
    assert list(rows_from_bits(bits_from_rows(text, "timeline"))) == text


@given(rows)
def test_swings_are_exactly_the_cells_in_the_air(text: list[str]) -> None:
    timeline = timeline_from_rows(text, 0.4)
    drawn = np.ones_like(timeline.stance)
    for swing in timeline.swings():
        drawn[swing.foot, swing.first : swing.last + 1] = False
    assert (drawn == timeline.stance).all()


@given(st.integers(-5, 5))
def test_four_quarter_turns_are_none(turns: int) -> None:
    timeline = timeline_from_order(4, [3, 2, 4, 1])
    assert timeline.turned(turns).turned(4 - turns) == timeline
    assert timeline.turned(1).swings()[0].foot == 0


@pytest.mark.parametrize(
    ("order", "phase", "closing"),
    [([1, 2, 3], 5, 5), ([1, 2, 3, 3], 5, 5), ([1, 2, 3, 4], 1, 5), ([1, 2, 3, 4], 5, -1)],
)
def test_orders_and_phases_that_make_no_gait_are_refused(order: list[int], phase: int, closing: int) -> None:
    with pytest.raises(InputError):
        timeline_from_order(4, order, phase_knots=phase, closing_knots=closing)


@pytest.mark.parametrize("text", [["111", "11"], ["11x"], ["1"]])
def test_rows_that_do_not_fit_are_refused(text: list[str]) -> None:
    with pytest.raises(InputError):
        timeline_from_rows(text, 0.4)


@pytest.mark.parametrize("sample_time", [0.0, -1.0, float("nan"), float("inf")])
def test_a_sample_time_must_be_a_time(sample_time: float) -> None:
    with pytest.raises(InputError, match="sample time"):
        timeline_from_rows(["11"], sample_time)
