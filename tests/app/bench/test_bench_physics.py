"""The physics benchmark's tables and its page: what is printed is what was simulated."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from app.bench.physics import runs as physics_runs
from app.bench.physics.cases import manual_problem
from app.bench.physics.page import physics_page
from app.bench.physics.runs import ManualCase, OptimisedCase, walked
from app.bench.physics.tables import bench_physics, manual_row, own_row, paper_rows, published_rows
from app.published.reference import PublishedRun
from core.errors import InputError
from core.physics.parameters import physics_set
from core.physics.problem import SimulationProblem
from tests.support.simulated_walk import BEHIND, followed

pytestmark = pytest.mark.heavy


@pytest.fixture(autouse=True)
def _robot_beside_its_plan(monkeypatch: pytest.MonkeyPatch) -> None:
    """In place of the physics a robot that goes the plan's way beside it, so that every figure is known."""
    monkeypatch.setattr(physics_runs, "simulate", followed)


@cache
def problem() -> SimulationProblem:
    return manual_problem("walk", 0, physics_set("published"))


def manual_case() -> ManualCase:
    return ManualCase("walk", 0, 0.0028, None, walked(problem()))


def optimised_case(thesis: float) -> OptimisedCase:
    run, plan = walked(problem()), problem().plan
    wanted = plan.body_world, plan.feet_world
    theirs = PublishedRun(plan.body_world + [0.0, 0.0, 0.004], plan.feet_world, *wanted)
    return OptimisedCase("walk", 0.010, thesis, theirs, run, 0.003, 0.003, plan, run, run)


def test_a_walk_keeps_what_tables_and_plots_need() -> None:
    run = walked(problem())
    body, feet = run.planned
    assert np.linalg.norm(run.body - body, axis=-1) == pytest.approx(np.full(55, BEHIND))
    assert np.linalg.norm(run.feet - feet, axis=-1) == pytest.approx(np.full((55, 4), BEHIND))
    assert run.report.feet_mean_error == pytest.approx(BEHIND)


def test_table_4_1_counts_the_way_that_the_robot_goes_as_error() -> None:
    row = manual_row(manual_case())
    assert row["feet_mm"] == 2.0
    assert row["goes_mm"] == row["planned_mm"] == 10.0
    assert row["ours_their_way_mm"] > 4.0
    assert row["their_lean_deg"] is None


def test_an_own_gait_is_held_to_the_thesis() -> None:
    assert own_row(optimised_case(thesis=0.0021))["is_at_most_thesis"] == "yes"
    assert own_row(optimised_case(thesis=0.0019))["is_at_most_thesis"] == "no"


def test_a_published_run_stands_beside_the_same_trajectory_in_our_physics() -> None:
    (row,) = published_rows([optimised_case(0.002)])
    assert (row["their_body_mm"], row["their_lean_deg"], row["cut_mm"], row["feet_mm"]) == (
        4.0,
        0.0,
        3.0,
        2.0,
    )
    assert published_rows([replace(optimised_case(0.002), theirs=None, again=None)]) == []


def test_the_papers_table_has_a_row_of_theirs_and_one_of_ours() -> None:
    theirs, ours = paper_rows("B", walked(problem()))
    assert (theirs["who"], theirs["body"], theirs["3"]) == ("paper", 1.8, None)
    assert (ours["who"], ours["body"], ours["3"], ours["falls"]) == ("ours", 2.0, 2.0, "no")


def test_the_page_draws_every_case_and_says_what_is_not_at_hand() -> None:
    page = physics_page([optimised_case(0.002)], [manual_case()])
    assert re.findall(r"<h2>(Figure 4\.\d: [\w, ]+)", page) == [
        "Figure 4.2: walk, made by hand",
        "Figure 4.5: walk, optimised",
    ]
    assert page.count("<svg") == 1 + 3
    assert "Version 0: no published run is at hand." in page
    assert "feet 2.00 mm, body 2.00 mm from the plan; leans 0.0° at most" in page
    ids = re.findall(r'id="([^"]+)"', page)
    assert len(ids) == len(set(ids))
    for drawing in re.findall(r"<svg.*?</svg>", page, re.DOTALL):
        ElementTree.fromstring(drawing)


def test_a_page_with_nowhere_to_go_is_refused_before_anything_is_simulated(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="is no folder"):
        bench_physics(page=tmp_path / "absent" / "page.html")


def test_a_folder_without_data_is_refused_before_anything_is_simulated(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="holds no simulation_manual"):
        bench_physics(reference=tmp_path)
