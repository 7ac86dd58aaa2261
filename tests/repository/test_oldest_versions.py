"""The oldest versions that are allowed: every module loads, and what rests on each package works."""

from __future__ import annotations

import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.support.studio_process import PROJECT

PYTHONS = ("python3.11", "python3.12")
"""For later ones several of the oldest versions have no ready-made files."""
OLDEST = PROJECT / "lowest-versions.txt"
INSTALL_SECONDS, TEST_SECONDS = 900, 1800
"""Deadlines for loaded machines, which no test waits out."""
pytestmark = pytest.mark.timeout(3 * INSTALL_SECONDS + TEST_SECONDS)
PACKAGES = ("app", "core", "robot_description", "solver_jobs")
LOAD_ALL = f"""
import importlib, pkgutil
for package in {PACKAGES}:
    for module in pkgutil.walk_packages([package], package + "."):
        if not module.name.endswith("__main__"):
            importlib.import_module(module.name)
"""
SEAMS = {
    "casadi": ("tests/solver_jobs/live/test_live.py", "tests/solver_jobs/nlp/test_leg_equations.py"),
    "ortools": ("tests/solver_jobs/patterns/test_solve.py",),
    "mujoco-core": ("tests/solver_jobs/physics/test_model.py", "tests/solver_jobs/physics/test_statics.py"),
    "trimesh, yourdfpy": ("tests/robot_description",),
    "viser, websockets": ("tests/app/scene/test_scene_server.py",),
    "pyserial": ("tests/app/bridge/test_transport.py",),
    "fastapi, fastapi-offline, pydantic, starlette, uvicorn": (
        "tests/app/server/test_server_process.py",
        "tests/app/web",
    ),
    "pillow": (
        "tests/app/export/test_export_forms.py::test_the_picture_has_the_colours_of_the_drawing",
        "tests/app/trials/test_photos.py",
    ),
    "mcap": ("tests/app/runs/test_runs.py",),
    "opencv-python-headless": ("tests/app/vision",),
    "ipykernel, matplotlib, nbclient, nbformat": (
        "tests/repository/test_notebooks.py",
        "tests/app/scripting/test_values.py",
    ),
    "axe-playwright-python, playwright": ("tests/app/export/test_export_page.py",),
}


def run(*words: str | Path, seconds: float) -> subprocess.CompletedProcess[str]:
    return subprocess.run(words, cwd=PROJECT, capture_output=True, text=True, timeout=seconds, check=False)


def can_fetch(python: Path, folder: Path) -> bool:
    """Whether any package can be obtained here: asked for a small one."""
    words = ("-m", "pip", "download", "-q", "--no-deps", "-d", folder, "iniconfig")
    return run(python, *words, seconds=INSTALL_SECONDS).returncode == 0


def fitting_python() -> str | None:
    """A Python of a version for which there are ready-made files of the oldest versions."""
    if f"python3.{sys.version_info.minor}" in PYTHONS:
        return sys.executable
    return next((name for name in PYTHONS if shutil.which(name) and answers(name)), None)


def answers(name: str) -> bool:
    """Whether a command is more than a name, as one of a version manager may be."""
    return run(name, "-V", seconds=60).returncode == 0


@pytest.fixture(scope="module")
def python(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """The Python of an environment with the oldest versions."""
    folder = tmp_path_factory.mktemp("oldest")
    chosen = fitting_python()
    if chosen is None:
        pytest.skip("Neither Python 3.11 nor 3.12 is here; later ones are too new for the oldest versions.")
    run(chosen, "-m", "venv", folder / "environment", seconds=INSTALL_SECONDS).check_returncode()
    inside = folder / "environment" / "bin" / "python"
    words = ("-m", "pip", "install", "-q", "--no-compile", "--only-binary", ":all:", "-r", OLDEST)
    installed = run(inside, *words, seconds=INSTALL_SECONDS)
    if installed.returncode != 0 and not can_fetch(inside, folder):
        pytest.skip("No packages can be obtained here, so that the oldest versions cannot be tried.")
    assert installed.returncode == 0, installed.stderr[-4000:]
    yield inside
    shutil.rmtree(folder / "environment")


@pytest.mark.soak
def test_every_module_loads_with_the_oldest_versions(python: Path) -> None:
    loaded = run(python, "-c", LOAD_ALL, seconds=TEST_SECONDS)
    assert loaded.returncode == 0, loaded.stderr[-4000:]


@pytest.mark.soak
def test_what_rests_on_each_package_works_with_its_oldest_version(python: Path) -> None:
    files = [file for tests in SEAMS.values() for file in tests]
    quietly = ("-q", "--tb=short", "-p", "no:cacheprovider", "-m", "not heavy and not soak and not property")
    done = run(python, "-m", "pytest", *quietly, *files, seconds=TEST_SECONDS)
    assert done.returncode == 0, done.stdout[-20000:] + done.stderr[-2000:]


@pytest.mark.soak
def test_every_default_test_passes_with_the_oldest_versions(python: Path) -> None:
    done = run(python, "-m", "tests", "-q", "--tb=short", "-p", "no:cacheprovider", seconds=TEST_SECONDS)
    assert done.returncode == 0, done.stdout[-20000:] + done.stderr[-2000:]
