"""Distributions of this checkout, and environments in which they are installed."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.repository.distributions import built, copied_source, installed


@pytest.fixture(scope="session")
def distributions(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the source distribution and the wheel of this checkout."""
    folder = tmp_path_factory.mktemp("distributions")
    source = copied_source(folder / "source")
    for kind in ("sdist", "wheel"):
        built(source, kind, folder)
    return folder


@pytest.fixture(scope="session")
def wheel_python(distributions: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The Python of an environment with the wheel."""
    return installed(next(distributions.glob("*.whl")), tmp_path_factory.mktemp("wheel"))


@pytest.fixture(scope="session")
def editable_python(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The Python of an environment with a checkout, as `pip install -e` makes it."""
    folder = tmp_path_factory.mktemp("editable")
    wheel = built(copied_source(folder / "source"), "editable", folder)
    return installed(wheel, folder / "environment")
