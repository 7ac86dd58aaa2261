"""The solved gaits of an atlas as columns of a page: a few characters a value.

A number is written as its whole distance from the least one, in steps of its column, and a choice as its
place among the choices. Both are written with as many digits to the base of 64 as the column needs.
"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from app.common.json import Json
from core.arrays import Floats
from core.atlas.row import DECIMALS

DIGITS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"
_BITS = 6
_LEVELS = 10**6
"""A range is cut into at least so many steps."""


def number_column(values: Floats, step: float) -> Json:
    """A column of numbers.

    Args:
        values: (gaits,) nan where there is none.
        step: to which they are rounded, in their unit.

    Returns:
        `low` and `step` in the unit of the values, `digits` of each, and all of them `packed`. The largest
        code stands for no value.
    """
    known = np.round(values[np.isfinite(values)] / step)
    low = int(known.min()) if len(known) else 0
    missing = (int(known.max()) - low if len(known) else 0) + 1
    codes = np.where(np.isfinite(values), np.round(np.nan_to_num(values) / step) - low, 0).astype(np.int64)
    digits = _digits(missing)
    codes[~np.isfinite(values)] = 64**digits - 1
    return {"low": low, "step": step, "digits": digits, "packed": _packed(codes, digits)}


def figure_column(values: Floats) -> Json:
    """A column of figures, which an atlas keeps with so many decimals; nothing is lost."""
    return number_column(values, 10.0**-DECIMALS)


def range_column(values: Floats) -> Json:
    """A column of numbers that were drawn from a range, to a millionth of the range or less."""
    width = float(np.ptp(values)) if len(values) else 0.0
    return number_column(values, 10.0 ** math.floor(math.log10(width)) / _LEVELS if width else 1e-9)


def choice_column(values: Sequence[Any]) -> Json:
    """A column of choices.

    Returns:
        `values` in rising order, `digits` of a place among them (0 of a single one), and all places `packed`.
    """
    known = sorted(set(values))
    digits = _digits(len(known) - 1) if len(known) > 1 else 0
    places = {value: place for place, value in enumerate(known)}
    codes = np.array([places[value] for value in values], dtype=np.int64)
    return {"values": known, "digits": digits, "packed": _packed(codes, digits)}


def _digits(largest: int) -> int:
    return max(1, math.ceil(largest.bit_length() / _BITS))


def _packed(codes: np.ndarray[Any, np.dtype[np.int64]], digits: int) -> str:
    alphabet = np.frombuffer(DIGITS.encode(), dtype=np.uint8)
    shifts = _BITS * np.arange(digits)[::-1]
    return str(alphabet[(codes[:, None] >> shifts) & (len(DIGITS) - 1)].tobytes(), "ascii")
