"""The definition behind the thesis's tables: from the published positions come the published errors."""

from __future__ import annotations

import math
import os
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from app.published.entries import entries_of
from app.published.reference import MANUAL_FEET, PublishedRun, Reference, is_missing, open_reference
from core.arrays import Floats
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
ABSENT = {("walk", 2), ("amble", 1), ("amble", 2), ("s-gait", 2)}


def errors_beside(simulated: Path) -> Floats:
    """The published errors of a run: of the four feet, and of the body or the first three feet."""
    errors = simulated.parents[1] / "errors" / f"{simulated.stem}_mse.csv"
    return np.asarray(np.loadtxt(errors, delimiter=",", ndmin=2)[0])


def reference() -> Reference:
    return Reference(reference_path("simulation_optimised").parent)


@pytest.mark.parametrize(("gait", "step"), TABLE_4_2)
def test_table_4_2_is_the_mean_distance_over_waypoints_and_four_feet(gait: str, step: float) -> None:
    run = reference().run(gait, step, None, MODEL)
    simulated, _ = reference().run_paths(gait, step, None)
    errors = errors_beside(simulated) / 100
    assert errors[:4] == pytest.approx(run.feet_error, abs=HALF_A_DIGIT_CM)
    assert errors[4] == pytest.approx(run.body_error, abs=HALF_A_DIGIT_CM)
    assert run.feet_error.mean() == pytest.approx(TABLE_4_2[gait, step], abs=HALF_A_DIGIT_CM)


@pytest.mark.parametrize(("family", "version"), sorted(set(TABLE_4_1) - ABSENT))
def test_table_4_1_wants_feet_of_a_robot_that_stands_still(family: str, version: int) -> None:
    run = reference().run(family, 0.010, version, MODEL)
    simulated, _ = reference().run_paths(family, 0.010, version)
    errors = errors_beside(simulated) / 1000
    assert errors[:4] == pytest.approx(run.feet_error, abs=HALF_A_DIGIT_MM)
    first = run.feet_error[:MANUAL_FEET].mean()
    assert first == pytest.approx(errors[4], abs=HALF_A_DIGIT_MM)
    assert first == pytest.approx(TABLE_4_1[family, version], abs=HALF_A_DIGIT_CM)


def test_every_published_run_of_an_optimised_gait_leans_by_degrees() -> None:
    leans = {case: float(np.degrees(reference().run(*case, None, MODEL).tilts.max())) for case in TABLE_4_2}
    assert min(leans.values()) == leans["walk", 0.020] == pytest.approx(2.87, abs=0.01)
    assert max(leans.values()) == leans["c-gait", 0.025] == pytest.approx(8.46, abs=0.01)


def test_the_lean_is_that_of_the_feet() -> None:
    feet = np.tile(MODEL.module_centres_robot, (3, 1, 1))
    angle = np.radians(5.0)
    lean = np.array([[1, 0, 0], [0, np.cos(angle), -np.sin(angle)], [0, np.sin(angle), np.cos(angle)]])
    body = np.zeros((3, 3))
    run = PublishedRun(body, feet @ lean.T + [0.01, 0.0, 0.02], body, feet)
    assert run.tilts == pytest.approx(np.full(3, angle))


def test_the_folder_lacks_the_runs_of_four_cells_of_table_4_1() -> None:
    paths = {
        (family, version): reference().run_paths(family, 0.010, version) for family, version in TABLE_4_1
    }
    assert {case for case, files in paths.items() if any(map(is_missing, files))} == ABSENT


def test_no_table_is_a_mean_of_squares() -> None:
    run = reference().run("walk", 0.010, None, MODEL)
    squares = ((run.feet - run.wanted_feet) ** 2).sum(axis=-1).mean(axis=0)
    assert np.sqrt(squares) != pytest.approx(run.feet_error, abs=HALF_A_DIGIT_CM)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("/" + "a" * 300, "cannot be read: File name too long"),
        ("~nosuchuser/x", "cannot be read: Could not determine home"),
        ("/\udcff", "is no text in UTF-8"),
        ("/nowhere/at\0all", "There is no folder"),
    ],
)
def test_a_folder_whose_name_cannot_be_is_refused(name: str, words: str) -> None:
    with pytest.raises(InputError, match=words):
        open_reference(name)


@pytest.mark.parametrize(
    ("damage", "words"),
    [
        (lambda path: path.write_text("1,2\n" * 10), "has 10 rows and 2 columns"),
        (lambda path: path.write_text("1\n" * 16), "has 16 rows and 1 columns"),
        (lambda path: path.write_text(""), "has 0 rows"),
        (lambda path: path.write_text("1,2,3\n" * 16), "has 3 columns, and its plan walk_a.csv has 2"),
        (lambda path: path.write_text("1,1e300\n" * 16), "beyond 10000"),
        (lambda path: path.write_text("1,nan\n" * 16), "not a finite number"),
        (lambda path: path.write_bytes(b"1,2\n\x80"), "not text in UTF-8"),
        (os.mkfifo, "is no plain file"),
        (Path.mkdir, "Is a directory"),
        (lambda path: path.symlink_to(path), "symbolic links"),
        (lambda path: os.truncate(os.open(path, os.O_CREAT | os.O_WRONLY), 10**9), "has 1000.0 MB"),
        (lambda path: None, "No such file"),
    ],
)
def test_a_damaged_run_is_refused_by_the_files_name(
    tmp_path: Path, damage: Callable[[Path], object], words: str
) -> None:
    for name in ("simulation_manual", "simulation_optimised/simulated", "trajectories/direction1"):
        (tmp_path / name).mkdir(parents=True)
    (tmp_path / "trajectories/direction1/walk_a.csv").write_text("Column1,Column2\n" + "0,0\n" * 30)
    path = tmp_path / "simulation_optimised/simulated/trajAa_o1.csv"
    damage(path)
    with pytest.raises(InputError, match=rf"trajAa_o1\.csv.*{words}"):
        Reference(tmp_path).run("walk", 0.010, None, MODEL)
    table = published_table("t4-2")
    again = [[one.key for one in entries_of(table, table.rows[0], Reference(tmp_path))] for _ in range(2)]
    assert again[0] == again[1]


def test_a_folder_without_the_data_is_refused_by_name(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="holds no simulation_manual"):
        Reference(tmp_path)


def test_a_damaged_table_is_refused_by_line_and_column(tmp_path: Path) -> None:
    for name in ("simulation_manual", "simulation_optimised/simulated", "trajectories"):
        (tmp_path / name).mkdir(parents=True)
    (tmp_path / "simulation_optimised/simulated/trajAa_o1.csv").write_text("1,2\n3,x\n")
    with pytest.raises(InputError, match=r"trajAa_o1\.csv:2, column 2: “x” is not a number"):
        Reference(tmp_path).run("walk", 0.010, None, MODEL)
