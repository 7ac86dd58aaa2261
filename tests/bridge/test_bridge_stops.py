"""Stops that must be heard: over half messages, failed writes, lost bytes and endless ramps."""

import re
import threading
from collections.abc import Callable

import pytest

from app.bridge.faults import Fault
from app.bridge.gate import Gate
from app.bridge.states import LinkState, RobotState
from app.bridge.words import NOT_SENT, NOT_STOPPED, clearing_sentence
from core.errors import RobotError, StateError
from core.wire import encode_flush
from tests.bridge.virtual_robot import VirtualRobot, make_plan, random_plan
from tests.studio_process import wait_for

FLUSH, STOP = encode_flush(), b"<s,1>"
WAYPOINT = b"<p,1,0.40,8.5000,8.5000,8.5000,8.5000,8.5000,8.5000,8.5000,8.5000,8.5000,8.5000,8.5000,8.5000>"
PATIENCE = 20.0
LONG = [[10.0] * 12, [3.0] * 12, [12.0] * 12]


@pytest.fixture
def robot() -> VirtualRobot:
    return VirtualRobot()


def payloads(robot: VirtualRobot) -> list[str]:
    return [m.payload for m in robot.firmware.messages]


def losing(count: int, what: bytes = STOP) -> Callable[[bytes], bytes]:
    """A cable that loses the first `count` messages of a kind."""
    left = [count]

    def pass_on(data: bytes) -> bytes:
        lost = data == what and left[0] > 0
        left[0] -= lost
        return b"" if lost else data

    return pass_on


def breaking(robot: VirtualRobot, after: int) -> Callable[[bytes], bytes]:
    """A line that takes the first bytes of one message and then fails, once."""

    def pass_on(data: bytes) -> bytes:
        robot.to_robot = bytes
        robot.firmware.board.inbox += data[:after]
        raise RobotError("virtual took no message for 0.5 s.", "virtual")

    return pass_on


def jammed_on_the_way(robot: VirtualRobot) -> None:
    robot.begin(make_plan(LONG))
    robot.until(lambda s: s.run is not None and s.run.reached == 1)
    robot.firmware.board.motors.jam(4, robot.firmware.board.now_us)


# The flush at the opening


@pytest.mark.parametrize("cut", [1, 2, 3, 4, 9, 10, 12, 16, 30, 57, 90, len(WAYPOINT) - 1])
@pytest.mark.parametrize("booted", [True, False])
def test_half_a_message_is_closed_within_the_range_before_the_robot_is_ready(cut: int, booted: bool) -> None:
    robot = VirtualRobot(strokes_mm=(8.0,) * 12)
    if booted:
        robot.boot()
    robot.write(WAYPOINT[:cut])
    robot.connect()
    assert robot.sent == [FLUSH]
    assert all(0.5 <= s <= 19.5 for m in robot.firmware.messages for s in m.strokes_mm or ())
    strokes, taken = robot.strokes_mm, len(robot.firmware.messages)
    robot.wait(1.0)
    assert robot.strokes_mm == strokes
    robot.stop()
    robot.until_robot(RobotState.STOPPED)
    assert robot.sent == [FLUSH, STOP]
    assert payloads(robot)[taken:] == ["s,1"]
    assert robot.strokes_mm == strokes


def test_a_robot_with_nothing_pending_ignores_the_flush(robot: VirtualRobot) -> None:
    robot.boot()
    robot.connect()
    assert robot.sent == [FLUSH]
    assert robot.firmware.messages == []


def test_the_flush_waits_until_the_board_has_booted(robot: VirtualRobot) -> None:
    robot.gate.attach(robot)
    robot.session.opened("virtual", robot.now)
    robot.until(lambda _: bool(robot.sent))
    received = b"".join(robot.heard)
    assert b"SETUP FINISHED" in received
    assert robot.snapshot.link is LinkState.CONNECTING


def test_a_stop_before_the_flush_brings_a_flush_of_its_own(robot: VirtualRobot) -> None:
    robot.boot()
    robot.write(WAYPOINT[:30])
    robot.run_unheard(0.1)
    robot.gate.attach(robot)
    robot.session.opened("virtual", robot.now)
    robot.stop()
    assert robot.sent == [FLUSH + STOP]
    robot.until_robot(RobotState.STOPPED)
    assert payloads(robot)[1] == "s,1"
    robot.until(lambda s: s.link is LinkState.READY)
    assert robot.snapshot.robot is RobotState.STOPPED


