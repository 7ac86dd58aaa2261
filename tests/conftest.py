"""A headless Chromium with software rendering, and properties that are tried the same way each time."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator
from typing import Any

import pytest
from hypothesis import HealthCheck, is_hypothesis_test, settings
from playwright.sync_api import Browser, expect, sync_playwright

from app.emulator.emulated_robot import EmulatedRobot
from tests.support.chromium import LONG_MS, WORDS, chromium_path
from tests.support.patience import patient_robot
from tests.support.process_defaults import restore_defaults
from tests.support.spent_seconds import SpentSeconds, known_seconds
from tests.support.studio_process import StudioProcess, running_studio, said_by_studios
from tests.support.timeout import harden_timer

# A slow machine is no failure, and one commit gives one answer: only a soak draws other examples each time.
SLOW = [HealthCheck.too_slow]
settings.register_profile(
    "same", deadline=None, derandomize=True, max_examples=25, suppress_health_check=SLOW
)
settings.register_profile(
    "many", deadline=None, derandomize=True, max_examples=50, suppress_health_check=SLOW
)
settings.register_profile(
    "explore", deadline=None, max_examples=300, print_blob=True, suppress_health_check=SLOW
)
settings.load_profile("same")

TIMER = pytest.StashKey[Callable[[], None]]()
"""Starts the timer of a test again."""


def pytest_addoption(parser: pytest.Parser) -> None:
    """An option that measures anew how long each file takes."""
    parser.addoption("--keep-seconds", action="store_true", help="keep how long each slow file takes")


def pytest_configure(config: pytest.Config) -> None:
    """Has the run end with where its seconds went."""
    config.pluginmanager.register(SpentSeconds(config.getoption("--keep-seconds")))


@pytest.hookimpl(tryfirst=True)
def pytest_sessionstart() -> None:
    """Makes the tests independent of how they were started, before any process of theirs starts."""
    restore_defaults()


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Marks what Hypothesis tries, so that it can be chosen; puts the slow files first.

    Short files at the end keep both lanes busy to the last second.
    """
    for item in items:
        if isinstance(item, pytest.Function) and is_hypothesis_test(item.obj):
            item.add_marker("property")
    seconds = known_seconds()
    items.sort(key=lambda item: -seconds.get(item.nodeid.partition("::")[0], 0.0))


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(
    item: pytest.Item,
) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Shows what the studios wrote to standard error where a test fails."""
    report = yield
    said = said_by_studios() if report.failed else ""
    if said:
        report.sections.append((f"Standard error of the studios at the end of {item.name}", said))
    return report


@pytest.hookimpl(wrapper=True)
def pytest_timeout_set_timer(item: pytest.Item, settings: Any) -> Generator[None, bool, bool]:
    """Has a test that takes too long fail alone, wherever it waits."""
    is_set = yield
    item.stash[TIMER] = harden_timer(settings.timeout)
    return is_set


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_teardown(item: pytest.Item) -> None:
    """Gives the end of a test a time of its own; a failure has ended that of the test."""
    if TIMER in item.stash:
        item.stash[TIMER]()


@pytest.fixture(scope="module")
def robot(request: pytest.FixtureRequest) -> Iterator[EmulatedRobot]:
    """An emulated robot, as fast as the file's `SPEED` says: its seconds in one of ours."""
    with patient_robot(request.module.SPEED) as emulated:
        yield emulated


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    program = chromium_path()
    if program is None:
        pytest.skip("Chromium is not installed; `python -m tests` says how to get it")
    expect.set_options(timeout=LONG_MS)
    with sync_playwright() as playwright:
        opened = playwright.chromium.launch(executable_path=program, args=WORDS)
        yield opened
        opened.close()


@pytest.fixture(scope="session")
def shared_studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    """A running studio without a robot, for many files."""
    with running_studio(tmp_path_factory.mktemp("shared")) as running:
        yield running


@pytest.fixture(scope="module")
def lent_studio(shared_studio: StudioProcess, request: pytest.FixtureRequest) -> Iterator[StudioProcess]:
    """The shared studio for one file: its gaits are as they came before and after."""
    yield shared_studio
    put_back(shared_studio, request.module.__name__)


def put_back(studio: StudioProcess, module: str) -> None:
    """Deletes the gaits that a file has made; those of the program have to be as they came."""
    for line in studio.ask("GET", "/api/gaits").content["gaits"]:
        if line["kind"] == "saved":
            assert studio.ask("DELETE", f"/api/gaits/{line['id']}").status == 200
        else:
            assert not line["edited"], f"{module} left {line['id']} of the shared studio edited"
