"""A few hundred waypoints with faults of every kind, judged by the emulated motors."""

import random

import pytest

import app.bench.robot.soak as bridge_soak
from app.bench.robot.auditor import Auditor, Findings
from app.bench.robot.soak import SoakRound, bench_soak, soak
from app.bridge.delivery import Delivery
from app.bridge.states import RobotState
from app.bridge.write_gate import WriteGate
from app.emulator.faults import Cable, Delayer, Dropper, Fault, Garbler, Splitter
from core.wire.lines import Telemetry
from tests.support.virtual_robot import VirtualRobot, random_plan

pytestmark = pytest.mark.heavy


@pytest.mark.parametrize("fault", list(Fault))
def test_a_fault_of_each_kind_breaks_no_promise(fault: Fault) -> None:
    findings = soak(40, seed=3, faults=[fault])[fault.value]
    assert findings.violations == 0, findings
    assert findings.sent >= 40


def test_the_table_has_a_row_for_each_fault_and_one_for_all() -> None:
    rows = bench_soak(12, seed=4)
    assert [row["fault"] for row in rows] == [*Fault, "all"]
    assert rows[-1]["sent"] == sum(row["sent"] for row in rows[:-1])


def play(fault: Fault, rounds: int) -> Findings:
    findings = Findings()
    for number in range(rounds):
        SoakRound(fault, random.Random(number), findings).run()
    return findings


def test_the_judge_sees_a_session_that_believes_every_echo(monkeypatch: pytest.MonkeyPatch) -> None:
    def believe(delivery: Delivery, line: object) -> None:
        del line
        delivery._left.pop(0)

    monkeypatch.setattr(Delivery, "_await_echo", believe)
    monkeypatch.setattr(Delivery, "_await_point", believe)
    monkeypatch.setattr("app.emulator.faults.GARBLE_CHANCE", 0.01)
    assert play(Fault.GARBLE, 6).violations > 0


def test_the_judge_sees_waypoints_that_were_not_reached(monkeypatch: pytest.MonkeyPatch) -> None:
    def believe(delivery: Delivery, line: object) -> None:
        if isinstance(line, Telemetry):
            delivery._left.clear()

    monkeypatch.setattr(Delivery, "_await_end", believe)
    assert play(Fault.STUCK_MOTOR, 3).skipped > 0


def test_the_judge_sees_messages_after_a_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(WriteGate, "stop", lambda gate: gate._put(b"<s,0>"))
    monkeypatch.setattr(bridge_soak, "LIMIT", 20.0)
    found = play(Fault.STUCK_MOTOR, 1)
    assert found.unapproved > 0
    assert found.hangs == 1


def test_the_judge_sees_a_wrong_stroke() -> None:
    robot = VirtualRobot()
    findings = Findings()
    auditor = Auditor(robot, findings)
    robot.boot()
    robot.connect()
    auditor.expect(random_plan(1, 3))
    robot.machine.arm("Ada")
    robot.machine.send(random_plan(2, 3), "Ada", robot.now)
    while robot.snapshot.robot is RobotState.MOVING:
        robot.step()
        auditor.look()
    assert findings.unapproved == 0
    assert findings.skipped == 3
    robot.gate.write(b"<p,1,1.00" + b",20.0" * 12 + b">", robot.gate.permit())
    assert (findings.out_of_range, findings.unapproved) == (1, 1)


@pytest.mark.parametrize(
    ("line", "sentence", "moves"),
    [
        ("end of all", "did not report that it arrived", 2),
        ("Trajectory Point", "did not confirm the strokes", 1),
    ],
)
def test_a_line_that_was_garbled_is_noticed_at_once(line: str, sentence: str, moves: int) -> None:
    robot = VirtualRobot()
    robot.boot()
    robot.begin(random_plan(5, 2))
    robot.from_robot = lambda data: data.replace(line.encode(), line.encode()[:-1] + b"X")
    snapshot = robot.until_robot(RobotState.FAULT)
    assert sentence in snapshot.sentence
    assert len(robot.firmware.completions) == moves
    last = robot.firmware.completions[-1].time if moves > 1 else robot.firmware.messages[-1].time
    assert robot.now - last < 0.3


def test_split_and_delayed_bytes_all_arrive_in_order() -> None:
    for spoiler in (Splitter(random.Random(1)), Delayer(random.Random(1))):
        sent = [bytes([i, i + 1]) for i in range(0, 200, 2)]
        came = [spoiler.carry(data, 0.01 * i) for i, data in enumerate(sent)]
        assert b"".join(came) != b"".join(sent)
        assert b"".join([*came, spoiler.carry(b"", 10.0)]) == b"".join(sent)


def test_a_mended_cable_gives_back_what_was_late_and_spoils_nothing() -> None:
    cable = Cable()
    cable.spoil(Delayer(random.Random(1)))
    assert cable.carry(b"late", 0.0) == b""
    cable.mend()
    assert cable.carry(b", now", 0.01) == b"late, now"
    assert cable.carry(b"sound", 0.02) == b"sound"


def test_dropped_and_garbled_bytes_are_as_many_as_their_chance_says() -> None:
    data = bytes(20_000)
    dropped = len(data) - len(Dropper(random.Random(1), 0.01).carry(data, 0.0))
    garbled = Garbler(random.Random(1), 0.01).carry(data, 0.0)
    assert 150 < dropped < 250
    assert 150 < sum(byte != 0 for byte in garbled) < 250
    assert all(byte.bit_count() <= 1 for byte in garbled)
