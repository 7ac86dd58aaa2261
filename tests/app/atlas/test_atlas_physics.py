"""Gaits of an atlas in physics: which are simulated, what is kept, and what shows it."""

from __future__ import annotations

import csv
import math
import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import numpy as np
import pytest

import footfall
from app.atlas.atlas_file import AtlasFile
from app.atlas.export import export_atlas
from app.atlas.front import atlas_front, front_keys
from app.atlas.physics import PhysicsProgress, run_physics
from app.atlas.physics_choice import PhysicsChoice, physics_choice, physics_rule
from app.simulation.problem import way_problem
from core.atlas.physics_row import PHYSICS_FIGURES, PhysicsRow
from core.atlas.row import RowStatus
from core.atlas.space import AtlasSpace, space_from_table
from core.errors import InputError
from core.physics.masses import default_physics
from core.physics.metrics import report
from core.physics.pose_gait_problem import PHYSICS_CYCLES, repeated
from core.wire.waypoint_merging import plan_of_knots
from solver_jobs import (
    EvaluatedGaits,
    drawn_points,
    evaluated_chunk,
    evaluated_point,
    simulate,
    simulate_variations,
)

SPACE = space_from_table(
    {"seed": 3, "vary": {"order": ["1,2,3,4"], "step_x": [0.010, 0.020], "margin": [0.003, 0.006, 0.008]}},
    "a file",
)
COUNT = 12


def filled(path: Path, space: AtlasSpace = SPACE, count: int = COUNT) -> AtlasFile:
    made = AtlasFile(path, space)
    made.add(evaluated_chunk(space.content(), 0, count))
    return made


@pytest.fixture(scope="module")
def gaits() -> EvaluatedGaits:
    return evaluated_chunk(SPACE.content(), 0, COUNT)


@pytest.fixture
def atlas(tmp_path: Path, gaits: EvaluatedGaits) -> Iterator[AtlasFile]:
    made = AtlasFile(tmp_path / "atlas.sqlite", SPACE)
    made.add(gaits)
    yield made
    made.close()


def numbers(choice: PhysicsChoice) -> list[int]:
    return [row.number for row in choice.rows]


def made_up(number: int, walked: float, max_tilt: float = 0.01) -> PhysicsRow:
    return PhysicsRow(number, 16, "", walked, 0.002, 0.0, max_tilt, 0.0, 0.001)


def test_rules_name_the_front_all_or_a_sample(atlas: AtlasFile) -> None:
    solved = [row.number for row in atlas.rows(RowStatus.SOLVED)]
    assert numbers(physics_choice(atlas, "all")) == solved
    assert numbers(physics_choice(atlas, "front")) == [row.number for row, _ in atlas_front(atlas)]
    some, more = physics_choice(atlas, 3), physics_choice(atlas, 5)
    assert len(numbers(some)) == 3
    assert set(numbers(more)) <= set(solved)
    assert numbers(more)[:3] == numbers(some) == numbers(physics_choice(atlas, 3))
    assert some.notice is None


def test_another_seed_draws_another_sample(atlas: AtlasFile, tmp_path: Path) -> None:
    other = AtlasFile(tmp_path / "seed.sqlite", AtlasSpace(SPACE.robot, SPACE.kind, 4, SPACE.axes))
    other.add(list(zip(drawn_points(SPACE, 0, COUNT), atlas.rows(), strict=True)))
    assert numbers(physics_choice(other, 8)) != numbers(physics_choice(atlas, 8))
    other.close()


def test_a_sample_that_is_too_large_takes_all_and_says_so(atlas: AtlasFile) -> None:
    choice = physics_choice(atlas, 500)
    solved = atlas.counts()[RowStatus.SOLVED]
    assert len(choice.rows) == solved
    assert choice.notice == (
        f"A sample of 500 gaits is more than the {solved} solved gaits of the atlas, so all of them are "
        "simulated."
    )


@pytest.mark.parametrize("value", [0, -1, 10_000_001, True, "0", "foo", "", "1.5", "٣", "9" * 30])
def test_a_rule_that_is_none_is_refused(value: str | int) -> None:
    with pytest.raises(InputError, match="it must be front, all, or the size of a sample from 1 to"):
        physics_rule(value, "--physics")


