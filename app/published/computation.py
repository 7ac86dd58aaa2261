"""A published table computed in this process, for commands and scripts."""

from collections.abc import Callable

from app.common.json import Json
from app.published.figures import Tools
from app.published.reference import Reference
from app.published.rows import table_entries, table_view
from core.errors import FootfallError
from core.published.tables import PublishedTable
from solver_jobs import simulate, solve_live

IN_PROCESS = Tools(solve_live, simulate)
"""Solver and physics in this process."""


def computed_table(
    table: PublishedTable,
    reference: Reference | None,
    kept: dict[str, Json],
    tell: Callable[[float], object] = lambda share: None,
    tools: Tools = IN_PROCESS,
) -> Json:
    """A table with every row computed; a row that cannot be says why.

    Args:
        table: which one.
        reference: the published data, where it is at hand.
        kept: what is computed already; gains the rest, which other tables may share.
        tell: told the share of rows that are done.
        tools: what solves and simulates.

    Raises:
        InputError: a published file cannot be read.
    """
    entries = table_entries(table, reference)
    failures: dict[str, str] = {}
    for number, (row, wanted) in enumerate(entries.items()):
        tell(number / len(entries))
        try:
            for entry in wanted:
                if entry.key not in kept:
                    kept[entry.key] = entry.compute(tools)
        except FootfallError as error:
            failures[row] = error.sentence
    view = table_view(table, reference, entries, kept)
    rows = [_row(row, failures.get(row["id"])) for row in view["rows"]]
    heads = {name: getattr(table, name) for name in ("id", "name", "title", "source")}
    return heads | view | {"rows": rows}


def _row(row: Json, failure: str | None) -> Json:
    return row if failure is None else row | {"state": "failed", "sentence": failure}
