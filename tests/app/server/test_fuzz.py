"""Every operation of the API under valid, nearly valid and hostile requests: no error of the server, no wait.

`FOOTFALL_FUZZ_SEED` repeats the requests of an earlier run, `FOOTFALL_FUZZ_REQUESTS` says how many.
"""

from __future__ import annotations

import os
import secrets
import sys
from collections.abc import Iterator
from pathlib import Path
from random import Random
from statistics import median

import pytest

from tests.support.fuzz.campaign import Campaign, Memory, failure
from tests.support.fuzz.client import Answered, Connection
from tests.support.fuzz.operations import operations_of
from tests.support.fuzz.report import report, tracebacks
from tests.support.fuzz.requests import Asked, Requests
from tests.support.fuzz.stock import film, stocked
from tests.support.fuzz.values import Pairs, Raw, encoded, mutated
from tests.support.studio_process import PROGRAM, StudioProcess, running_studio

REQUESTS = int(os.environ.get("FOOTFALL_FUZZ_REQUESTS", "20000"))
MOST_GROWTH = 0.15
"""Of the memory of the studio and its processes, from 30 % of the requests to the last ones."""


@pytest.fixture
def studio(tmp_path: Path) -> Iterator[StudioProcess]:
    file = tmp_path / "film.avi"
    file.write_bytes(film())
    with running_studio(tmp_path / "data", "--camera", f"film={file}", program=PROGRAM) as running:
        yield running


@pytest.mark.heavy
def test_no_request_makes_an_error_a_long_wait_or_a_leak(studio: StudioProcess, tmp_path: Path) -> None:
    seed = int(os.environ.get("FOOTFALL_FUZZ_SEED") or secrets.randbelow(10**6))
    stock, description = stocked(studio), studio.ask("GET", "/openapi.json").content
    requests = Requests(operations_of(description), description["components"]["schemas"], stock, seed)
    outcome = Campaign(studio, requests, stock, REQUESTS).run()
    found = report(outcome, seed, studio.url, tmp_path)
    sys.stdout.write(f"\n{found}\n")
    assert not outcome.failures, found
    assert growth([one.everything for one in outcome.memory]) < MOST_GROWTH, found
    assert studio.said is not None
    assert not tracebacks(studio.said.read_text(errors="replace"))
    for path in (
        "/api/health",
        "/api/gaits",
        "/api/gaits/deleted",
        "/api/runs",
        "/api/trials",
        "/api/videos",
    ):
        assert studio.ask("GET", path).status == 200
    assert studio.ask("POST", "/api/robot/stop").status == 200


def growth(sizes: list[int]) -> float:
    """How much more there is in the last tenth than from 30 to 40 %, as a share."""
    tenth = max(1, len(sizes) // 10)
    return median(sizes[-tenth:]) / median(sizes[3 * tenth : 4 * tenth]) - 1.0


@pytest.mark.parametrize(
    ("asked", "answered", "kind"),
    [
        (Asked(1, "", "near", "GET", "/api/gaits"), Answered(200, 0.1), None),
        (Asked(1, "", "near", "GET", "/api/gaits"), Answered(200, 5.1), "slow"),
        (Asked(1, "", "near", "GET", "/api/gaits"), Answered(500, 0.1), "500"),
        (Asked(1, "", "near", "GET", "/api/gaits"), Answered(0, 0.1), "no answer"),
        (Asked(1, "", "near", "GET", "/api/gaits", is_whole=False), Answered(0, 0.1), None),
        (Asked(1, "", "near", "GET", "/api/gaits"), Answered(422, 0.1, body=b'{"error": "No."}'), None),
        (Asked(1, "", "near", "GET", "/api/gaits"), Answered(422, 0.1, body=b"{}"), "422 without a sentence"),
        (Asked(1, "", "near", "GET", "/api/gaits"), Answered(503, 0.1, body=b'{"error": "No."}'), "503"),
        (Asked(1, "", "near", "GET", "/api/robot"), Answered(503, 0.1, body=b'{"error": "No."}'), None),
    ],
)
def test_what_counts_as_a_failure(asked: Asked, answered: Answered, kind: str | None) -> None:
    assert failure(asked, answered) == kind


def test_memory_that_grows_is_seen_and_a_plateau_is_none() -> None:
    memory = [Memory(number, 100 + number, 50) for number in range(100)]
    assert growth([one.everything for one in memory]) > MOST_GROWTH
    assert growth([min(one.everything, 120) for one in memory]) == 0.0


def test_a_document_can_hold_what_json_does_not_write() -> None:
    value = Pairs((("a", [Raw("NaN"), "\ud800"]), ("a", {"b": None})))
    assert encoded(value) == '{"a":[NaN,"\\ud800"],"a":{"b":null}}'


def test_the_same_seed_changes_a_document_in_the_same_way_and_leaves_the_document_alone() -> None:
    document = {"a": [1, 2.0, "b"], "c": {"d": [[0]]}}
    before = encoded(document)
    changed = {encoded(mutated(document, Random(seed))) for seed in range(50)}
    assert changed == {encoded(mutated(document, Random(seed))) for seed in range(50)}
    assert len(changed) > 30
    assert encoded(document) == before


def test_the_last_lines_of_tracebacks_are_counted() -> None:
    head = "ERROR: x\nTraceback (most recent call last):\n"
    text = f'{head}  File "a.py", line 1, in f\n    g()\nValueError: no\nmore\n'
    assert tracebacks(text * 2) == {"ValueError: no": 2}
    assert not tracebacks("Nothing.\n")


def test_a_connection_says_that_nobody_answers() -> None:
    connection = Connection("http://127.0.0.1:9/")
    assert connection.ask(Asked(1, "", "near", "GET", "/")).status == 0
