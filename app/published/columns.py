"""The columns of a published table: the row's gait, the printed figures, and ours beside them."""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum

from app.common.json import Json
from core.library.library import library
from core.published.gaits import family_title, feet_of_roles
from core.published.tables import Kind, PublishedRow, PublishedTable


class Who(StrEnum):
    """The origin of a column's figures."""

    PUBLISHED = "published"
    """Printed in the source."""
    OURS = "ours"
    """Our gait, in our physics."""
    RECORDED = "recorded"
    """The published motion, in our physics."""
    RUN = "run"
    """The published simulation (PyBullet), read from its positions by our definitions."""
    TRACK = "track"
    """The published foot tracks of the real robot, read by our definitions."""


WITH_REFERENCE = (Who.RECORDED, Who.RUN, Who.TRACK)
"""Columns that need the published data."""

TITLES = {
    Who.OURS: "ours",
    Who.RECORDED: "published motion, our physics",
    Who.RUN: "published run, PyBullet",
    Who.TRACK: "published tracks, our reading",
}
"""Origins of figures for a person; a printed figure's is the thesis or the paper."""


@dataclass(frozen=True)
class Column:
    """A column as pages and scripts get it.

    Args:
        key: of the cells; before the dot is `who`, behind it the figure.
        label: the figure and its origin, for a person.
        unit: of the numbers; empty for texts.
        who: the figure's origin; empty for what describes the row.
        quantity: the figure alone, for a person; empty for what describes the row.
        origin: the origin alone, for a person; empty for what describes the row.
        decimals: of a number, for a person.
        better: `less` where a figure nearer to zero is better, `more` where a larger one is; else empty.
    """

    key: str
    label: str
    unit: str = ""
    who: str = ""
    quantity: str = ""
    origin: str = ""
    decimals: int = 1
    better: str = ""


@dataclass(frozen=True)
class Figure:
    """A figure of a kind of table, and the origins that have it.

    Args:
        name: in the keys of columns.
        label: for a person.
        unit: of the numbers.
        who: the origins that have it.
        decimals: of computed numbers, for a person.
        printed: decimals of the printed numbers.
        better: as in `Column`; empty too where a computed figure stands beside a measured one.
    """

    name: str
    label: str
    unit: str
    who: tuple[Who, ...]
    decimals: int = 1
    printed: int = 1
    better: str = ""


_ALL = (Who.PUBLISHED, Who.OURS, Who.RUN, Who.RECORDED)
_OWN = (Who.OURS, Who.RUN, Who.RECORDED)
_WALKED = (Who.PUBLISHED, Who.OURS, Who.TRACK, Who.RECORDED)
_MARGIN = Figure("margin_mm", "margin asked", "mm", (Who.OURS,))
_MOVED = (
    Figure("desired_cm", "wanted distance", "cm", (Who.PUBLISHED,)),
    Figure("distance_cm", "distance", "cm", _WALKED, decimals=2),
    Figure("angle_deg", "angle", "°", _WALKED),
    Figure("error_percent", "error", "%", _WALKED),
)
FIGURES: dict[Kind, tuple[Figure, ...]] = {
    Kind.STANDING: (
        Figure("feet_mm", "error by the table", "mm", (Who.PUBLISHED, Who.OURS, Who.RUN), 2, better="less"),
        Figure("way_mm", "feet from the plan", "mm", (Who.OURS,), 2),
        Figure("goes_mm", "goes", "mm", (Who.OURS, Who.RUN)),
        Figure("planned_mm", "is planned to go", "mm", (Who.OURS,)),
        Figure("lean_deg", "largest lean", "°", (Who.OURS, Who.RUN)),
    ),
    Kind.TRACKING: (
        Figure("feet_mm", "feet", "mm", _ALL, 2, better="less"),
        Figure("body_mm", "body", "mm", _OWN, 2),
        Figure("lean_deg", "largest lean", "°", _OWN),
        Figure("goes_mm", "goes", "mm", _OWN),
        _MARGIN,
    ),
    Kind.PAPER: (
        *(
            Figure(name, label, "mm", (Who.PUBLISHED, Who.OURS), 2, better="less")
            for name, label in (("body_mm", "body"), *((f"foot{n}_mm", f"foot {n}") for n in range(1, 5)))
        ),
        Figure("lean_deg", "largest lean", "°", (Who.OURS,)),
        _MARGIN,
    ),
    Kind.WALKED: (*_MOVED, _MARGIN),
    Kind.EXTENTS: (*_MOVED, _MARGIN),
    Kind.PACE: (
        Figure("seconds", "time of a step", "s", (Who.PUBLISHED, Who.OURS, Who.RECORDED)),
        Figure("speed_mm_s", "speed", "mm/s", (Who.PUBLISHED, Who.OURS, Who.RECORDED), 2),
        Figure("gait_speed_mm_s", "mean speed of the gait", "mm/s", (Who.PUBLISHED,), printed=3),
        _MARGIN,
    ),
}
"""The figures of each kind of table."""


