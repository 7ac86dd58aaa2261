"""A flat drawing as a list of shapes, for whoever paints it: SVG and PNG show the same."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import pairwise

INK, QUIET, GRID, SHEET = "#1b2430", "#667085", "#e3e6eb", "#ffffff"
"""Colours of lines and words, of lesser ones, of the grid and of the ground."""


class Anchor(StrEnum):
    """Which end of a text stands at its place."""

    START = "start"
    MIDDLE = "middle"
    END = "end"


@dataclass(frozen=True)
class Box:
    """A filled rectangle with rounded corners, px."""

    x: float
    y: float
    width: float
    height: float
    fill: str
    radius: float = 0.0


@dataclass(frozen=True)
class Rule:
    """A straight line, px."""

    x1: float
    y1: float
    x2: float
    y2: float
    colour: str
    width: float = 1.0


@dataclass(frozen=True)
class Trace:
    """A line through points (x, y), px."""

    points: tuple[tuple[float, float], ...]
    colour: str
    width: float = 1.0


@dataclass(frozen=True)
class Dot:
    """A filled circle, px."""

    x: float
    y: float
    radius: float
    fill: str


@dataclass(frozen=True)
class Words:
    """A line of text; y is its baseline, px."""

    x: float
    y: float
    text: str
    size: float
    colour: str
    anchor: Anchor = Anchor.START
    bold: bool = False


Shape = Box | Rule | Trace | Dot | Words


@dataclass(frozen=True)
class Drawing:
    """Shapes in the order of painting.

    Args:
        width: px.
        height: px.
        title: what it is.
        description: what it shows, in words.
        background: colour of the sheet.
        shapes: the first is painted first.
    """

    width: float
    height: float
    title: str
    description: str
    background: str
    shapes: tuple[Shape, ...]


def moved(shape: Shape, along: float) -> Shape:
    """A shape farther to the right, px."""
    match shape:
        case Rule():
            return replace(shape, x1=shape.x1 + along, x2=shape.x2 + along)
        case Trace():
            return replace(shape, points=tuple((x + along, y) for x, y in shape.points))
        case _:
            return replace(shape, x=shape.x + along)


def hatching(box: Box, colour: str, spacing: float = 6.0, width: float = 1.6) -> Iterator[Rule]:
    """Lines at 45° that fill a rectangle, cut off at its edges."""
    start = -box.height + spacing / 2
    while start < box.width:
        x1, x2 = max(start, 0.0), min(start + box.height, box.width)
        yield Rule(
            box.x + x1,
            box.y + box.height - (x1 - start),
            box.x + x2,
            box.y + box.height - (x2 - start),
            colour,
            width,
        )
        start += spacing


def dashed(
    points: Sequence[tuple[float, float]], colour: str, width: float, dash: float, gap: float
) -> Iterator[Trace]:
    """A broken line through points: pieces of a length, with a gap between them, px."""
    piece, left, is_drawn = [points[0]], dash, True
    for (x1, y1), (x2, y2) in pairwise(points):
        length, done = math.hypot(x2 - x1, y2 - y1), 0.0
        while length - done > left:
            done += left
            at = (x1 + (x2 - x1) * done / length, y1 + (y2 - y1) * done / length)
            if is_drawn:
                yield Trace((*piece, at), colour, width)
            piece, is_drawn = [at], not is_drawn
            left = dash if is_drawn else gap
        left -= length - done
        piece.append((x2, y2))
    if is_drawn and len(piece) > 1:
        yield Trace(tuple(piece), colour, width)
