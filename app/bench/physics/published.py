"""The published tables beside our figures, as the page shows them."""

from collections.abc import Sequence
from pathlib import Path

from app.bench.common.measure import Row
from app.common.json import Json
from app.published.computation import computed_table
from app.published.reference import open_reference
from core.published.tables import published_table, published_tables


def bench_published(reference: Path | None = None, tables: Sequence[str] = ()) -> list[Row]:
    """Computes published tables.

    Args:
        reference: folder with the published data; without it only the printed figures stand beside ours.
        tables: ids of those that are wanted; none for all.

    Raises:
        InputError: the data is not in the folder.
        NotFoundError: there is no such table.
    """
    data = None if reference is None else open_reference(reference)
    kept: dict[str, Json] = {}
    wanted = [published_table(table) for table in tables or published_tables()]
    return [row for table in wanted for row in _rows(computed_table(table, data, kept))]


def _rows(table: Json) -> list[Row]:
    """Rows with the cells by key; the remark on a row stands last."""
    heads = {"table": table["id"]}
    return [{**heads, "row": row["id"], **row["cells"], "remark": row["sentence"]} for row in table["rows"]]
