"""One suite for bridge and emulated robot over a pseudo-terminal and over TCP, on real threads."""

import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

from app.bridge.bridge import RobotBridge
from app.bridge.states import Direction, LinkState, RobotSnapshot, RobotState
from app.bridge.transport import Transport
from app.emulator.emulated_robot import EmulatedRobot
from app.emulator.faults import Fault, FaultRequest
from app.emulator.firmware import Firmware
from app.emulator.ports import Port, PtyPort, TcpPort
from app.emulator.profiles import PROFILES, ProfileName
from core.errors import RobotError, StateError
from core.wire.messages import encode_waypoint
from tests.support.virtual_robot import make_plan, random_plan

SHORT = [[4.0] * 12, [6.0] * 12, [3.0, 8.0] * 6]
PATIENCE = 60.0


class Lockstep:
    """Lets the robot's time pass only as fast as the bridge takes what the robot has said."""

    def __init__(self, port: Port) -> None:
        self.port = port
        self.traffic: list[tuple[Direction, bytes, float]] = []
        self._ahead = 0
        self._connected = False
        self._is_connecting = False
        self._departures = 0
        self._noticed = 0
        self._change = threading.Condition()

    @property
    def device(self) -> str:
        return self.port.device

    def write(self, data: bytes) -> int:
        with self._change:
            self._let_connect()
            count = self.port.write(data) if self._connected else 0
            self._ahead += count
        return count

    def read(self) -> bytes:
        departures = self._departures
        data = self.port.read()
        with self._change:
            if not data:
                self._noticed = departures
            self._change.notify_all()
        return data

    def close(self) -> None:
        self.port.close()
        self._release()

    def pace(self, now: float, interrupt: threading.Event) -> None:
        deadline = time.monotonic() + PATIENCE
        with self._change:
            self._let_connect()
            if not self._connected:
                self._change.wait(0.002)
            while self._ahead > 0 and not interrupt.is_set() and time.monotonic() < deadline:
                self._change.wait(0.02)

    def log(self, direction: Direction, data: bytes, when: float) -> None:
        self.traffic.append((direction, data, when))

    def taken(self, count: int) -> None:
        """The bridge has taken so many bytes into account."""
        with self._change:
            self._ahead -= count
            self._change.notify_all()

    def connect(self, bridge: RobotBridge) -> None:
        # The robot waits meanwhile, the bridge does not: it may still be at what an earlier line left.
        with self._change:
            self._is_connecting = True
        try:
            bridge.connect(self.device)
        finally:
            with self._change:
                self._ahead, self._connected, self._is_connecting = 0, True, False
                self._change.notify_all()

    def _let_connect(self) -> None:
        while self._is_connecting:
            self._change.wait(0.02)

    def disconnect(self, bridge: RobotBridge) -> None:
        bridge.disconnect()
        self._release()
        # Until the port has seen that its host has gone, it would send the next host's lines to nobody.
        with self._change:
            self._departures += 1
            assert self._change.wait_for(lambda: self._noticed == self._departures, PATIENCE)

    def _release(self) -> None:
        with self._change:
            self._ahead = 0
            self._connected = False
            self._change.notify_all()


@pytest.fixture(params=["pty", "tcp"])
def lockstep(request: pytest.FixtureRequest) -> Lockstep:
    return Lockstep(TcpPort() if request.param == "tcp" else PtyPort())


@pytest.fixture
def emulator(lockstep: Lockstep) -> Iterator[EmulatedRobot]:
    robot = EmulatedRobot(Firmware(PROFILES[ProfileName.NOMINAL]), lockstep, pace=lockstep.pace, booted=True)
    yield robot
    robot.close()


class FollowedBridge(RobotBridge):
    """A bridge that tells what it has taken into account."""

    def __init__(self, lockstep: Lockstep, **options: Any) -> None:
        self._lockstep = lockstep
        super().__init__(lockstep.log, **options)

    def _feed(self, item: Any) -> None:
        super()._feed(item)
        self._lockstep.taken(len(getattr(item, "data", b"")))


@pytest.fixture
def bridge(emulator: EmulatedRobot, lockstep: Lockstep) -> Iterator[RobotBridge]:
    bridge = FollowedBridge(lockstep, clock=lambda: emulator.firmware.now, tick=0.005)
    yield bridge
    bridge.close()


def until(
    bridge: RobotBridge,
    condition: Callable[[RobotSnapshot], bool],
    action: Callable[[], None] = lambda: None,
) -> None:
    """Waits for a condition; the action happens at that very moment of the robot's time."""
    met = threading.Event()

    def look(snapshot: RobotSnapshot) -> None:
        if condition(snapshot) and not met.is_set():
            action()
            met.set()

    unsubscribe = bridge.subscribe(look)
    if not met.wait(PATIENCE):
        raise TimeoutError(f"not within {PATIENCE} s: {bridge.snapshot}")
    unsubscribe()


def until_robot(bridge: RobotBridge, *states: RobotState) -> None:
    until(bridge, lambda s: s.robot in states)


