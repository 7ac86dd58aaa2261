"""The gait diagram (Hildebrand 1965): rows of feet, swing in the foot's colour, time along."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby

import numpy as np

from app.export.drawing import INK, QUIET, SHEET, Anchor, Box, Dot, Drawing, Rule, Shape, Words, hatching
from core.arrays import Bools, Floats
from core.gait.gait import Gait
from core.pose_gaits.gait_poses import found_gait
from core.robot.model import RobotModel

GRID, STANCE, LOCKED = "#d5dae2", "#eceef2", "#8b5cf6"
WIDTH, LEFT, RIGHT = 1120.0, 104.0, 76.0
TOP, BARE_TOP = 96.0, 40.0
"""Above the first row: with name and facts, and without them, px."""
ROW, GAP = 30.0, 6.0
"""Height of a row and the space between rows, px."""
MOST_TICKS = 14
MOST_PARTS_TEXT = 80
"""Characters of a sequence's parts that the line under its name has room for."""
_TICK_STEPS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0)


@dataclass(frozen=True)
class PlotArea:
    """Where the rows lie on the sheet, px, and where their samples begin and end, s."""

    left: float
    width: float
    top: float
    bottom: float
    edges: Floats

    @property
    def seconds(self) -> float:
        """How long the rows last."""
        return float(self.edges[-1])

    def x(self, time: float) -> float:
        """Place of a time."""
        return self.left + self.width * time / self.seconds


def sample_edges(gait: Gait, model: RobotModel) -> Floats:
    """(samples + 1,) where each sample begins and the last one ends, s.

    A sample lasts until the next one; of a gait for the robot's clock it lasts from half way before its pose
    to half way after it, in the robot's own seconds.
    """
    found = None if gait.poses is None else found_gait(gait, model)
    if found is None:
        return np.asarray(gait.timeline.sample_time * np.arange(gait.timeline.sample_count + 1), float)
    times = np.concatenate([[0.0], np.cumsum(found.move_seconds)])
    return np.concatenate([times[:1], (times[1:] + times[:-1]) / 2, times[-1:]])


def plot_area(gait: Gait, model: RobotModel, is_headed: bool = True) -> PlotArea:
    """Where the rows of a gait's diagram lie."""
    rows, top = gait.timeline.leg_count, TOP if is_headed else BARE_TOP
    return PlotArea(
        left=LEFT,
        width=WIDTH - LEFT - RIGHT,
        top=top,
        bottom=top + rows * (ROW + GAP) - GAP,
        edges=sample_edges(gait, model),
    )


def gait_diagram(gait: Gait, model: RobotModel, is_headed: bool = True) -> Drawing:
    """Draws a gait's timeline for print.

    Args:
        gait: whose timeline.
        model: its robot, for the feet's colours.
        is_headed: whether its name and facts stand above.
    """
    area = plot_area(gait, model, is_headed)
    head = _head(gait, area) if is_headed else ()
    shapes: list[Shape] = [*head, *_grid(area)]
    for foot in range(gait.timeline.leg_count):
        shapes += _row(gait, foot, model.colours[foot], area)
    shapes += [*_axis(area), *_legend(model, area, bool(gait.timeline.locked.any()))]
    return Drawing(
        width=WIDTH,
        height=area.bottom + 80,
        title=f"Gait diagram of {gait.name}",
        description=_in_words(gait, area),
        background=SHEET,
        shapes=tuple(shapes),
    )


def _in_words(gait: Gait, area: PlotArea) -> str:
    sentences = []
    for foot, row in enumerate(gait.timeline.stance):
        spans = [f"{a:.4g} to {b:.4g} s" for a, b in _runs(~row, area.edges)]
        swings = " and ".join(spans) if spans else "never"
        role = f" ({gait.roles[foot]})" if gait.roles[foot] else ""
        sentences.append(f"Foot {foot + 1}{role} swings {swings}.")
    return " ".join(sentences)


def _runs(row: Bools, edges: Floats) -> Iterator[tuple[float, float]]:
    """Times from and to which a row is true."""
    first = 0
    for value, run in groupby(row.tolist()):
        after = first + len(list(run))
        if value:
            yield float(edges[first]), float(edges[after])
        first = after


def facts(gait: Gait, edges: Floats) -> str:
    """A line on what the gait asks, with the samples that begin and end at these times."""
    dx, dy, yaw = gait.step
    turn = f", turn {np.degrees(yaw):.1f}°" if yaw else ""
    way = f"{np.hypot(dx, dy) * 1000:.1f} mm{turn}"
    count = gait.timeline.sample_count
    samples = f"{count} samples of {gait.timeline.sample_time:g} s"
    if gait.poses is not None:
        is_even = np.allclose(np.diff(edges), gait.timeline.sample_time)
        samples = f"{count} poses" + (
            ", not solved yet" if is_even else f" in {edges[-1]:.1f} s on the robot"
        )
    if gait.sequence:
        return f"{_parts(gait)}  ·  {way}  ·  {samples}"
    iterations = f"{gait.iterations} iteration{'' if gait.iterations == 1 else 's'}"
    return (
        f"{gait.orientation}, direction {gait.direction}  ·  order {'-'.join(map(str, gait.order))}  ·  "
        f"step {way}  ·  {iterations}  ·  {samples}"
    )


