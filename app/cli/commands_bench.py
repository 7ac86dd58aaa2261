"""`bench`."""

from argparse import ArgumentParser, Namespace
from functools import partial
from typing import Any

from app.bench import BENCHMARKS, BY_NAME_ONLY, measured
from app.bench.common.measure import EndedEarly, Row, conditions
from app.bench.solvers.fastest_grid import bench_fastest_grid
from app.cli.bench_documents import run_documents
from app.cli.bench_options import (
    GRID,
    MOVES,
    PHYSICS,
    PUBLISHED,
    add_bench_options,
    grid_of,
    reports_of,
    require_no_measuring,
    tables_of,
)
from app.cli.common.command import set_command
from app.cli.common.output import INTERRUPTED, end_on_signals, note, show
from app.cli.common.progress import clear_line
from app.cli.fastest_search import show_progress
from app.common.json import Json
from core.errors import InputError


def bench_command(parser: ArgumentParser) -> None:
    """Makes the parser of `bench`."""
    set_command(parser, run_bench, "Measure what users feel.")
    add_bench_options(parser)


def run_bench(options: Namespace) -> int:
    """Runs benchmarks and prints their conditions; with `--docs` compares the documents with them.

    Where a signal ends one that has rows by then, they are printed and no further one is run.
    """
    end_on_signals()
    unknown = [name for name in options.names if name not in BENCHMARKS]
    if unknown:
        raise InputError(f"There is no benchmark “{unknown[0]}”; choose of {', '.join(BENCHMARKS)}.", "NAME")
    if options.docs:
        require_no_measuring(options)
        return run_documents(options)
    reports = reports_of(options)
    arguments: dict[str, tuple[Any, ...]] = {
        "edits": (options.count, options.seed),
        PHYSICS: (options.reference, reports.get(PHYSICS)),
        MOVES: (options.reference, reports.get(MOVES)),
        "walk": (options.reference,),
        "learning": (options.reference,),
        PUBLISHED: (options.reference, tables_of(options)),
    }
    grid = grid_of(options)
    if grid is not None:
        grid.problems()  # refuses a grid that is too large before anything is measured
    where = conditions()
    results: dict[str, list[Row]] = {}
    was_interrupted = False
    for name in options.names or [name for name in BENCHMARKS if name not in BY_NAME_ONLY]:
        note(f"Measuring {name} …")
        try:
            if name == GRID and grid is not None:
                results[name] = bench_fastest_grid(grid, partial(show_progress, "Grid"))
            else:
                results[name] = measured(name, *arguments.get(name, ()))
        except EndedEarly as ended:
            results[name] = ended.rows
            was_interrupted = True
            break
    lines = [", ".join(f"{key}: {value}" for key, value in where.items())]
    for name, rows in results.items():
        for part in _tables(rows):
            lines += (
                ["", f"## {name}", "", *_markdown(part)] if options.markdown else ["", name, *_text(part)]
            )
    content: Json = {"conditions": where, "results": results}
    if was_interrupted:
        clear_line()
        note("Interrupted. What was measured by then:")
        content |= {"error": "Interrupted.", "where": "command"}
    show(options, content, lines)
    return INTERRUPTED if was_interrupted else 0


def _tables(rows: list[Row]) -> list[list[Row]]:
    """Rows that have the same columns, together."""
    tables: list[list[Row]] = []
    for row in rows:
        if not tables or list(tables[-1][0]) != list(row):
            tables.append([])
        tables[-1].append(row)
    return tables


def _cells(rows: list[Row]) -> list[list[str]]:
    return [list(rows[0]), *([_cell(value) for value in row.values()] for row in rows)]


def _cell(value: Any) -> str:
    return "–" if value is None else str(value)


def _text(rows: list[Row]) -> list[str]:
    """For people: a header and aligned columns."""
    cells = _cells(rows)
    widths = [max(len(line[column]) for line in cells) for column in range(len(cells[0]))]
    return [
        "  " + "  ".join(text.rjust(width) for text, width in zip(line, widths, strict=True))
        for line in cells
    ]


def _markdown(rows: list[Row]) -> list[str]:
    header, *body = _cells(rows)
    lines = [header, ["---"] * len(header), *body]
    return ["| " + " | ".join(text.replace("|", "\\|") for text in line) + " |" for line in lines]