def test_a_robot_that_moves_is_not_ready_before_it_rests(robot: VirtualRobot) -> None:
    robot.boot()
    robot.write(WAYPOINT)
    robot.run_unheard(0.5)
    robot.connect()
    assert robot.strokes_mm == pytest.approx([8.5] * 12, abs=1.0)


def test_a_robot_that_never_rests_is_said_to_answer(robot: VirtualRobot) -> None:
    robot.boot()
    robot.firmware.board.motors.jam(0, robot.firmware.board.now_us)
    robot.write(WAYPOINT)
    robot.run_unheard(0.1)
    robot.gate.attach(robot)
    robot.session.opened("virtual", robot.now)
    sentence = robot.until(lambda s: s.link is LinkState.LOST).sentence
    assert "answers but did not come to rest within 15 s" in sentence


# An unsure line


def test_after_a_write_that_failed_half_way_a_stop_is_heard_as_a_stop(robot: VirtualRobot) -> None:
    robot.begin(make_plan(LONG))
    robot.until(lambda s: s.run is not None and s.run.reached == 1)
    robot.to_robot = breaking(robot, 30)
    robot.until(lambda s: s.link is LinkState.LOST)
    assert robot.snapshot.robot is RobotState.FAULT
    robot.wait(1.0)
    sent, taken = len(robot.sent), len(robot.firmware.messages)
    robot.stop("Grace")
    assert robot.sent[sent:] == [FLUSH + STOP]
    robot.until_robot(RobotState.STOPPED)
    closed, stop = robot.firmware.messages[taken:]
    assert closed.strokes_mm is not None
    assert min(closed.strokes_mm) >= 0.5
    assert stop.payload == "s,1"


def test_a_stop_that_was_cut_off_is_made_whole_by_the_next(robot: VirtualRobot) -> None:
    robot.begin(random_plan(11, 6))
    robot.wait(2.0)
    robot.to_robot = breaking(robot, 2)
    with pytest.raises(RobotError):
        robot.gate.stop()
    robot.session.hung_up("virtual took no message.", robot.now)
    robot.stop("Grace")
    assert robot.sent[-1] == FLUSH + STOP
    robot.until_robot(RobotState.STOPPED)
    assert payloads(robot)[-2:] == ["s" + FLUSH.decode()[:-1], "s,1"]


class Outlet:
    def __init__(self) -> None:
        self.taken: list[bytes] = []
        self.broken = False

    def write(self, data: bytes) -> None:
        if self.broken:
            raise RobotError("broken")
        self.taken.append(data)


def test_only_a_trusted_line_takes_a_message_and_a_failed_write_outlasts_the_trust() -> None:
    gate, outlet = Gate(lambda way, data, when: None, lambda: 0.0), Outlet()
    gate.attach(outlet)
    assert not gate.write(WAYPOINT, gate.permit())
    gate.stop()
    gate.trust()
    gate.stop()
    assert gate.write(WAYPOINT, gate.permit())
    outlet.broken = True
    with pytest.raises(RobotError):
        gate.write(WAYPOINT, gate.permit())
    outlet.broken = False
    gate.trust()
    gate.stop()
    assert not gate.write(WAYPOINT, gate.permit())
    assert outlet.taken == [FLUSH + STOP, STOP, WAYPOINT, FLUSH + STOP]


class SlowOutlet(Outlet):
    """A line on which a message takes until it is let out."""

    def __init__(self) -> None:
        super().__init__()
        self.begun, self.let_out = threading.Event(), threading.Event()

    def write(self, data: bytes) -> None:
        self.begun.set()
        assert self.let_out.wait(PATIENCE)
        super().write(data)


def test_who_must_not_wait_sends_the_stop_only_where_no_message_is_going_out() -> None:
    gate, outlet = Gate(lambda way, data, when: None, lambda: 0.0), SlowOutlet()
    gate.attach(outlet)
    writer = threading.Thread(target=gate.flush)
    writer.start()
    assert outlet.begun.wait(PATIENCE)
    before = gate.permit()
    assert not gate.try_stop()
    assert gate.permit() == before
    outlet.let_out.set()
    writer.join()
    assert gate.try_stop()
    assert outlet.taken == [FLUSH, FLUSH + STOP]


