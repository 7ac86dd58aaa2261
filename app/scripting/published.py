"""The published tables beside our figures, for scripts."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from app.common.json import Json
from app.published.computation import computed_table
from app.published.reference import open_reference
from app.published.reference_folder import PublishedFolder
from app.published.rows import table_entries, table_view
from app.scripting.html import table as html_table
from app.scripting.progress import progress_bar
from core.arrays import Floats
from core.errors import InputError
from core.published.tables import published_table
from core.text.numbers import shortened


@dataclass(frozen=True, eq=False)
class Published:
    """A published table.

    Args:
        content: as `GET /api/published/{table}` answers.
    """

    content: Json

    @property
    def name(self) -> str:
        """The table as the sources call it, such as `T 4.2`."""
        return str(self.content["name"])

    @property
    def about(self) -> tuple[str, ...]:
        """Sentences on its figures: whose physics, and which definition."""
        return tuple(self.content["about"])

    @property
    def columns(self) -> tuple[dict[str, str], ...]:
        """Each column's key, label, unit and origin (`who`)."""
        return tuple(self.content["columns"])

    @property
    def rows(self) -> tuple[dict[str, Any], ...]:
        """Each row's cells by the column's key."""
        return tuple(row["cells"] for row in self.content["rows"])

    @property
    def remarks(self) -> tuple[str, ...]:
        """A sentence a row, empty where there is none."""
        return tuple(row["sentence"] for row in self.content["rows"])

    def __getitem__(self, key: str) -> Floats:
        """(rows,) numbers of a column, in its unit; nan where there is none.

        Raises:
            InputError: there is no such column, or it holds texts.
        """
        known = [column["key"] for column in self.columns]
        if key not in known:
            raise InputError(f"{self.name} has no column “{shortened(key)}”; it has {', '.join(known)}.", key)
        values = [row[key] for row in self.rows]
        if any(isinstance(value, str) for value in values):
            raise InputError(f"The column {key} of {self.name} holds texts; take them from rows.", key)
        return np.array([np.nan if value is None else value for value in values], dtype=np.float64)

    def __repr__(self) -> str:
        return f"Published table {self.name}: {len(self.rows)} rows, {len(self.columns)} columns"

    def _repr_html_(self) -> str:
        heads = [" ".join(filter(None, (column["label"], column["unit"]))) for column in self.columns]
        return html_table(heads, [[_cell(value) for value in row.values()] for row in self.rows])


def _cell(value: Any) -> str:
    return "–" if value is None else f"{value:g}" if isinstance(value, float) else str(value)


def published(table: str, *, reference: str | Path | None = None, compute: bool = True) -> Published:
    """A table of the thesis or the paper, its printed figures beside ours.

    Our gaits are solved and simulated in this process, about two seconds a row.

    Args:
        table: `t4-1`, `t4-2`, `t5-2` to `t5-8`, `t6-1`, `ta-1` to `ta-4`, or `p-1`.
        reference: folder with the published data; None for printed figures and ours alone.
        compute: false for what is printed alone.

    Returns:
        The table; `table["ours.feet_mm"]` is a column as an array, in the unit of its name (mm, cm, °, s).

    Raises:
        NotFoundError: there is no such table.
        InputError: the data is not in the folder.

    Example:
        >>> import footfall as ff
        >>> table = ff.published("t4-2", compute=False)
        >>> table["published.feet_mm"][:3]
        array([1.7, 1.6, 2. ])
    """
    found = published_table(table)
    data = None if reference is None else open_reference(reference)
    if not compute:
        entries = table_entries(found, data)
        view = table_view(found, PublishedFolder(reference=data), entries, {})
        return Published({"name": found.name, **view})
    with progress_bar(found.name) as tell:
        return Published(computed_table(found, data, {}, tell))
