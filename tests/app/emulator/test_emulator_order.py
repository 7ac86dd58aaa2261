"""What the emulated robot says, line by line, where no recordings are at hand (docs/firmware.md)."""

import re
from itertools import pairwise

import pytest

from app.emulator.firmware import Firmware
from app.emulator.profiles import PROFILES, ProfileName

STROKES = "2,19.5,7.5,0.5,12.34,5,10,15.25,3.3,8.8,17,1"
NUMBERS = re.compile(r"(?<![\w.])-?\d+\.\d+")
ECHO = f"p,1,1.0,{STROKES}"
TWELVE = "#," * 12
POINT = "Trajectory Point 0: \tp 1.00 " + "".join(f"{float(s):.4f} " for s in STROKES.split(","))
PASS = ["num pts 1 execute waypoints ", "", "Curr point 0 Max pts 1", "", "E, " + TWELVE]
IDLE = ["j," + TWELVE, "new data tf 0"]
END = ["reached point, onto next trajectory", "end of all available trajectories"]


class Line:
    """One line: its text without CR LF, its time in s, and its text with numbers as `#`."""

    def __init__(self, text: str, time: float) -> None:
        self.text = text
        self.time = time
        self.kind = NUMBERS.sub("#", text) if text.startswith(("j,", "E, ")) else text


class Listener:
    """A nominal robot whose lines are kept."""

    def __init__(self) -> None:
        self.firmware = Firmware(PROFILES[ProfileName.NOMINAL])
        self._program = self.firmware.run()
        self._pending = b""

    def listen(self, seconds: float, message: bytes = b"") -> list[Line]:
        self.firmware.board.inbox += message
        lines, end = [], self.firmware.now + seconds
        while self.firmware.now < end:
            next(self._program)
            for chunk in self.firmware.board.take_sent():
                self._pending += chunk.data
                while b"\r\n" in self._pending:
                    text, _, self._pending = self._pending.partition(b"\r\n")
                    lines.append(Line(text.decode(), chunk.time_us / 1e6))
        return lines


def kinds(lines: list[Line]) -> list[str]:
    return [line.kind for line in lines]


@pytest.fixture
def robot() -> Listener:
    return Listener()


def test_the_boot_in_order(robot: Listener) -> None:
    lines = robot.listen(5.4)
    first = [IDLE[0], "SETUP MOVING", "SETUP FINISHED", IDLE[1]]
    expected = [*first, *PASS, "Checked errors, reached point 1", *END, *IDLE]
    assert kinds(lines)[: len(expected)] == expected
    assert lines[0].time == pytest.approx(5.07, abs=0.01)


def test_one_waypoint_in_order_and_in_time(robot: Listener) -> None:
    robot.listen(6.0)
    sent = robot.firmware.now
    lines = robot.listen(2.8, f"<{ECHO}>".encode())
    began = kinds(lines).index("new data tf 1")
    assert set(kinds(lines)[:began]) <= set(IDLE)
    parsed = ["new data tf 1", ECHO, "", "p durations i1.00", POINT, "Number of trajectory points \t1"]
    moved = [*PASS, "Checked errors, reached point 0", *IDLE]
    reached = [*PASS, "Checked errors, reached point 1", *END, *IDLE]
    expected = [*parsed, *moved, *reached]
    lines = lines[began : began + len(expected)]
    assert kinds(lines) == expected
    assert lines[10].time - sent == pytest.approx(0.161, abs=0.02)
    silence = max(b.time - a.time for a, b in pairwise(lines))
    assert silence == pytest.approx(2.34, abs=0.05)
    assert lines[-3].time - sent == pytest.approx(2.664, abs=0.05)


def test_a_stop_is_echoed_and_ends_the_execution_without_an_end_line(robot: Listener) -> None:
    robot.listen(6.0)
    robot.listen(1.0, f"<{ECHO}>".encode())
    said = kinds(robot.listen(3.0, b"<s,1>"))
    assert said[:4] == [IDLE[0], "new data tf 1", "s,1", IDLE[0]]
    assert set(said[3:]) == set(IDLE)


def test_what_is_no_message_is_echoed_or_ignored(robot: Listener) -> None:
    robot.listen(6.0)
    assert kinds(robot.listen(0.1, b"junk>" + b",1" * 14 + b">")).count("new data tf 1") == 0
    said = kinds(robot.listen(0.1, b"<P,1>"))
    assert said[said.index("new data tf 1") :][:4] == ["new data tf 1", "P,1", *IDLE]
