"""Published tables for commands and scripts: rows, arrays, and refusals."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import footfall as ff
from app.bench.physics.published import bench_published
from app.cli import bench_options
from app.cli.parser import make_parser
from app.common.json import Json
from app.published.computation import computed_table
from app.published.figures import Tools
from core.errors import CheckError, InputError, NotFoundError
from core.physics.motion import SimulatedMotion
from core.physics.problem import SimulationProblem
from core.published.tables import published_table
from tests.support.simulated_walk import BEHIND, followed, no_solver


def test_a_table_is_computed_in_this_process_and_shares_what_is_known() -> None:
    whole = published_table("t4-1")
    short, kept = replace(whole, rows=whole.rows[:1]), dict[str, Json]()
    shares: list[float] = []
    view = computed_table(short, None, kept, shares.append, Tools(no_solver, followed))
    assert view["rows"][0]["cells"]["ours.way_mm"] == BEHIND * 1000
    assert (len(kept), shares, view["name"]) == (1, [0.0], "T 4.1")

    def never(problem: SimulationProblem) -> SimulatedMotion:
        raise AssertionError("It is known already.")

    assert computed_table(short, None, kept, tools=Tools(no_solver, never)) == view


def test_a_row_that_cannot_be_simulated_says_why() -> None:
    whole = published_table("t4-1")

    def refuses(problem: SimulationProblem) -> SimulatedMotion:
        raise CheckError("The chains open.", "physics")

    view = computed_table(replace(whole, rows=whole.rows[:1]), None, {}, tools=Tools(no_solver, refuses))
    assert (view["rows"][0]["state"], view["rows"][0]["sentence"]) == ("failed", "The chains open.")


def test_scripts_get_columns_as_arrays() -> None:
    table = ff.published("p-1", compute=False)
    assert table.name == "P I"
    np.testing.assert_array_equal(table["published.foot3_mm"], [7.0, np.nan, 3.0])
    assert np.isnan(table["ours.body_mm"]).all()
    assert table.rows[1]["label"] == "B"
    assert "cannot be read" in table.remarks[1]
    with pytest.raises(ff.InputError, match="has no column “feet”; it has label"):
        table["feet"]
    with pytest.raises(ff.InputError, match="holds texts"):
        table["gait"]
    with pytest.raises(ff.InputError, match="no published table “t9”"):
        ff.published("t9")


def test_the_benchmark_refuses_before_anything_is_computed(tmp_path: Path) -> None:
    with pytest.raises(NotFoundError, match="no published table “t9”"):
        bench_published(tables=("t4-1", "t9"))
    with pytest.raises(InputError, match="holds no simulation_manual"):
        bench_published(reference=tmp_path)
    with pytest.raises(InputError, match="belongs to the benchmark published"):
        bench_options.tables_of(make_parser().parse_args(["bench", "physics", "--table", "t4-1"]))
