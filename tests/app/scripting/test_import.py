"""`import footfall`: quick, lazy, with docstrings, and beside files named like the program's packages."""

from __future__ import annotations

import doctest
import inspect
import json
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import footfall as ff
from tests.support.studio_process import PROJECT

SIX_LINES = """
import footfall as ff
plan = ff.optimise("walk", step=0.010, margin=0.006)
print(plan.status, ff.check(plan).passed)
run = ff.send(plan, to="emulator", by="Ada")
print(run.measured.shape)
"""
FUNCTIONS = sorted(name for name in ff.__all__ if inspect.isfunction(getattr(ff, name)))
VALUES = ("Gait", "Pattern", "Plan", "Remedy", "Robot", "Run", "Segments", "Simulation", "Trial", "Verdict")
SIZES = re.compile(r"\(\w+, |\bm\b|\bmm\b|\bcm\b|\bs\b|SI\b|units|metres")


def run_script(text: str, folder: Path, seconds: float = 120.0) -> str:
    """What a script prints that stands in a folder of its own, with its data there too."""
    script = folder / "script.py"
    script.write_text(text)
    environment = {**os.environ, "PYTHONPATH": str(PROJECT), "XDG_DATA_HOME": str(folder / "data")}
    (folder / "data").mkdir(exist_ok=True)
    done = subprocess.run(
        [sys.executable, str(script)],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        timeout=seconds,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.heavy
def test_six_lines_lead_from_a_name_to_measured_strokes(tmp_path: Path) -> None:
    first, second = run_script(SIX_LINES, tmp_path).splitlines()
    assert first == "solved True"
    lines, legs, motors = json.loads(second.replace("(", "[").replace(")", "]"))
    assert lines > 20
    assert (legs, motors) == (4, 3)


@pytest.mark.heavy
def test_it_works_beside_files_of_the_same_names_and_runs_no_script_again_in_a_worker(tmp_path: Path) -> None:
    for name in ("core", "app", "solver_jobs", "robot_description"):
        (tmp_path / f"{name}.py").write_text(f"mine = {name!r}\n")
    text = """
print("once")
import core, app
import footfall as ff
plan = ff.optimise("walk", method="live")
import solver_jobs, robot_description
print(core.mine, app.mine, solver_jobs.mine, robot_description.mine, plan.status)
print(ff.fastest("c-gait", step=0.005).status)
"""
    assert run_script(text, tmp_path).split() == [
        "once", "core", "app", "solver_jobs", "robot_description", "solved", "solved",
    ]  # fmt: skip


@pytest.mark.heavy
def test_import_is_quick_and_loads_no_solver(tmp_path: Path) -> None:
    text = """
import sys, time
begin = time.perf_counter()
import footfall
seconds = time.perf_counter() - begin
print(seconds < 0.3, any(name in sys.modules for name in ("casadi", "mujoco", "ortools", "numpy")))
footfall.gait("walk")
print(any(name in sys.modules for name in ("casadi", "mujoco", "ortools")))
"""
    assert run_script(text, tmp_path).split() == ["True", "False", "False"]


@pytest.mark.parametrize("name", ff.__all__)
def test_every_public_name_says_what_a_user_has_to_know(name: str) -> None:
    value = getattr(ff, name)
    words = inspect.getdoc(value) or ""
    assert words
    if name in FUNCTIONS or name in VALUES:
        assert SIZES.search(words), "shapes or units"
        assert "Raises:" in words
        assert re.search(r"^>>> ", re.sub(r"^ +", "", words, flags=re.MULTILINE), re.MULTILINE), "an example"


def examples() -> list[Any]:
    """A test of each docstring with an example."""
    finder = doctest.DocTestFinder()
    found = [one for name in ff.__all__ for one in finder.find(getattr(ff, name), name) if one.examples]
    return [pytest.param(one, id=one.name) for one in found]


@pytest.mark.heavy
@pytest.mark.parametrize("example", examples())
def test_the_examples_of_docstrings_run(example: doctest.DocTest) -> None:
    failed, _ = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS).run(example, clear_globs=False)
    assert failed == 0


def test_what_the_contract_names_is_there() -> None:
    names = {"robot", "gait", "optimise", "fastest", "pattern", "check", "simulate", "send", "show"}
    assert names <= set(FUNCTIONS)
    assert set(dir(ff)) == {*ff.__all__, "__version__"}
    with pytest.raises(AttributeError, match="has no attribute 'optimize'"):
        _ = ff.optimize
    with pytest.raises(ModuleNotFoundError):
        __import__("footfall.numpy")
