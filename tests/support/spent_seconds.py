"""Where the seconds of a run go: a table at its end, and how long each file takes, which orders the files."""

from __future__ import annotations

import json
import time
from collections.abc import Generator, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

FILE_SECONDS = Path(__file__).with_suffix(".json")
"""Seconds of each slow file of tests, by its path in the project, as `--keep-seconds` has measured them."""
LEAST = 2.0
"""Seconds from which on a file is kept there."""

SPENT: dict[str, float] = {}
"""Seconds of this process by what they were for."""


def add(sums: dict[str, float], more: Mapping[str, float]) -> None:
    """Adds seconds to those of the same name."""
    for name, seconds in more.items():
        sums[name] = sums.get(name, 0.0) + seconds


@contextmanager
def spending(purpose: str) -> Iterator[None]:
    """Adds the seconds of its body to those that the purpose has."""
    begun = time.monotonic()
    try:
        yield
    finally:
        add(SPENT, {purpose: time.monotonic() - begun})


def known_seconds() -> dict[str, float]:
    """Seconds of the slow files, by path."""
    content: dict[str, float] = json.loads(FILE_SECONDS.read_text())
    return content


class SpentSeconds:
    """Counts in each process of the tests, and tells of all of them together at the end.

    Args:
        keeps: whether the files' seconds are kept for later runs.
    """

    def __init__(self, keeps: bool) -> None:
        self._keeps = keeps
        self._files: dict[str, float] = {}

    @pytest.hookimpl(wrapper=True)
    def pytest_collection(self) -> Generator[None, object, object]:
        """Counts the seconds of collection."""
        with spending("collection"):
            return (yield)

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Counts a part of a test for its file."""
        add(self._files, {report.nodeid.partition("::")[0]: report.duration})

    @pytest.hookimpl(trylast=True)
    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        """Gives the main process what this one has counted, or keeps the files' seconds."""
        output: dict[str, Any] | None = getattr(session.config, "workeroutput", None)
        if output is not None:
            output["spent"] = dict(SPENT)
        elif self._keeps:
            known = known_seconds() | self._files
            slow = {path: round(of, 1) for path, of in known.items() if of >= LEAST and Path(path).exists()}
            FILE_SECONDS.write_text(json.dumps(slow, indent=1, sort_keys=True) + "\n")

    @pytest.hookimpl(optionalhook=True)
    def pytest_testnodedown(self, node: Any) -> None:
        """Adds what one of the processes has counted."""
        add(SPENT, getattr(node, "workeroutput", {}).get("spent", {}))

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        """Says what the seconds were for."""
        terminalreporter.section("seconds of all processes together")
        tests = sum(self._files.values())
        for purpose, seconds in {"tests": tests, **SPENT}.items():
            terminalreporter.line(f"{seconds:8.0f} s  {purpose}")
