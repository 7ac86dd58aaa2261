"""Values between knots."""

from __future__ import annotations

import numpy as np

from core.arrays import interpolated

KNOTS = np.array([0.0, 1.0, 3.0])
VALUES = np.arange(12.0).reshape(3, 2, 2) ** 2


def test_between_knots_values_are_on_the_line_whatever_their_shape() -> None:
    found = interpolated(np.array([0.5, 2.0]), KNOTS, VALUES)
    assert found.shape == (2, 2, 2)
    np.testing.assert_allclose(found[0], (VALUES[0] + VALUES[1]) / 2)
    np.testing.assert_allclose(found[1], (VALUES[1] + VALUES[2]) / 2)


def test_beyond_the_knots_values_stay_as_they_are() -> None:
    found = interpolated(np.array([-1.0, 9.0]), KNOTS, VALUES)
    np.testing.assert_array_equal(found, VALUES[[0, 2]])


def test_one_number_a_knot_stays_one_number() -> None:
    np.testing.assert_allclose(interpolated(np.array([2.0]), KNOTS, np.array([0.0, 1.0, 5.0])), [3.0])
