"""`footfall atlas`: a run and what is made of it, interruptions, a cluster, and bad input."""

from __future__ import annotations

import json
import os
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path
from typing import NoReturn

import pytest

from app.documents.gait_json import parse_gait
from tests.support.command import run, run_json
from tests.support.studio_process import PROJECT

SPACE = """
seed = 3
[vary]
order = ["1,2,3,4", "1,4,2,3"]
step_x = [0.010, 0.020]
margin = [0.003, 0.006, 0.008]
"""

WITH_ONE_VARIATION = """
import sys
from app.cli import main
from app.cli.atlas import physics
physics.VARIATIONS = 1
sys.exit(main(sys.argv[1:]))
"""


@pytest.fixture(scope="module")
def space(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("space") / "space.toml"
    path.write_text(SPACE)
    return path


@pytest.mark.heavy
def test_a_space_becomes_an_atlas_whose_best_gaits_are_shown_and_opened(
    capsys: pytest.CaptureFixture[str], space: Path, tmp_path: Path
) -> None:
    atlas = str(tmp_path / "atlas.sqlite")
    asked = ("atlas", "run", "--space", str(space), "--count", "20", "--workers", "1", "-o", atlas)
    status, made = run_json(capsys, *asked)
    assert status == 0
    assert made["evaluated"] == made["solved"] + made["infeasible"] + made["failed"] == 20
    assert made["solved"] >= 10
    assert made["seconds"] > 0.0
    status, again = run_json(capsys, *asked)
    assert (status, again["evaluated"], again["hash"]) == (0, 0, made["hash"])
    status, shown = run_json(capsys, "atlas", "front", atlas)
    assert status == 0
    assert [one["margin"] for one in shown["front"]] == sorted(one["margin"] for one in shown["front"])
    best = shown["front"][0]
    gait = tmp_path / "gait.json"
    status, opened = run_json(capsys, "atlas", "open", atlas, str(best["id"]), "-o", str(gait))
    assert (status, opened["agrees"], opened["gait"]) == (0, True, str(gait))
    document = parse_gait(gait.read_text())
    assert document.poses is not None
    assert document.poses.found is not None
    assert ",".join(map(str, document.order)) == best["order"]
    assert opened["from_stance"] > 0.0
    status, checked = run_json(capsys, "check", str(gait))
    assert (status, checked["passed"]) == (0, True)
    status, written = run_json(capsys, "atlas", "export", atlas, "-o", str(tmp_path / "atlas.csv"))
    assert (status, written["gaits"]) == (0, 20)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("run", "--robot", "spot", "-o", "a.sqlite"), "spot"),
        (("run", "--space", "none.toml", "-o", "a.sqlite"), "none.toml"),
        (("run", "-o", "a.db"), "a.db must end in .sqlite"),
        (("run", "--count", "0", "-o", "a.sqlite"), "--count"),
        (("run", "--dask", "node1", "-o", "a.sqlite"), "--dask is node1; it must be “local”"),
        (("run", "--robot", "hexapod", "--space", "SPACE", "-o", "a.sqlite"), "is a space of deltawalker"),
        (("run", "--physics", "0", "-o", "a.sqlite"), "--physics is 0; it must be front, all, or the size"),
        (("run", "--physics", "foo", "-o", "a.sqlite"), "--physics is foo; it must be front, all, or"),
        (("run", "--physics", "1.5", "-o", "a.sqlite"), "--physics is 1.5; it must be front, all, or"),
        (("front", "none.sqlite"), "There is no atlas none.sqlite"),
        (("open", "none.sqlite", "3"), "There is no atlas none.sqlite"),
        (("export", "none.sqlite", "-o", "a.csv"), "There is no atlas none.sqlite"),
    ],
)
def test_bad_input_is_refused_with_a_sentence(
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    space: Path,
    tmp_path: Path,
    arguments: tuple[str, ...],
    words: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    status, _, said = run(capsys, "atlas", *(str(space) if one == "SPACE" else one for one in arguments))
    assert status == 2
    assert words in said
    assert not (tmp_path / "a.sqlite").exists()


@pytest.mark.heavy
def test_a_run_that_is_interrupted_says_what_it_keeps(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, space: Path, tmp_path: Path
) -> None:
    asked = ("atlas", "run", "--space", str(space), "--workers", "1", "-o", str(tmp_path / "a.sqlite"))
    assert run(capsys, *asked, "--count", "3")[0] == 0

    def interrupted(*_: object) -> NoReturn:
        raise KeyboardInterrupt

    monkeypatch.setattr("app.cli.atlas.commands.run_atlas", interrupted)
    status, _, said = run(capsys, *asked, "--count", "5")
    assert status == 130
    assert "a.sqlite keeps the 3 gaits that it has. The same command goes on there." in said


def command(*arguments: str) -> list[str]:
    return [sys.executable, "-m", "app", "atlas", *arguments, "--json"]


def count_of(path: Path, table: str = "gaits") -> int:
    connection = sqlite3.connect(path, timeout=20)
    try:
        return int(connection.execute(f"SELECT count(*) FROM {table}").fetchone()[0])
    except sqlite3.OperationalError:
        return 0
    finally:
        connection.close()


@pytest.mark.soak
def test_a_run_that_is_killed_goes_on_and_ends_with_the_same_hash(tmp_path: Path) -> None:
    whole, killed = tmp_path / "whole.sqlite", tmp_path / "killed.sqlite"
    count = ("--count", "800")
    first = subprocess.run(
        command("run", *count, "--workers", "2", "-o", str(whole)),
        cwd=PROJECT,
        capture_output=True,
        check=True,
    )
    process = subprocess.Popen(
        command("run", *count, "--workers", "1", "-o", str(killed)),
        cwd=PROJECT,
        stdout=subprocess.DEVNULL,
        start_new_session=True,
    )
    deadline = time.monotonic() + 120.0
    while not (killed.exists() and count_of(killed)):
        assert time.monotonic() < deadline, "no chunk was done"
        time.sleep(0.1)
    os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    done = count_of(killed)
    assert 0 < done < 800
    again = subprocess.run(
        command("run", *count, "--workers", "1", "-o", str(killed)),
        cwd=PROJECT,
        capture_output=True,
        check=True,
    )
    answer, expected = json.loads(again.stdout), json.loads(first.stdout)
    assert answer["evaluated"] == 800 - done
    assert answer["hash"] == expected["hash"]
    assert answer["solved"] == expected["solved"]


@pytest.mark.soak
def test_a_cluster_of_which_a_worker_is_killed_gives_the_same_hash(tmp_path: Path) -> None:
    alone, cluster = tmp_path / "alone.sqlite", tmp_path / "cluster.sqlite"
    count = ("--count", "800", "--workers", "2")
    first = subprocess.run(
        command("run", *count, "-o", str(alone)), cwd=PROJECT, capture_output=True, check=True
    )
    process = subprocess.Popen(
        command("run", *count, "--dask", "local", "-o", str(cluster)), cwd=PROJECT, stdout=subprocess.PIPE
    )
    deadline = time.monotonic() + 120.0
    while not (cluster.exists() and count_of(cluster)):
        assert time.monotonic() < deadline, "no chunk was done"
        time.sleep(0.1)
    # Of the processes below the command, the leaves are workers.
    listed = subprocess.run(["ps", "-eo", "pid=,ppid="], capture_output=True, check=True, text=True).stdout
    pairs = (line.split() for line in listed.splitlines())
    parents = {int(child): int(parent) for child, parent in pairs}

    def is_below(child: int) -> bool:
        return child in parents and (parents[child] == process.pid or is_below(parents[child]))

    below = [child for child in parents if is_below(child)]
    leaves = [child for child in below if child not in parents.values()]
    assert leaves
    os.kill(max(leaves), signal.SIGKILL)
    output, _ = process.communicate(timeout=300)
    assert process.returncode == 0
    answer, expected = json.loads(output), json.loads(first.stdout)
    assert answer["evaluated"] == 800
    assert answer["hash"] == expected["hash"]


@pytest.mark.heavy
def test_physics_of_the_front_is_printed_exported_and_not_simulated_twice(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, space: Path, tmp_path: Path
) -> None:
    monkeypatch.setattr("app.cli.atlas.physics.VARIATIONS", 2)
    atlas = str(tmp_path / "atlas.sqlite")
    asked = ("atlas", "run", "--space", str(space), "--count", "8", "--workers", "1", "-o", atlas)
    status, plain = run_json(capsys, *asked)
    assert (status, plain["physics"]) == (0, None)
    status, made = run_json(capsys, *asked, "--physics", "front")
    assert (status, made["hash"]) == (0, plain["hash"])
    physics = made["physics"]
    assert physics["rule"] == "front"
    assert physics["simulated"] == physics["chosen"] >= 1
    assert physics["walk_in_all"] <= physics["chosen"]
    assert physics["variations"] == 2
    status, again = run_json(capsys, *asked, "--physics", "front")
    assert again["physics"] == physics | {"simulated": 0, "seconds": again["physics"]["seconds"]}
    status, shown = run_json(capsys, "atlas", "front", atlas, "--y", "walked")
    best = shown["front"][0]
    assert 0.0 <= best["walked"] <= 1.0
    status, opened = run_json(capsys, "atlas", "open", atlas, str(best["id"]))
    assert opened["physics"]["walked"] == best["walked"]
    status, words, _ = run(capsys, "atlas", "open", atlas, str(best["id"]))
    assert "of 2 variations walk." in words


@pytest.mark.heavy
@pytest.mark.parametrize("ending", [signal.SIGKILL, pytest.param(signal.SIGINT, marks=pytest.mark.soak)])
def test_simulations_that_are_ended_go_on(space: Path, tmp_path: Path, ending: signal.Signals) -> None:
    atlas = tmp_path / "atlas.sqlite"
    asked = ["atlas", "run", "--space", str(space), "--count", "8", "--workers", "2", "-o", str(atlas)]
    whole = [sys.executable, "-c", WITH_ONE_VARIATION, *asked, "--physics", "3", "--json"]
    process = subprocess.Popen(whole, cwd=PROJECT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    deadline = time.monotonic() + 300.0
    while not (atlas.exists() and count_of(atlas, "physics")):
        assert time.monotonic() < deadline, "no gait was simulated"
        time.sleep(0.1)
    process.send_signal(ending)
    assert process.wait(timeout=20) != 0
    done = count_of(atlas, "physics")
    assert 1 <= done < 3
    again = subprocess.run(whole, cwd=PROJECT, capture_output=True, check=True)
    physics = json.loads(again.stdout)["physics"]
    assert (physics["chosen"], physics["simulated"]) == (3, 3 - done)
