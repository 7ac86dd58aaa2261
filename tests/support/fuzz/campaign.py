"""Many requests at a time against a running studio: what came back, how long it took, and the memory."""

from __future__ import annotations

import json
import threading
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import closing, suppress
from dataclasses import dataclass, field
from typing import Any

from tests.support.fuzz.client import Answered, Connection
from tests.support.fuzz.memory import resident_bytes
from tests.support.fuzz.requests import Asked, Requests
from tests.support.fuzz.stock import Stock, approve
from tests.support.studio_process import StudioProcess

CONNECTIONS = 4
LONGEST_SECONDS = 5.0
"""No answer takes longer."""

TIDY_EVERY = 500
"""Requests after which the stored gaits are as they were, and the robot is ready again."""
MEMORY_EVERY = 100
"""Requests after which the memory is read."""

LONGEST_LIST = 10
MAY_BE_ABSENT = ("/api/robot", "/api/cameras")
"""What stands behind these may be gone, which is answered by 503 and a sentence."""

MADE: dict[str, str] = {
    "POST /api/gaits": "/api/gaits/{id}",
    "POST /api/gaits/import": "/api/gaits/{id}",
    "POST /api/gaits/drawn": "/api/gaits/{id}",
    "POST /api/patterns/gait": "/api/gaits/{id}",
    "POST /api/sequences": "/api/gaits/{id}",
    "POST /api/jobs": "/api/jobs/{id}",
    "POST /api/videos/{video}/track": "/api/jobs/{id}",
    "POST /api/patterns": "/api/patterns/{id}",
    "POST /api/trials": "/api/trials/{id}",
    "POST /api/trials/{trial}/photos": "/api/trials/{trial}/photos/{id}",
    "POST /api/setups": "/api/setups/{id}",
    "POST /api/videos": "/api/videos/{id}",
    "POST /api/learning": "/api/learning/{id}",
}
"""Where what a request has made is deleted or ended again."""


@dataclass(frozen=True)
class Memory:
    """Memory after so many requests, in bytes: of all processes, and of the studio's own."""

    requests: int
    everything: int
    studio: int


@dataclass
class Outcome:
    """What came of the requests.

    Args:
        statuses: how often each came back; 0 is no answer.
        slowest: the longest answers, the longest first.
        failures: by operation and kind of failure, with the first ones of each.
        counts: how often each failed.
        memory: on the way.
        seconds: in all.
    """

    statuses: Counter[int] = field(default_factory=Counter)
    slowest: list[tuple[float, Asked, int]] = field(default_factory=list)
    failures: dict[tuple[str, str], list[tuple[Asked, Answered]]] = field(default_factory=dict)
    counts: Counter[tuple[str, str]] = field(default_factory=Counter)
    memory: list[Memory] = field(default_factory=list)
    seconds: float = 0.0

    def add(self, asked: Asked, answered: Answered) -> None:
        """Counts an answer."""
        self.statuses[answered.status] += 1
        self.slowest.append((answered.seconds, asked, answered.status))
        self.slowest.sort(key=lambda one: -one[0])
        del self.slowest[LONGEST_LIST:]
        kind = failure(asked, answered)
        if kind is not None:
            key = (asked.operation, kind)
            self.counts[key] += 1
            kept = self.failures.setdefault(key, [])
            if len(kept) < 3:
                kept.append((asked, answered))


def together(parts: Sequence[Outcome]) -> Outcome:
    """What came of all parts."""
    whole = Outcome()
    for part in parts:
        whole.statuses += part.statuses
        whole.counts += part.counts
        whole.failures |= part.failures
        whole.memory += part.memory
        whole.seconds += part.seconds
        whole.slowest += part.slowest
    whole.slowest = sorted(whole.slowest, key=lambda one: -one[0])[:LONGEST_LIST]
    return whole


def failure(asked: Asked, answered: Answered) -> str | None:
    """What is wrong with an answer; None where nothing is."""
    if answered.status == 0:
        return None if asked.may_be_cut else "no answer"
    sentence = _sentence(answered)
    if answered.status >= 500:
        is_absent = answered.status == 503 and asked.target.startswith(MAY_BE_ABSENT) and sentence
        return None if is_absent else str(answered.status)
    if answered.seconds > LONGEST_SECONDS:
        return "slow"
    is_refused = answered.status >= 400 and asked.is_http and asked.method not in ("HEAD", "TRACE")
    return f"{answered.status} without a sentence" if is_refused and not sentence else None


