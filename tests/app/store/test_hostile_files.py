"""A data folder that somebody else filled: the studio starts, lists what is there, and says what is wrong."""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from app.studio.studio import Studio
from tests.support.hostile_files import NO_FILES, put_hostile_gaits, put_no_files
from tests.support.studio_process import StudioProcess, running_studio

LIST_SECONDS, START_SECONDS = 1.0, 5.0


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("hostile")


@pytest.fixture(scope="module")
def ids(data: Path) -> list[str]:
    return put_hostile_gaits(data)


@pytest.fixture(scope="module")
def studio(data: Path, ids: list[str]) -> Iterator[StudioProcess]:
    with running_studio(data) as running:
        yield running
        assert "Traceback" not in (running.said or Path()).read_text()


def test_a_studio_starts_and_lists_among_hostile_gaits_at_once(data: Path, ids: list[str]) -> None:
    assert len(ids) >= 40
    # Seconds of the processor, whatever else runs beside the test.
    began = time.process_time()
    studio = Studio(data, "emulator")
    try:
        started = time.process_time()
        greeting = studio.call(studio.hello).result(60)
        greeted = time.process_time()
    finally:
        studio.close()
    assert set(ids) <= {line["id"] for line in greeting["gaits"]}
    assert started - began < START_SECONDS
    assert greeted - started < LIST_SECONDS


def listed(studio: StudioProcess) -> dict[str, Any]:
    return {line["id"]: line for line in studio.ask("GET", "/api/gaits").content["gaits"]}


def test_every_file_is_a_line_of_the_list_with_its_fault(studio: StudioProcess, ids: list[str]) -> None:
    lines = listed(studio)
    assert set(ids) <= set(lines)
    assert [one for one in ids if not lines[one]["problem"]] == []
    assert not lines["walk"]["problem"]


def test_no_file_makes_an_answer_of_500(studio: StudioProcess, ids: list[str]) -> None:
    for gait in ids:
        statuses = {
            path: studio.ask(method, f"/api/gaits/{gait}{path}").status
            for method, path in (("GET", ""), ("GET", "/view"), ("POST", "/check"), ("POST", "/approve"))
        }
        assert max(statuses.values()) < 500, (gait, statuses)


@pytest.mark.parametrize("kind", NO_FILES)
def test_a_studio_starts_whatever_stands_where_its_files_are(kind: str, tmp_path: Path) -> None:
    put_no_files(tmp_path, kind)
    studio = Studio(tmp_path, "emulator")
    try:
        greeting = studio.call(studio.hello).result(20)
        assert greeting["gaits"]
        studio.gaits.deleted()
    finally:
        studio.close()
