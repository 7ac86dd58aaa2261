"""An atlas in other forms: CSV and Parquet."""

import csv
import io
from pathlib import Path
from typing import Any

from app.atlas.atlas_file import AtlasFile
from app.common.json import Json
from app.store.gait_files import write_atomically
from core.atlas.row import FIGURES, AtlasRow
from core.errors import InputError

SUFFIXES = (".csv", ".parquet")


def export_atlas(atlas: AtlasFile, path: Path) -> int:
    """Writes an atlas in the form that the name of the file ends in; gives the number of its gaits.

    Args:
        atlas: the file.
        path: ends in .csv or .parquet.

    Raises:
        InputError: it ends in something else, or what Parquet needs is not installed.
        StorageError: the disk does not take it.
    """
    if path.suffix not in SUFFIXES:
        raise InputError(f"{path} must end in {' or '.join(SUFFIXES)}.", "-o")
    entries = list(atlas.entries())
    if path.suffix == ".csv":
        write_atomically(path, _csv(entries))
    else:
        _write_parquet(path, entries)
    return len(entries)


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
    writer = csv.DictWriter(text, list(rows[0]) if rows else ["id", "status", "reason", *FIGURES])
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def _write_parquet(path: Path, entries: list[tuple[AtlasRow, Json]]) -> None:
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
    write_atomically(path, sink.getvalue())
