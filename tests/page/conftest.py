"""Studios for the tests of one file.

A file that says `SHARES_STUDIO = True` gets the studio that all such files share: its tests edit gaits of
their own, leave those that come with the program as they are, and do not ask what is in lists of jobs, runs
or trials.
"""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.support.studio_process import StudioProcess, running_studio


@pytest.fixture(scope="module")
def studio(
    tmp_path_factory: pytest.TempPathFactory, request: pytest.FixtureRequest
) -> Iterator[StudioProcess]:
    """A running studio: the shared one, or an empty one; told of a robot where the file has a `SPEED`."""
    if getattr(request.module, "SHARES_STUDIO", False):
        yield request.getfixturevalue("lent_studio")
        return
    has_robot = hasattr(request.module, "SPEED")
    words = ("--robot", request.getfixturevalue("robot").device) if has_robot else ()
    with running_studio(tmp_path_factory.mktemp("data"), *words) as running:
        yield running
