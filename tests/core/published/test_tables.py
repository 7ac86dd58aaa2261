"""The printed figures of the published tables agree with each other, but for the misprint that has a note."""

from __future__ import annotations

import pytest

from core.errors import NotFoundError
from core.library.library import appendix_orders, library
from core.published.gaits import published_gait, row_title
from core.published.tables import (
    Kind,
    Movement,
    PublishedRow,
    PublishedTable,
    published_table,
    published_tables,
)

ALL = [(table, row) for table in published_tables().values() for row in table.rows]
REAL_TABLES = {"walk": "t5-5", "amble": "t5-6", "s-gait": "t5-7", "c-gait": "t5-8"}


def printed(row: PublishedRow, name: str) -> float:
    value = row.printed[name]
    assert value is not None
    return value


def disagreement(row: PublishedRow) -> bool:
    """Whether distance and error, each rounded to a decimal, cannot be of one measurement."""
    wanted, distance = printed(row, "desired_cm"), printed(row, "distance_cm")
    error = printed(row, "error_percent")
    low, high = ((distance + half) / wanted * 100 - 100 for half in (-0.05, 0.05))
    return not low - 0.05 <= error <= high + 0.05


def test_every_table_that_is_named_is_there_in_the_order_of_the_sources() -> None:
    names = [table.name for table in published_tables().values()]
    assert names == [
        *("T 4.1", "T 4.2"),
        *(f"T 5.{number}" for number in range(2, 9)),
        "T 6.1",
        *(f"T A.{number}" for number in range(1, 5)),
        "P I",
    ]
    assert [len(table.rows) for table in published_tables().values()] == [
        9,
        16,
        9,
        9,
        16,
        *[8] * 4,
        2,
        *[4] * 4,
        3,
    ]


def test_distance_and_error_agree_but_for_the_misprints_that_have_a_note() -> None:
    walked = [(table, row) for table, row in ALL if table.kind in (Kind.WALKED, Kind.EXTENTS)]
    misprints = {(table.id, row.id) for table, row in walked if disagreement(row)}
    assert misprints == {("t5-8", "c-gait-20-step")}
    assert {(table.id, row.id) for table, row in walked if row.note} == misprints


def test_the_speed_is_the_measured_step_in_the_time_of_a_step() -> None:
    for row in published_table("t5-4").rows:
        step = published_table(REAL_TABLES[row.gait.family]).row(f"{row.id}-step")
        distance_mm = printed(step, "desired_cm") * (10 + printed(step, "error_percent") / 10)
        assert distance_mm / printed(row, "seconds") == pytest.approx(printed(row, "speed_mm_s"), abs=0.0505)


def test_the_speed_of_a_gait_is_the_mean_of_its_steps() -> None:
    rows = published_table("t5-4").rows
    for row in rows:
        speeds = [printed(one, "speed_mm_s") for one in rows if one.gait.family == row.gait.family]
        assert sum(speeds) / 4 == pytest.approx(printed(row, "gait_speed_mm_s"))


def test_roles_of_appendix_a_are_the_librarys_foot_orders() -> None:
    tables = {f"ta-{number}": family for number, family in enumerate(REAL_TABLES, 1)}
    orders = {
        family: tuple(
            published_gait(published_table(table), row).order for row in published_table(table).rows
        )
        for table, family in tables.items()
    }
    assert orders == appendix_orders()


def test_every_row_is_a_gait_that_goes_as_far_as_is_printed() -> None:
    for table, row in ALL:
        require_gait(table, row)


def require_gait(table: PublishedTable, row: PublishedRow) -> None:
    gait = published_gait(table, row)
    assert gait.name == f"{row_title(row)} ({table.name})"
    assert (gait.iterations, gait.direction) == (row.gait.iterations, row.gait.direction)
    assert (gait.segment_table is None) == (row.gait.version is None)
    way_cm = float((gait.step[0] ** 2 + gait.step[1] ** 2) ** 0.5) * 100
    share = 1 if row.movement is Movement.STEP else row.gait.iterations
    assert way_cm * share == pytest.approx(row.printed.get("desired_cm", way_cm * share))


def test_the_papers_goals_are_along_x_and_y() -> None:
    gaits = {row.id: published_gait(published_table("p-1"), row) for row in published_table("p-1").rows}
    ways = {name: gait.iterations * gait.step[0] for name, gait in gaits.items()}
    assert ways == pytest.approx({"A": 0.020, "B": 0.010, "C": 0.020})
    assert published_table("p-1").row("B").printed["foot3_mm"] is None


def test_the_step_of_the_library_is_a_rows_where_it_names_none() -> None:
    row = published_table("ta-1").rows[0]
    assert published_gait(published_table("ta-1"), row).step == pytest.approx(library()["walk"].gait.step)


def test_what_there_is_not_is_refused_with_what_there_is() -> None:
    with pytest.raises(NotFoundError, match="no published table “t9”; there are t4-1, t4-2"):
        published_table("t9")
    with pytest.raises(NotFoundError, match=r"T 6\.1 has no row “walk-10”; it has walk-20, s-gait-20"):
        published_table("t6-1").row("walk-10")
