"""A board whose words contradict themselves or its telemetry: the run ends by name, and only stops follow."""

import re
from collections.abc import Callable

import pytest

from app.bridge.pass_check import REMEDY, PassCheck
from app.bridge.states import RobotState
from app.emulator import faults
from app.emulator.faults import Fault
from app.emulator.profiles import ProfileName
from core.robot.model import load_robot
from core.wire.lines import (
    LONGEST_LINE,
    EndOfTrajectories,
    ErrorScan,
    ErrorsChecked,
    Line,
    NewData,
    PointReached,
    Telemetry,
)
from tests.support.virtual_robot import VirtualRobot, make_plan, random_plan

Lie = Callable[[str], str | None]
"""Turns a line into another, or leaves it out."""

STOP = b"<s,1>"
NUMBER = re.compile(r"-?\d+\.\d{4}")


class Liar:
    """Changes whole lines on their way to the host."""

    def __init__(self, lie: Lie) -> None:
        self._lie = lie
        self._rest = ""

    def __call__(self, data: bytes) -> bytes:
        *lines, self._rest = (self._rest + data.decode("latin-1")).split("\n")
        told = (self._lie(line.removesuffix("\r")) for line in lines)
        return "".join(f"{line}\r\n" for line in told if line is not None).encode("latin-1")


class Spoiler:
    """Puts bytes in place of one, pass by pass.

    Args:
        place: finds the byte, after its first group.
        put: one byte or none.
    """

    def __init__(self, place: re.Pattern[bytes], put: bytes) -> None:
        self.count = 0
        self._place = place
        self._put = put
        self._rest = b""

    def __call__(self, data: bytes) -> bytes:
        *lines, self._rest = re.split(rb"(?<=\n)(?=j,)", self._rest + data)
        spoilt, count = self._place.subn(lambda m: m[1] + self._put, b"".join(lines))
        self.count += count
        return spoilt


def replaced(old: str, new: str) -> Lie:
    return lambda line: line.replace(old, new)


def without(begin: str) -> Lie:
    return lambda line: None if line.startswith(begin) else line


def errors(change: Callable[[str], str], *, completing: bool = True) -> Lie:
    def lie(line: str) -> str:
        is_meant = line.startswith("E, ") and (
            not completing or all(abs(float(n)) <= 1.0 for n in NUMBER.findall(line))
        )
        return change(line) if is_meant else line

    return lie


def all_errors(text: str) -> Callable[[str], str]:
    return lambda line: NUMBER.sub(text, line)


def shifted(by: float) -> Callable[[str], str]:
    """Errors that are wrong by so much, towards 0 or beyond it."""
    return lambda line: NUMBER.sub(lambda m: f"{float(m[0]) + (by if float(m[0]) < 0 else -by):.4f}", line)


def spoilt(*begins: str) -> Lie:
    """A byte in each line that begins so is another one."""
    return lambda line: f"{line[:6]}#{line[7:]}" if line.startswith(begins) else line


def both(first: Lie, second: Lie) -> Lie:
    def lie(line: str) -> str | None:
        told = first(line)
        return None if told is None else second(told)

    return lie


def frozen() -> Lie:
    first: list[str] = []

    def lie(line: str) -> str:
        if not line.startswith("j,"):
            return line
        first.append(line)
        return first[0]

    return lie


