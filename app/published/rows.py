"""A published table as pages and scripts get it: columns, and rows of printed and computed figures."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from types import MappingProxyType

from app.common.json import Json
from app.published.about import about_table
from app.published.columns import Who, columns_of, row_cells
from app.published.entries import Entry, entries_of
from app.published.figures import SIMULATED, definition_of, joined
from app.published.opening import sources_of
from app.published.reference import Reference
from app.published.reference_folder import PublishedFolder
from core.published.tables import PublishedRow, PublishedTable

Kept = Mapping[str, Json]
"""Computed figures by their key."""
Failures = Mapping[str, str]
"""Sentences of computations that failed, by their key."""
Entries = Mapping[str, Sequence[Entry]]
"""The computations of a table's rows, by row."""
DECIMALS = 3
"""Of computed figures in a table's cells."""


def table_entries(table: PublishedTable, reference: Reference | None) -> Entries:
    """The computations of a table's rows."""
    return {row.id: entries_of(table, row, reference) for row in table.rows}


def is_row_done(entries: Sequence[Entry], kept: Kept) -> bool:
    """True if every computation of a row is kept."""
    return all(entry.key in kept for entry in entries)


def has_row_failed(entries: Sequence[Entry], kept: Kept, failures: Failures) -> bool:
    """True if a computation of a row has failed and is not kept."""
    return any(entry.key in failures and entry.key not in kept for entry in entries)


def table_view(
    table: PublishedTable,
    published: PublishedFolder,
    entries: Entries,
    kept: Kept,
    failures: Failures = MappingProxyType({}),
) -> Json:
    """Sentences, columns and rows of a table.

    Args:
        table: which one.
        published: the folder of the published data.
        entries: of its rows.
        kept: what is computed by now.
        failures: sentences of computations that failed.
    """
    has_reference = published.reference is not None
    columns = columns_of(table, has_reference=has_reference)
    keys = [column.key for column in columns]
    return {
        "about": about_table(table, published),
        "columns": [asdict(column) for column in columns],
        "rows": [
            _row(table, row, keys, entries[row.id], kept, failures)
            | {"opens": [source.value for source in sources_of(table, row, published.reference)]}
            for row in table.rows
        ],
    }


def _row(
    table: PublishedTable,
    row: PublishedRow,
    keys: Sequence[str],
    entries: Sequence[Entry],
    kept: Kept,
    failures: Failures,
) -> Json:
    contents = {entry.who: kept[entry.key] for entry in entries if entry.key in kept}
    known = row_cells(row)
    for who, content in contents.items():
        known |= _cells(who, content, definition_of(table, row))
    refused = any(content["is_refused"] for content in contents.values())
    failed = refused or has_row_failed(entries, kept, failures)
    remarks = [
        kept[entry.key]["sentence"] if entry.key in kept else failures.get(entry.key, "") for entry in entries
    ]
    return {
        "id": row.id,
        "cells": {key: known.get(key) for key in keys},
        "state": "failed" if failed else "done" if is_row_done(entries, kept) else "none",
        "sentence": joined(row.note, *remarks),
        "has_plot": table.kind in SIMULATED and any(one["ways"] is not None for one in contents.values()),
    }


def _cells(who: Who, content: Json, definition: str) -> Json:
    """The cells of kept figures by one definition, rounded."""
    return {
        f"{who}.{name}": None if value is None else round(value, DECIMALS) + 0.0
        for name, value in content["figures"].get(definition, {}).items()
    }
