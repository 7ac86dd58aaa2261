"""Messages to the robot: what they say, and what is refused."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from core.arrays import Floats
from core.errors import InputError
from core.wire.messages import (
    HIGHEST_MM,
    LONGEST_MESSAGE,
    LOWEST_MM,
    MOTORS,
    encode_release,
    encode_reset,
    encode_stop,
    encode_waypoint,
    payload_of,
)
from core.wire.waypoints import Waypoints

sendable = arrays(np.float64, (4, 3), elements=st.floats(LOWEST_MM / 1000, HIGHEST_MM / 1000))


@given(sendable, st.floats(0, 999))
def test_a_waypoint_message_says_the_strokes_in_millimetres(strokes: Floats, duration: float) -> None:
    fields = payload_of(encode_waypoint(strokes, duration)).split(",")
    assert fields[:2] == ["p", "1"]
    assert len(fields) == 3 + MOTORS
    np.testing.assert_allclose([float(f) for f in fields[3:]], strokes.reshape(-1) * 1000, atol=5.001e-5)


@given(sendable)
def test_what_is_sent_is_what_the_approved_file_says(strokes: Floats) -> None:
    waypoints = Waypoints(strokes[None], np.array([0.4]))
    sent = payload_of(encode_waypoint(waypoints.strokes[0], 0.4)).split(",")[3:]
    assert sent == [f"{h:.4f}" for h in waypoints.strokes_mm[0]]


@given(sendable, st.floats(0, 999))
def test_no_message_is_longer_than_the_robot_takes(strokes: Floats, duration: float) -> None:
    message = encode_waypoint(strokes, duration)
    assert len(message) <= LONGEST_MESSAGE
    assert message.count(b"<") == message.count(b">") == 1


@given(st.integers(0, 11), st.one_of(st.floats(max_value=0.00049), st.floats(min_value=0.01951)))
def test_a_stroke_out_of_range_is_refused_by_motor_value_and_limit(motor: int, stroke: float) -> None:
    strokes = np.full(12, 0.01)
    strokes[motor] = stroke
    with pytest.raises(InputError, match=rf"motor {motor + 1} \(foot {motor // 3 + 1}"):
        encode_waypoint(strokes, 1.0)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_a_stroke_that_is_not_finite_is_refused(bad: float) -> None:
    strokes = np.full((4, 3), 0.01)
    strokes[2, 1] = bad
    with pytest.raises(InputError, match="motor 8"):
        encode_waypoint(strokes, 1.0)


@pytest.mark.parametrize("shape", [(11,), (13,), (3, 4), (6, 3), (1, 12)])
def test_a_wrong_number_of_strokes_is_refused(shape: tuple[int, ...]) -> None:
    with pytest.raises(InputError, match="4 legs of 3 motors"):
        encode_waypoint(np.full(shape, 0.01), 1.0)


@pytest.mark.parametrize("duration", [-0.1, np.nan, np.inf, 1000.0])
def test_a_duration_that_makes_no_sense_is_refused(duration: float) -> None:
    with pytest.raises(InputError, match="duration"):
        encode_waypoint(np.full(12, 0.01), duration)


def test_the_short_messages_are_those_of_the_protocol() -> None:
    assert (encode_reset(), encode_stop(), encode_release()) == (b"<r>", b"<s,1>", b"<s,0>")
