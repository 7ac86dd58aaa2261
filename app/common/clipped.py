"""Where strokes were clipped, as JSON."""

from typing import Any

import numpy as np

from app.common.json import Json
from core.arrays import Floats
from core.errors import InputError
from core.motion.within_stroke import clipped_places


def clipped_content(clipped: Floats | None) -> list[Json]:
    """Foot and sample, from 0, where strokes were clipped, and the largest of the foot's three in mm."""
    if clipped is None:
        return []
    return [
        {"foot": place.foot, "sample": place.sample, "mm": round(place.by * 1000, 4)}
        for place in clipped_places(clipped)
    ]


def clipped_from_content(content: Any, shape: tuple[int, ...]) -> Floats | None:
    """Inverse of `clipped_content`, with a foot's largest for each of its motors; None where nothing was.

    Args:
        content: of a file.
        shape: (count, legs, 3) of the strokes.

    Raises:
        InputError: it is of another form, or of another number of waypoints or feet.
    """
    clipped = np.zeros(shape)
    try:
        for place in content:
            clipped[int(place["sample"]), int(place["foot"])] = float(place["mm"]) / 1000.0
    except (KeyError, TypeError, ValueError, IndexError) as error:
        raise InputError(
            "clipped_mm of the companion does not fit the waypoints. Write the file anew.", "clipped_mm"
        ) from error
    return clipped if clipped.any() else None
