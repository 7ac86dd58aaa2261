"""Foot tracks in the lab's files: `X_D1, Y_D1, …`, a row a frame, in cm or in pixels (thesis 5.2)."""

import math
from dataclasses import dataclass

import numpy as np

from core.arrays import Floats
from core.errors import InputError
from core.text.tables import Table, read_table
from core.vision.track import FootTrack, filled_track

FRAME_RATE = 13.0
"""Frames a second where a file does not tell; about what the published recordings have (thesis 5.2)."""


@dataclass(frozen=True)
class PixelScale:
    """How pixels become metres on the platform.

    Args:
        metres: of one pixel.
        origin: (x, y) pixel of the platform's centre.
        is_downwards: whether the picture's y runs downwards, so that it is turned over.
    """

    metres: float
    origin: tuple[float, float]
    is_downwards: bool = True

    def __post_init__(self) -> None:
        if not (math.isfinite(self.metres) and self.metres > 0):
            raise InputError(f"One pixel is {self.metres} m; it must be more than 0.", "scale")


@dataclass(frozen=True)
class TrackFile:
    """A track's file as read.

    Args:
        track: the file's.
        notes: sentences on what was unusual in the file's form.
    """

    track: FootTrack
    notes: tuple[str, ...]


def read_track_csv(
    text: str,
    name: str = "track",
    *,
    frame_rate: float = FRAME_RATE,
    pixels: PixelScale | None = None,
) -> TrackFile:
    """Reads a foot track.

    In pixel files 0,0 is a gap, as the lab's tracker writes it; in files in centimetres it is a position, and
    an empty pair of fields is a gap.

    Args:
        text: the file's text.
        name: the file's name, for messages.
        frame_rate: frames a second.
        pixels: how pixels become metres; None where the file is in centimetres.

    Raises:
        InputError: naming line and column of the first thing that is wrong.
    """
    table = read_table(text, name, has_empty_rows=True)
    feet = _feet_of_header(table)
    if len(table.rows) < 3:
        raise InputError(f"{name} holds {len(table.rows) - 1} frames; a track needs at least two.", name)
    positions = table.numbers(1, 2 * feet, has_gaps=True).reshape(-1, feet, 2)
    times = np.arange(len(positions)) / frame_rate
    moved = positions / 100.0 if pixels is None else _scaled(positions, pixels)
    return TrackFile(filled_track(times, moved, name), table.notes)


def parse_track_csv(
    text: str,
    name: str = "track",
    *,
    frame_rate: float = FRAME_RATE,
    pixels: PixelScale | None = None,
) -> FootTrack:
    """The track of a file (see `read_track_csv`)."""
    return read_track_csv(text, name, frame_rate=frame_rate, pixels=pixels).track


def format_track_csv(track: FootTrack) -> str:
    """Writes a track in centimetres; what was filled is left empty, so that it stays a gap."""
    header = ", ".join(f"X_D{foot}, Y_D{foot}" for foot in range(1, track.foot_count + 1))
    lines = [header]
    for frame, filled in zip(track.feet, track.filled, strict=True):
        pairs = (
            "," if gap else f"{x * 100:.4f},{y * 100:.4f}" for (x, y), gap in zip(frame, filled, strict=True)
        )
        lines.append(",".join(pairs))
    return "\n".join(lines) + "\n"


def _feet_of_header(table: Table) -> int:
    feet = len(table.head) // 2
    wanted = [f"{axis}_D{foot}" for foot in range(1, max(feet, 2) + 1) for axis in "XY"][: 2 * feet or None]
    if not feet or [cell.upper() for cell in table.head] != wanted:
        raise table.header_refusal("X_D1, Y_D1, X_D2, Y_D2, …", wanted)
    return feet


def _scaled(positions: Floats, pixels: PixelScale) -> Floats:
    gap = (positions == 0.0).all(axis=2)
    moved = (positions - np.array(pixels.origin)) * pixels.metres
    if pixels.is_downwards:
        moved[..., 1] *= -1.0
    moved[gap] = math.nan
    return np.asarray(moved)
