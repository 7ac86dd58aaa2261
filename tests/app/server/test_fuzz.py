"""Every operation of the API under valid, nearly valid and hostile requests: no error of the server, no wait.

`FOOTFALL_FUZZ_SEED` repeats the requests of an earlier run, `FOOTFALL_FUZZ_REQUESTS` says how many.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from random import Random
from statistics import median

import pytest

from tests.support.fuzz.campaign import Campaign, Memory, Outcome, failure, together
from tests.support.fuzz.client import Answered, Connection
from tests.support.fuzz.operations import operations_of
from tests.support.fuzz.report import report, tracebacks
from tests.support.fuzz.requests import Asked, Requests
from tests.support.fuzz.stock import film, stocked
from tests.support.fuzz.values import Pairs, Raw, encoded, mutated
from tests.support.soak import is_soak, seed_of, soaked
from tests.support.studio_process import PROGRAM, StudioProcess, running_studio

REQUESTS = soaked(20_000, 300, "FOOTFALL_FUZZ_REQUESTS")
PARTS = 8
"""In which they are sent, each within the time that a test may take on a busy machine."""

MOST_GROWTH = 0.15
"""Of the memory of the studio and its processes, from 30 % of the requests to the last ones."""


@dataclass(frozen=True)
class Attack:
    """A campaign against a studio of its own.

    Args:
        studio: that is attacked.
        campaign: what is sent, and what came of it.
        seed: of the requests.
        folder: where requests that failed are kept.
    """

    studio: StudioProcess
    campaign: Campaign
    seed: int
    folder: Path

    def words(self, outcome: Outcome) -> str:
        """What came of a part, for people."""
        return f"\n{report(outcome, self.seed, self.studio.url, self.folder)}\n"


@pytest.fixture(scope="module")
def attack(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Attack]:
    seed = seed_of("FOOTFALL_FUZZ_SEED")
    folder = tmp_path_factory.mktemp("fuzz")
    file = folder / "film.avi"
    file.write_bytes(film())
    with running_studio(folder / "data", "--camera", f"film={file}", program=PROGRAM) as studio:
        stock, description = stocked(studio), studio.ask("GET", "/openapi.json").content
        operations = operations_of(description)
        requests = Requests(operations, description["components"]["schemas"], stock, seed)
        yield Attack(studio, Campaign(studio, requests, stock), seed, folder)


@pytest.mark.soak(short=True)
@pytest.mark.parametrize("part", range(PARTS))
def test_no_request_makes_an_error_or_a_long_wait(attack: Attack, part: int) -> None:
    outcome = attack.campaign.run(REQUESTS // PARTS)
    words = attack.words(outcome)
    sys.stdout.write(f"part {part}: {words}")
    assert not outcome.failures, words


@pytest.mark.soak(short=True)
def test_after_all_that_the_studio_is_as_good_as_new_and_after_a_soak_its_memory_flat(attack: Attack) -> None:
    words = attack.words(together(attack.campaign.parts))
    sys.stdout.write(words)
    sizes = [one.everything for part in attack.campaign.parts for one in part.memory]
    # A short run is all beginning, in which caches fill.
    assert not is_soak() or growth(sizes) < MOST_GROWTH, words
    assert attack.studio.said is not None
    assert not tracebacks(attack.studio.said.read_text(errors="replace"))
    for path in ("health", "gaits", "gaits/deleted", "runs", "trials", "videos", "setups", "jobs"):
        assert attack.studio.ask("GET", f"/api/{path}").status == 200
    assert attack.studio.ask("POST", "/api/robot/stop").status == 200


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