def has_reached(count: int) -> Callable[[RobotSnapshot], bool]:
    return lambda s: s.run is not None and s.run.reached >= count


def make_ready(bridge: RobotBridge, lockstep: Lockstep) -> None:
    lockstep.connect(bridge)
    until(bridge, lambda s: s.link is LinkState.READY)
    bridge.arm("Ada")


def test_a_run_reaches_every_approved_waypoint(
    bridge: RobotBridge, emulator: EmulatedRobot, lockstep: Lockstep
) -> None:
    make_ready(bridge, lockstep)
    plan = random_plan(1, 8)
    bridge.send(plan, "Ada")
    until_robot(bridge, RobotState.DONE, RobotState.FAULT)
    assert bridge.snapshot.robot is RobotState.DONE, bridge.snapshot.last_error
    taken = np.array([m.strokes_mm for m in emulator.firmware.messages])
    np.testing.assert_allclose(taken[-8:], plan.waypoints.strokes_mm, atol=1e-5)
    assert max(c.worst_mm for c in emulator.firmware.completions[-8:]) <= 1.0
    assert bridge.snapshot.strokes == pytest.approx(plan.waypoints.strokes[-1].reshape(-1), abs=0.0011)
    sent = [data for way, data, _ in lockstep.traffic if way is Direction.TO_ROBOT]
    assert sent[-8:] == [encode_waypoint(s, 0.4) for s in plan.waypoints.strokes]


def test_a_run_has_the_name_that_it_was_given(bridge: RobotBridge, lockstep: Lockstep) -> None:
    make_ready(bridge, lockstep)
    assert bridge.send(make_plan(SHORT), "Ada", "walk-7") == "walk-7"
    assert bridge.snapshot.run is not None
    assert bridge.snapshot.run.run_id == "walk-7"


def test_a_stop_in_mid_run_latches_until_cleared(
    bridge: RobotBridge, emulator: EmulatedRobot, lockstep: Lockstep
) -> None:
    make_ready(bridge, lockstep)
    bridge.send(random_plan(2, 6), "Ada")
    until(bridge, has_reached(2), lambda: bridge.stop("Grace"))
    until_robot(bridge, RobotState.STOPPED)
    assert emulator.firmware.messages[-1].payload == "s,1"
    with pytest.raises(StateError, match="stopped"):
        bridge.arm("Ada")
    bridge.clear("Ada")
    until_robot(bridge, RobotState.DISARMED)
    bridge.arm("Ada")
    bridge.send(make_plan(SHORT), "Ada")
    until_robot(bridge, RobotState.DONE, RobotState.FAULT)
    assert bridge.snapshot.robot is RobotState.DONE, bridge.snapshot.last_error


def test_a_stop_does_not_wait_for_a_subscriber_that_dawdles(bridge: RobotBridge, lockstep: Lockstep) -> None:
    make_ready(bridge, lockstep)
    hold, held = threading.Event(), threading.Event()

    def dawdle(_: RobotSnapshot) -> None:
        held.set()
        hold.wait(PATIENCE)

    bridge.send(random_plan(3, 4), "Ada")
    unsubscribe = bridge.subscribe(dawdle)
    assert held.wait(PATIENCE)
    bridge.stop("Grace")
    sent = [data for way, data, _ in lockstep.traffic if way is Direction.TO_ROBOT]
    assert sent[-1] == b"<s,1>"
    assert bridge.snapshot.robot is RobotState.STOPPING
    unsubscribe()
    hold.set()
    until_robot(bridge, RobotState.STOPPED)


def test_a_stop_that_waits_for_nothing_is_on_the_line_when_it_returns(
    bridge: RobotBridge, lockstep: Lockstep
) -> None:
    make_ready(bridge, lockstep)
    bridge.send(random_plan(3, 4), "Ada")
    until(bridge, has_reached(1))
    left = bridge.try_stop("Grace")
    sent = [data for way, data, _ in lockstep.traffic if way is Direction.TO_ROBOT]
    assert sent[-1] == b"<s,1>"
    if left is not None:
        left()
    assert bridge.snapshot.robot is RobotState.STOPPING
    until_robot(bridge, RobotState.STOPPED)
    assert "Grace" in (bridge.snapshot.stop_text or "")


def test_an_unplugged_cable_ends_the_run_as_a_fault(
    bridge: RobotBridge, emulator: EmulatedRobot, lockstep: Lockstep
) -> None:
    make_ready(bridge, lockstep)
    bridge.send(random_plan(4, 6), "Ada")
    until(bridge, has_reached(1), lambda: emulator.inject(FaultRequest(Fault.UNPLUG)))
    until(bridge, lambda s: s.link is LinkState.LOST)
    assert bridge.snapshot.robot is RobotState.FAULT
    assert "hung up" in bridge.snapshot.sentence


SURVIVABLE = (Fault.DROP, Fault.GARBLE, Fault.SPLIT, Fault.DELAY, Fault.WEAK_MOTOR, Fault.NOISE)


