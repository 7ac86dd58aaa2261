"""The x–y plots of thesis Figures 4.2 to 4.8 beside ours, a row of panels in one drawing."""

from collections.abc import Mapping, Sequence

import numpy as np

from app.common.json import Json
from app.export.drawing import QUIET, SHEET, Drawing, Shape, Words, moved
from app.export.path_plot import EDGE, Ways, way_plot
from app.published.columns import TITLES, Who
from app.published.figures import definition_of
from core.published.gaits import row_title
from core.published.tables import PublishedRow, PublishedTable

FIGURES = {
    ("walk", False): "4.2",
    ("amble", False): "4.3",
    ("s-gait", False): "4.4",
    ("walk", True): "4.5",
    ("amble", True): "4.6",
    ("s-gait", True): "4.7",
    ("c-gait", True): "4.8",
}
"""Number of the thesis's figure, by gait and whether it is optimised."""
ROOM = 0.006
"""Space around the farthest way, m."""
ORDER = (Who.RUN, Who.RECORDED, Who.OURS)
"""Panels from left to right, as far as they are computed."""
_CAPTIONS = {"feet_mm": "feet {:.2f} mm", "body_mm": "body {:.2f} mm", "lean_deg": "leans {:.1f}°"}
CAPTION, SPACE = 22.0, 10.0
"""Height of a caption, and space between panels, px."""


def row_plot(
    table: PublishedTable, row: PublishedRow, contents: Mapping[Who, Json], colours: tuple[str, ...]
) -> Drawing | None:
    """The panels of a row; None where no way is computed.

    Args:
        table: of the row.
        row: which one.
        contents: what is kept of it (`app.published.figures`), by its origin.
        colours: a colour a foot.
    """
    shown = {who: contents[who] for who in ORDER if who in contents and contents[who]["ways"] is not None}
    if not shown:
        return None
    ways = [_ways(f"{row_title(row)}, {TITLES[who]}", content["ways"]) for who, content in shown.items()]
    reach = max(one.reach for one in ways) + ROOM
    panels = [way_plot(one, colours, reach) for one in ways]
    definition = definition_of(table, row)
    captions = [_caption(content["figures"].get(definition, {})) for content in shown.values()]
    return _side_by_side(panels, captions, _title(row))


def _ways(title: str, content: Json) -> Ways:
    names = ("planned_body", "planned_feet", "body", "feet")
    return Ways(title, *(np.array(content[name], dtype=np.float64) for name in names))


def _title(row: PublishedRow) -> str:
    number = FIGURES.get((row.gait.family, row.gait.version is None))
    return row_title(row) if number is None else f"{row_title(row)}, T Figure {number}"


def _caption(figures: Json) -> str:
    """Figures under a panel; one that is not known is left out."""
    known = {name: value for name, value in figures.items() if value is not None}
    return "; ".join(form.format(known[name]) for name, form in _CAPTIONS.items() if name in known)


def _side_by_side(panels: Sequence[Drawing], captions: Sequence[str], title: str) -> Drawing:
    shapes: list[Shape] = []
    left = 0.0
    for panel, caption in zip(panels, captions, strict=True):
        shapes += [moved(shape, left) for shape in panel.shapes]
        shapes.append(Words(left + EDGE, panel.height + 14, caption, 11, QUIET))
        left += panel.width + SPACE
    words = " ".join(f"{panel.title}: {panel.description}" for panel in panels)
    return Drawing(left - SPACE, panels[0].height + CAPTION, title, words, SHEET, tuple(shapes))
