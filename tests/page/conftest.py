"""Studios for the tests of one file.

A file that says `SHARES_STUDIO = True` gets the studio that all such files share: its tests edit gaits of
their own, leave those that come with the program as they are, and do not ask what is in lists of jobs, runs
or trials.
"""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.support.studio_process import StudioProcess, running_studio


@pytest.fixture(scope="session")
def shared_studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    """A running studio without a robot, for many files."""
    with running_studio(tmp_path_factory.mktemp("shared")) as running:
        yield running


@pytest.fixture(scope="module")
def studio(
    tmp_path_factory: pytest.TempPathFactory, request: pytest.FixtureRequest
) -> Iterator[StudioProcess]:
    """A running studio: the shared one, or an empty one; told of a robot where the file has a `SPEED`."""
    if getattr(request.module, "SHARES_STUDIO", False):
        shared: StudioProcess = request.getfixturevalue("shared_studio")
        yield shared
        put_back(shared, request.module.__name__)
        return
    has_robot = hasattr(request.module, "SPEED")
    words = ("--robot", request.getfixturevalue("robot").device) if has_robot else ()
    with running_studio(tmp_path_factory.mktemp("data"), *words) as running:
        yield running


def put_back(studio: StudioProcess, module: str) -> None:
    """Deletes the gaits that a file has made; those of the program have to be as they came."""
    for line in studio.ask("GET", "/api/gaits").content["gaits"]:
        if line["kind"] == "saved":
            assert studio.ask("DELETE", f"/api/gaits/{line['id']}").status == 200
        else:
            assert not line["edited"], f"{module} left {line['id']} of the shared studio edited"