LIES: dict[str, tuple[Lie, str]] = {
    "large errors when it arrives": (errors(all_errors("9.9000")), "error of +9.90 mm for motor 1 (foot 1"),
    "errors just over the limit": (errors(all_errors("1.0002")), "error of +1.00 mm for motor"),
    "errors that differ a little": (
        errors(shifted(1.2), completing=False),
        "they agree within 1.00 mm",
    ),
    "large errors from the beginning": (
        errors(all_errors("-9.9000"), completing=False),
        "error of -9.90 mm for motor",
    ),
    "nan": (errors(all_errors("nan")), "no number for the error of motor 1"),
    "ovf": (errors(all_errors("ovf")), "no number for the error of motor 1"),
    "eleven errors": (errors(lambda line: line.rsplit(",", 2)[0] + ","), "said “E, "),
    "no errors": (without("E, "), "no line of errors came"),
    "not reached, and the end": (
        replaced("reached point 1", "reached point 0"),
        "a motor is not within 1.00 mm of its target, but its largest error",
    ),
    "no check": (without("Checked errors"), "not the check of its errors that leads to it"),
    "two unreadable lines": (
        spoilt("E, ", "Checked"),
        "not the check of its errors that leads to it. It said “E, ",
    ),
    "an unreadable line and none": (
        both(spoilt("E, "), without("Checked")),
        "not the check of its errors that leads to it. It said “E, ",
    ),
    "none, and an unreadable line elsewhere": (
        both(spoilt("num pts"), without("E, ")),
        "no line of errors came",
    ),
    "an unreadable line in place of the waypoint": (
        both(spoilt("Curr"), without("E, ")),
        "said “Curr p#int",
    ),
    "large errors, and an unreadable check": (
        both(errors(all_errors("1.1000")), spoilt("Checked")),
        "reports that it arrived, and in the same pass an error of +1.10 mm",
    ),
    "an unreadable end": (spoilt("end of all"), "but did not report that it arrived"),
    "no reached point": (without("reached point, onto"), "the end of all trajectories, but not the check"),
    "reached too early": (
        replaced("reached point 0", "reached point 1"),
        "reports that it arrived, and in the same pass an error of",
    ),
    "an end without work": (
        lambda line: None if re.match("num pts|Curr|E, |Checked|reached", line) else line,
        "but by its last telemetry at",
    ),
    "three waypoints read": (replaced("points \t1", "points \t3"), "read 3 waypoints, but one was sent"),
    "no waypoint read": (replaced("points \t1", "points \t0"), "read 0 waypoints, but one was sent"),
    "number of waypoints left out": (without("Number of"), "did not confirm how many waypoints it read"),
    "works on two": (replaced("num pts 1", "num pts 2"), "works on 2 waypoints"),
    "another waypoint": (replaced("Curr point 0", "Curr point 1"), "works on waypoint 1 of 1"),
    "more waypoints": (replaced("Max pts 1", "Max pts 7"), "works on waypoint 0 of 7"),
    "frozen strokes": (frozen(), "they agree within"),
    "a message that nobody sent": (
        lambda line: line.replace("reached point, onto", "new data tf 1\r\n<p,1,\r\nreached point, onto"),
        "The robot took “<p,1,”, which was not sent",
    ),
}


@pytest.mark.parametrize("name", LIES)
def test_a_lie_of_the_board_ends_the_run_by_its_name(name: str) -> None:
    lie, sentence = LIES[name]
    robot = lying_robot(lie)
    ended = robot.until_robot(RobotState.FAULT, RobotState.DONE)
    assert ended.robot is RobotState.FAULT
    assert sentence in ended.sentence
    sent = len(robot.sent)
    robot.wait(3.0)
    assert set(robot.sent[sent:]) <= {STOP}
    assert robot.sent[sent - 1] == STOP
    if not name.endswith(("read", "left out", "sent")):
        assert REMEDY in ended.sentence


SPOILT_LINES = {
    "errors": rb"(E, -?\d)\.",
    "end of the errors": rb"(E, .*\r)\n",
    "blank line before the errors": rb"(Max pts 1\r\n\r)\n",
    "check": rb"(Checked )e",
    "end of the check": rb"(Checked .*\r)\n",
    "reached point": rb"(reached point,) ",
    "strokes before": rb"(j,\d+)\.(?=.*\nnew data tf 0\r\nnum pts)",
    "end of the strokes before": rb"(j,.*\r)\n(?=new data tf 0\r\nnum pts)",
    "beginning of the pass": rb"(new data tf) 0(?=\r\nnum pts)",
    "end of that": rb"(new data tf 0\r)\n(?=num pts)",
    "waypoints": rb"(num )p",
}


@pytest.mark.parametrize("put", [b"", b"#"])
@pytest.mark.parametrize("name", SPOILT_LINES)
def test_a_byte_that_is_lost_or_spoilt_in_each_pass_ends_no_run(name: str, put: bytes) -> None:
    spoiler = Spoiler(re.compile(SPOILT_LINES[name]), put)
    robot = lying_robot(spoiler)
    assert robot.until_robot(RobotState.FAULT, RobotState.DONE).robot is RobotState.DONE
    assert spoiler.count > 0


def lying_robot(lie: Lie | Spoiler) -> VirtualRobot:
    """A robot that lies from the first approved waypoint on."""
    robot = VirtualRobot(ProfileName.NOMINAL)
    robot.boot()
    robot.begin(make_plan([[6.0] * 12, [9.0, 3.0] * 6, [2.0, 8.0] * 6]))
    robot.until(lambda s: s.run is not None and s.run.reached == 1)
    robot.from_robot = lie if isinstance(lie, Spoiler) else Liar(lie)
    return robot


def test_strokes_that_jump_although_no_motor_is_driven_are_a_contradiction() -> None:
    check = PassCheck((5.0,) * 12, (5.0,) * 12)
    assert check.see(NewData(taken=False), is_taken=False) is None
    assert check.see(Telemetry((5.3,) * 12), is_taken=False) is None
    sentence = check.see(Telemetry((5.3,) * 11 + (9.0,)), is_taken=False) or ""
    assert (
        "motor 12 (foot 4, motor 3 of 3) stands at 9.00 mm, but by its last telemetry at 5.30 mm" in sentence
    )


