"""Small atlases with invented figures, for the page with the map."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from app.atlas.atlas_file import AtlasFile
from core.atlas.row import FIGURES, AtlasRow, RowStatus
from core.atlas.space import AtlasSpace, default_space
from solver_jobs import drawn_points

SPACE = default_space("deltawalker")
SCALES = {
    "seconds": (20.0, 6.0),
    "speed": (0.002, 0.0008),
    "turn_rate": (0.0, 0.01),
    "least_margin": (0.006, 0.002),
    "body_move": (0.02, 0.006),
    "stroke_use": (0.7, 0.2),
    "stop_seconds": (1.4, 0.3),
}
"""Middle and spread of each figure, SI."""


def invented_atlas(
    path: Path, solved: int = 200, infeasible: int = 60, failed: int = 3, space: AtlasSpace = SPACE
) -> AtlasFile:
    """An atlas with so many gaits of each status, the solved ones first."""
    assert tuple(SCALES) == FIGURES
    atlas = AtlasFile(path, space)
    draw = np.random.default_rng(5)
    rows = []
    for number in range(solved):
        figures = [middle + spread * draw.uniform(-1.0, 1.0) for middle, spread in SCALES.values()]
        rows.append(AtlasRow(number, RowStatus.SOLVED, "", *figures))
    for number in range(solved, solved + infeasible):
        limit = "margin" if number % 3 else "clearance and <stop>"
        rows.append(AtlasRow(number, RowStatus.INFEASIBLE, f"Prevented by: {limit}."))
    for number in range(len(rows), len(rows) + failed):
        rows.append(AtlasRow(number, RowStatus.FAILED, f"The check does not confirm move {number}."))
    if rows:
        atlas.add(list(zip(drawn_points(space, 0, len(rows)), rows, strict=True)))
    return atlas
