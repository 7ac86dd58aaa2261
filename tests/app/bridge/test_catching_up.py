"""After a time away the bridge reads what waits at a real line before it judges anything."""

from __future__ import annotations

import os
import threading
import time
import tty
from collections.abc import Iterator

import pytest

from app.bridge.bridge import RobotBridge
from app.bridge.states import LinkState, RobotState
from app.bridge.transport import Transport
from app.server.descriptors import raise_limit
from core.errors import StateError
from tests.support.studio_process import wait_for

READING = b"new data tf 0\r\nj," + b"5.0040," * 12 + b"\r\n"
MOVED = READING.replace(b"5.0040", b"9.0040")


class Board:
    """A robot at a terminal that idles, says what it is told to, and takes everything."""

    def __init__(self) -> None:
        self._end, end = os.openpty()
        tty.setraw(end)
        self.device = os.ttyname(end)
        self._says, self._ended = READING, threading.Event()
        self._thread = threading.Thread(target=self._talk)
        self._thread.start()

    def say(self, reading: bytes) -> None:
        self._says = reading

    def _talk(self) -> None:
        while not self._ended.wait(0.01):
            os.write(self._end, self._says)

    def close(self) -> None:
        self._ended.set()
        self._thread.join()
        os.close(self._end)


class Away:
    """A clock that is put forward."""

    def __init__(self) -> None:
        self.seconds = 0.0

    def __call__(self) -> float:
        return time.monotonic() + self.seconds


@pytest.fixture
def board() -> Iterator[Board]:
    board = Board()
    yield board
    board.close()


@pytest.mark.parametrize("many", [0, 1500])
def test_a_wish_after_a_time_away_is_answered_by_fresh_readings(board: Board, many: int) -> None:
    if raise_limit(2 * many) < many:
        pytest.skip("this system allows too few open files")
    files = [os.open(os.devnull, os.O_RDONLY) for _ in range(many)]  # beyond the 1024 that select() takes
    clock = Away()
    bridge = RobotBridge(clock=clock)
    try:
        bridge.connect(board.device)
        wait_for(lambda: bridge.snapshot.link is LinkState.READY, "the robot answers")
        bridge.arm("Ada")
        clock.seconds += 3600.0
        board.say(MOVED)
        wait_for(lambda: bridge.snapshot.robot is RobotState.DISARMED, "the robot is disarmed")
        assert "The program did not run for 3600" in bridge.snapshot.sentence
        wait_for(lambda: (bridge.snapshot.strokes or (0.0,))[0] == pytest.approx(0.009004), "it is read")
        bridge.arm("Ada")
        assert bridge.snapshot.link is LinkState.READY
    finally:
        bridge.close()
        for file in files:
            os.close(file)


def test_a_stop_after_a_time_away_is_the_persons(board: Board) -> None:
    clock = Away()
    bridge = RobotBridge(clock=clock, tick=0.2)
    try:
        bridge.connect(board.device)
        wait_for(lambda: bridge.snapshot.link is LinkState.READY, "the robot answers")
        bridge.arm("Ada")
        clock.seconds += 20.0
        bridge.stop("Grace")
        assert bridge.snapshot.stop_text == "stopped by Grace"
        with pytest.raises(StateError):
            bridge.reset("Ada")
    finally:
        bridge.close()


def test_waiting_for_the_reader_ends_where_the_line_never_rests(board: Board) -> None:
    line = Transport(board.device, lambda data: time.sleep(0.005), lambda reason: None)
    begun = time.monotonic()
    line.wait_read()
    assert time.monotonic() - begun < 5.0
    line.close()
    line.wait_read()