def test_who_must_not_wait_leaves_a_line_that_failed_to_others() -> None:
    gate, outlet = Gate(lambda way, data, when: None, lambda: 0.0), Outlet()
    gate.attach(outlet)
    outlet.broken = True
    with pytest.raises(RobotError):
        gate.try_stop()
    outlet.broken = False
    assert not gate.try_stop()
    gate.stop()
    assert outlet.taken == [FLUSH + STOP]


def test_what_a_stop_is_noted_in_delays_no_other_stop() -> None:
    notes, outlet = threading.Event(), Outlet()
    gate = Gate(lambda way, data, when: _hold(notes), lambda: 0.0)
    gate.attach(outlet)
    first = threading.Thread(target=gate.stop)
    first.start()
    wait_for(lambda: len(outlet.taken) == 1, "the first stop is out")
    second = threading.Thread(target=gate.stop)
    second.start()
    wait_for(lambda: len(outlet.taken) == 2, "the second stop is out")
    notes.set()
    first.join()
    second.join()


def _hold(notes: threading.Event) -> None:
    assert notes.wait(PATIENCE)


# A fault's own stop


def test_a_faults_stop_is_repeated_until_it_is_confirmed(robot: VirtualRobot) -> None:
    jammed_on_the_way(robot)
    robot.to_robot = losing(2)
    snapshot = robot.until_robot(RobotState.FAULT)
    assert "Stop was sent" in snapshot.sentence
    with pytest.raises(StateError, match="not confirmed the stop yet"):
        robot.session.clear("Ada", robot.now)
    snapshot = robot.until(lambda s: "Clear it" in s.sentence, 8.0)
    assert snapshot.robot is RobotState.FAULT
    assert "motor 5" in snapshot.sentence
    assert payloads(robot)[-1] == "s,1"
    robot.session.clear("Ada", robot.now)
    robot.until_robot(RobotState.DISARMED)


def test_a_faults_stop_that_is_never_heard_is_said_and_may_be_cleared(robot: VirtualRobot) -> None:
    jammed_on_the_way(robot)
    robot.to_robot = losing(1000)
    robot.until_robot(RobotState.FAULT)
    snapshot = robot.until(lambda s: "NOT STOPPED" in s.sentence, 7.0)
    assert snapshot.robot is RobotState.FAULT
    assert "motor 5" in snapshot.sentence
    assert "power switch" in snapshot.sentence
    robot.until(lambda _: robot.session.watch.stands_still(robot.now))
    robot.session.clear("Ada", robot.now)
    assert robot.snapshot.sentence.startswith("The robot has not confirmed the stop. Clearing")


def test_a_stop_after_a_loss_is_repeated_when_the_line_is_back(robot: VirtualRobot) -> None:
    robot.begin(random_plan(12, 20))
    robot.wait(2.0)
    robot.to_robot = robot.from_robot = lambda _: b""
    robot.until(lambda s: s.link is LinkState.LOST)
    assert robot.snapshot.robot is RobotState.FAULT
    taken = len(robot.firmware.messages)
    robot.to_robot = robot.from_robot = bytes
    snapshot = robot.until(lambda s: "Clear it" in s.sentence, 5.0)
    assert snapshot.robot is RobotState.FAULT
    assert set(payloads(robot)[taken:]) == {"s,1"}


def test_a_stop_that_a_broken_line_took_away_is_sent_on_the_next_line(robot: VirtualRobot) -> None:
    robot.begin(random_plan(13, 20))
    robot.wait(2.0)
    robot.session.hung_up("virtual has hung up. Check the cable, then connect again.", robot.now)
    assert "connect again" in robot.snapshot.sentence
    robot.wait(7.0)
    assert "NOT STOPPED" in robot.snapshot.sentence
    assert STOP not in robot.sent
    robot.connect()
    snapshot = robot.until(lambda s: "Clear it" in s.sentence, 5.0)
    assert snapshot.robot is RobotState.FAULT
    assert "virtual has hung up" in snapshot.sentence
    assert "connect again" not in snapshot.sentence  # it has been
    assert robot.firmware.messages[-1].payload == "s,1"


def test_a_stop_that_was_not_confirmed_is_not_called_stopped_after_reconnecting(robot: VirtualRobot) -> None:
    robot.begin(random_plan(14, 20))
    robot.wait(2.0)
    robot.to_robot = losing(1000)
    robot.stop()
    robot.session.closed(robot.now)
    robot.to_robot = losing(1000, FLUSH + STOP)
    robot.connect()
    assert robot.snapshot.robot is RobotState.STOPPING
    robot.until_robot(RobotState.STOPPED)
    assert robot.firmware.messages[-1].payload == "s,1"


