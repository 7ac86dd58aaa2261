"""Wheel and source distribution: what they hold, and that they run on every Python; the image."""

from __future__ import annotations

import re
import shutil
import sys
import tarfile
import tomllib
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from app.cli.parser import make_parser
from tests.repository.distributions import INSTALL_SECONDS, built, run
from tests.repository.test_oldest_versions import answers, can_fetch
from tests.repository.test_packaging import SCRIPT
from tests.support.studio_process import PROJECT, running_studio

PYTHONS = ("3.11", "3.12", "3.13", "3.14")
"""The Pythons that are supported."""
IMAGE = PROJECT / "docs" / "docker" / "Dockerfile"
ORDERS = re.findall(r"^([A-Z]+) (.+)$", IMAGE.read_text(encoding="utf-8"), re.MULTILINE)
"""The lines of the image's recipe, as instruction and its text."""


def files_of(wheel: Path) -> dict[str, int]:
    """Files of a wheel with the checksums of their contents, its own list of them left out."""
    with zipfile.ZipFile(wheel) as file:
        return {one.filename: one.CRC for one in file.infolist() if not one.filename.endswith("/RECORD")}


@pytest.fixture(scope="module")
def unpacked(distributions: Path) -> Path:
    """The folder in the source distribution."""
    target = distributions / "unpacked"
    with tarfile.open(next(distributions.glob("*.tar.gz"))) as file:
        file.extractall(target, filter="data")
    (inside,) = target.iterdir()
    return inside


@pytest.mark.heavy
def test_the_source_distribution_makes_the_same_wheel_as_the_checkout(
    distributions: Path, unpacked: Path, tmp_path: Path
) -> None:
    wheel = files_of(next(distributions.glob("*.whl")))
    assert files_of(built(unpacked, "wheel", tmp_path)) == wheel
    assert len(wheel) > 700


@pytest.mark.heavy
def test_the_wheel_has_every_file_of_the_program_and_no_other(distributions: Path) -> None:
    wheel = {name for name in files_of(next(distributions.glob("*.whl"))) if ".dist-info/" not in name}
    places = {
        "footfall-stubs": "",
        **dict.fromkeys(("app", "core", "robot_description", "solver_jobs"), "footfall_studio/"),
    }
    program = {
        f"{place}{path.relative_to(PROJECT)}"
        for package, place in places.items()
        for path in (PROJECT / package).rglob("*")
        if path.is_file() and path.suffix != ".pyc"
    }
    assert wheel == program | {"footfall.py"}


@pytest.mark.heavy
def test_both_have_licence_and_description(distributions: Path, unpacked: Path) -> None:
    wheel = files_of(next(distributions.glob("*.whl")))
    assert [name for name in wheel if name.endswith("licenses/LICENSE")]
    assert {"LICENSE", "PKG-INFO", "README.md", "pyproject.toml"} <= {
        path.name for path in unpacked.iterdir()
    }
    assert "# Footfall Studio" in (unpacked / "PKG-INFO").read_text(encoding="utf-8")


@pytest.fixture(params=PYTHONS)
def environment(request: pytest.FixtureRequest, distributions: Path, tmp_path: Path) -> Iterator[str]:
    """The Python of a new environment into which the wheel was installed, by the tested versions."""
    name = f"python{request.param}"
    if sys.version_info[:2] == tuple(map(int, request.param.split("."))):
        name = sys.executable
    elif shutil.which(name) is None or not answers(name):
        pytest.skip(f"Python {request.param} is not here.")
    home = tmp_path / "environment"
    run(name, "-m", "venv", home, cwd=tmp_path, seconds=INSTALL_SECONDS)
    inside = home / "bin" / "python"
    if not can_fetch(inside, tmp_path / "fetched"):
        pytest.skip("No packages can be obtained here, so that nothing can be installed.")
    pip = (inside, "-m", "pip", "install", "-q", "--no-compile", "--only-binary", ":all:")
    wheel = next(distributions.glob("*.whl"))
    run(*pip, "-c", PROJECT / "constraints.txt", wheel, cwd=tmp_path, seconds=INSTALL_SECONDS)
    yield str(inside)
    shutil.rmtree(home)


@pytest.mark.soak
@pytest.mark.timeout(2 * INSTALL_SECONDS)
def test_the_wheel_runs_on_every_supported_python_far_from_the_checkout(
    environment: str, tmp_path: Path
) -> None:
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    command = Path(environment).with_name("footfall")
    assert "fast-c-gait" in run(command, "gaits", cwd=elsewhere, seconds=120)
    run(command, "doctor", "--data", elsewhere / "data", cwd=elsewhere, seconds=120)
    assert run(environment, "-c", SCRIPT, cwd=elsewhere, seconds=120).split()[:2] == ["solved", "True"]
    with running_studio(elsewhere / "data", cwd=elsewhere, program=(str(command),)) as studio:
        assert studio.text("/").startswith("<!doctype html>")
        assert studio.ask("GET", "/api/gaits/walk/view").content["plan"]["strokes_mm"] is not None


def test_the_supported_pythons_are_those_of_the_project_and_of_the_image() -> None:
    project = tomllib.loads((PROJECT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert project["requires-python"] == f">={PYTHONS[0]}"
    (python,) = (text.removeprefix("PYTHON=") for order, text in ORDERS if order == "ARG")
    assert python in PYTHONS


def test_the_image_serves_without_rights_and_demands_a_token() -> None:
    by_order = dict(ORDERS)
    assert by_order["ENTRYPOINT"] == '["footfall"]'
    words = re.findall(r'"([^"]+)"', by_order["CMD"])
    asked = make_parser().parse_args(words)
    # An address that is not loopback always demands a token (app/server/launch.py).
    assert (asked.host, asked.port, asked.token) == ("0.0.0.0", int(by_order["EXPOSE"]), None)
    orders = [order for order, _ in ORDERS]
    assert by_order["USER"] == "footfall"
    assert orders.index("USER") < orders.index("ENTRYPOINT")
    assert any("--groups dialout footfall" in text for order, text in ORDERS if order == "RUN")


def test_the_image_is_built_of_what_the_wheel_needs() -> None:
    listed = (IMAGE.parent / f"{IMAGE.name}.dockerignore").read_text(encoding="utf-8").splitlines()
    kept = [line[1:] for line in listed if line.startswith("!")]
    assert [name for name in kept if not (PROJECT / name).exists()] == []
    packages = {"app", "core", "footfall-stubs", "robot_description", "solver_jobs"}
    files = {"LICENSE", "README.md", "constraints.txt", "footfall.py", "pyproject.toml"}
    assert set(kept) == packages | files
    assert any("-c constraints.txt ." in text for order, text in ORDERS if order == "RUN")