def _parts(gait: Gait) -> str:
    """What a sequence chains, as far as there is room for it."""
    # The font of pictures has no multiplication sign.
    names = [f"{part.times}x {part.gait.name}" for part in gait.sequence]
    shown = names[:1]
    while len(shown) < len(names) and len(", ".join(names[: len(shown) + 1])) <= MOST_PARTS_TEXT:
        shown.append(names[len(shown)])
    left = len(names) - len(shown)
    return _shortened(", ".join(shown)) + (f" and {left} more" if left else "")


def _head(gait: Gait, area: PlotArea) -> Iterator[Shape]:
    yield Words(LEFT - 84, 36, _shortened(gait.name), 20, INK, bold=True)
    yield Words(LEFT - 84, 58, facts(gait, area.edges), 13, QUIET)


def _shortened(name: str) -> str:
    flat = " ".join(name.split())
    return flat if len(flat) <= 90 else flat[:89] + "…"


def _grid(area: PlotArea) -> Iterator[Shape]:
    yield Words(WIDTH - 20, area.top - 12, "stance", 12, QUIET, Anchor.END)
    for time in _ticks(area.seconds):
        x = area.x(time)
        yield Rule(x, area.top - 6, x, area.bottom + 6, GRID)


def _row(gait: Gait, foot: int, colour: str, area: PlotArea) -> Iterator[Shape]:
    stance, locked = gait.timeline.stance[foot], gait.timeline.locked[foot]
    y = area.top + foot * (ROW + GAP)
    baseline = y + ROW / 2 + 5
    yield Dot(LEFT - 76, y + ROW / 2, 6, colour)
    yield Words(LEFT - 62, baseline, str(foot + 1), 15, INK, bold=True)
    if gait.roles[foot] != str(foot + 1):
        yield Words(LEFT - 42, baseline, gait.roles[foot], 13, QUIET)
    yield Box(area.left, y, area.width, ROW, STANCE, 3)
    for first, after in _runs(~stance, area.edges):
        x, width = area.x(first), area.x(after) - area.x(first)
        yield Box(x, y, width, ROW, colour, min(3.0, width / 2))
        if width > 46:
            yield Words(
                x + width / 2, baseline, f"{after - first:.2f} s", 12, SHEET, Anchor.MIDDLE, bold=True
            )
    for first, after in _runs(locked, area.edges):
        span = Box(area.x(first), y, area.x(after) - area.x(first), ROW, LOCKED)
        yield from hatching(span, LOCKED)
    share = float(np.diff(area.edges) @ stance) / area.seconds
    yield Words(WIDTH - 20, baseline, f"{share * 100:.0f} %", 14, INK, Anchor.END)


def _ticks(seconds: float) -> list[float]:
    """Times of the axis's marks: a round step, at most `MOST_TICKS` of them."""
    step = next((s for s in _TICK_STEPS if seconds / s <= MOST_TICKS), seconds / MOST_TICKS)
    return [k * step for k in range(int(seconds / step + 1e-9) + 1)]


def _axis(area: PlotArea) -> Iterator[Shape]:
    yield Rule(area.left, area.bottom + 6, area.left + area.width, area.bottom + 6, INK)
    for time in _ticks(area.seconds):
        yield Rule(area.x(time), area.bottom + 6, area.x(time), area.bottom + 11, INK)
        yield Words(area.x(time), area.bottom + 27, f"{time:g}", 12, INK, Anchor.MIDDLE)
    yield Words(WIDTH - 20, area.bottom + 27, "time, s", 12, QUIET, Anchor.END)


def _legend(model: RobotModel, area: PlotArea, has_locks: bool) -> Iterator[Shape]:
    y, x = area.bottom + 56, area.left
    count = model.leg_count
    for foot, colour in enumerate(model.colours):
        yield Box(x + 36.0 * foot / count, y - 11, 36.0 / count, 14, colour)
    yield Words(x + 44, y, "swing", 12, QUIET)
    yield Box(x + 104, y - 11, 36, 14, STANCE, 3)
    yield Words(x + 148, y, "stance", 12, QUIET)
    if has_locks:
        swatch = Box(x + 216, y - 11, 36, 14, LOCKED)
        yield from hatching(swatch, LOCKED)
        yield Words(x + 260, y, "locked", 12, QUIET)
