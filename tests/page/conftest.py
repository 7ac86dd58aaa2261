"""A studio for the tests of one file."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.studio_process import StudioProcess, running_studio


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    """A running studio with an empty data folder."""
    with running_studio(tmp_path_factory.mktemp("data")) as running:
        yield running
