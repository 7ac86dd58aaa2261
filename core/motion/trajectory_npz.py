"""A motion as NumPy's NPZ: arrays with time first, their units and names inside the file."""

import io
import zipfile
import zlib
from dataclasses import dataclass
from typing import Any

import numpy as np

from core.arrays import Floats
from core.errors import InputError
from core.motion.trajectory import Trajectory

NPZ_FORMAT = "footfall-motion"
_REQUIRED = {
    "times": "s",
    "body_world": "m, centre of mass",
    "heading": "rad",
    "feet_world": "m, platform centres; z = 0 is a standing foot",
    "contact": "1 stance, 0 swing",
}
_KNOWN_SOMETIMES = {"body_velocity": "m/s", "feet_velocity": "m/s", "contact_forces": "N"}
_DAMAGES = (
    ValueError,
    OSError,
    EOFError,
    KeyError,
    TypeError,
    NotImplementedError,
    zipfile.BadZipFile,
    zlib.error,
)
"""What reading an archive of another kind, or a damaged one, raises."""
_STROKES = "m; nan where no rod is that long"


@dataclass(frozen=True, eq=False)
class MotionFile:
    """What an NPZ of a motion holds.

    Args:
        trajectory: the motion.
        strokes: (n, legs, 3) motor strokes, m; nan where no rod is that long.
        name: of the gait.
        feet: what each foot is called, foot 1 first.
    """

    trajectory: Trajectory
    strokes: Floats
    name: str
    feet: tuple[str, ...]


def format_npz(motion: MotionFile) -> bytes:
    """Writes an NPZ; the same motion gives the same bytes."""
    units = {**_REQUIRED, "strokes": _STROKES}
    arrays = {name: getattr(motion.trajectory, name) for name in _REQUIRED}
    for name, unit in _KNOWN_SOMETIMES.items():
        values = getattr(motion.trajectory, name)
        if values is not None:
            arrays[name] = values
            units[name] = unit
    buffer = io.BytesIO()
    np.savez_compressed(
        buffer,
        **arrays,
        strokes=motion.strokes,
        format=np.array(NPZ_FORMAT),
        version=np.array(1),
        name=_text(motion.name),
        feet=np.stack([_text(foot, 40) for foot in motion.feet]),
        units=np.array([f"{name}: {unit}" for name, unit in units.items()]),
    )
    return buffer.getvalue()


def _text(words: str, width: int | None = None) -> np.ndarray[tuple[int, ...], np.dtype[np.str_]]:
    """Text as an array; NumPy drops closing zero characters, which no name needs."""
    return np.array(words, dtype=np.str_ if width is None else f"U{width}")


def parse_npz(content: bytes, name: str = "NPZ") -> MotionFile:
    """Reads an NPZ that `format_npz` wrote.

    Raises:
        InputError: it is damaged, of another kind, or lacks an array.
    """
    try:
        with np.load(io.BytesIO(content), allow_pickle=False) as archive:
            arrays = {key: archive[key] for key in archive.files}
    except _DAMAGES as error:
        raise InputError(f"{name} is not an NPZ of plain arrays: {error}.", name) from error
    if str(arrays.get("format")) != NPZ_FORMAT or arrays.get("version") != 1:
        raise InputError(f"{name} is not a motion of version 1 (“{NPZ_FORMAT}”).", name)
    missing = [key for key in (*_REQUIRED, "strokes", "name", "feet") if key not in arrays]
    if missing:
        raise InputError(f"{name} lacks {', '.join(missing)}.", name)
    fields: dict[str, Any] = {key: arrays.get(key) for key in (*_REQUIRED, *_KNOWN_SOMETIMES)}
    trajectory = Trajectory(**fields)
    if arrays["strokes"].shape != trajectory.feet_world.shape:
        raise InputError(
            f"{name}: strokes has shape {arrays['strokes'].shape}; it must be {trajectory.feet_world.shape}.",
            name,
        )
    return MotionFile(
        trajectory, arrays["strokes"], str(arrays["name"]), tuple(str(foot) for foot in arrays["feet"])
    )