def _sentence(answered: Answered) -> str | None:
    with suppress(ValueError, TypeError, KeyError):
        return str(json.loads(answered.body)["error"])
    return None


class Campaign:
    """Sends requests over some connections at once.

    Args:
        studio: that is attacked.
        requests: what is sent.
        stock: what the studio holds.

    Attributes:
        parts: what came of each part so far.
    """

    def __init__(self, studio: StudioProcess, requests: Requests, stock: Stock) -> None:
        self._studio, self._requests, self._stock = studio, requests, stock
        self.parts: list[Outcome] = []
        self._numbers: Iterator[int] = iter(())
        self._lock = threading.Lock()
        self._tidying = threading.Lock()
        self._outcome = Outcome()
        self._done = 0
        self._broken: list[BaseException] = []

    def run(self, count: int) -> Outcome:
        """Sends so many more of them, then repeats the slow ones with nothing else under way."""
        begun = time.monotonic()
        self._outcome = Outcome()
        self._numbers = iter(range(self._done, self._done + count))
        threads = [threading.Thread(target=self._guarded, name=f"fuzz {n}") for n in range(CONNECTIONS)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        if self._broken:
            raise self._broken[0]
        self._outcome.seconds = time.monotonic() - begun
        self._repeat_slow_ones()
        self.parts.append(self._outcome)
        return self._outcome

    def _guarded(self) -> None:
        try:
            self._send_all()
        except BaseException as error:
            self._broken.append(error)

    def _send_all(self) -> None:
        with closing(Connection(self._studio.url)) as connection:
            while not self._broken and (number := self._next()) is not None:
                if number % TIDY_EVERY == TIDY_EVERY - 1:
                    self._tidy_up()
                asked = self._requests.request(number)
                answered = connection.ask(asked)
                self._undo(connection, asked, answered)
                with self._lock:
                    self._outcome.add(asked, answered)
                    self._done += 1
                    if self._done % MEMORY_EVERY == 0:
                        self._outcome.memory.append(self._memory())

    def _next(self) -> int | None:
        with self._lock:
            return next(self._numbers, None)

    def _memory(self) -> Memory:
        sizes = resident_bytes(self._studio.pid)
        return Memory(self._done, sum(sizes.values()), sizes[self._studio.pid])

    def _undo(self, connection: Connection, asked: Asked, answered: Answered) -> None:
        """Deletes what a request has made, brings back what it has deleted."""
        path = asked.target.partition("?")[0]
        if asked.method == "DELETE" and answered.status == 200:
            connection.ask(Asked(asked.number, "", "undo", "POST", f"{path}/restore"))
        where = MADE.get(asked.operation)
        if where is None or answered.status not in (201, 202):
            return
        with suppress(ValueError, TypeError, KeyError):
            made = where.replace("{id}", str(json.loads(answered.body)["id"]))
            trial = path.split("/")[3] if "{trial}" in made else ""
            connection.ask(Asked(asked.number, "", "undo", "DELETE", made.replace("{trial}", trial)))

    def _tidy_up(self) -> None:
        """The gaits as they were, and the robot connected, approved and armed."""
        with self._tidying, suppress(AssertionError):
            for gait, document in self._stock.documents.items():
                self._studio.ask("PUT", f"/api/gaits/{gait}", document)
            actions: tuple[tuple[str, Any], ...] = (
                ("fault", {"name": "none"}),
                ("connect", {}),
                ("clear", {}),
                ("arm", {}),
            )
            for action, content in actions:
                self._studio.ask("POST", f"/api/robot/{action}", content)
            approve(self._studio, "walk")

    def _repeat_slow_ones(self) -> None:
        """A request counts as slow if it is slow alone too; the machine may have been busy with others."""
        for key in [key for key in self._outcome.failures if key[1] == "slow"]:
            connection = Connection(self._studio.url)
            again = [connection.ask(asked) for asked, _ in self._outcome.failures[key]]
            connection.close()
            if all(one.seconds <= LONGEST_SECONDS for one in again):
                del self._outcome.failures[key]