def test_rules_are_read_from_text_and_numbers() -> None:
    assert [physics_rule(value, "physics") for value in ("front", "all", "12", 12)] == [
        "front",
        "all",
        12,
        12,
    ]


def test_a_file_without_the_table_is_read_as_it_is_and_gets_the_table_with_the_first_result(
    atlas: AtlasFile,
) -> None:
    with sqlite3.connect(atlas.path) as connection:
        assert not connection.execute("SELECT 1 FROM sqlite_master WHERE name = 'physics'").fetchall()
    assert atlas.physics() == {}
    row = PhysicsRow(3, 16, "The physics diverged.")
    atlas.add_physics(row)
    atlas.add_physics(made_up(1, 0.5))
    again = AtlasFile(atlas.path, SPACE)
    kept = again.physics()
    assert kept[1] == made_up(1, 0.5)
    assert (kept[3].variations, kept[3].reason) == (16, "The physics diverged.")
    assert all(math.isnan(value) for value in kept[3].figures.values())
    again.close()


def test_figures_of_physics_are_keys_of_the_front_where_there_are_any(atlas: AtlasFile) -> None:
    assert not set(PHYSICS_FIGURES) & set(front_keys(atlas))
    with pytest.raises(InputError, match="y is walked, and no gait was simulated"):
        atlas_front(atlas, "margin", "walked")
    solved = [row.number for row in atlas.rows(RowStatus.SOLVED)]
    atlas.add_physics(made_up(solved[0], 0.5, 0.01))
    atlas.add_physics(made_up(solved[1], 0.75, 0.02))
    atlas.add_physics(made_up(solved[2], 0.25, 0.03))
    atlas.add_physics(PhysicsRow(solved[3], 16, "The physics diverged."))
    assert set(PHYSICS_FIGURES) <= set(front_keys(atlas))
    front = atlas_front(atlas, "max_tilt", "walked")
    assert [row.number for row, _ in front] == [solved[1], solved[0]]
    assert [values["walked"] for _, values in front] == [0.75, 0.5]


def test_tables_have_the_figures_of_physics_and_are_empty_where_none_are_known(
    atlas: AtlasFile, tmp_path: Path
) -> None:
    digest = atlas.hash
    solved = [row.number for row in atlas.rows(RowStatus.SOLVED)]
    atlas.add_physics(made_up(solved[1], 0.75))
    export_atlas(atlas, tmp_path / "all.csv")
    text = (tmp_path / "all.csv").read_text().splitlines()
    lines = {int(one["id"]): one for one in csv.DictReader(text)}
    assert (lines[solved[1]]["walked"], lines[solved[1]]["variations"]) == ("0.75", "16")
    assert all(lines[solved[0]][name] == "" for name in ("variations", *PHYSICS_FIGURES))
    from pyarrow import parquet

    export_atlas(atlas, tmp_path / "all.parquet")
    table = parquet.read_table(tmp_path / "all.parquet")
    assert [value for value in table.column("walked").to_pylist() if value is not None] == [0.75]
    assert atlas.hash == digest


def test_another_number_of_variations_is_simulated_again_and_the_same_is_not(atlas: AtlasFile) -> None:
    choice = physics_choice(atlas, "front")
    for row in choice.rows:
        atlas.add_physics(made_up(row.number, 1.0))
    progress = run_physics(atlas, choice, 2, variations=16)
    assert (progress.done, progress.count, progress.simulated) == (len(choice.rows), len(choice.rows), 0)
    assert progress.walking == len(choice.rows)
    assert run_physics(atlas, choice, 2, go_on=lambda: False, variations=15).done == 0


def test_an_atlas_of_another_robot_is_not_simulated(atlas: AtlasFile) -> None:
    with sqlite3.connect(atlas.path) as connection:
        connection.execute("UPDATE about SET value = ? WHERE key = 'robot_hash'", ("0" * 64,))
    with (
        closing(AtlasFile(atlas.path)) as other,
        pytest.raises(InputError, match="The parameters of deltawalker have changed"),
    ):
        run_physics(other, physics_choice(other, "front"), 1)


def test_time_left_counts_gaits_in_work() -> None:
    assert PhysicsProgress(0, 4, 0, 0, 0.0, 3.0).seconds_left is None
    assert PhysicsProgress(3, 8, 0, 1, 1.0, 10.0).seconds_left == pytest.approx(20.0)