def test_a_stop_that_the_line_did_not_take_is_not_called_sent(robot: VirtualRobot) -> None:
    robot.begin(random_plan(15, 20))
    robot.wait(2.0)
    robot.troubles.strike(Fault.UNPLUG)
    robot.stop("Grace")
    assert robot.snapshot.robot is RobotState.STOPPING
    assert robot.snapshot.sentence == f"virtual has hung up. {NOT_SENT}"
    robot.connect()
    assert robot.until_robot(RobotState.STOPPED).stop_text == "stopped by Grace"


def test_a_persons_stop_after_a_fault_leaves_the_faults_sentence(robot: VirtualRobot) -> None:
    jammed_on_the_way(robot)
    robot.until_robot(RobotState.FAULT)
    robot.stop("Grace")
    assert "motor 5" in robot.snapshot.sentence
    stopped = robot.until_robot(RobotState.STOPPED)
    assert "motor 5" in stopped.sentence
    assert stopped.stop_text == "stopped by Grace"


# Lost stops


def test_a_lost_stop_is_repeated_while_the_robot_ramps_again_and_again(robot: VirtualRobot) -> None:
    jammed_on_the_way(robot)
    robot.wait(2.0)
    passes = [0]

    def shake(found: re.Match[bytes]) -> bytes:
        passes[0] += 1
        return b"j," + (b"7.0000," if passes[0] % 2 else b"7.6000,")

    robot.from_robot = lambda data: re.sub(rb"j,[\d.]+,", shake, data)
    robot.to_robot = losing(1)
    lost = robot.now
    robot.stop()
    robot.until(lambda _: payloads(robot)[-1] == "s,1", 6.0)
    assert robot.now - lost < 5.0
    assert robot.sent.count(STOP) == 2


def test_an_overdue_stop_is_repeated_although_the_robot_is_silent(robot: VirtualRobot) -> None:
    robot.begin(random_plan(10, 4))
    robot.wait(1.0)
    robot.firmware.stall("test")
    robot.stop()
    robot.wait(5.5)
    assert robot.sent.count(STOP) == 1
    robot.wait(6.0)
    assert robot.sent.count(STOP) >= 3


# Clearing


@pytest.mark.parametrize("last", [b"<p,1,1.00,", b"<s,0>"])
def test_a_stop_stands_that_comes_while_one_which_was_not_confirmed_is_cleared(
    robot: VirtualRobot, last: bytes
) -> None:
    robot.begin(random_plan(3, 4))
    robot.wait(3.0)
    robot.to_robot = losing(1000)
    robot.stop()
    robot.until(lambda s: NOT_STOPPED in s.sentence)
    robot.until(lambda _: robot.session.watch.stands_still(robot.now))
    robot.to_robot = bytes
    robot.session.clear("Ada", robot.now)
    robot.until(lambda _: robot.sent[-1].startswith(last))
    robot.stop("Grace")
    assert robot.snapshot.sentence.startswith("Stop was sent")
    robot.until(lambda s: s.robot is not RobotState.STOPPING)
    assert robot.snapshot.robot is RobotState.STOPPED
    assert robot.snapshot.stop_text == "stopped by Grace"
    assert payloads(robot)[-1] == "s,1"


def test_clearing_says_which_motor_it_moves(robot: VirtualRobot) -> None:
    robot.connect()
    robot.stop()
    robot.until_robot(RobotState.STOPPED)
    robot.from_robot = lambda data: re.sub(rb"j,[\d.]+,", b"j,20.5000,", data)
    robot.wait(1.0)
    robot.session.clear("Ada", robot.now)
    sentence = robot.snapshot.sentence
    assert "motor 1 (foot 1, motor 1 of 3) moves 1.00 mm to 19.50 mm" in sentence
    assert "no motor moves" not in sentence


@pytest.mark.parametrize(
    ("stroke_mm", "words"), [(20.3, "no motor moves"), (20.45, "moves 0.95 mm"), (-0.45, "moves 0.95 mm")]
)
def test_a_motor_within_the_robots_threshold_is_not_moved(stroke_mm: float, words: str) -> None:
    target = min(max(stroke_mm, 0.5), 19.5)
    assert words in clearing_sentence((stroke_mm,), (target,), confirmed=True)
