"""The wheel holds everything that the program needs outside the checkout."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

from tests.support.studio_process import PROGRAM, PROJECT, running_studio

NO_SOURCE = (".git", ".venv", ".hypothesis", "build", "*.egg-info", "__pycache__", ".*_cache")


def run_quietly(*words: str) -> None:
    subprocess.run(words, check=True, capture_output=True, timeout=120)


def test_a_wheel_serves_the_studio_far_from_the_checkout(tmp_path: Path) -> None:
    source, wheels, installed = tmp_path / "source", tmp_path / "wheels", tmp_path / "installed"
    shutil.copytree(PROJECT, source, ignore=shutil.ignore_patterns(*NO_SOURCE))
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--no-input"]
    subprocess.run(
        [*pip, "wheel", "--no-deps", "--no-build-isolation", "-w", wheels, source],
        check=True,
        capture_output=True,
        timeout=120,
    )
    wheel = next(wheels.glob("*.whl"))
    subprocess.run(
        [*pip, "install", "--no-deps", "--target", installed, wheel],
        check=True,
        capture_output=True,
        timeout=120,
    )
    environment = {**os.environ, "PYTHONPATH": str(installed)}
    words = subprocess.run(
        [sys.executable, "-c", "import app, sys; print(app.__file__)"],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        text=True,
        check=True,
    )
    assert words.stdout.startswith(str(installed))
    with running_studio(tmp_path / "data", cwd=tmp_path, environment=environment, program=PROGRAM) as studio:
        view = studio.ask("GET", "/api/gaits/walk/view").content
        assert view["plan"]["strokes_mm"] is not None
        assert studio.text("/").startswith("<!doctype html>")
        assert "viser" in studio.text("/viser/").lower()
