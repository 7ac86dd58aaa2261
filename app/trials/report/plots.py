"""Plots of trials for print: planned dotted, simulated dashed, tracked solid, from above and over time."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from app.export.drawing import GRID, QUIET, SHEET, Anchor, Dot, Drawing, Rule, Shape, Trace, Words, dashed
from app.trials.figures import CM
from core.arrays import Bools, Floats
from core.vision.track import FootTrack

UNSEEN = "#9aa3b2"
SIZE, EDGE = 300.0, 26.0
WIDE, TALL = 640.0, 170.0
MOST_POINTS = 800
"""Points of a line; a sheet of paper shows no more."""
MOST_LINES = 100
"""Lines of a grid; ways that go farther have lines 10 cm apart, or 1 m, and so on."""
MOST_TICKS = 10
"""Ticks of an axis of time."""
DASHES = {"planned": (2.0, 5.0, 2.2), "simulated": (7.0, 3.0, 0.9)}
"""Length of the pieces, of the gaps between them, and width, px, by the source; the others are solid."""
PAINTED = ("simulated", "planned", "tracked")
"""The first lies lowest: the plan's wide dots can be seen on the thin dashes of a simulation that agrees."""

Place = Callable[[float, float], tuple[float, float]]
Points = Sequence[tuple[float, float]]


def ways_from_above(sources: Mapping[str, FootTrack], colours: Sequence[str]) -> Drawing:
    """The feet from above, x to the right and y up, in equal scales on a grid in cm.

    Args:
        sources: `tracked`, and where they are known `planned` and `simulated`, in one frame.
        colours: a colour a foot.
    """
    ways = {name: _thinned(track.feet * CM) for name, track in sources.items()}
    every = np.concatenate([way.reshape(-1, 2) for way in ways.values()])
    place, grid = _ground(every, "on the platform")
    shapes: list[Shape] = [*grid]
    filled = _thinned(sources["tracked"].filled.astype(np.float64)) > 0
    for name in PAINTED:
        for foot, colour in enumerate(colours if name in ways else ()):
            points = [place(float(x), float(y)) for x, y in ways[name][:, foot]]
            shapes += (
                _seen(points, filled[:, foot], colour) if name == "tracked" else _line(points, colour, name)
            )
    words = [
        f"foot {foot + 1} goes {math.hypot(*(way[-1] - way[0])):.2f} cm"
        for foot, way in enumerate(ways["tracked"].swapaxes(0, 1))
    ]
    return _drawing(SIZE + EDGE, SIZE + EDGE, "Feet from above", "; ".join(words) + ".", shapes)


def ways_over_time(lines: Mapping[str, tuple[Floats, Floats]], colours: Sequence[str], unit: str) -> Drawing:
    """How far the feet are along the way.

    Args:
        lines: by source, (n,) times and (n, feet) ways in cm.
        colours: a colour a foot.
        unit: of the times.
    """
    longest = max(float(times[-1]) for times, _ in lines.values())
    low = min(0.0, *(float(ways.min()) for _, ways in lines.values()))
    high = max(0.1, *(float(ways.max()) for _, ways in lines.values()))
    right, bottom = WIDE - 8.0, TALL - 20.0

    def place(time: float, way: float) -> tuple[float, float]:
        share = (way - low) / (high - low)
        return EDGE + time / longest * (right - EDGE), bottom - share * (bottom - 10.0)

    shapes: list[Shape] = []
    for level in _levels(low, high):
        (left, y), (end, _) = place(0.0, level), place(longest, level)
        shapes += [Rule(left, y, end, y, GRID), Words(left - 4, y + 3, str(level), 9, QUIET, Anchor.END)]
    for time in _ticks(longest):
        x, words = place(time, low)[0], f"{time} {unit}"
        shapes += [Rule(x, bottom, x, bottom + 4, QUIET), Words(x, TALL - 4, words, 9, QUIET, Anchor.MIDDLE)]
    shapes.append(Words(EDGE + 4, 8, "cm along the tracked direction", 9, QUIET))
    for name in (name for name in PAINTED if name in lines):
        times, ways = lines[name]
        for foot, colour in enumerate(colours):
            rows = _thinned(np.column_stack([times, ways[:, foot]]))
            shapes += _line([place(float(t), float(way)) for t, way in rows], colour, name)
    ends = ", ".join(f"{name} {ways[-1].mean():.2f} cm" for name, (_, ways) in lines.items())
    return _drawing(WIDE, TALL, "Ways of the feet", f"Mean along the tracked direction: {ends}.", shapes)


