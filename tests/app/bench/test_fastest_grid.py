"""The grid of fastest walks: its problems, its options, and what its rows say."""

from __future__ import annotations

import json
import os
import select
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator

import numpy as np
import pytest

from app.bench.common.measure import EndedEarly
from app.bench.solvers.fastest_grid import Grid, bench_fastest_grid
from app.cli.bench_options import grid_of
from app.cli.common.output import INTERRUPTED
from app.cli.parser import make_parser
from app.common.signals import Interrupted
from core.errors import InputError
from core.library.library import library
from core.pose_gaits.gait_poses import found_gait
from core.pose_gaits.pose_check import PoseCheck, check_poses
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import PoseProblem
from core.robot.model import load_robot
from solver_jobs import PoseResult, SearchStep, SolveStatus, TriedGait
from tests.support.command import run, run_json
from tests.support.studio_process import PROJECT, wait_for


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


class Search:
    """Answers the first problem of a grid with a known gait; then the signal arrives."""

    ending = signal.SIGINT

    def __init__(self, niceness: int) -> None:
        pass

    def solve(self, problems: list[PoseProblem], report: Callable[[SearchStep], object]) -> None:
        found = found_gait(library()["fast-c-gait"].gait, load_robot("deltawalker"))
        result = PoseResult(SolveStatus.SOLVED, found, None, True, (), 0.1, 0.1)
        newest = TriedGait(problems[0], result)
        report(SearchStep(1, len(problems), 0, newest, newest))
        signal.raise_signal(self.ending)

    def close(self) -> None:
        pass


@pytest.fixture
def kept_signals() -> Iterator[None]:
    """A command sets its own handlers; afterwards they are what they were."""
    numbers = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
    before = [signal.getsignal(number) for number in numbers]
    yield
    for number, handler in zip(numbers, before, strict=True):
        signal.signal(number, handler)


@pytest.mark.parametrize("ending", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_ends_it_with_what_is_answered_and_begins_no_other_benchmark(
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    kept_signals: None,
    ending: signal.Signals,
) -> None:
    measured: list[str] = []
    monkeypatch.setattr("app.cli.commands_bench.measured", measured.append)
    monkeypatch.setattr("app.bench.solvers.fastest_grid.FastestSearch", Search)
    monkeypatch.setattr(Search, "ending", ending)
    words = ("bench", "fastest", "kinematics", "--grid", "--orders", "c-gait")
    status, answer = run_json(capsys, *words)
    assert (status, answer["error"], answer["where"]) == (INTERRUPTED, "Interrupted.", "command")
    assert list(answer["results"]) == ["fastest"]
    row, first, whole = answer["results"]["fastest"]
    assert (row["status"], row["moves"]) == ("solved", 26)
    assert (first["solved"], first["mm_s"]) == ("1 of 1", row["mm_s"])
    assert (whole["problems"], whole["answered"]) == (16, 1)
    assert measured == []


@pytest.mark.parametrize("has_rows", [True, False])
def test_each_gait_is_checked_once(monkeypatch: pytest.MonkeyPatch, has_rows: bool) -> None:
    checked: list[PoseGait] = []

    def check(gait: PoseGait, samples: int) -> PoseCheck:
        checked.append(gait)
        return check_poses(gait, samples)

    def solve(search: Search, problems: list[PoseProblem], report: Callable[[SearchStep], object]) -> None:
        if has_rows:
            whole(search, problems, report)
        raise Interrupted

    whole = Search.solve
    monkeypatch.setattr(Search, "solve", solve)
    monkeypatch.setattr("app.bench.solvers.fastest_grid.FastestSearch", Search)
    monkeypatch.setattr("app.bench.solvers.fastest_grid.check_poses", check)
    monkeypatch.setattr(signal, "raise_signal", lambda number: None)
    with pytest.raises(EndedEarly) as ended:
        bench_fastest_grid(Grid(((1, 2, 3, 4),)))
    assert len(checked) == int(has_rows)
    assert ended.value.rows[-1]["answered"] == int(has_rows)


@pytest.mark.heavy
@pytest.mark.parametrize("ending", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_the_command_itself(ending: signal.Signals) -> None:
    words = "bench fastest kinematics --grid --orders c-gait --steps 0.02,free --stop-bounds 1.5 --json"
    terminal, its_end = os.openpty()
    command = [sys.executable, "-m", "app", *words.split()]
    with subprocess.Popen(
        command, cwd=PROJECT, stdout=subprocess.PIPE, stderr=its_end, start_new_session=True
    ) as process:
        os.close(its_end)
        said = b""

        def hear() -> bytes:
            nonlocal said
            if select.select([terminal], [], [], 1.0)[0]:
                said += os.read(terminal, 1000)
            return said

        wait_for(lambda: b"Grid: 1 of 4" in hear(), "a problem is answered")
        if ending is signal.SIGINT:
            os.killpg(process.pid, ending)  # as a terminal does
        else:
            process.send_signal(ending)
        wait_for(lambda: b"Interrupted." in hear(), "it ends")
        out, _ = process.communicate(timeout=60)
    os.close(terminal)
    answer = json.loads(out)
    assert process.returncode == INTERRUPTED
    assert list(answer["results"]) == ["fastest"]
    *rows, _, whole = answer["results"]["fastest"]
    assert (whole["problems"], whole["answered"]) == (4, len(rows))
    assert {row["check"] for row in rows} == {"confirmed"}
    assert b"kinematics" not in said
    assert b"Traceback" not in said


@pytest.mark.soak
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
