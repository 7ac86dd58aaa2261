"""The ways of body and feet from above: planned wide and pale, simulated thin over it."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from app.export.drawing import GRID, INK, QUIET, SHEET, Anchor, Dot, Drawing, Rule, Shape, Trace, Words
from core.arrays import Floats

SIZE, EDGE, HEAD = 300.0, 30.0, 26.0
"""Side of the plot, space for numbers at the left and below, and for the title, px."""
RIGHT = 12.0
"""Space at the right for half of a number, px."""
GRID_STEP = 0.020
"""Distance of grid lines, m."""
PALE = 0.72
"""How far the planned way's colour goes towards the sheet's."""


@dataclass(frozen=True, eq=False)
class Ways:
    """Positions from above, at each waypoint.

    Args:
        title: over the plot.
        planned_body: (n, 2) m.
        planned_feet: (n, legs, 2) m.
        body: (n, 2) simulated, m.
        feet: (n, legs, 2) simulated, m.
    """

    title: str
    planned_body: Floats
    planned_feet: Floats
    body: Floats
    feet: Floats

    @property
    def reach(self) -> float:
        """The farthest from the origin along an axis, m."""
        tracks = (self.planned_body, self.planned_feet, self.body, self.feet)
        return float(max(np.abs(track).max() for track in tracks))


def way_plot(ways: Ways, colours: tuple[str, ...], reach: float) -> Drawing:
    """Draws the ways with x to the right and y up, in equal scales.

    Args:
        ways: what is drawn.
        colours: a colour a foot.
        reach: what the plot shows to each side of the origin, m.
    """
    paper = _Paper(SIZE / (2 * reach), reach)
    shapes: list[Shape] = [
        Words(EDGE, 16, ways.title, 13, INK, bold=True),
        *_grid(paper),
        *_track(paper, ways.planned_body, ways.body, INK),
    ]
    for foot, colour in enumerate(colours):
        shapes += _track(paper, ways.planned_feet[:, foot], ways.feet[:, foot], colour)
    return Drawing(
        width=EDGE + SIZE + RIGHT,
        height=HEAD + SIZE + EDGE,
        title=ways.title,
        description=_in_words(ways),
        background=SHEET,
        shapes=tuple(shapes),
    )


@dataclass(frozen=True)
class _Paper:
    """Where points of the ground lie on the sheet: px a metre, and what is shown to each side, m."""

    scale: float
    reach: float

    def place(self, x: float, y: float) -> tuple[float, float]:
        return EDGE + (x + self.reach) * self.scale, HEAD + (self.reach - y) * self.scale


def _grid(paper: _Paper) -> Iterator[Shape]:
    most = int(paper.reach / GRID_STEP)
    for number in range(-most, most + 1):
        at = number * GRID_STEP
        (left, y), (right, _) = paper.place(-paper.reach, at), paper.place(paper.reach, at)
        (x, top), (_, bottom) = paper.place(at, paper.reach), paper.place(at, -paper.reach)
        yield Rule(left, y, right, y, GRID)
        yield Rule(x, top, x, bottom, GRID)
        yield Words(left - 4, y + 4, f"{at * 1000:.0f}", 10, QUIET, Anchor.END)
        yield Words(x, bottom + 14, f"{at * 1000:.0f}", 10, QUIET, Anchor.MIDDLE)
    yield Words(EDGE + SIZE, HEAD + SIZE + 27, "x right, y up, mm", 10, QUIET, Anchor.END)


def _track(paper: _Paper, planned: Floats, real: Floats, colour: str) -> Iterator[Shape]:
    wanted = tuple(paper.place(float(x), float(y)) for x, y in planned)
    made = tuple(paper.place(float(x), float(y)) for x, y in real)
    yield Trace(wanted, _paler(colour), 5.0)
    yield Dot(*wanted[-1], 3.5, _paler(colour))
    yield Trace(made, colour, 1.4)
    yield Dot(*made[-1], 2.2, colour)


def _paler(colour: str) -> str:
    """A colour `#rrggbb` nearer to white."""
    parts = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
    return "#" + "".join(f"{round(part + (255 - part) * PALE):02x}" for part in parts)


def _in_words(ways: Ways) -> str:
    gaps = np.linalg.norm(ways.feet - ways.planned_feet, axis=-1).mean(axis=0) * 1000
    feet = ", ".join(f"foot {foot + 1} {gap:.1f} mm" for foot, gap in enumerate(gaps))
    (x, y), (planned_x, planned_y) = ways.body[-1] * 1000, ways.planned_body[-1] * 1000
    return (
        f"From above, the body ends at ({x:.1f}, {y:.1f}) mm, planned ({planned_x:.1f}, {planned_y:.1f}) mm; "
        f"mean distance from the plan on the ground: {feet}."
    )
