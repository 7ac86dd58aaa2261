"""The picture of moves over time: for each walk a row for the body and one for each foot."""

from collections.abc import Iterator, Sequence
from itertools import accumulate, pairwise

from app.bench.robot.walked_moves import Move, WalkedMoves
from app.export.drawing import GRID, INK, QUIET, SHEET, Anchor, Box, Dot, Drawing, Rule, Shape, Words

WIDTH, LEFT, RIGHT = 1000.0, 84.0, 28.0
TOP, HEAD, BETWEEN, FOOT = 44.0, 50.0, 22.0, 74.0
"""Above all, above the rows of a walk, under them, and under the last of them, px."""
ROW, GAP = 20.0, 5.0
"""Height of a row and the space between rows, px."""
STANDS, WAYPOINT, BODY = "#f1f3f6", "#98a2b3", "#475467"
TICK_SECONDS = 5
LEAST_BODY_MM = 0.05
"""A shorter way of the body is none, mm."""


def moves_picture(walks: Sequence[WalkedMoves], colours: Sequence[str]) -> Drawing:
    """Draws walks one under the other on the same axis of time.

    Args:
        walks: with their messages.
        colours: of the feet.
    """
    seconds = TICK_SECONDS * -(-max(walk.seconds for walk in walks) // TICK_SECONDS)
    height = HEAD + (len(colours) + 1) * (ROW + GAP) + BETWEEN
    bottom = TOP + height * len(walks)
    title = _title(walks)
    shapes: list[Shape] = [
        Words(20, 30, title, 18, INK, bold=True),
        *_axis(seconds, bottom),
        *_legend(bottom + 46, colours),
    ]
    for number, walk in enumerate(walks):
        shapes += _walk(walk, colours, TOP + number * height, seconds)
    return Drawing(
        width=WIDTH,
        height=bottom + FOOT,
        title=title,
        description=" ".join(f"{walk.name}: {_facts(walk)}." for walk in walks),
        background=SHEET,
        shapes=tuple(shapes),
    )


def _title(walks: Sequence[WalkedMoves]) -> str:
    """How many messages the last walk needs where the first one needs others."""
    first, last = len(walks[0].moves), len(walks[-1].moves)
    return f"{last} messages a cycle" + (f" instead of {first}" if first != last else "")


def _x(time: float, seconds: float) -> float:
    return LEFT + (WIDTH - LEFT - RIGHT) * time / seconds


def _facts(walk: WalkedMoves) -> str:
    still = walk.with_ramps(0)
    idle = f", {still} of them move nothing" if still else ""
    return (
        f"{walk.way:.1f} mm in {len(walk.moves)} messages{idle}  ·  {walk.seconds:.1f} s, motors move "
        f"{walk.ramp_seconds:.1f} s of them  ·  {walk.way / walk.seconds:.2f} mm/s"
    )


def _walk(walk: WalkedMoves, colours: Sequence[str], top: float, seconds: float) -> Iterator[Shape]:
    """Head, rows and waypoints of a walk."""
    yield Words(20, top + 20, walk.name, 15, INK, bold=True)
    yield Words(20, top + 39, _facts(walk), 13, QUIET)
    starts = [0.0, *accumulate(move.seconds for move in walk.moves)]
    first = top + HEAD
    rows = len(colours) + 1
    for row in range(rows):
        y = first + row * (ROW + GAP)
        yield Box(LEFT, y, _x(starts[-1], seconds) - LEFT, ROW, STANDS)
        yield from _label(row, y, colours)
    for time in range(0, int(seconds) + 1, TICK_SECONDS):
        x = _x(time, seconds)
        yield Rule(x, first - 4, x, first + rows * (ROW + GAP), GRID, 0.8)
    for start in starts:
        x = _x(start, seconds)
        yield Rule(x, first - 4, x, first + rows * (ROW + GAP), WAYPOINT, 0.8)
    for move, (start, _) in zip(walk.moves, pairwise(starts), strict=True):
        yield from _bars(move, start, first, seconds, colours)


def _label(row: int, y: float, colours: Sequence[str]) -> Iterator[Shape]:
    baseline = y + ROW / 2 + 4.5
    yield Dot(26, y + ROW / 2, 5, BODY if row == 0 else colours[row - 1])
    yield Words(38, baseline, "body" if row == 0 else f"foot {row}", 13, INK)


def _bars(move: Move, start: float, first: float, seconds: float, colours: Sequence[str]) -> Iterator[Shape]:
    """A bar in each row of what moves, for each ramp of a message."""
    rows = [(foot, colours[foot - 1]) for foot in move.feet]
    if move.body >= LEAST_BODY_MM:
        rows.insert(0, (0, BODY))
    for begin, end in move.ramps:
        x = _x(start + begin, seconds)
        width = _x(start + end, seconds) - x
        for row, colour in rows:
            yield Box(x, first + row * (ROW + GAP) + 2, width, ROW - 4, colour, 2)


def _axis(seconds: float, bottom: float) -> Iterator[Shape]:
    for time in range(0, int(seconds) + 1, TICK_SECONDS):
        x = _x(time, seconds)
        yield Rule(x, bottom, x, bottom + 5, INK)
        yield Words(x, bottom + 19, f"{time} s" if time == seconds else str(time), 12, INK, Anchor.MIDDLE)
    yield Rule(LEFT, bottom, WIDTH - RIGHT, bottom, INK)


def _legend(y: float, colours: Sequence[str]) -> Iterator[Shape]:
    for foot, colour in enumerate(colours):
        yield Box(LEFT + 9.0 * foot, y - 10, 9, 12, colour)
    yield Words(LEFT + 42, y, "motors take this foot through the air", 12, QUIET)
    yield Box(LEFT + 282, y - 10, 36, 12, BODY)
    yield Words(LEFT + 324, y, "and move the body on", 12, QUIET)
    yield Rule(LEFT + 476, y - 12, LEFT + 476, y + 4, WAYPOINT)
    yield Words(LEFT + 484, y, "a message begins", 12, QUIET)
    yield Box(LEFT + 610, y - 10, 36, 12, STANDS)
    yield Words(LEFT + 652, y, "scans and telemetry: nothing moves", 12, QUIET)
