"""The Pareto front of an atlas over two of its figures or parameters."""

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np

from app.atlas.atlas_file import AtlasFile
from app.atlas.entries import entries_with_physics
from app.common.json import Json
from core.atlas.axes import KEYS
from core.atlas.physics_row import PHYSICS_FIGURES
from core.atlas.row import FIGURES, AtlasRow, RowStatus
from core.errors import InputError

BETTER_SMALL = frozenset(
    {
        "seconds",
        "body_move",
        "stroke_use",
        "stop_seconds",
        "stop_bound",
        "max_tilt",
        "swing_load",
        "slip",
    }
)
"""Keys of which less is better; of all others more is."""
BY_SIZE = frozenset({"turn_rate", "simulated_turn_rate", "turn"})
"""Keys whose values count by their size, to whichever side they lead."""
NUMBERS = tuple(name for name, key in KEYS.items() if key.is_number)
UNITS: Mapping[str, tuple[str, float]] = MappingProxyType(
    {
        "seconds": ("s", 1.0),
        "speed": ("mm/s", 1000.0),
        "turn_rate": ("°/s", 180.0 / np.pi),
        "least_margin": ("mm", 1000.0),
        "body_move": ("mm", 1000.0),
        "stroke_use": ("%", 100.0),
        "stop_seconds": ("s", 1.0),
        "step_x": ("mm", 1000.0),
        "step_y": ("mm", 1000.0),
        "turn": ("°", 180.0 / np.pi),
        "height": ("mm", 1000.0),
        "clearance": ("mm", 1000.0),
        "margin": ("mm", 1000.0),
        "stop_bound": ("s", 1.0),
        "walked": ("%", 100.0),
        "simulated_speed": ("mm/s", 1000.0),
        "simulated_turn_rate": ("°/s", 180.0 / np.pi),
        "max_tilt": ("°", 180.0 / np.pi),
        "swing_load": ("%", 100.0),
        "slip": ("mm", 1000.0),
    }
)
"""Unit in which a person reads a figure or a parameter, and the factor from SI."""


def front_keys(atlas: AtlasFile) -> tuple[str, ...]:
    """What an atlas can be looked at by: figures, those of physics if there are any, and numbers of gaits."""
    own = tuple(name for name in atlas.space.axes if name.startswith("robot."))
    physics = PHYSICS_FIGURES if atlas.physics() else ()
    return (*FIGURES, *physics, *NUMBERS, *own)


def atlas_front(
    atlas: AtlasFile, x: str = "margin", y: str = "speed", where: tuple[str, str] = ("x", "y")
) -> list[tuple[AtlasRow, Json]]:
    """Solved gaits that no other one beats in one of two keys without losing in the other.

    By a figure of physics only gaits that have it are compared.

    Args:
        atlas: the file.
        x: a figure or a parameter.
        y: another one.
        where: what a refusal calls the two.

    Returns:
        Rows, and parameters with figures of physics; the best in `y` first.

    Raises:
        InputError: the atlas has no such key.
        StorageError: the disk does not give it.
    """
    known = front_keys(atlas)
    for option, key in zip(where, (x, y), strict=True):
        if key not in known:
            raise InputError(_unknown_key(option, key, known), option)
    entries = [
        (row, parameters)
        for row, parameters in entries_with_physics(atlas, RowStatus.SOLVED)
        if all(key not in PHYSICS_FIGURES or parameters[key] is not None for key in (x, y))
    ]
    if not entries:
        return []
    gains = np.array([[_gain(entry, x), _gain(entry, y)] for entry in entries])
    # The best in y first, and of equals the best in x: each that follows has to be better in x.
    order = np.lexsort((np.arange(len(gains)), -gains[:, 0], -gains[:, 1]))
    chosen, best = [], -np.inf
    for place in order:
        if gains[place, 0] > best:
            best = gains[place, 0]
            chosen.append(entries[place])
    return chosen


def value_of(row: AtlasRow, parameters: Json, key: str) -> float:
    """A figure of a row, or a parameter or a figure of physics of its gait, SI."""
    return float(getattr(row, key)) if key in FIGURES else float(parameters[key])


def _unknown_key(option: str, key: str, known: tuple[str, ...]) -> str:
    """Why a key cannot be chosen, in sentences."""
    if key in PHYSICS_FIGURES:
        return f"{option} is {key}, and no gait was simulated yet (footfall atlas run --physics front)."
    return f"{option} is {key}; it must be one of {', '.join(known)}."


def _gain(entry: tuple[AtlasRow, Json], key: str) -> float:
    """The value of a key, or its negative where less is better; turns count by their size."""
    value = value_of(*entry, key)
    if key in BY_SIZE:
        return abs(value)
    return -value if key in BETTER_SMALL else value
