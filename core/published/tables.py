"""Printed figures of the published tables, row by row, with the gait that each row is of."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from functools import cache
from types import MappingProxyType
from typing import Any

from core.data.tables import data_table
from core.errors import NotFoundError


class Kind(StrEnum):
    """The definition of a table's figures."""

    STANDING = "standing"
    """Mean distance of the first three feet from those of a robot that stands still (T Table 4.1)."""
    TRACKING = "tracking"
    """Mean distance of the feet from the plan."""
    PAPER = "paper"
    """Mean distance of the body and of each foot from the plan."""
    WALKED = "walked"
    """Largest excursions of the real robot's feet from the first frame."""
    EXTENTS = "extents"
    """Differences of the extremes of the real robot's feet."""
    PACE = "pace"
    """Time and speed of the real robot."""


class Movement(StrEnum):
    """The part of a walk that a row counts."""

    STEP = "individual step"
    """The mean of its iterations."""
    TOTAL = "total movement"
    """All iterations together."""


@dataclass(frozen=True)
class RowGait:
    """The gait of a row, in the words of the library.

    Args:
        family: `walk`, `amble`, `s-gait` or `c-gait`.
        version: of a gait made by hand; None for an optimised one.
        step: the body's travel an iteration along the gait's heading, m.
        order: roles of the feet in the order of their steps; None for the gait's own order.
        direction: 1 to 4 (T Table 3.1).
        iterations: how often every foot steps.
        is_one_motion: whether the published trajectory holds all iterations; else it holds one, and was run
            as often.
    """

    family: str
    version: int | None = None
    step: float = 0.010
    order: tuple[str, ...] | None = None
    direction: int = 1
    iterations: int = 1
    is_one_motion: bool = False

    @property
    def motion_iterations(self) -> int:
        """Iterations that the published trajectory holds."""
        return self.iterations if self.is_one_motion else 1


@dataclass(frozen=True)
class PublishedRow:
    """A row as it is printed.

    Args:
        id: of the row within its table.
        gait: what walked.
        movement: the part that counts.
        printed: figures by name, in the unit that the name ends with; None where one cannot be read.
        label: how the source calls the row; empty where it does not.
        note: on what cannot be read, or does not agree.
    """

    id: str
    gait: RowGait
    movement: Movement
    printed: Mapping[str, float | None]
    label: str = ""
    note: str = ""


@dataclass(frozen=True)
class PublishedTable:
    """A table as it is printed.

    Args:
        id: such as `t4-2`.
        name: such as `T 4.2`.
        title: what it is of.
        source: where it stands.
        kind: the definition of its figures.
        rows: in the order of the source.
    """

    id: str
    name: str
    title: str
    source: str
    kind: Kind
    rows: tuple[PublishedRow, ...]

    def row(self, row: str) -> PublishedRow:
        """The row of an id.

        Raises:
            NotFoundError: there is none.
        """
        found = next((one for one in self.rows if one.id == row), None)
        if found is None:
            known = ", ".join(one.id for one in self.rows)
            raise NotFoundError(f"{self.name} has no row “{row}”; it has {known}.", "row")
        return found


@cache
def published_tables() -> Mapping[str, PublishedTable]:
    """Every published table by its id, in the order of the sources."""
    tables = (_table(content) for content in data_table("published.toml")["table"])
    return MappingProxyType({table.id: table for table in tables})


def published_table(table: str) -> PublishedTable:
    """The table of an id.

    Raises:
        NotFoundError: there is none.
    """
    found = published_tables().get(table)
    if found is None:
        known = ", ".join(published_tables())
        raise NotFoundError(f"There is no published table “{table}”; there are {known}.", "table")
    return found


def _table(content: dict[str, Any]) -> PublishedTable:
    notes = content.get("notes", {})
    names = [*content["columns"], *content["figures"]]
    rows = [content.get("gait", {}) | dict(zip(names, row, strict=True)) for row in content["rows"]]
    made = tuple(_row(row, content["figures"], notes) for row in rows)
    heads = {name: content[name] for name in ("id", "name", "title", "source")}
    return PublishedTable(**heads, kind=Kind(content["kind"]), rows=made)


def _row(values: dict[str, Any], figures: list[str], notes: dict[str, str]) -> PublishedRow:
    printed = {name: None if math.isnan(values[name]) else float(values[name]) for name in figures}
    label, movement = values.get("label", ""), Movement(values.get("movement", Movement.TOTAL))
    gait = RowGait(
        family=values["family"],
        version=values.get("version"),
        step=_step(values),
        order=tuple(values["order"]) if "order" in values else None,
        direction=values.get("direction", 1),
        iterations=values.get("iterations", 1),
        is_one_motion=values.get("is_one_motion", False),
    )
    row = _row_id(values, gait)
    return PublishedRow(row, gait, movement, MappingProxyType(printed), label, notes.get(row, ""))


def _step(values: dict[str, Any]) -> float:
    """Step of an iteration, m; a goal is the travel of all of them."""
    if "goal" in values:
        return float(math.hypot(*values["goal"])) / 1000.0 / int(values["iterations"])
    return float(values.get("step", 10)) / 1000.0


def _row_id(values: dict[str, Any], gait: RowGait) -> str:
    """An id within the table, of what tells its rows apart."""
    if "label" in values:
        return str(values["label"])
    if gait.order is not None:
        return "-".join("".join(word[0] for word in role.split()) for role in gait.order).lower()
    if gait.version is not None:
        return f"{gait.family}-{gait.version}"
    size = f"{gait.family}-{gait.step * 1000:.0f}"
    return size if "movement" not in values else f"{size}-{Movement(values['movement']).name.lower()}"