def columns_of(table: PublishedTable, *, has_reference: bool) -> tuple[Column, ...]:
    """The columns of a table.

    Args:
        table: as it is printed.
        has_reference: whether the published data is at hand.
    """
    return (*_row_columns(table), *_figure_columns(table, has_reference))


def _figure_columns(table: PublishedTable, has_reference: bool) -> Iterator[Column]:
    printed = {name for row in table.rows for name in row.printed}
    manual = all(row.gait.version is not None for row in table.rows)
    for figure in FIGURES[table.kind]:
        for who in figure.who:
            if who is Who.PUBLISHED and figure.name not in printed:
                continue
            if who in WITH_REFERENCE and not (has_reference and has_data(table, who)):
                continue
            if figure is _MARGIN and manual:
                continue
            yield _figure_column(figure, who, _title(table, who))


def _figure_column(figure: Figure, who: Who, origin: str) -> Column:
    return Column(
        key=f"{who}.{figure.name}",
        label=f"{figure.label}, {origin}",
        unit=figure.unit,
        who=who.value,
        quantity=figure.label,
        origin=origin,
        decimals=figure.printed if who is Who.PUBLISHED else figure.decimals,
        better=figure.better,
    )


def has_data(table: PublishedTable, who: Who) -> bool:
    """True if the published data may hold what a column of a table is made of."""
    if table.kind is Kind.EXTENTS or not any(who in figure.who for figure in FIGURES[table.kind]):
        return False
    manual = any(row.gait.version is not None for row in table.rows)
    if who is Who.TRACK:
        return not (manual or table.rows[0].gait.is_one_motion)
    return who is Who.RUN or not manual


def _title(table: PublishedTable, who: Who) -> str:
    if who is Who.PUBLISHED:
        return "paper" if table.kind is Kind.PAPER else "thesis"
    return TITLES[who]


def _row_columns(table: PublishedTable) -> Iterator[Column]:
    """Columns that tell the rows apart."""
    rows = table.rows
    if rows[0].label:
        yield Column("label", "Trajectory")
    yield Column("gait", "Gait")
    if rows[0].gait.version is not None:
        yield Column("version", "Version")
    elif rows[0].gait.order is not None:
        yield Column("order", "Foot order")
    else:
        yield Column("step_mm", "Step", "mm")
    if any(row.gait.iterations > 1 for row in rows):
        yield Column("iterations", "Iterations")
    if len({row.movement for row in rows}) > 1:
        yield Column("movement", "Movement")


def row_cells(row: PublishedRow) -> Json:
    """Cells of a row that need no computation: its gait, and the printed figures."""
    gait = row.gait
    order = None if gait.order is None else feet_of_roles(library()[gait.family].gait, gait.order)
    cells: Json = {
        "label": row.label,
        "gait": family_title(gait),
        "version": gait.version,
        "order": None if order is None else "-".join(map(str, order)),
        "step_mm": round(gait.step * 1000, 1),
        "iterations": gait.iterations,
        "movement": row.movement.value,
    }
    return cells | {f"{Who.PUBLISHED}.{name}": value for name, value in row.printed.items()}