def band_from_above(feet: Sequence[Mapping[str, Any]], colours: Sequence[str]) -> Drawing:
    """Trials over each other from above: each thin, their mean solid, the plan dotted.

    Args:
        feet: of `app.trials.bands.band_content`.
        colours: a colour a foot.
    """
    ways = [
        (foot, name, np.column_stack([way["x"], way["y"]]))
        for foot, content in enumerate(feet)
        for name, way in _layers(content["place"])
    ]
    place, grid = _ground(np.concatenate([way for _, _, way in ways]), "from the robot")
    shapes: list[Shape] = [*grid]
    for foot, name, way in ways:
        shapes += _line([place(float(x), float(y)) for x, y in way], colours[foot], name)
    words = f"Mean ways of {len(feet[0]['place']['trials'])} trials over the plan."
    return _drawing(SIZE + EDGE, SIZE + EDGE, "Trials from above", words, shapes)


def _layers(place: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """A foot's ways in the order of painting."""
    if place["plan"] is not None:
        yield "planned", place["plan"]
    for way in place["trials"]:
        yield "trial", way
    yield "mean", place["mean"]


def _ground(every: Floats, frame: str) -> tuple[Place, list[Shape]]:
    """Where places in cm lie on the sheet, and the grid's lines with their numbers; `frame` says of what."""
    low, high = every.min(axis=0), every.max(axis=0)
    middle, scale = (low + high) / 2, (SIZE - 20.0) / max(float((high - low).max()), 1.0)

    def place(x: float, y: float) -> tuple[float, float]:
        return (
            EDGE + SIZE / 2 + (x - float(middle[0])) * scale,
            SIZE / 2 - (y - float(middle[1])) * scale,
        )

    half = SIZE / 2 / scale
    shapes: list[Shape] = []
    columns, rows = (_levels(float(at) - half, float(at) + half) for at in middle)
    for x in columns:
        across, _ = place(x, 0.0)
        number = _number(x, columns.step, across, SIZE + 12, Anchor.MIDDLE)
        shapes += [Rule(across, 0, across, SIZE, GRID), number]
    for y in rows:
        _, down = place(0.0, y)
        number = _number(y, rows.step, EDGE - 4, down + 3, Anchor.END)
        shapes += [Rule(EDGE, down, EDGE + SIZE, down, GRID), number]
    shapes.append(Words(EDGE + SIZE, SIZE + 24, f"x right, y up {frame}, cm", 9, QUIET, Anchor.END))
    return place, shapes


def _levels(low: float, high: float) -> range:
    """Where the grid's lines are, cm."""
    step = 1
    while (high - low) / step > MOST_LINES:
        step *= 10
    return range(math.ceil(low / step) * step, math.floor(high / step) * step + 1, step)


def _ticks(longest: float) -> range:
    """Moments with a tick: whole 1, 2 or 5, or tens of those."""
    step = next(
        one * 10**power for power in range(10) for one in (1, 2, 5) if longest <= one * 10**power * MOST_TICKS
    )
    return range(0, math.floor(longest) + 1, step)


def _number(value: int, step: int, x: float, y: float, anchor: Anchor) -> Words:
    return Words(x, y, str(value) if value // step % 2 == 0 else "", 9, QUIET, anchor)


def _line(points: Points, colour: str, name: str) -> Iterator[Shape]:
    if name in DASHES:
        length, gap, width = DASHES[name]
        yield from dashed(points, colour, width, length, gap)
    else:
        yield Trace(tuple(points), colour, 0.6 if name == "trial" else 1.6)


def _seen(points: Points, filled: Bools, colour: str) -> Iterator[Shape]:
    """A tracked way, grey where the foot was not seen, with a dot at its end and a ring at its beginning."""
    first = 0
    while first + 1 < len(points):
        is_gap, last = bool(filled[first] or filled[first + 1]), first + 1
        while last + 1 < len(points) and bool(filled[last] or filled[last + 1]) == is_gap:
            last += 1
        part = tuple(points[first : last + 1])
        yield Trace(part, UNSEEN if is_gap else colour, 1.6)
        first = last
    yield Dot(*points[0], 3.5, colour)
    yield Dot(*points[0], 2.2, SHEET)
    yield Dot(*points[-1], 3.0, colour)


def _thinned(values: Floats) -> Floats:
    every = max(1, -(-len(values) // MOST_POINTS))
    return np.asarray(values[np.unique(np.append(np.arange(0, len(values), every), len(values) - 1))])


def _drawing(width: float, height: float, title: str, words: str, shapes: Sequence[Shape]) -> Drawing:
    return Drawing(width, height, title, words, SHEET, tuple(shapes))
