"""What was half written is closed before anything else is said: the flush, and a line one is not sure of."""

import threading
from collections.abc import Callable

import pytest

from app.bridge.states import LinkState, RobotState
from app.bridge.write_gate import WriteGate
from core.errors import RobotError
from core.wire.messages import encode_flush
from tests.support.studio_process import wait_for
from tests.support.virtual_robot import VirtualRobot, make_plan, payloads, random_plan

FLUSH, STOP = encode_flush(), b"<s,1>"
WAYPOINT = b"<p,1,0.40,8.5000,8.5000,8.5000,8.5000,8.5000,8.5000,8.5000,8.5000,8.5000,8.5000,8.5000,8.5000>"
PATIENCE = 60.0
LONG = [[10.0] * 12, [3.0] * 12, [12.0] * 12]


def breaking(robot: VirtualRobot, after: int) -> Callable[[bytes], bytes]:
    """A line that takes the first bytes of one message and then fails, once."""

    def pass_on(data: bytes) -> bytes:
        robot.to_robot = bytes
        robot.firmware.board.inbox += data[:after]
        raise RobotError("virtual took no message for 0.5 s.", "virtual")

    return pass_on


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
    robot.machine.opened("virtual", robot.now)
    robot.until(lambda _: bool(robot.sent))
    received = b"".join(robot.heard)
    assert b"SETUP FINISHED" in received
    assert robot.snapshot.link is LinkState.CONNECTING


def test_a_stop_before_the_flush_brings_a_flush_of_its_own(robot: VirtualRobot) -> None:
    robot.boot()
    robot.write(WAYPOINT[:30])
    robot.run_unheard(0.1)
    robot.gate.attach(robot)
    robot.machine.opened("virtual", robot.now)
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
    robot.machine.opened("virtual", robot.now)
    sentence = robot.until(lambda s: s.link is LinkState.LOST).sentence
    assert "answers but did not come to rest within 15 s" in sentence


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
    robot.machine.hung_up("virtual took no message.", robot.now)
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
    gate, outlet = WriteGate(lambda way, data, when: None, lambda: 0.0), Outlet()
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
    gate, outlet = WriteGate(lambda way, data, when: None, lambda: 0.0), SlowOutlet()
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
    gate, outlet = WriteGate(lambda way, data, when: None, lambda: 0.0), Outlet()
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
    gate = WriteGate(lambda way, data, when: _hold(notes), lambda: 0.0)
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
