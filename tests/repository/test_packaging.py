"""The wheel holds everything that the program needs outside the checkout."""

from __future__ import annotations

import ast
import inspect
import subprocess
import sys
from pathlib import Path

import pytest

import footfall
from tests.repository.distributions import run
from tests.support.studio_process import PROJECT, running_studio


@pytest.mark.heavy
def test_a_wheel_serves_the_studio_far_from_the_checkout(wheel_python: Path, tmp_path: Path) -> None:
    command = wheel_python.with_name("footfall")
    with running_studio(tmp_path / "data", cwd=tmp_path, program=(str(command),)) as studio:
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
    wheel_python: Path, tmp_path: Path
) -> None:
    for name in ("app", "core"):
        (tmp_path / f"{name}.py").write_text("mine = True\n")
    (tmp_path / "script.py").write_text(f"import app, core{SCRIPT}assert app.mine and core.mine\n")
    assert run(wheel_python, "script.py", cwd=tmp_path, seconds=60).split()[:2] == ["solved", "True"]


@pytest.mark.heavy
def test_types_reach_users(wheel_python: Path, tmp_path: Path) -> None:
    """Mypy reads the stubs of the wheel, as a user's own check does."""
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
    words = [*mypy, str(wheel_python), str(script)]
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
