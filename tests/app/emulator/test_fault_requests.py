"""Faults of the emulated robot as they are asked for, and what those of motors do."""

from __future__ import annotations

import pytest

from app.emulator.faults import Fault, FaultRequest
from app.emulator.motors import Motors
from core.errors import InputError


@pytest.mark.parametrize(
    ("text", "request_"),
    [
        ("noise", FaultRequest(Fault.NOISE)),
        ("reversed-motor", FaultRequest(Fault.REVERSED_MOTOR)),
        ("stuck-motor:12", FaultRequest(Fault.STUCK_MOTOR, (11,))),
        ("swapped-motors:4,5", FaultRequest(Fault.SWAPPED_MOTORS, (3, 4))),
    ],
)
def test_a_fault_is_read_with_its_motors(text: str, request_: FaultRequest) -> None:
    assert FaultRequest.parse(text) == request_


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("sneeze", "There is no fault sneeze; choose one of drop"),
        ("noise:3", "The fault noise has no motors; leave them out"),
        ("stuck-motor:0", "Motors are 1 to 12; the fault stuck-motor names 0"),
        ("stuck-motor:13", "Motors are 1 to 12"),
        ("stuck-motor:1,2", "The fault stuck-motor names one motor"),
        ("stuck-motor:x", "x are no motors; write as in stuck-motor:4"),
        ("stuck-motor:1_0", "1_0 are no motors; write as in stuck-motor:4"),
        ("stuck-motor:٤", "٤ are no motors; write as in stuck-motor:4"),
        ("swapped-motors:4", "The fault swapped-motors names 2 different motors"),
        ("swapped-motors:4,4", "The fault swapped-motors names 2 different motors"),
    ],
)
def test_a_fault_that_cannot_be_is_refused_with_a_sentence(text: str, sentence: str) -> None:
    with pytest.raises(InputError, match=sentence):
        FaultRequest.parse(text)


def test_swapped_motors_are_driven_by_each_other_until_they_are_mended() -> None:
    motors = Motors([5.0] * 12)
    motors.command(3, 255, 0)
    motors.swap(3, 4, 1_000_000)
    assert [motors.stroke_mm(index, 2_000_000) for index in (3, 4)] == [20.0, 5.0]
    motors.command(3, 255, 2_000_000)
    assert motors.way(3) == 1
    assert motors.way(4) == 0
    assert motors.stroke_mm(4, 2_200_000) == pytest.approx(8.0)
    motors.mend(2_200_000)
    assert motors.stroke_mm(4, 3_000_000) == pytest.approx(8.0)
    motors.command(4, 255, 3_000_000)
    assert motors.stroke_mm(4, 3_200_000) == pytest.approx(11.0)


def test_a_reversed_motor_turns_the_wrong_way_until_it_is_mended() -> None:
    motors = Motors([10.0] * 12)
    motors.weaken(6, -1.0, 0)
    motors.command(6, 255, 0)
    assert motors.stroke_mm(6, 200_000) == pytest.approx(7.0)
    motors.mend(200_000)
    assert motors.stroke_mm(6, 400_000) == pytest.approx(10.0)
