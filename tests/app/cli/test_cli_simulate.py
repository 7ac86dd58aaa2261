"""`footfall simulate`: figures for scripts and people, status 4 for what does not walk, and a clean end."""

from __future__ import annotations

import json
import os
import pty
import select
import signal
import subprocess
import sys
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from app.documents.gait_json import gait_content
from app.export.trajectory_files import write_trajectory
from app.learning.parameter_sets import ParameterSets
from app.store.database import DATABASE, Database
from core.library.library import library
from core.motion.trajectory import Trajectory
from core.physics.parameters import physics_set
from tests.support.command import run, run_json
from tests.support.simulated_walk import walk_problem
from tests.support.studio_process import PROJECT, wait_for

INTERRUPTED = 130
RISE = 0.007
"""Of the body over the first pose of a gait by hand, at which motors have room either way, m."""


def standing(lift: float = 0.0, aside: float = 0.0) -> Trajectory:
    """A robot that moves its body aside and then lifts foot 1, m."""
    plan = walk_problem().plan
    count = 4
    feet = np.repeat(plan.feet_world[:1], count, axis=0)
    body = np.repeat(plan.body_world[:1], count, axis=0) + [0.0, 0.0, RISE]
    outward = feet[0, 0, :2] / np.linalg.norm(feet[0, 0, :2])
    body[1:, :2] += aside * outward
    feet[2, 0, 2] += lift
    contact = np.ones((count, 4), dtype=np.bool_)
    contact[2, 0] = False
    return Trajectory(0.4 * np.arange(count, dtype=np.float64), body, np.zeros(count), feet, contact)


def written(path: Path, trajectory: Trajectory) -> str:
    write_trajectory(path, trajectory, "deltawalker")
    return str(path)


@pytest.fixture
def bow(tmp_path: Path) -> str:
    return written(tmp_path / "bow.csv", standing(aside=0.008))


def test_scripts_get_the_figures_of_the_contract(capsys: pytest.CaptureFixture[str], bow: str) -> None:
    status, answer = run_json(capsys, "simulate", bow)
    assert (status, answer["fell"], answer["passed"]) == (0, False, True)
    errors = answer["mean_error"]
    assert errors["feet_mean"] == pytest.approx(np.mean(errors["feet"]))
    assert len(errors["feet"]) == len(answer["slip"]) == 4
    assert 0 < errors["body"] < 0.001
    assert 0 <= answer["max_tilt"] < np.radians(1.0)
    assert answer["realtime_factor"] > 0
    assert answer["variations"] is None


def test_people_read_the_same(capsys: pytest.CaptureFixture[str], bow: str) -> None:
    status, out, _ = run(capsys, "simulate", bow, "--variations", "2", "--rig", "walking")
    assert status == 0
    assert out.startswith("Walks: 0 errors")
    for word in ("mean error", "largest tilt", "slip", "2 of 2 walk"):
        assert word in out


def test_the_same_seed_gives_the_same_variations(capsys: pytest.CaptureFixture[str], bow: str) -> None:
    runs = [
        run_json(capsys, "simulate", bow, "--variations", "2", "--seed", seed)[1]["variations"]["runs"]
        for seed in ("5", "5", "6")
    ]
    assert runs[0] == runs[1]
    assert runs[0] != runs[2]


def test_a_robot_that_rocks_onto_the_foot_that_is_lifted_from_under_it_gets_a_warning(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    path = written(tmp_path / "tip.csv", standing(lift=0.005, aside=0.006))
    status, answer = run_json(capsys, "simulate", path)
    assert (status, answer["passed"], answer["fell"]) == (0, True, False)
    assert answer["max_tilt"] > np.radians(2.0)
    [tilt] = [finding for finding in answer["findings"] if finding["rule"] == "simulated_tilt"]
    assert tilt["severity"] == "warning"
    assert "does not fall" in tilt["sentence"]


@pytest.mark.heavy
def test_a_gait_file_is_simulated_as_it_would_be_sent(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    gait = library()["walk-manual-0"].gait
    assert gait.segment_table is not None
    table = replace(gait.segment_table, samples_per_segment=2)
    timeline = table.timeline(gait.timeline.sample_time)
    path = tmp_path / "walk.json"
    path.write_text(json.dumps(gait_content(replace(gait, segment_table=table, timeline=timeline))))
    merged = run_json(capsys, "simulate", str(path), "--rig", "floating")[1]
    every = run_json(capsys, "simulate", str(path), "--rig", "floating", "--merge", "0")[1]
    assert merged["waypoints"] <= every["waypoints"]
    assert (merged["rig"], merged["max_tilt"] < 0.2) == ("floating", True)


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--physics", "moon"], "no physics set “moon”"),
        (["--variations", "-1"], "--variations"),
        (["--rig", "hanging"], "must be one of walking, floating, clamped"),
        (["--robot", "hexapod"], "feet"),
        (["--merge", "1"], "--merge"),
    ],
)
def test_what_cannot_be_simulated_is_refused_with_a_sentence(
    capsys: pytest.CaptureFixture[str], bow: str, words: list[str], sentence: str
) -> None:
    status, answer = run_json(capsys, "simulate", bow, *words)
    assert status == 2
    assert sentence in answer["error"]


@pytest.mark.parametrize("moment", ["while the engine loads", "while it runs"])
def test_an_interrupted_simulation_ends_cleanly(bow: str, moment: str) -> None:
    command = [sys.executable, "-m", "app", "simulate", bow, "--variations", "1000"]
    terminal, its_end = pty.openpty()
    with subprocess.Popen(command, cwd=PROJECT, stdout=subprocess.DEVNULL, stderr=its_end) as process:
        os.close(its_end)
        maps = Path(f"/proc/{process.pid}/maps")
        said = b""

        def hear() -> bytes:
            nonlocal said
            if select.select([terminal], [], [], 1.0)[0]:
                said += os.read(terminal, 1000)
            return said

        if moment == "while it runs":
            wait_for(lambda: b"%" in hear(), "the simulation runs")
        else:
            wait_for(lambda: "mujoco" in maps.read_text(), "the engine is being loaded")
        os.kill(process.pid, signal.SIGINT)
        wait_for(lambda: b"Interrupted." in hear(), "it ends")
        process.wait(60)
    os.close(terminal)
    assert process.returncode == INTERRUPTED
    assert b"Traceback" not in said


def test_a_learned_set_is_found_in_the_data_folder_by_its_name_and_version(
    bow: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    physics = replace(physics_set("scales"), cable_drag=0.5)
    with closing(Database(tmp_path / DATABASE)) as database:
        ParameterSets(database).save("Lab floor", "Ada", "deltawalker", physics, "made", "made")
    words = ("simulate", bow, "--data", str(tmp_path), "--physics")
    status, content = run_json(capsys, *words, "Lab floor, version 1")
    assert status == 0
    assert content["physics"] == "Lab floor, version 1"
    status, content = run_json(capsys, *words, "Lab floor, version 2")
    assert status == 2
    assert "Lab floor, version 1" in content["error"]
    status, content = run_json(
        capsys, "simulate", bow, "--data", str(tmp_path / "none"), "--physics", "Lab floor"
    )
    assert status == 2
    assert "--data" in content["error"]