@pytest.mark.parametrize("fault", list(Fault))
def test_every_fault_that_is_asked_for_beforehand_ends_in_a_named_state(fault: Fault) -> None:
    lockstep = Lockstep(PtyPort())
    firmware = Firmware(PROFILES[ProfileName.NOMINAL])
    robot = EmulatedRobot(firmware, lockstep, pace=lockstep.pace, faults=[FaultRequest(fault)], booted=True)
    bridge = FollowedBridge(lockstep, clock=lambda: firmware.now, tick=0.005)
    make_ready(bridge, lockstep)
    bridge.send(random_plan(6, 8), "Ada")
    until_robot(bridge, RobotState.FAULT, RobotState.DONE)
    ended = bridge.snapshot
    assert fault in SURVIVABLE or ended.robot is RobotState.FAULT
    assert (ended.last_error is None) is (ended.robot is RobotState.DONE)
    bridge.close()
    robot.close()


def test_disconnecting_in_mid_run_stops_the_robot_first(
    bridge: RobotBridge, emulator: EmulatedRobot, lockstep: Lockstep
) -> None:
    make_ready(bridge, lockstep)
    bridge.send(random_plan(5, 100), "Ada")
    until(bridge, has_reached(1))
    lockstep.disconnect(bridge)
    assert bridge.snapshot.link is LinkState.DISCONNECTED
    assert emulator.firmware.messages[-1].payload == "s,1"
    lockstep.connect(bridge)
    until(bridge, lambda s: s.link is LinkState.READY)
    assert bridge.snapshot.robot is RobotState.STOPPED


def test_of_two_clears_at_once_one_goes_out(bridge: RobotBridge, lockstep: Lockstep) -> None:
    make_ready(bridge, lockstep)
    bridge.stop("Ada")
    until_robot(bridge, RobotState.STOPPED)
    until(bridge, lambda s: bridge._machine.monitor.stands_still(bridge._now()))
    refusals: list[str] = []

    def clear() -> None:
        try:
            bridge.clear("Ada")
        except StateError as refusal:
            refusals.append(refusal.sentence)

    threads = [threading.Thread(target=clear) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(PATIENCE)
    until_robot(bridge, RobotState.DISARMED)
    assert len(refusals) == 3
    sent = b"".join(data for way, data, _ in lockstep.traffic if way is Direction.TO_ROBOT)
    assert (sent.count(b"<p,1,"), sent.count(b"<s,0>")) == (1, 1)


class DeafLine(Transport):
    """A line on which nobody answers."""

    def __init__(self, device: str, on_data: Callable[[bytes], None], on_lost: Callable[[str], None]) -> None:
        del on_data, on_lost
        self.device = device

    def write(self, data: bytes) -> None:
        del data

    def wait_read(self) -> None:
        pass

    def close(self) -> None:
        pass


@pytest.mark.parametrize("way_out", [RobotBridge.disconnect, RobotBridge.close])
def test_leaving_twice_at_once_is_leaving_once(way_out: Callable[[RobotBridge], None]) -> None:
    bridge = RobotBridge(clock=lambda: 20.0 * time.monotonic(), tick=0.005, opener=DeafLine)
    bridge.connect("deaf")
    bridge.stop("Ada")
    threads = [threading.Thread(target=way_out, args=(bridge,)) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(PATIENCE)
        assert not thread.is_alive()
    assert bridge.snapshot.link is LinkState.DISCONNECTED
    assert [t.cause for t in bridge.transitions].count("Disconnected.") == 1
    bridge.close()


def test_a_second_connection_is_refused(bridge: RobotBridge, lockstep: Lockstep) -> None:
    lockstep.connect(bridge)
    with pytest.raises(StateError, match="is connected"):
        bridge.connect(lockstep.device)


def test_every_byte_is_logged_both_ways_in_order(bridge: RobotBridge, lockstep: Lockstep) -> None:
    make_ready(bridge, lockstep)
    bridge.send(make_plan(SHORT), "Ada")
    until_robot(bridge, RobotState.DONE)
    text = b"".join(data for way, data, _ in lockstep.traffic if way is Direction.FROM_ROBOT)
    assert text.count(b"end of all available trajectories") == 5
    times = [when for way, _, when in lockstep.traffic if way is Direction.FROM_ROBOT]
    assert times == sorted(times)


def test_a_subscriber_that_fails_does_not_end_the_bridge(
    bridge: RobotBridge, lockstep: Lockstep, caplog: pytest.LogCaptureFixture
) -> None:
    def fail(snapshot: RobotSnapshot) -> None:
        raise ZeroDivisionError(snapshot.sentence)

    bridge.subscribe(fail)
    make_ready(bridge, lockstep)
    assert "subscriber" in caplog.text


def test_a_line_in_use_is_refused_with_a_sentence(bridge: RobotBridge, lockstep: Lockstep) -> None:
    if lockstep.device.startswith("socket"):
        pytest.skip("a TCP port takes the next host when the first has gone")
    lockstep.connect(bridge)
    with pytest.raises(RobotError, match="in use by another program"):
        Transport(lockstep.device, lambda _: None, lambda _: None)
