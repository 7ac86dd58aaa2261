"""The wheel holds everything that the program needs outside the checkout."""

from __future__ import annotations

import ast
import inspect
import os
import shutil
import subprocess
import sys
import sysconfig
import venv
from pathlib import Path

import pytest

import footfall
from tests.support.studio_process import PROGRAM, PROJECT, running_studio

NO_SOURCE = (".git", ".venv", "node_modules", ".hypothesis", "build", "*.egg-info", "__pycache__", ".*_cache")


def run_quietly(*words: str) -> None:
    subprocess.run(words, check=True, capture_output=True, timeout=180)


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where the wheel is installed, far from the checkout."""
    folder = tmp_path_factory.mktemp("wheel")
    source, wheels, target = folder / "source", folder / "wheels", folder / "installed"
    shutil.copytree(PROJECT, source, ignore=shutil.ignore_patterns(*NO_SOURCE))
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--no-input"]
    run_quietly(*pip, "wheel", "--no-deps", "--no-build-isolation", "-w", str(wheels), str(source))
    wheel = next(wheels.glob("*.whl"))
    run_quietly(*pip, "install", "--no-deps", "--target", str(target), str(wheel))
    return target


@pytest.mark.heavy
def test_a_wheel_serves_the_studio_far_from_the_checkout(installed: Path, tmp_path: Path) -> None:
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


SCRIPT = """
import footfall as ff
plan = ff.optimise("walk", step=0.010, margin=0.006, method="live")
print(plan.status, ff.check(plan).passed, ff.__version__)
"""


@pytest.mark.heavy
def test_import_footfall_works_from_the_wheel_beside_files_of_the_same_names(
    installed: Path, tmp_path: Path
) -> None:
    for name in ("app", "core"):
        (tmp_path / f"{name}.py").write_text("mine = True\n")
    (tmp_path / "script.py").write_text(f"import app, core{SCRIPT}assert app.mine and core.mine\n")
    done = subprocess.run(
        [sys.executable, "script.py"],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(installed)},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.stdout.split()[:2] == ["solved", "True"], done.stderr


@pytest.mark.heavy
def test_types_reach_users(installed: Path, tmp_path: Path) -> None:
    """Mypy reads the stubs of the wheel, as a user's own check does."""
    home = tmp_path / "fresh"
    venv.create(home, with_pip=False)
    packages = next((home / "lib").glob("python*/site-packages"))
    for name in ("footfall.py", "footfall-stubs"):
        (packages / name).symlink_to(installed / name)
    (packages / "numpy.pth").write_text(sysconfig.get_path("purelib") + "\n")
    script = tmp_path / "six.py"
    script.write_text(
        "import footfall as ff\n"
        'plan = ff.optimise("walk", step=0.010, margin=0.006)\n'
        "print(plan.status, ff.check(plan).passed)\n"
        'run = ff.send(plan, to="emulator", by="Ada")\n'
        "print(run.measured.shape)\n"
        "reveal_type(run.seconds)\n"
        "plan.body.no_such_thing\n"
    )
    mypy = [
        sys.executable,
        "-m",
        "mypy",
        "--strict",
        "--no-incremental",
        "--config-file=",
        "--python-executable",
    ]
    words = [*mypy, str(home / "bin" / "python"), str(script)]
    said = subprocess.run(
        words, cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False
    ).stdout
    assert 'Revealed type is "float"' in said or 'Revealed type is "builtins.float"' in said
    assert '"no_such_thing"' in said
    assert "Found 1 error" in said


def test_the_stubs_say_what_the_module_has() -> None:
    stubs = ast.parse((PROJECT / "footfall-stubs" / "__init__.pyi").read_text())
    said = {
        node.name: node
        for node in stubs.body
        if isinstance(node, ast.ClassDef | ast.FunctionDef) and not node.name.startswith("_")
    }
    assert sorted(said) == footfall.__all__
    for name, node in said.items():
        value = getattr(footfall, name)
        if isinstance(node, ast.FunctionDef):
            arguments = [*node.args.args, *node.args.kwonlyargs]
            names = [argument.arg for argument in arguments]
            kinds = inspect.signature(value).parameters.values()
            own = [one.name for one in kinds if one.kind not in (one.VAR_POSITIONAL, one.VAR_KEYWORD)]
            assert sorted(names) == sorted(own), name
            continue
        for member in node.body:
            if isinstance(member, ast.FunctionDef) and member.name != "__init__":
                assert hasattr(value, member.name), f"{name}.{member.name}"
