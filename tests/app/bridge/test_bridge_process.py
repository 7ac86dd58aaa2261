"""Stops and kills with the studio and the emulated robot as processes of their own."""

import os
import random
import subprocess
import sys
import tempfile
import tty
from pathlib import Path

import pytest

from app.bench.robot.processes import Piece, Studio, Tap, emulator_process, sleeper, wait_until
from app.bench.robot.standstill import BOUNDS, seconds_to_stand
from app.bench.robot.stop import _lost, kill_rounds, stop_latencies
from app.bench.robot.telemetry import LINES_A_SECOND, bench_telemetry, lines_between
from app.emulator.profiles import ProfileName

GENEROUS = 10.0
"""On a machine that is busy with other things, s; the benchmark measures what it is on a quiet one."""


@pytest.mark.parametrize("bound", BOUNDS)
@pytest.mark.parametrize("profile", [ProfileName.PUBLISHED, ProfileName.SLOW])
def test_a_stopped_robot_stands_still_within_its_bound(bound: float, profile: ProfileName) -> None:
    dice = random.Random(7)
    assert max(seconds_to_stand(bound, profile, dice) for _ in range(5)) <= bound + 0.2


@pytest.mark.heavy
def test_a_kill_in_mid_run_ends_the_messages_and_the_run_is_shown_as_interrupted() -> None:
    for killed in kill_rounds(2, random.Random(5)):
        assert killed.written == 0
        assert killed.state == "interrupted"
        assert killed.whole
        assert killed.lost < GENEROUS


def test_a_stop_by_http_is_on_the_line_at_once() -> None:
    with tempfile.TemporaryDirectory() as data, emulator_process(4.0) as robot:
        tap = Tap(robot)
        studio = Studio(Path(data), tap.device)
        try:
            studio.connect()
            latencies = stop_latencies(studio, tap, 5)
        finally:
            studio.close()
            tap.close()
    assert len(latencies) == 5
    assert 0.0 < max(latencies) < GENEROUS


def test_what_a_record_lacks_is_found() -> None:
    pieces = [Piece(1.0, b"old"), Piece(2.0, b"abc"), Piece(3.0, b"def"), Piece(9.0, b"later")]
    assert _lost(pieces, b"abcdef", 4.0) == 0.0
    assert _lost(pieces, b"abc", 4.0) == 1.0
    assert _lost(pieces, b"ab", 4.0) == 2.0
    assert _lost(pieces, b"acdef", 4.0) is None
    assert _lost(pieces, b"", 4.0) is None


def test_the_command_tells_what_has_spoilt_the_robots_memory() -> None:
    words = (sys.executable, "-u", "-m", "app", "emulate", "--speed", "50")
    process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout is not None
    assert process.stderr is not None
    device = os.open(process.stdout.readline().strip(), os.O_RDWR | os.O_NOCTTY)
    tty.setraw(device)
    os.write(device, b"<p,2" + b",1" * 26 + b">")
    told = process.stderr.readline()
    process.terminate()
    process.communicate()
    os.close(device)
    assert "fault state. A message of 2 waypoints" in told


@pytest.mark.heavy
@pytest.mark.alone
def test_telemetry_is_kept_to_the_last_line_and_a_page_hears_of_it_all_the_time() -> None:
    (row,) = bench_telemetry(10.0, 5.0)
    assert row["lines"] > 10.0 * LINES_A_SECOND * 0.9
    assert row["lines_not_kept"] == 0
    assert 0.0 < row["page_gap_max_ms"] < GENEROUS * 1000.0
    assert row["stop_seen_ms"] < GENEROUS * 1000.0


def test_lines_are_counted_between_a_runs_first_waypoint_and_its_stop() -> None:
    pass_ = b"new data tf 0\r\nj,1.0,\r\n"
    run = b"new data tf 1\r\np,1,1.0,5\r\nj,1.0,\r\n" + 2 * pass_ + b"new data tf 1\r\ns,1\r\nj,1.0,\r\n"
    assert lines_between(3 * pass_ + run + pass_) == 3
    assert lines_between(3 * pass_) == 0


def test_a_sleeper_tells_how_late_it_woke() -> None:
    with sleeper() as late:
        wait_until(lambda: len(late()) > 0, "the sleeper has woken")
        assert all(seconds >= 0.0 for seconds in late())
