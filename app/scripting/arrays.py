"""Arrays that scripts pass in: their shapes and units are looked at, and refused in a sentence."""

import numpy as np
from numpy.typing import ArrayLike

from core.arrays import Floats
from core.errors import InputError


def array_of(values: ArrayLike, shape: tuple[int, ...], name: str, unit: str) -> Floats:
    """An array whose last axes have a shape; there may be one axis more before them.

    Args:
        values: what was passed in.
        shape: of the last axes.
        name: of the argument.
        unit: of its numbers.

    Raises:
        InputError: it has another shape, or holds what is no finite number.
    """
    try:
        found = np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise InputError(f"{name} holds what is no number; give numbers in {unit}.", name) from None
    wanted = ", ".join(map(str, shape))
    if found.shape[-len(shape) :] != shape or found.ndim > len(shape) + 1:
        got = ", ".join(map(str, found.shape))
        raise InputError(
            f"{name} has the shape ({got}); it must be (n, {wanted}) or ({wanted}), in {unit}.", name
        )
    if not np.isfinite(found).all():
        raise InputError(f"{name} holds nan or infinity; give finite numbers in {unit}.", name)
    return found
