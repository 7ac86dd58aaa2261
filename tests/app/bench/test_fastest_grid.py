"""The grid of fastest walks: its problems, its options, and what its rows say."""

from __future__ import annotations

import numpy as np
import pytest

from app.bench.solvers.fastest_grid import Grid, bench_fastest_grid
from app.cli.bench_options import grid_of
from app.cli.parser import make_parser
from core.errors import InputError
from solver_jobs import SearchStep
from tests.support.command import run


def test_the_grid_without_options_has_every_order_and_direction_that_differ() -> None:
    problems = Grid().problems()
    choices = {(problem.order, round(float(np.degrees(problem.heading)))) for problem in problems}
    assert choices == {
        *(((1, 2, 3, 4), heading) for heading in (0, 45)),
        *(((1, 3, 2, 4), heading) for heading in (0, 45)),
        *(((1, 2, 4, 3), heading) for heading in (0, 45)),
        ((1, 4, 2, 3), 45),
    }
    assert len(problems) == 7 * 4 * 1 * 2
    assert {problem.step for problem in problems} == {None, 0.02, 0.03, 0.04}
    assert all(problem.cycles is None for problem in problems)


def test_options_limit_the_grid_and_a_value_that_stands_twice_counts_once() -> None:
    words = "bench fastest --grid --orders c-gait,3-2-4-1,1-3-2-4 --steps free,0.01,free"
    options = make_parser().parse_args([*words.split(), "--margins", "0.003,0.006", "--stop-bounds", "1.5"])
    grid = grid_of(options)
    assert grid == Grid(
        ((1, 2, 3, 4), (3, 2, 4, 1), (1, 3, 2, 4)), (None, 0.01, None), (0.003, 0.006), (1.5,)
    )
    problems = grid.problems()
    assert {problem.order for problem in problems} == {(1, 2, 3, 4), (1, 3, 2, 4)}
    keys = [(p.order, p.heading, p.step, p.bounds.margin, p.bounds.stop_bound) for p in problems]
    assert len(set(keys)) == len(keys) == (2 + 5) * 2 * 2


def test_no_grid_is_asked_without_its_option() -> None:
    assert grid_of(make_parser().parse_args(["bench", "fastest"])) is None


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ("fastest --steps 0.02", "--steps limits the grid of the benchmark fastest; add --grid."),
        ("fastest --stop-bounds 1.2", "--stop-bounds limits the grid of the benchmark fastest; add --grid."),
        ("--grid", "--grid belongs to the benchmark fastest; name it: footfall bench fastest --grid."),
        ("live --grid", "name it: footfall bench fastest --grid."),
        (
            "fastest --grid --orders trot",
            "--orders: “trot” is neither walk, amble, s-gait or c-gait nor feet",
        ),
        ("fastest --grid --orders 1-2-3-3", "--orders: “1-2-3-3” must name each foot 1 to 4 once"),
        ("fastest --grid --steps 0.3", "--steps: 0.3 must lie between 0.0005 and 0.2 m"),
        ("fastest --grid --steps 0.02,", "--steps: “” is not a number"),
        ("fastest --grid --margins fast", "--margins: “fast” is not a number"),
        ("fastest --grid --stop-bounds 0.1", "--stop-bounds: 0.1 must lie between 0.8 and 10.0 s"),
    ],
)
def test_bad_input_is_refused_with_the_option(
    capsys: pytest.CaptureFixture[str], words: str, sentence: str
) -> None:
    status, out, error = run(capsys, "bench", *words.split())
    assert (status, out) == (2, "")
    assert sentence in error


def test_a_grid_that_is_too_large_is_refused_before_anything_is_measured(
    capsys: pytest.CaptureFixture[str],
) -> None:
    steps = ",".join(f"{0.001 * number:g}" for number in range(1, 150))
    status, _, error = run(capsys, "bench", "kinematics", "fastest", "--grid", "--steps", steps)
    assert status == 2
    assert "at most 2,000 are tried. Give fewer --orders" in error
    assert "Measuring" not in error


def test_an_order_of_other_feet_is_refused() -> None:
    with pytest.raises(InputError, match="each foot 1 to 4"):
        Grid(orders=((1, 2, 3),)).problems()


@pytest.mark.heavy
def test_ctrl_c_ends_it_with_what_is_answered() -> None:
    def interrupted(step: SearchStep) -> None:
        raise KeyboardInterrupt

    row, first, whole = bench_fastest_grid(Grid(((1, 2, 3, 4),), (0.02, 0.01), (0.006,), (1.5,)), interrupted)
    assert (row["status"], row["check"]) == ("solved", "confirmed")
    assert first["solved"] == "1 of 1"
    assert (whole["problems"], whole["answered"]) == (4, 1)


@pytest.mark.heavy
def test_a_row_has_the_figures_of_a_gait_that_is_confirmed_or_its_status() -> None:
    told: list[SearchStep] = []
    grid = Grid(((1, 2, 3, 4),), (0.02, 0.19), (0.006,), (1.5,))
    *rows, first, second, whole = bench_fastest_grid(grid, told.append)
    assert [(row["heading_deg"], row["asked_step_mm"]) for row in rows] == [
        (0, 20.0),
        (0, 190.0),
        (45, 20.0),
        (45, 190.0),
    ]
    solved, no = rows[0], rows[1]
    assert (solved["gait"], solved["status"], solved["moves"], solved["step_mm"]) == (
        "c-gait",
        "solved",
        8,
        20.0,
    )
    assert solved["check"] == "confirmed"
    assert solved["mm_s"] == pytest.approx(solved["step_mm"] / solved["robot_s"], abs=0.01)
    assert solved["least_margin_mm"] >= 5.95
    assert solved["stop_s"] <= 1.5 + 0.18
    assert (no["status"], no["moves"], no["check"]) == ("infeasible", None, None)
    assert {first["fastest_of"], second["fastest_of"]} == {"1-2-3-4 (c-gait), 0°", "1-2-3-4 (c-gait), 45°"}
    assert first["mm_s"] >= second["mm_s"]
    assert first["solved"] == second["solved"] == "1 of 2"
    assert (whole["problems"], whole["answered"], whole["solved"], whole["confirmed"]) == (4, 4, 2, 2)
    assert [step.done for step in told] == [1, 2, 3, 4]
