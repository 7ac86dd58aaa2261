"""An atlas in other forms: CSV, Parquet, and a page with its map."""

import csv
import io
from pathlib import Path
from typing import Any

from app.atlas.atlas_file import AtlasFile
from app.atlas.entries import entries_with_physics
from app.atlas.map_page import map_page
from app.common.json import Json
from app.common.table_cell import table_cell
from app.store.named_file import form_of, write_named
from core.atlas.row import FIGURES, AtlasRow
from core.errors import InputError

MEDIA_TYPES = {
    ".csv": "text/csv; charset=utf-8",
    ".parquet": "application/vnd.apache.parquet",
    ".html": "text/html; charset=utf-8",
}
"""The forms by the ends of their files' names."""


def export_atlas(atlas: AtlasFile, path: Path) -> int:
    """Writes an atlas in the form that the name of the file ends in; gives the number of its gaits.

    Args:
        atlas: the file.
        path: ends in .csv, .parquet or .html; CSV where it is no plain file.

    Raises:
        InputError: it ends in something else, or what Parquet needs is not installed.
        StorageError: the disk does not take it.
    """
    form = form_of(path, MEDIA_TYPES)
    if form is None:
        *others, last = MEDIA_TYPES
        raise InputError(f"{path} must end in {', '.join(others)} or {last}.", "-o")
    write_named(path, exported(atlas, form))
    return sum(atlas.counts().values())


def exported(atlas: AtlasFile, suffix: str) -> bytes:
    """An atlas in one of the forms of `MEDIA_TYPES`.

    Raises:
        InputError: what Parquet needs is not installed.
    """
    if suffix == ".html":
        return map_page(atlas).encode()
    entries = list(entries_with_physics(atlas))
    return _csv(entries).encode() if suffix == ".csv" else _parquet(entries)


def table_row(row: AtlasRow, parameters: Json) -> dict[str, Any]:
    """A gait as a row of a table: number, status, reason, figures (None where there are none), parameters."""
    figures = {
        name: None if value != value else value for name, value in zip(FIGURES, row.figures, strict=True)
    }
    return {
        "id": row.number,
        "status": row.status.value,
        "reason": row.reason,
        **figures,
        **parameters,
    }


def _csv(entries: list[tuple[AtlasRow, Json]]) -> str:
    text = io.StringIO()
    rows = [table_row(*entry) for entry in entries]
    writer = csv.writer(text)
    writer.writerow(map(table_cell, rows[0] if rows else ["id", "status", "reason", *FIGURES]))
    for row in rows:
        writer.writerow(table_cell(value) if isinstance(value, str) else value for value in row.values())
    return text.getvalue()


def _parquet(entries: list[tuple[AtlasRow, Json]]) -> bytes:
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError as error:
        raise InputError(
            "Parquet files need the optional package pyarrow. Install footfall-studio[cluster], or write a "
            "CSV file.",
            "-o",
        ) from error
    sink = io.BytesIO()
    parquet.write_table(pyarrow.Table.from_pylist([table_row(*entry) for entry in entries]), sink)
    return sink.getvalue()
