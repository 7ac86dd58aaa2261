"""What the emulated robot does with odd messages (docs/firmware.md, Messages and Hazards)."""

import threading

import pytest

from app.emulator.c_text import Fields, c_string, padded_text, print_pieces, to_float, to_int
from app.emulator.emulated_robot import EmulatedRobot, start_emulator
from app.emulator.faults import Fault
from app.emulator.firmware import Firmware
from app.emulator.ports import PtyPort
from app.emulator.profiles import PROFILES, ProfileName
from core.wire.robot_time import LONGEST_SCAN


class Bench:
    """A booted robot in virtual time."""

    def __init__(self) -> None:
        self.firmware = Firmware(PROFILES[ProfileName.NOMINAL])
        self._program = self.firmware.run()
        while not self.firmware.completions:
            next(self._program)
        self.firmware.board.take_sent()

    def say(self, message: bytes, seconds: float) -> str:
        self.firmware.board.inbox += message
        end = self.firmware.now + seconds
        while self.firmware.now < end:
            next(self._program)
        return b"".join(chunk.data for chunk in self.firmware.board.take_sent()).decode("latin-1")

    @property
    def first_mm(self) -> float:
        return self.firmware.board.motors.stroke_mm(0, self.firmware.board.now_us)


@pytest.fixture
def bench() -> Bench:
    return Bench()


MOVE = b"<p,1,1.0,6,6,6,6,6,6,6,6,6,6,6,6>"


@pytest.mark.parametrize("stop", [b"<s,1>", b"<s,2>", b"<s, 0>", b"<s,false>", b"<stop>", b"<s0>", b"<s>"])
def test_all_these_stop(bench: Bench, stop: bytes) -> None:
    bench.say(stop + MOVE, 4.0)
    assert bench.first_mm == pytest.approx(0.5)


@pytest.mark.parametrize("start", [b"<s,0>", b"<s,00>", b"<s,01>", b"<s,0.0>", b"<s,0><s>", b"<x,0><s>"])
def test_all_these_start_again_and_the_old_target_goes_on(bench: Bench, start: bytes) -> None:
    bench.say(b"<s,1>" + MOVE, 1.0)
    bench.say(start, 4.0)
    assert bench.first_mm == pytest.approx(6.0, abs=1.0)


def test_a_stop_is_heard_only_after_the_ramp(bench: Bench) -> None:
    bench.say(b"<p,1,1.0,19.5,19.5,19.5,19.5,19.5,19.5,19.5,19.5,19.5,19.5,19.5,19.5>", 0.5)
    text = bench.say(b"<s,1>", 1.5)
    assert text == ""
    assert "s,1\r\n" in bench.say(b"", 1.0)
    assert bench.first_mm > 18.0


def test_a_second_waypoint_replaces_the_first(bench: Bench) -> None:
    text = bench.say(MOVE, 0.5) + bench.say(MOVE.replace(b"6", b"3"), 4.0)
    assert text.count("end of all available trajectories") == 1
    assert bench.first_mm == pytest.approx(3.0, abs=1.0)


def waypoints(duration: int, *strokes: str) -> bytes:
    numbers = [f"{duration},{','.join([stroke] * 12)}" for stroke in strokes]
    return f"<p,{len(strokes)},{','.join(numbers)}>".encode()


def test_seven_waypoints_in_a_message_are_a_fault_that_is_reported_in_silence(bench: Bench) -> None:
    text = bench.say(waypoints(9, *"6969696"), 3.0)
    assert "Trajectory Point 6: " in text
    assert bench.say(b"<s,1>", 5.0) == ""
    assert bench.firmware.fault == "A message of 7 waypoints overran the memory for one."
    assert bench.first_mm > 2.0


@pytest.mark.parametrize("count", [2, 3, 4, 6])
def test_a_few_waypoints_in_a_message_are_reported_and_go_astray(bench: Bench, count: int) -> None:
    text = bench.say(waypoints(1, *["9"] * count), 12.0)
    assert text.count("reached point, onto next trajectory") == count
    assert bench.first_mm < 2.0
    assert bench.firmware.spoilt == f"A message of {count} waypoints overran the memory for one."
    assert bench.firmware.fault is None


def test_an_overlong_message_is_a_fault_at_the_next_movement(bench: Bench) -> None:
    bench.say(b"<x" + b"A" * 20100 + b">", 1.0)
    assert bench.firmware.fault is None
    bench.say(MOVE, 2.0)
    assert bench.firmware.fault is not None
    assert "20101 bytes" in bench.firmware.fault
    assert bench.say(b"", 5.0) == ""


def test_a_reset_of_the_board_keeps_the_motors_going_until_it_is_up(bench: Bench) -> None:
    bench.say(MOVE.replace(b"6", b"19"), 0.7)
    bench.firmware.reset()
    text = bench.say(b"", 5.5)
    assert text.startswith("j,20.0040,")
    assert "SETUP MOVING" in text


def test_the_published_profile_is_the_default_and_scans_as_long_as_is_said() -> None:
    robot = start_emulator(speed=20.0)
    assert robot.firmware.board.profile is PROFILES[ProfileName.PUBLISHED]
    assert all(p.scan < LONGEST_SCAN + 0.01 for p in PROFILES.values())
    robot.close()
    robot.close()


def test_faults_asked_for_beforehand_must_exist() -> None:
    with pytest.raises(ValueError, match="garbage"):
        Fault("garbage")


@pytest.mark.parametrize(
    ("text", "value"),
    [
        (b"5mm", 5),
        (b"0x8", 8),
        (b"-0x1F", -31),
        (b"1e1", 10),
        (b" 7", 7),
        (b"abc", 0),
        (b"", 0),
        (b".5", 0.5),
    ],
)
def test_numbers_are_read_as_c_reads_them(text: bytes, value: float) -> None:
    assert to_float(text) == value


@pytest.mark.parametrize(("text", "value"), [(b"12x", 12), (b"-1", -1), (b"x", 0), (b"", 0), (b" 3.9", 3)])
def test_integers_are_read_as_c_reads_them(text: bytes, value: int) -> None:
    assert to_int(text) == value


def test_fields_collapse_and_run_out_as_strtok_has_it() -> None:
    buffer = bytearray(b"p,,1,,5\0,9")
    fields = Fields(buffer)
    assert [fields.take() for _ in range(5)] == [b"p", b"1", b"5", b"", b""]
    assert c_string(buffer) == b"p"


@pytest.mark.parametrize(
    ("value", "text"), [(-1.496, b"-1.4960"), (float("nan"), b"nan"), (float("-inf"), b"inf"), (5e9, b"ovf")]
)
def test_numbers_are_printed_as_the_board_prints_them(value: float, text: bytes) -> None:
    assert b"".join(print_pieces(value, 4)) == text


def test_odd_numbers_in_a_string_are_padded() -> None:
    assert padded_text(float("nan"), 4) == b"   nan"
    assert padded_text(19.5, 4) == b"19.5000"


def test_a_board_that_was_just_powered_on_is_silent_for_five_of_its_seconds() -> None:
    paces: list[float] = []

    def pace(now: float, interrupt: threading.Event) -> None:
        paces.append(now)
        interrupt.wait(0.001)

    robot = EmulatedRobot(Firmware(PROFILES[ProfileName.NOMINAL]), PtyPort(), pace=pace)
    robot.close()
    assert paces[0] == 0.0
