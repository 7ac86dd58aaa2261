"""Sentences of the bridge: where a garbled echo differs."""

from __future__ import annotations

import pytest

from app.bridge.messages import misread_sentence
from app.bridge.states import RobotState
from core.wire.messages import encode_waypoint, payload_of
from tests.support.virtual_robot import VirtualRobot, make_plan

SENT = payload_of(encode_waypoint([0.005] * 12, 0.4))


@pytest.mark.parametrize("place", [0, 7, 45, 60, len(SENT) - 1])
def test_a_garbled_echo_is_shown_where_it_first_differs_and_its_two_texts_look_different(place: int) -> None:
    read = SENT[:place] + "#" + SENT[place + 1 :]
    sentence = misread_sentence(SENT, read)
    assert f"from character {place + 1} on" in sentence
    shown, expected = sentence.split("it read ")[1].split(" where ")
    assert "#" in shown
    assert "#" not in expected
    assert len(shown) < 40


@pytest.mark.parametrize(
    ("read", "place", "shown"),
    [
        (SENT[:50], 51, "nothing more after “…"),
        (SENT + ",9", len(SENT) + 1, ",9”"),
        ("", 1, "nothing more after “”"),
        (SENT[:20] + "\x07" + SENT[21:], 21, "\\x07"),
    ],
)
def test_an_echo_that_is_cut_longer_or_not_printable_is_shown_too(read: str, place: int, shown: str) -> None:
    sentence = misread_sentence(SENT, read)
    assert f"from character {place} on" in sentence
    assert shown in sentence
    assert sentence.isprintable()


def test_a_run_whose_echo_differs_far_from_its_beginning_says_where(robot: VirtualRobot) -> None:
    robot.arm()
    robot.to_robot = lambda data: data[:-5] + b"3" + data[-4:] if data.startswith(b"<p") else data
    robot.machine.send(make_plan([[4.0] * 12, [6.0] * 12]), "Ada", robot.now)
    fault = robot.until_robot(RobotState.FAULT).last_error
    assert fault is not None
    shown, expected = fault.split("it read ")[1].split(" was sent")[0].split(" where ")
    assert shown != expected
