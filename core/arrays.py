"""Read-only float and boolean arrays for frozen values."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from core.errors import InputError

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]


def frozen_floats(values: ArrayLike, shape: Sequence[int | None], name: str) -> Floats:
    """Copies `values` into a read-only float array of the wanted shape.

    Args:
        values: anything numpy can read as numbers.
        shape: wanted length of each axis; None where any length will do.
        name: what the array is, for the message.

    Returns:
        A C-contiguous read-only float64 array.

    Raises:
        InputError: wrong number of axes or wrong length, or a number that is not finite.
    """
    array = np.array(values, dtype=np.float64, order="C")
    _require_shape(array.shape, shape, name)
    if not np.isfinite(array).all():
        index = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        raise InputError(f"{name} holds {array[index]} at {index}; every number must be finite.", name)
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
