"""The first of the lowest or highest values, where rounding would choose among equal ones."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.arrays import SAME, first_highest, first_lowest, first_place

lengths = st.lists(st.floats(-1.0, 1.0), min_size=1, max_size=12)


@given(lengths)
def test_what_is_chosen_is_as_low_as_any(values: list[float]) -> None:
    row = np.array(values)
    chosen = int(first_lowest(row))
    assert row[chosen] <= row.min() + SAME
    assert (row[:chosen] > row.min() + SAME).all()


@pytest.mark.parametrize("seed", range(10))
def test_rounding_does_not_choose(seed: int) -> None:
    row = np.array([3.0, 1.0, 2.0, 1.0, 3.0]) + np.random.default_rng(seed).normal(0.0, 1e-12, 5)
    assert (int(first_lowest(row)), int(first_highest(row))) == (1, 0)


def test_a_value_that_is_lower_by_more_is_chosen() -> None:
    assert int(first_lowest(np.array([1.0, 1.0 - 3 * SAME]))) == 1


def test_along_an_axis_every_row_has_its_own() -> None:
    rows = np.array([[1.0, 0.0, 1e-12], [2.0, 1.0, 5.0]])
    assert first_lowest(rows, axis=1).tolist() == [1, 1]
    assert first_highest(rows, axis=0).tolist() == [1, 1, 1]


def test_nan_is_left_out_and_infinity_is_a_value() -> None:
    assert int(first_lowest(np.array([np.nan, 2.0, 1.0]))) == 2
    assert int(first_highest(np.array([np.nan, 2.0, np.inf]))) == 2
    assert int(first_lowest(np.array([-np.inf, -np.inf]))) == 0


def test_a_place_counts_along_every_axis() -> None:
    values = np.zeros((2, 3, 2))
    values[1, 2, 0] = values[1, 2, 1] = 4.0
    assert first_place(values) == (1, 2, 0)
