"""How soon a stop is on the wire and the robot still, and what a kill −9 in mid-run leaves behind."""

import random
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from app.bench.common.measure import Row, milliseconds
from app.bench.robot.processes import Piece, Studio, Tap, busy_cores, emulator_process, sleeper, wait_until
from app.store.database import Database
from core.wire.messages import encode_flush, encode_stop
from solver_jobs import NICENESS

STOPS = 200
KILLS = 50
BUSY = {"busy with solvers": NICENESS, "busy at full priority": 0}
"""What keeps every core busy: solvers stand back, other programs do not."""

GAIT = "walk"
SPEED = 4.0
"""Seconds of the emulated robot in a second, where its own time is not what is measured."""

BETWEEN_STOPS = 0.05
LATEST_KILL = 1.5
"""A kill comes up to this long after the first waypoint, s."""

UNREAD = 0.05
"""Bytes that were written before a kill are read by the tap within this, s."""

WATCHED = 1.0
"""How long the line is watched after a kill, and after the studio is back, s."""


def bench_stop(stops: int = STOPS) -> list[Row]:
    """Time from a request's being sent to the stop's bytes on the line, by HTTP, idle and with busy cores.

    Beside it stands how late a process that only sleeps wakes up meanwhile: the machine's own share.
    """
    with tempfile.TemporaryDirectory() as data, emulator_process() as robot:
        tap = Tap(robot)
        studio = Studio(Path(data), tap.device)
        try:
            studio.connect()
            rows = [_stop_row("idle", studio, tap, stops)]
            for cores, niceness in BUSY.items():
                with busy_cores(niceness):
                    time.sleep(WATCHED)
                    rows.append(_stop_row(cores, studio, tap, stops))
        finally:
            studio.close()
            tap.close()
    return rows


def stop_latencies(studio: Studio, tap: Tap, stops: int) -> list[float]:
    """Seconds from sending each request for a stop to its first byte at the far end of the line."""
    latencies = []
    for _ in range(stops):
        seen = len(tap.from_host)
        asked = time.monotonic()
        studio.ask("POST", "api/robot/stop")
        latencies.append(when_stopped(tap, seen) - asked)
        time.sleep(BETWEEN_STOPS)
    return latencies


def when_stopped(tap: Tap, seen: int) -> float:
    """When the first stop after so many pieces was on the line, by `time.monotonic()` in s."""

    def found() -> bool:
        return any(encode_stop() in piece.data for piece in tap.from_host[seen:])

    wait_until(found, "the stop is on the line")
    return next(piece.time for piece in tap.from_host[seen:] if encode_stop() in piece.data)


def _stop_row(cores: str, studio: Studio, tap: Tap, stops: int) -> Row:
    with sleeper() as late:
        latencies = stop_latencies(studio, tap, stops)
        wakes = late()
    p50, p99 = np.percentile(latencies, (50, 99))
    return {
        "cores": cores,
        "stops": len(latencies),
        "median_ms": milliseconds(float(p50)),
        "p99_ms": milliseconds(float(p99)),
        "max_ms": milliseconds(max(latencies)),
        "sleeper_p99_ms": milliseconds(float(np.percentile(wakes, 99))),
    }


@dataclass(frozen=True)
class Killed:
    """What one kill left behind.

    Args:
        written: bytes that reached the robot after the kill, but for the flush when the studio is back and
            connected.
        state: what the run is called when the studio is back.
        whole: whether the record is a piece of what passed the line, without a hole.
        lost: age of the oldest byte that the record lacks, at the kill, s; 0 if it lacks none.
    """

    written: int
    state: str
    whole: bool
    lost: float


def bench_kill(rounds: int = KILLS, seed: int = 0) -> list[Row]:
    """Kills the studio at random moments of a run."""
    killed = kill_rounds(rounds, random.Random(seed))
    return [
        {
            "kills": len(killed),
            "bytes_after": sum(k.written for k in killed),
            "interrupted": sum(k.state == "interrupted" for k in killed),
            "whole_records": sum(k.whole for k in killed),
            "lost_median_ms": milliseconds(float(np.median([k.lost for k in killed]))),
            "lost_max_ms": milliseconds(max(k.lost for k in killed)),
        }
    ]


def kill_rounds(rounds: int, dice: random.Random) -> list[Killed]:
    """Runs a gait and kills the studio, again and again, on one robot and one data folder."""
    with tempfile.TemporaryDirectory() as folder, emulator_process(SPEED) as robot:
        data, tap = Path(folder), Tap(robot)
        studio = Studio(data, tap.device)
        killed = []
        try:
            studio.connect()
            for _ in range(rounds):
                run = studio.begin_run(GAIT)
                time.sleep(dice.uniform(0.0, LATEST_KILL))
                when = studio.kill()
                time.sleep(WATCHED)
                studio = Studio(data, tap.device)
                studio.connect()
                time.sleep(WATCHED)
                killed.append(_judge(studio, tap, data, run, when))
        finally:
            studio.close()
            tap.close()
    return killed


def _judge(studio: Studio, tap: Tap, data: Path, run: str, when: float) -> Killed:
    database = Database(data / "studio.sqlite3")
    try:
        rows = database.rows("SELECT direction, data FROM run_bytes WHERE run=? ORDER BY time, number", run)
    finally:
        database.close()
    ways = {
        "to robot": (tap.from_host, b"".join(data for way, data in rows if way == "to robot")),
        "from robot": (tap.to_host, b"".join(data for way, data in rows if way == "from robot")),
    }
    after = b"".join(piece.data for piece in tap.from_host if piece.time > when + UNREAD)
    losses = [_lost(pieces, record, when) for pieces, record in ways.values()]
    return Killed(
        written=len(after.replace(encode_flush(), b"", 1)),
        state=str((studio.robot()["previous_run"] or {}).get("state")),
        whole=all(lost is not None for lost in losses),
        lost=max((lost for lost in losses if lost is not None), default=0.0),
    )


def _lost(pieces: list[Piece], record: bytes, when: float) -> float | None:
    """Age of the oldest byte before a kill that a record lacks; None if the record has a hole, or nothing."""
    before = [piece for piece in pieces if piece.time <= when]
    # A record may also hold what passed between the look at the clock and the kill itself.
    begin = b"".join(piece.data for piece in pieces).rfind(record) if record else -1
    if begin < 0:
        return None
    end = begin + len(record)
    for piece in before:
        end -= len(piece.data)
        if end < 0:
            return when - piece.time
    return 0.0
