"""The definition behind the thesis's tables: from the published positions come the published errors."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from app.published.reference import MANUAL_FEET, PublishedRun, Reference
from core.errors import InputError
from core.published.tables import published_table
from core.robot.model import load_robot
from tests.support.reference import reference_path

MODEL = load_robot("deltawalker")
HALF_A_DIGIT_MM, HALF_A_DIGIT_CM = 0.0051e-3, 0.0051e-2
"""Half of the last digit printed: manual errors are in mm, optimised ones in cm, both with two decimals."""
TABLE_4_1 = {
    (row.gait.family, row.gait.version or 0): (row.printed["feet_mm"] or math.nan) / 1000
    for row in published_table("t4-1").rows
}
TABLE_4_2 = {
    (row.gait.family, row.gait.step): (row.printed["feet_mm"] or math.nan) / 1000
    for row in published_table("t4-2").rows
}
UNPUBLISHED = {("walk", 2), ("amble", 1), ("amble", 2), ("s-gait", 2)}


def reference() -> Reference:
    return Reference(reference_path("simulation_optimised").parent)


@pytest.mark.parametrize(("gait", "step"), TABLE_4_2)
def test_table_4_2_is_the_mean_distance_over_waypoints_and_four_feet(gait: str, step: float) -> None:
    run = reference().optimised_run(gait, step, MODEL)
    assert run.printed[:4] == pytest.approx(run.feet_error, abs=HALF_A_DIGIT_CM)
    assert run.printed[4] == pytest.approx(run.body_error, abs=HALF_A_DIGIT_CM)
    assert run.feet_error.mean() == pytest.approx(TABLE_4_2[gait, step], abs=HALF_A_DIGIT_CM)


@pytest.mark.parametrize(("family", "version"), sorted(set(TABLE_4_1) - UNPUBLISHED))
def test_table_4_1_wants_feet_of_a_robot_that_stands_still(family: str, version: int) -> None:
    run = reference().manual_run(family, version, MODEL)
    assert run is not None
    assert run.printed[:4] == pytest.approx(run.feet_error, abs=HALF_A_DIGIT_MM)
    first = run.feet_error[:MANUAL_FEET].mean()
    assert first == pytest.approx(run.printed[4], abs=HALF_A_DIGIT_MM)
    assert first == pytest.approx(TABLE_4_1[family, version], abs=HALF_A_DIGIT_CM)


def test_every_published_run_of_an_optimised_gait_leans_by_degrees() -> None:
    leans = {
        case: float(np.degrees(reference().optimised_run(*case, MODEL).tilts.max())) for case in TABLE_4_2
    }
    assert min(leans.values()) == leans["walk", 0.020] == pytest.approx(2.87, abs=0.01)
    assert max(leans.values()) == leans["c-gait", 0.025] == pytest.approx(8.46, abs=0.01)


def test_the_lean_is_that_of_the_feet() -> None:
    feet = np.tile(MODEL.module_centres_robot, (3, 1, 1))
    angle = np.radians(5.0)
    lean = np.array([[1, 0, 0], [0, np.cos(angle), -np.sin(angle)], [0, np.sin(angle), np.cos(angle)]])
    body = np.zeros((3, 3))
    run = PublishedRun(body, feet @ lean.T + [0.01, 0.0, 0.02], body, feet, ())
    assert run.tilts == pytest.approx(np.full(3, angle))


def test_four_cells_of_table_4_1_have_no_published_run() -> None:
    runs = {case: reference().manual_run(*case, MODEL) for case in TABLE_4_1}
    assert {case for case, run in runs.items() if run is None} == UNPUBLISHED


def test_no_table_is_a_mean_of_squares() -> None:
    run = reference().optimised_run("walk", 0.010, MODEL)
    squares = ((run.feet - run.wanted_feet) ** 2).sum(axis=-1).mean(axis=0)
    assert np.sqrt(squares) != pytest.approx(run.feet_error, abs=HALF_A_DIGIT_CM)


def test_a_folder_without_the_data_is_refused_by_name(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="holds no simulation_manual"):
        Reference(tmp_path)


def test_a_damaged_table_is_refused_by_line_and_column(tmp_path: Path) -> None:
    for name in ("simulation_manual", "simulation_optimised/simulated", "trajectories"):
        (tmp_path / name).mkdir(parents=True)
    (tmp_path / "simulation_optimised/simulated/trajAa_o1.csv").write_text("1,2\n3,x\n")
    with pytest.raises(InputError, match=r"trajAa_o1\.csv:2, column 2: “x” is not a number"):
        Reference(tmp_path).optimised_run("walk", 0.010, MODEL)
