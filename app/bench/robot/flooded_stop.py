"""How soon a stop is on the wire while others flood the studio, without the token and with it."""

import tempfile
import time
from dataclasses import dataclass
from http.client import HTTPException
from pathlib import Path
from urllib.parse import urlsplit

import numpy as np

from app.bench.common.measure import Row, milliseconds, seconds_of
from app.bench.robot.crowd import Crowd, crowded
from app.bench.robot.floods import Attack, Flood, attacked, loopback_addresses
from app.bench.robot.processes import Studio, Tap, busy_cores, emulator_process, sleeper
from app.bench.robot.stop import BETWEEN_STOPS, when_stopped
from solver_jobs import NICENESS

STOPS = 100
"""Under each flood."""

CONNECTIONS = 1150
ADDRESSES = 64
TOKEN = "token-of-the-measurement"

NO_FLOOD = "none"
SETTLED = 2.0
"""From the last connection of a flood to the first stop, s."""

PAGES = 10
"""Requests of an honest page under each flood."""


@dataclass(frozen=True)
class Flooded:
    """What was measured under one flood.

    Args:
        stops: seconds from each request for a stop to its first byte at the far end of the line.
        repeated: requests for a stop that were cut off and had to be sent again.
        pages: seconds from each request for the list of gaits, with the token, to its answer.
        wakes: how much later than asked for a process woke up that only sleeps, s.
        opened: connections that the flood opened meanwhile.
        seconds: how long it was measured.
        log_bytes: what the studio wrote to its log meanwhile.
    """

    stops: list[float]
    repeated: int
    pages: list[float]
    wakes: list[float]
    opened: int
    seconds: float
    log_bytes: int


def all_attacks(connections: int = CONNECTIONS) -> dict[str, Attack]:
    """No flood, each kind from one address, and all at once from many, by what they are called."""
    one_by_one = {kind.value: Attack((kind,), connections) for kind in Flood}
    return (
        {"none": Attack((), 0)}
        | one_by_one
        | {
            "all of these": Attack(tuple(Flood), connections),
            "all, from many addresses": Attack(tuple(Flood), connections, loopback_addresses(ADDRESSES)),
            "pages and programs with the token": Attack((), 0, crowd=Crowd()),
            "these and all floods": Attack(
                tuple(Flood), connections, loopback_addresses(ADDRESSES), crowd=Crowd()
            ),
        }
    )


class FloodedStudio:
    """A studio with a token and a robot, and a tap on the line between them.

    Args:
        folder: where its data and its log go.
        device: the robot's.
    """

    def __init__(self, folder: Path, device: str) -> None:
        self._log = folder / "log.txt"
        self._tap = Tap(device)
        self.studio = Studio(folder, self._tap.device, "--token", TOKEN, log=self._log)
        self.studio.connect()

    def close(self) -> None:
        """Ends the studio."""
        self.studio.close()
        self._tap.close()

    def under(self, attack: Attack, stops: int) -> Flooded:
        """Measures under a flood."""
        server = urlsplit(self.studio.address)
        address = server.hostname or "", server.port or 0
        with (
            attacked(address, attack) as opened,
            crowded(address, TOKEN, attack.crowd),
            sleeper() as late,
        ):
            time.sleep(SETTLED)
            late()
            first, log_bytes, begin = opened(), self._log.stat().st_size, time.monotonic()
            latencies, repeated = self._stop_latencies(stops)
            pages = [seconds_of(lambda: self.studio.ask("GET", "api/gaits")) for _ in range(PAGES)]
            return Flooded(
                stops=latencies,
                repeated=repeated,
                pages=pages,
                wakes=late(),
                opened=opened() - first,
                seconds=time.monotonic() - begin,
                log_bytes=self._log.stat().st_size - log_bytes,
            )

    def _stop_latencies(self, stops: int) -> tuple[list[float], int]:
        """Seconds from sending each request for a stop first, and how many had to be sent again."""
        latencies, repeated = [], 0
        for _ in range(stops):
            seen, asked = len(self._tap.from_host), time.monotonic()
            while not self._is_stopped():
                repeated += 1
            latencies.append(when_stopped(self._tap, seen) - asked)
            time.sleep(BETWEEN_STOPS)
        return latencies, repeated

    def _is_stopped(self) -> bool:
        try:
            self.studio.ask("POST", "api/robot/stop")
        except (OSError, HTTPException):
            return False
        return True


def bench_floods(stops: int = STOPS) -> list[Row]:
    """Time from a request's being sent to the stop's bytes on the line under each flood.

    Every core is busy with solvers. The flood comes from one process more, which opens each connection again
    that the studio closes. Beside it stands how late a process that only sleeps wakes up meanwhile: the
    machine's own share.
    """
    with tempfile.TemporaryDirectory() as folder, emulator_process() as robot:
        flooded = FloodedStudio(Path(folder), robot)
        try:
            with busy_cores(NICENESS):
                all_measured = {name: flooded.under(one, stops) for name, one in all_attacks().items()}
        finally:
            flooded.close()
    rows = [_row(name, [measured]) for name, measured in all_measured.items()]
    floods = [measured for name, measured in all_measured.items() if name != NO_FLOOD]
    return [*rows, _row("every flood", floods)]


def _row(flood: str, measured: list[Flooded]) -> Row:
    stops = [latency for one in measured for latency in one.stops]
    p50, p99 = np.percentile(stops, (50, 99))
    wakes = [wake for one in measured for wake in one.wakes]
    pages = [page for one in measured for page in one.pages]
    opened, seconds = sum(one.opened for one in measured), sum(one.seconds for one in measured)
    return {
        "flood": flood,
        "stops": len(stops),
        "repeated": sum(one.repeated for one in measured),
        "median_ms": milliseconds(float(p50)),
        "p99_ms": milliseconds(float(p99)),
        "max_ms": milliseconds(max(stops)),
        "page_median_ms": milliseconds(float(np.median(pages))),
        "connections_per_s": round(opened / seconds),
        "log_bytes": sum(one.log_bytes for one in measured),
        "sleeper_p99_ms": milliseconds(float(np.percentile(wakes, 99))),
    }
