"""A published table computed in this process, for commands and scripts."""

from collections.abc import Callable

from app.common.json import Json
from app.published.figures import Tools
from app.published.reference import Reference
from app.published.reference_folder import PublishedFolder
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
    """
    entries = table_entries(table, reference)
    failures: dict[str, str] = {}
    for number, row_entries in enumerate(entries.values()):
        tell(number / len(entries))
        for entry in row_entries:
            if entry.key in kept or entry.key in failures:
                continue
            try:
                kept[entry.key] = entry.compute(tools)
            except FootfallError as error:
                failures[entry.key] = error.sentence
    view = table_view(table, PublishedFolder(reference=reference), entries, kept, failures)
    return {name: getattr(table, name) for name in ("id", "name", "title", "source")} | view
