"""An hour of telemetry at the robot's full rate: memory, what is kept of it, and what a page sees of it."""

import json
import tempfile
import threading
import time
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from app.bench.common.measure import Row, milliseconds
from app.bench.robot.processes import ANSWER_SECONDS, Studio, Tap, emulator_process, wait_until
from app.emulator.profiles import ProfileName
from app.store.database import Database
from core.errors import StateError

HOUR = 3600.0
SPEED = 10.0
"""Seconds of the robot in a second; what the machine does not manage the robot makes up by taking longer."""

LINES_A_SECOND = 69.3
"""Of an idle robot in the nominal profile (docs/firmware.md, Times)."""

GAIT = "walk"
WARM_UP = 0.1
"""Share of the time after which memory is looked at for the first time."""

BEGIN, END = b"new data tf 1\r\np,1,", b"new data tf 1\r\ns,1\r\n"
"""What the robot says on the first waypoint of a run, and on its stop: seen on the line and in the record."""

TELEMETRY = b"\nj,"
PATIENCE = 4.0
"""The robot is waited for so many times as long as it should take, and a minute more."""


class Page:
    """Hears what a page hears of the robot.

    Args:
        address: of the studio.

    Attributes:
        heard: when each state of the robot came, by `time.monotonic()` in s, and what the robot was.
    """

    def __init__(self, address: str) -> None:
        self.heard: list[tuple[float, str]] = []
        events = address.replace("http", "ws", 1) + "api/events"
        self._socket = connect(events, max_size=None, open_timeout=ANSWER_SECONDS)
        self._thread = threading.Thread(target=self._listen, name="page", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Leaves."""
        self._socket.close()
        self._thread.join()

    def _listen(self) -> None:
        try:
            for text in self._socket:
                event = json.loads(text)
                if event["type"] == "robot":
                    self.heard.append((time.monotonic(), event["robot"]["robot"]))
        except ConnectionClosed:
            return


def bench_telemetry(seconds: float = HOUR, speed: float = SPEED) -> list[Row]:
    """A paused run on a robot that stands still and says so as often as it can, by a studio of its own.

    Args:
        seconds: time of the robot.
        speed: seconds of the robot in a second.

    Raises:
        StateError: the run ended by itself, for a machine that is too busy for this speed.
    """
    with tempfile.TemporaryDirectory() as data, emulator_process(speed, ProfileName.NOMINAL) as robot:
        tap = Tap(robot)
        studio = Studio(Path(data), tap.device)
        try:
            studio.connect()
            page = Page(studio.address)
            run, row = _paused_run(studio, tap, page, seconds, speed)
            page.close()
        finally:
            studio.close()
            tap.close()
        record = recorded(Path(data), run)
    on_line = lines_between(b"".join(piece.data for piece in tap.to_host))
    return [row | {"lines": on_line, "lines_not_kept": on_line - lines_between(record)}]


def lines_between(said: bytes) -> int:
    """Telemetry lines from a run's first waypoint to its stop."""
    return said.partition(BEGIN)[2].partition(END)[0].count(TELEMETRY)


def recorded(data: Path, run: str) -> bytes:
    """What is kept of what the robot said in a run."""
    database = Database(data / "studio.sqlite3")
    try:
        rows = database.rows("SELECT direction, data FROM run_bytes WHERE run=? ORDER BY time, number", run)
    finally:
        database.close()
    return b"".join(data for way, data in rows if way == "from robot")


def _paused_run(studio: Studio, tap: Tap, page: Page, seconds: float, speed: float) -> tuple[str, Row]:
    run = studio.begin_run(GAIT)
    studio.ask("POST", "api/robot/pause")
    wait_until(lambda: studio.robot()["robot"] == "paused", "the run is paused")
    began, first = time.monotonic(), len(page.heard)
    patience = PATIENCE * seconds / speed + 60.0
    memory = []
    for share in (WARM_UP, (1.0 - WARM_UP) / 2, (1.0 - WARM_UP) / 2):
        lines = _Lines(tap, share * seconds)
        wait_until(lines.are_said, "the robot has said its lines", patience)
        memory.append(studio.memory_mb())
    took = time.monotonic() - began
    if (shown := studio.robot())["robot"] != "paused":
        raise StateError(f"The run did not stay paused: {shown['sentence']} Choose a lower speed.", "speed")
    gaps = np.diff([when for when, _ in page.heard[first:]])
    studio.ask("POST", "api/robot/stop")
    wait_until(lambda: page.heard[-1][1] == "stopped", "the page hears of the stop")
    return run, {
        "robot_s": round(seconds),
        "acceleration": round(seconds / took, 1),
        "memory_mb": round(memory[0], 1),
        "growth_mb": round(memory[-1] - memory[0], 1),
        "second_half_mb": round(memory[-1] - memory[1], 1),
        "page_gap_p99_ms": milliseconds(float(np.percentile(gaps, 99))),
        "page_gap_max_ms": milliseconds(float(gaps.max())),
        "stop_seen_ms": milliseconds(_seen_after(tap, page.heard)),
    }


class _Lines:
    """Tells when the robot has said as many lines from now on as it does in some of its time."""

    def __init__(self, tap: Tap, seconds: float) -> None:
        self._tap = tap
        self._seen = len(tap.to_host)
        self._left = round(seconds * LINES_A_SECOND)

    def are_said(self) -> bool:
        """Whether it has; to be asked again and again."""
        pieces = self._tap.to_host[self._seen :]
        self._seen += len(pieces)
        self._left -= b"".join(piece.data for piece in pieces).count(b"j,")
        return self._left <= 0


def _seen_after(tap: Tap, heard: Sequence[tuple[float, str]]) -> float:
    """From the robot's answer to the stop on the line to a page that shows it as stopped, s."""
    answered = next(piece.time for piece in reversed(tap.to_host) if b"s,1" in piece.data)
    return next(when for when, robot in heard if robot == "stopped") - answered
