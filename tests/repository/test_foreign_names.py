"""The command beside packages of others that are named like ours, as on a computer with ROS."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tomllib
from collections.abc import Callable
from pathlib import Path

import pytest

from app.common.version import VERSION
from tests.repository.distributions import run
from tests.support.studio_process import PROJECT, running_studio, wait_for

NAMES = ("app", "core", "robot_description", "solver_jobs", "tests")
FOREIGN = "raise ImportError(f'{__name__} is foreign')\n"
SPACE = 'seed = 3\n[vary]\norder = ["1,2,3,4"]\nstep_x = [0.010, 0.020]\nmargin = [0.003, 0.006]\n'
SCRIPT = "import sys; from footfall import main; sys.exit(main())"
"""What the script `footfall` does."""


def packages(folder: Path) -> None:
    for name in NAMES:
        (folder / name).mkdir()
        (folder / name / "__init__.py").write_text(FOREIGN)


def modules(folder: Path) -> None:
    for name in NAMES:
        (folder / f"{name}.py").write_text(FOREIGN)


def folders_without_an_init(folder: Path) -> None:
    for name in NAMES:
        (folder / name).mkdir()
        (folder / name / "errors.py").write_text(FOREIGN)


def packages_with_parts_like_ours(folder: Path) -> None:
    for part in ("app/cli", "core/errors", "core/data", "solver_jobs/workers", "robot_description/meshes"):
        (folder / part).mkdir(parents=True)
        (folder / part / "__init__.py").write_text(FOREIGN)
        (folder / part).with_name("__init__.py").write_text("")


def packages_that_are_loaded_first(folder: Path) -> None:
    modules(folder)
    for name in NAMES:
        (folder / f"{name}.py").write_text("mine = True\n")
    (folder / "sitecustomize.py").write_text(f"import {', '.join(NAMES)}\n")


FORMS = (
    packages,
    modules,
    folders_without_an_init,
    packages_with_parts_like_ours,
    packages_that_are_loaded_first,
)


@pytest.mark.parametrize("form", FORMS, ids=lambda form: form.__name__)
def test_a_command_runs_beside_them(
    form: Callable[[Path], None], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    form(tmp_path)
    monkeypatch.setenv("PYTHONPATH", f"{tmp_path}{os.pathsep}{PROJECT}")
    words = ("manual", "walk", "-o", "walk.csv", "--json")
    assert json.loads(run(sys.executable, "-c", SCRIPT, *words, cwd=tmp_path, seconds=60))["knots"] == 55
    said = run(sys.executable, "-m", "footfall", "--version", cwd=tmp_path, seconds=60)
    assert said == f"footfall {VERSION}\n"


def test_the_script_that_is_installed_is_the_one_that_is_tested_here() -> None:
    project = tomllib.loads((PROJECT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert project["scripts"] == {"footfall": "footfall:main"}


def test_the_exit_status_of_a_module_that_is_run_is_that_of_the_command(tmp_path: Path) -> None:
    environment = {**os.environ, "PYTHONPATH": str(PROJECT)}
    words = (sys.executable, "-m", "footfall", "check", "nothing.csv")
    done = subprocess.run(words, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (2, "")
    assert "nothing.csv" in done.stderr


@pytest.fixture(params=[pytest.param("wheel", marks=pytest.mark.soak), "editable"])
def program(request: pytest.FixtureRequest) -> tuple[str, ...]:
    """The script of an environment with the wheel; with an editable installation, what Python is told."""
    python: Path = request.getfixturevalue(f"{request.param}_python")
    return (
        (str(python.with_name("footfall")),) if request.param == "wheel" else (str(python), "-m", "footfall")
    )


@pytest.mark.heavy
def test_every_command_runs_beside_them_where_the_program_is_installed(
    program: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    packages(tmp_path)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "home"))
    (tmp_path / "space.toml").write_text(SPACE)
    python = Path(program[0]).with_name("python")
    for other in ((python, "-m", "footfall"), (python.with_name("footfall"),)):
        assert run(*other, "--version", cwd=tmp_path, seconds=60) == f"footfall {VERSION}\n"
    for words in (
        "gaits",
        "manual walk -o manual.csv",
        "optimise walk -o walk.csv",
        "check walk.csv",
        "simulate walk.csv",
        "frontier walk --method live",
        "waypoints walk.csv -o way.csv",
        "export walk --format html -o walk.html",
        "import walk.csv -o walk.json",
        "fastest c-gait --step 0.005 -o fast.json",
        "pattern --legs 4 --samples 8 --from 1110 --to 1011",
        "atlas run --space space.toml --count 4 --workers 2 -o atlas.sqlite",
        "atlas run --space space.toml --count 4 --workers 1 --dask local -o dask.sqlite",
        "atlas front atlas.sqlite",
        "atlas export atlas.sqlite -o atlas.html",
        "atlas front deltawalker-small",
        "doctor --data data",
    ):
        assert run(*program, *words.split(), cwd=tmp_path, seconds=180)
    show = "import footfall as ff; print(ff.show('walk', data='shown', opens_browser=False))"
    assert run(python, "-c", show, cwd=tmp_path, seconds=180).startswith("http://")
    emulator = subprocess.Popen(
        [*program, "emulate", "--speed", "50"], cwd=tmp_path, stdout=subprocess.PIPE, text=True
    )
    try:
        device = emulator.stdout.readline().strip() if emulator.stdout is not None else ""
        assert run(*program, *f"send way.csv --robot {device} --yes".split(), cwd=tmp_path, seconds=180)
        with running_studio(tmp_path / "data", "--robot", device, cwd=tmp_path, program=program) as studio:
            job = studio.ask("POST", "/api/jobs", {"gait": "walk"}).content["id"]
            wait_for(lambda: studio.ask("GET", f"/api/jobs/{job}").content["state"] == "done", "solved")
            assert studio.ask("GET", "/api/gaits/walk/view").content["plan"]["strokes_mm"] is not None
            assert studio.text("/").startswith("<!doctype html>")
    finally:
        emulator.terminate()
        emulator.communicate()
