"""Read-only float and boolean arrays for frozen values."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from core.errors import InputError

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

SAME = 1e-6
"""Two lengths that differ by less are equal in every decision, m; speeds, m/s, as well. Motions are solved
to 1e-9 m. Where a gait is symmetric or a foot is still, lengths are equal except for rounding, which differs
from processor to processor; a bare comparison would lead to other waypoints or sentences on each."""


FARTHEST = 10_000.0
"""Numbers beyond this are no m, m/s, N or rad of a robot; a guard against a slip of the pen in a file."""


def frozen_floats(
    values: ArrayLike, shape: Sequence[int | None], name: str, most: float = math.inf
) -> Floats:
    """Copies `values` into a read-only float array of the wanted shape.

    Args:
        values: anything numpy can read as numbers.
        shape: wanted length of each axis; None where any length will do.
        name: what the array is, for the message.
        most: that any number may be, whatever its sign, in the unit of `values`.

    Returns:
        A C-contiguous read-only float64 array.

    Raises:
        InputError: wrong number of axes or wrong length, or a number that is not finite or beyond `most`.
    """
    array = np.array(values, dtype=np.float64, order="C")
    _require_shape(array.shape, shape, name)
    if not np.isfinite(array).all():
        index = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        raise InputError(f"{name} holds {array[index]} at {index}; every number must be finite.", name)
    for index in np.argwhere(np.abs(array) > most)[:1].tolist():
        raise InputError(
            f"{name} holds {array[tuple(index)]:g} at {tuple(index)}; it must lie within ±{most:g}.", name
        )
    array.setflags(write=False)
    return array


def frozen_bools(values: ArrayLike, shape: Sequence[int | None], name: str) -> Bools:
    """Copies `values` into a read-only boolean array of the wanted shape (see `frozen_floats`)."""
    array = np.array(values, dtype=np.bool_, order="C")
    _require_shape(array.shape, shape, name)
    array.setflags(write=False)
    return array


def interpolated(times: Floats, knots: Floats, values: Floats) -> Floats:
    """Values at some times, straight between their knots and constant beyond the first and the last.

    Args:
        times: (n,) wanted.
        knots: (m,) rising.
        values: (m, …) at the knots.

    Returns:
        (n, …) in the unit of `values`.
    """
    columns = values.reshape(len(knots), -1).T
    found = [np.interp(times, knots, column) for column in columns]
    return np.stack(found, axis=-1).reshape(len(times), *values.shape[1:])


def first_lowest(values: Floats, within: float = SAME, axis: int | None = None) -> NDArray[np.intp]:
    """Index of the first of the lowest values, which rounding does not change where several are equal.

    Args:
        values: any shape; nan is left out, and at least one value along the axis is a number.
        within: values above the lowest by no more than this count as lowest, in the unit of `values`.
        axis: along which the index counts; None for that into the flattened array.
    """
    lowest = np.nanmin(values, axis=axis, keepdims=True)
    return np.asarray((values <= lowest + within).argmax(axis=axis))


def first_highest(values: Floats, within: float = SAME, axis: int | None = None) -> NDArray[np.intp]:
    """The same of the highest values."""
    return first_lowest(-values, within, axis)


def first_place(values: Floats, within: float = SAME) -> tuple[int, ...]:
    """Index of the first of the highest values along every axis (see `first_lowest`)."""
    flat = int(first_highest(values, within))
    return tuple(int(index) for index in np.unravel_index(flat, values.shape))


def stretches(flags: Bools) -> list[tuple[int, int]]:
    """First and last index of each run of true values in (n,) flags."""
    edges = np.diff(np.concatenate([[0], flags.astype(np.int8), [0]]))
    starts, ends = np.nonzero(edges > 0)[0], np.nonzero(edges < 0)[0]
    return [(int(a), int(b) - 1) for a, b in zip(starts, ends, strict=True)]


def _require_shape(actual: tuple[int, ...], wanted: Sequence[int | None], name: str) -> None:
    matches = len(actual) == len(wanted) and all(
        w is None or a == w for a, w in zip(actual, wanted, strict=True)
    )
    if not matches:
        text = " × ".join("any" if w is None else str(w) for w in wanted)
        raise InputError(f"{name} has shape {actual}; it must be {text}.", name)
