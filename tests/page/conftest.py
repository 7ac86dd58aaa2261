"""A studio for the tests of one file."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.support.studio_process import StudioProcess, running_studio


@pytest.fixture(scope="module")
def studio(
    tmp_path_factory: pytest.TempPathFactory, request: pytest.FixtureRequest
) -> Iterator[StudioProcess]:
    """A running studio with an empty data folder; told of a robot where the file has a `SPEED` for one."""
    has_robot = hasattr(request.module, "SPEED")
    words = ("--robot", request.getfixturevalue("robot").device) if has_robot else ()
    with running_studio(tmp_path_factory.mktemp("data"), *words) as running:
        yield running