@pytest.mark.heavy
def test_physics_of_worker_processes_is_that_of_the_same_gait_alone_and_leaves_the_hash(
    atlas: AtlasFile,
) -> None:
    digest, before = atlas.hash, list(atlas.entries())
    told: list[PhysicsProgress] = []
    choice = physics_choice(atlas, 2)
    progress = run_physics(atlas, choice, 2, told.append, variations=2)
    assert (progress.done, progress.count, progress.simulated) == (2, 2, 2)
    assert told[-1].done == 2
    assert atlas.hash == digest
    assert list(atlas.entries()) == before
    assert run_physics(atlas, choice, 2, variations=2).simulated == 0
    cycle, _ = evaluated_point(SPACE, choice.rows[0].number)
    assert cycle is not None
    model = cycle.problem.model
    trajectory, knots = repeated(cycle, PHYSICS_CYCLES)
    problem = way_problem(model, trajectory, plan_of_knots(model, trajectory, knots), default_physics(model))
    figures, runs = report(problem, simulate(problem)), simulate_variations(problem, 2)
    kept = atlas.physics()[choice.rows[0].number]
    assert kept.walked == sum(run.walks for run in runs) / 2
    assert kept.max_tilt == figures.max_tilt
    assert kept.slip == figures.slip.max()
    assert kept.simulated_speed == pytest.approx(figures.way.made / figures.arrival_times[-1])
    assert kept.simulated_speed == pytest.approx(choice.rows[0].speed, rel=0.1)


@pytest.mark.heavy
def test_a_wish_to_end_keeps_what_is_done(atlas: AtlasFile) -> None:
    choice = physics_choice(atlas, 3)
    progress = run_physics(atlas, choice, 1, go_on=lambda: not atlas.physics(), variations=1)
    assert (progress.done, progress.simulated) == (1, 1)
    assert list(atlas.physics()) == numbers(choice)[:1]
    rest = run_physics(atlas, choice, 2, variations=1)
    assert (rest.done, rest.simulated) == (3, 2)


@pytest.mark.heavy
def test_a_row_that_its_gait_does_not_have_any_more_gets_no_figures(atlas: AtlasFile) -> None:
    number = physics_choice(atlas, "front").rows[0].number
    with sqlite3.connect(atlas.path) as connection:
        connection.execute("UPDATE gaits SET speed = speed * 1.1 WHERE id = ?", (number,))
    choice = physics_choice(atlas, "front")
    run_physics(atlas, PhysicsChoice("front", choice.rows[:1], choice.solved), 1, variations=1)
    assert atlas.physics()[number].reason == "Solved again, its motion differs from its row."


@pytest.mark.heavy
def test_drawn_gaits_are_simulated_as_a_whole(tmp_path: Path) -> None:
    space = space_from_table(
        {"kind": "drawn", "vary": {"order": ["1,2,3,4"], "step_x": [0.008, 0.012]}}, "a file"
    )
    atlas = filled(tmp_path / "drawn.sqlite", space, 2)
    choice = physics_choice(atlas, 1)
    assert run_physics(atlas, choice, 1, variations=1).simulated == 1
    (row,) = atlas.physics().values()
    assert row.reason == ""
    assert row.simulated_speed == pytest.approx(choice.rows[0].speed, rel=0.1)
    atlas.close()


def test_python_takes_the_same_rules(atlas: AtlasFile) -> None:
    solved = [row.number for row in atlas.rows(RowStatus.SOLVED)]
    for number in solved:
        atlas.add_physics(made_up(number, 0.5))
    opened = footfall.atlas(atlas.path, physics="front")
    assert opened.values("walked").tolist() == [0.5] * len(solved)
    with pytest.warns(UserWarning, match="A sample of 500 gaits is more than"):
        footfall.atlas(atlas.path, physics=500)
    with pytest.raises(footfall.InputError, match="physics is some; it must be front, all, or"):
        footfall.atlas(atlas.path, physics="some")


def test_python_gives_nan_for_gaits_that_were_not_simulated(atlas: AtlasFile) -> None:
    solved = [row.number for row in atlas.rows(RowStatus.SOLVED)]
    atlas.add_physics(made_up(solved[1], 0.5))
    values = footfall.atlas(atlas.path).values("walked")
    assert values[1] == 0.5
    assert np.isnan(np.delete(values, 1)).all()