def test_a_pass_whose_strokes_were_lost_is_compared_with_nothing() -> None:
    check = PassCheck((5.0,) * 12, (5.0,) * 12)
    for line in (NewData(taken=True), NewData(taken=False)):
        check.see(line, is_taken=True)
    assert check.see(ErrorScan((0.9,) * 12), is_taken=True) is None
    lines: list[Line] = [ErrorsChecked(reached=True), PointReached(), EndOfTrajectories()]
    assert [check.see(line, is_taken=True) for line in lines] == [None] * 3
    assert "by its error in the same pass at 5.90 mm" in (
        check.see(Telemetry((4.8,) * 12), is_taken=True) or ""
    )


@pytest.mark.parametrize("strokes", ["60.0000", "-9.0000"])
def test_strokes_that_no_motor_can_have_end_the_run_at_once(strokes: str) -> None:
    robot = lying_robot(lambda line: NUMBER.sub(strokes, line) if line.startswith("j,") else line)
    ended = robot.until_robot(RobotState.FAULT, RobotState.DONE)
    assert ended.robot is RobotState.FAULT
    assert f"stands at {float(strokes):.2f} mm, but motors go from 0 to 20.5 mm" in ended.sentence


@pytest.mark.parametrize("strokes", ["nan", "1.0", "inf"])
def test_strokes_that_cannot_be_read_end_the_run_by_name(strokes: str) -> None:
    robot = lying_robot(lambda line: NUMBER.sub(strokes, line) if line.startswith("j,") else line)
    ended = robot.until_robot(RobotState.FAULT, RobotState.DONE)
    assert ended.robot is RobotState.FAULT
    assert (
        f"gave no strokes that can be read (limit 2.7 s): its telemetry was “j,{strokes}," in ended.sentence
    )
    assert robot.sent[-1] == STOP


def test_a_motor_test_of_a_robot_that_says_no_strokes_ends() -> None:
    robot = VirtualRobot()
    robot.boot()
    robot.arm()
    robot.machine.test_motors(load_robot("deltawalker"), "Ada", robot.now)
    robot.wait(1.0)
    robot.from_robot = Liar(without("j,"))
    ended = robot.until_robot(RobotState.FAULT)
    assert "no telemetry came" in ended.sentence


def test_a_line_that_never_ends_ends_the_run_by_name() -> None:
    robot = VirtualRobot()
    robot.boot()
    robot.begin(random_plan(3, 4))
    robot.wait(1.0)
    robot.from_robot = lambda data: b"\0" * (LONGEST_LINE // 2)
    ended = robot.until_robot(RobotState.FAULT)
    assert f"a line of more than {LONGEST_LINE} bytes" in ended.sentence
    assert robot.sent[-1] == STOP


def test_a_line_that_never_ends_is_noted_once_in_a_connection_of_an_idle_robot() -> None:
    robot = VirtualRobot()
    robot.boot()
    robot.connect()
    robot.machine.received(b"x" * (3 * LONGEST_LINE) + b"\n" + b"x" * (2 * LONGEST_LINE) + b"\n", robot.now)
    causes = [change.cause for change in robot.machine.transitions]
    assert sum("It was cut there" in cause for cause in causes) == 1
    robot.wait(1.0)
    robot.machine.arm("Ada")


@pytest.mark.parametrize("profile", list(ProfileName))
def test_an_honest_board_is_believed_whatever_its_noise_and_however_late_its_bytes(
    profile: ProfileName,
) -> None:
    robot = VirtualRobot(profile, [9.0] * 12, seed=5)
    robot.boot()
    for fault in (Fault.NOISE, Fault.SPLIT, Fault.DELAY, Fault.WEAK_MOTOR):
        robot.troubles.strike(fault)
    robot.begin(random_plan(8, 6))
    assert robot.until_robot(RobotState.FAULT, RobotState.DONE).robot is RobotState.DONE


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("noise", [0.08, 0.12])
def test_an_honest_board_is_believed_with_six_times_the_usual_noise(
    noise: float, seed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(faults, "NOISE_MM", noise)
    robot = VirtualRobot(list(ProfileName)[seed], [9.0] * 12, seed=seed)
    robot.boot()
    robot.troubles.strike(Fault.NOISE)
    robot.begin(random_plan(seed, 6))
    assert robot.until_robot(RobotState.FAULT, RobotState.DONE).robot is RobotState.DONE
