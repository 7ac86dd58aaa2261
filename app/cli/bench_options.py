"""The options of `bench`, and what its grid of fastest walks is asked with them."""

import argparse
from argparse import Namespace
from pathlib import Path

from app.bench.physics.tables import require_page
from app.bench.robot.moves import require_picture
from app.bench.solvers.edits import COUNT as EDITS
from app.bench.solvers.edits import SEED
from app.bench.solvers.fastest_grid import MARGINS, STEPS, STOP_BOUNDS, Grid
from app.cli.common.argument_types import foot_order, free_or, listed, number, whole
from app.store.named_file import file_path
from core.errors import InputError
from core.library.library import Group, library
from core.pose_gaits.pose_problem import POSE_BOUNDS

GRID = "fastest"
"""The benchmark that has a grid."""
PHYSICS, MOVES = "physics", "moves"
"""The benchmarks that write a report."""
PUBLISHED = "published"
"""The benchmark that prints published tables."""
_LIMITS = ("orders", "steps", "margins", "stop_bounds")
"""Options that limit the grid, as the parser's result names them."""


def add_bench_options(parser: argparse.ArgumentParser) -> None:
    """Adds names and options of `bench`."""
    add = parser.add_argument
    add(
        "names",
        nargs="*",
        metavar="NAME",
        help="none: all but page, advice, atlas, gaits, scene, learning and published",
    )
    add("--count", type=whole(1, 100_000), default=EDITS, help="edits to try (edits)")
    add("--seed", type=whole(0, 2**31), default=SEED, help="of the edits (edits)")
    text = "folder of published data (physics, published, walk, moves, learning)"
    add("--reference", type=Path, default=None, help=text)
    text = "tables such as t4-2 (published; default all)"
    add("--table", dest="tables", type=listed(str), default=None, metavar="TABLE,…", help=text)
    text = (
        "file to write: HTML page with plots (physics), or picture with its data beside it (moves, which has "
        "to be named)"
    )
    add("--report", type=file_path, default=None, help=text)
    add("--markdown", action="store_true", help="print tables as Markdown")
    text = (
        "compare the figures that README and docs quote with what their commands print now: of the quick "
        "commands, or of the named benchmarks, however long they take"
    )
    add("--docs", action="store_true", help=text)
    text = (
        "search a grid of orders, steps, margins and stop bounds in mid-walk instead of the walks (fastest)"
    )
    add("--grid", action="store_true", help=text)
    text = "of the grid: gaits such as walk or feet such as 3-2-4-1 (default all orders that differ)"
    add("--orders", type=listed(grid_order), default=None, metavar="ORDER,…", help=text)
    words = ",".join("free" if step is None else f"{step:g}" for step in STEPS)
    step = listed(free_or(number(0.0005, 0.2, "m")))
    add("--steps", type=step, default=None, metavar="M|free,…", help=f"of the grid, m (default {words})")
    margin = listed(number(*POSE_BOUNDS["margin"], "m"))
    text = f"of the grid, m (default {_words(MARGINS)})"
    add("--margins", type=margin, default=None, metavar="M,…", help=text)
    bound = listed(number(*POSE_BOUNDS["stop_bound"], "s"))
    text = f"of the grid, s (default {_words(STOP_BOUNDS)})"
    add("--stop-bounds", type=bound, default=None, metavar="S,…", help=text)


def _words(values: tuple[float, ...]) -> str:
    return ",".join(f"{value:g}" for value in values)


def grid_order(text: str) -> tuple[int, ...]:
    """An argument type: a gait of the library by its foot order, or feet such as `3-2-4-1`."""
    entry = library().get(text)
    if entry is not None and entry.group is Group.OPTIMISED and entry.gait.step[2] == 0.0:
        return entry.gait.order
    try:
        order = foot_order(text.replace("-", ","))
    except argparse.ArgumentTypeError:
        raise argparse.ArgumentTypeError(
            f"“{text}” is neither walk, amble, s-gait or c-gait nor feet such as 3-2-4-1"
        ) from None
    if sorted(order) != [1, 2, 3, 4]:
        raise argparse.ArgumentTypeError(f"“{text}” must name each foot 1 to 4 once, such as 3-2-4-1")
    return order


def tables_of(options: Namespace) -> tuple[str, ...]:
    """The published tables that are asked for; none for all.

    Raises:
        InputError: they are asked for without their benchmark.
    """
    if options.tables is not None and PUBLISHED not in options.names:
        raise InputError(
            f"--table belongs to the benchmark {PUBLISHED}; name it: footfall bench {PUBLISHED} --table "
            f"{','.join(options.tables)}.",
            "--table",
        )
    return options.tables or ()


def grid_of(options: Namespace) -> Grid | None:
    """The grid that is asked; None where none is.

    Raises:
        InputError: options of the grid without it, or the grid without its benchmark.
    """
    limits = {name: getattr(options, name) for name in _LIMITS if getattr(options, name) is not None}
    if not options.grid:
        for name in limits:
            option = f"--{name.replace('_', '-')}"
            raise InputError(f"{option} limits the grid of the benchmark {GRID}; add --grid.", option)
        return None
    if GRID not in options.names:
        raise InputError(
            f"--grid belongs to the benchmark {GRID}; name it: footfall bench {GRID} --grid.", "--grid"
        )
    return Grid(**limits)


def require_no_measuring(options: Namespace) -> None:
    """Makes sure that no option of a measurement stands beside `--docs`.

    Raises:
        InputError: one does.
    """
    for name in ("report", "markdown", "grid", "tables", *_LIMITS):
        if getattr(options, name):
            option = "--table" if name == "tables" else f"--{name.replace('_', '-')}"
            raise InputError(
                f"{option} does not go with --docs, which measures nothing; leave it out.", option
            )


def reports_of(options: Namespace) -> dict[str, Path]:
    """The report that is asked, by the benchmark that writes it; `moves` writes one only where it is named.

    Raises:
        InputError: two benchmarks would write the same file, or the report cannot be written.
    """
    report: Path | None = options.report
    if report is None:
        return {}
    names = [name for name in (PHYSICS, MOVES) if name in (options.names or [PHYSICS])]
    if len(names) > 1:
        raise InputError(
            f"{PHYSICS} and {MOVES} would both write {report}; name one of them with --report, and measure "
            "the other by itself.",
            "--report",
        )
    for name in names:
        if name == PHYSICS:
            require_page(report)
        else:
            require_picture(report, options.reference)
    return dict.fromkeys(names, report)
