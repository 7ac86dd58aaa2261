"""A published table as pages and scripts get it: columns, and rows of printed and computed figures."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict

from app.common.json import Json
from app.published.about import about_table
from app.published.columns import Column, Who, columns_of, row_cells
from app.published.entries import Entry, entries_of
from app.published.figures import SIMULATED, definition_of, joined
from app.published.opening import sources_of
from app.published.reference import Reference
from core.published.tables import PublishedRow, PublishedTable

Kept = Mapping[str, Json]
"""Computed figures by their key."""
Entries = Mapping[str, Sequence[Entry]]
"""The computations of a table's rows, by row."""
DECIMALS = 3
"""Of computed figures in a table's cells."""


def table_entries(table: PublishedTable, reference: Reference | None) -> Entries:
    """The computations of a table's rows.

    Raises:
        InputError: a published file cannot be read.
    """
    return {row.id: entries_of(table, row, reference) for row in table.rows}


def is_row_done(entries: Sequence[Entry], kept: Kept) -> bool:
    """Whether every computation of a row is kept."""
    return all(entry.key in kept for entry in entries)


def table_view(table: PublishedTable, reference: Reference | None, entries: Entries, kept: Kept) -> Json:
    """Sentences, columns and rows of a table.

    Args:
        table: which one.
        reference: the published data, where it is at hand.
        entries: of its rows.
        kept: what is computed by now.
    """
    has_reference = reference is not None
    columns = columns_of(table, has_reference=has_reference)
    return {
        "about": about_table(table, has_reference=has_reference),
        "columns": [asdict(column) for column in columns],
        "rows": [_row(table, row, columns, entries[row.id], kept, reference) for row in table.rows],
    }


def _row(
    table: PublishedTable,
    row: PublishedRow,
    columns: Sequence[Column],
    entries: Sequence[Entry],
    kept: Kept,
    reference: Reference | None,
) -> Json:
    contents = [kept[entry.key] for entry in entries if entry.key in kept]
    known = row_cells(row)
    for content in contents:
        known |= _cells(content, definition_of(table, row))
    refused = any(content["is_refused"] for content in contents)
    done = "failed" if refused else "done" if is_row_done(entries, kept) else "none"
    return {
        "id": row.id,
        "cells": {column.key: known.get(column.key) for column in columns},
        "state": done,
        "opens": [source.value for source in sources_of(table, row, reference)],
        "sentence": joined(row.note, *(content["sentence"] for content in contents)),
        "has_plot": table.kind in SIMULATED and any(content["ways"] for content in contents),
    }


def _cells(content: Json, definition: str) -> Json:
    """The cells of kept figures by one definition, rounded."""
    return {
        f"{Who(who)}.{name}": None if value is None else round(value, DECIMALS) + 0.0
        for who, definitions in content["figures"].items()
        for name, value in definitions.get(definition, {}).items()
    }
