"""Where strokes were clipped, as JSON."""

from app.common.json import Json
from core.arrays import Floats
from core.motion.within_stroke import clipped_places


def clipped_content(clipped: Floats | None) -> list[Json]:
    """Foot and sample, from 0, where strokes were clipped, and the largest of the foot's three in mm."""
    if clipped is None:
        return []
    return [
        {"foot": place.foot, "sample": place.sample, "mm": round(place.by * 1000, 4)}
        for place in clipped_places(clipped)
    ]
