"""A motion as NumPy's NPZ: arrays with time first, their units and names inside the file."""

import io
import math
import tokenize
import zipfile
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.arrays import Floats
from core.errors import InputError
from core.motion.trajectory import Trajectory
from core.text.decoding import MOST_BYTES

NPZ_FORMAT = "footfall-motion"
_Array = NDArray[Any]
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
    tokenize.TokenError,
    RecursionError,
    MemoryError,
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
        InputError: it is damaged, too large, of another kind, or lacks an array.
    """
    try:
        arrays = dict(_arrays(content))
    except _DAMAGES as error:
        raise InputError(f"{name} is not an NPZ of plain arrays: {error}.", name) from error
    is_known = str(arrays.get("format")) == NPZ_FORMAT and str(arrays.get("version")) == "1"
    if not is_known:
        raise InputError(f"{name} is not a motion of version 1 (“{NPZ_FORMAT}”).", name)
    missing = [key for key in (*_REQUIRED, "strokes", "name", "feet") if key not in arrays]
    if missing:
        raise InputError(f"{name} lacks {', '.join(missing)}.", name)
    for key in (*_REQUIRED, *_KNOWN_SOMETIMES, "strokes"):
        if key in arrays and arrays[key].dtype.kind not in "biuf":
            raise InputError(f"{name}: {key} must have numbers and has other values.", name)
    fields: dict[str, Any] = {key: arrays.get(key) for key in (*_REQUIRED, *_KNOWN_SOMETIMES)}
    trajectory = Trajectory(**fields)
    feet = arrays["feet"]
    if arrays["strokes"].shape != trajectory.feet_world.shape:
        raise InputError(
            f"{name}: strokes has shape {arrays['strokes'].shape}; it must be {trajectory.feet_world.shape}.",
            name,
        )
    if feet.shape != (trajectory.leg_count,):
        raise InputError(f"{name}: feet must name each of the {trajectory.leg_count} feet.", name)
    return MotionFile(trajectory, arrays["strokes"], str(arrays["name"]), tuple(str(foot) for foot in feet))


def _arrays(content: bytes) -> Iterator[tuple[str, _Array]]:
    """The arrays of an NPZ, by name; what unpacks to more than a text file may have is not unpacked.

    Raises:
        ValueError: it is too large, or an array is not as long as it says.
    """
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        parts = archive.infolist()
        size = sum(part.file_size for part in parts)
        if size > MOST_BYTES:
            raise ValueError(f"it unpacks to {size / 1e6:.0f} MB; at most {MOST_BYTES / 1e6:g} MB are read")
        for part in parts:
            yield part.filename.removesuffix(".npy"), _array(archive.read(part))


def _array(content: bytes) -> _Array:
    """An array of numbers or of text, whose head says neither more nor less than what follows it."""
    file = io.BytesIO(content)
    if np.lib.format.read_magic(file) != (1, 0):
        raise ValueError("an array is of another version of NPY than 1.0")
    shape, is_column_first, kind = np.lib.format.read_array_header_1_0(file)
    held = len(content) - file.tell()
    if kind.hasobject or math.prod(shape) * kind.itemsize != held or min(shape, default=0) < 0:
        raise ValueError(f"an array says that it has the shape {shape}, and holds {held} bytes of {kind}")
    array = np.frombuffer(content, kind, offset=file.tell()) if held else np.empty(0, kind)
    return array.reshape(shape, order="F" if is_column_first else "C")
