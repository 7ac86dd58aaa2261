"""Steps by hand: they move what they say and nothing else, and what the robot cannot make is refused."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from core.arrays import Floats
from core.errors import InputError
from core.findings import Finding, Severity
from core.jog.check import JogCheck, check_jog
from core.jog.steps import Axis, JogPart, JogStep, jog_range, jog_strokes, within_range
from core.robot.kinematics import feet_in_robot
from core.robot.leg import strokes_from_foot
from core.robot.model import ROBOT_NAMES, load_robot
from core.wire.robot_time import ARRIVAL_THRESHOLD, START_MOVE

WALKER = load_robot("deltawalker")
LOWER, UPPER = WALKER.stroke.lower, WALKER.stroke.upper
ROUNDING = 1e-9
JUST_BEYOND = np.geomspace(1e-8, 1e-4, 9)
"""Distances behind the end of a range, m."""

strokes_of_walker = arrays(np.float64, (4, 3), elements=st.floats(0.0, 0.02))
lengths = st.floats(-0.02, 0.02)
motor_steps = st.builds(JogStep, st.just(JogPart.MOTOR), lengths, st.integers(0, 3), st.integers(0, 2))
foot_steps = st.builds(
    JogStep, st.just(JogPart.FOOT), lengths, st.integers(0, 3), st.none(), st.sampled_from(Axis)
)
body_steps = st.builds(JogStep, st.just(JogPart.BODY), lengths, axis=st.sampled_from(Axis))
any_steps = st.lists(motor_steps | foot_steps | body_steps, max_size=4)


def standing(stroke: float = 0.008) -> Floats:
    """Every motor at one stroke, m."""
    return np.full((4, 3), stroke)


def foot(number: int, axis: Axis, by: float) -> JogStep:
    return JogStep(JogPart.FOOT, by, number - 1, None, axis)


def body(axis: Axis, by: float) -> JogStep:
    return JogStep(JogPart.BODY, by, axis=axis)


def motor(number: int, of_foot: int, by: float) -> JogStep:
    return JogStep(JogPart.MOTOR, by, of_foot - 1, number - 1)


def along(step: JogStep) -> Floats:
    """(3,) the axis of a step."""
    return np.array([float(axis is step.axis) for axis in Axis])


def found(answer: JogCheck, rule: str) -> Finding:
    """The one finding of a rule."""
    (finding,) = [f for f in answer.findings if f.rule == rule]
    return finding


@given(strokes_of_walker, any_steps)
def test_no_step_leaves_the_range_that_may_be_sent(measured: Floats, steps: Sequence[JogStep]) -> None:
    answer = check_jog(WALKER, measured, steps)
    assert (answer.target is None) == (not answer.way and bool(steps))
    for place in answer.way:
        assert LOWER - ROUNDING <= place.min() <= place.max() <= UPPER + ROUNDING
    if answer.target is None:
        assert answer.errors[0].rule == "stroke"


@given(strokes_of_walker, any_steps)
def test_no_move_of_a_jog_is_longer_than_one_to_a_start_pose(measured: Floats, steps: list[JogStep]) -> None:
    answer = check_jog(WALKER, measured, steps)
    assert answer.largest_move <= START_MOVE + ROUNDING
    if answer.way:
        assert answer.target is not None
        np.testing.assert_allclose(answer.way[-1], answer.target, atol=ROUNDING)


@given(st.floats(0.004, 0.016), st.lists(body_steps, min_size=1, max_size=3))
def test_the_body_goes_by_a_step_and_every_foot_stays_where_it_stands(
    stroke: float, steps: Sequence[JogStep]
) -> None:
    answer = check_jog(WALKER, standing(stroke), steps)
    gone = np.zeros(3)
    for step in steps:
        gone += step.by * along(step)
    for share, place in enumerate(answer.way, 1):
        feet = feet_in_robot(WALKER, place) + gone * share / len(answer.way)
        np.testing.assert_allclose(feet, feet_in_robot(WALKER, answer.start), atol=1e-9)


@given(strokes_of_walker, foot_steps)
def test_a_foot_goes_by_its_step_along_the_robots_axis_and_the_others_stay(
    measured: Floats, step: JogStep
) -> None:
    answer = check_jog(WALKER, measured, [step])
    if answer.target is None or step.foot is None:
        return
    gone = answer.feet - feet_in_robot(WALKER, answer.start)
    wanted = np.zeros((4, 3))
    wanted[step.foot] = step.by * along(step)
    np.testing.assert_allclose(gone, wanted, atol=1e-9)


@given(strokes_of_walker, motor_steps)
def test_a_motor_moves_alone(measured: Floats, step: JogStep) -> None:
    gone = jog_strokes(WALKER, measured, [step]) - measured
    assert gone[step.foot, step.motor] == pytest.approx(step.by, abs=1e-12)
    gone[step.foot, step.motor] = 0.0
    assert not gone.any()


@given(strokes_of_walker, foot_steps | body_steps | motor_steps)
def test_the_range_of_a_step_is_as_far_as_it_can_go(measured: Floats, step: JogStep) -> None:
    start = np.clip(measured, LOWER, UPPER)
    for length in jog_range(WALKER, start, step):
        inside = jog_strokes(WALKER, start, [JogStep(step.part, length, step.foot, step.motor, step.axis)])
        assert LOWER - 1e-8 <= inside.min() <= inside.max() <= UPPER + 1e-8
        if abs(length) < 0.02:
            # A motor may touch its end and come back, so what is just beyond counts, not what is far beyond.
            beyond = [replace(step, by=length + np.copysign(more, length)) for more in JUST_BEYOND]
            assert not all(within_range(WALKER, jog_strokes(WALKER, start, [one])) for one in beyond)


def test_the_range_ends_where_a_motor_touches_its_end_for_a_moment() -> None:
    start = standing(0.00751821)
    start[3] = 0.00217522, 0.00050968, 0.00751821
    low, high = jog_range(WALKER, start, body(Axis.X, 0.0))
    for length in (low, high):
        assert within_range(WALKER, jog_strokes(WALKER, start, [body(Axis.X, length)]))
    assert within_range(WALKER, jog_strokes(WALKER, start, [body(Axis.X, low - 1e-4)]))
    assert not within_range(WALKER, jog_strokes(WALKER, start, [body(Axis.X, low - 1e-6)]))


def test_a_step_within_the_firmwares_threshold_is_refused_before_it_is_sent() -> None:
    refused = found(check_jog(WALKER, standing(), [motor(2, 3, ARRIVAL_THRESHOLD)]), "threshold")
    assert refused.severity is Severity.ERROR
    assert "No motor would move: the largest change is 1.00 mm" in refused.sentence
    assert check_jog(WALKER, standing(), [motor(2, 3, 0.0011)]).errors == ()


def test_two_small_steps_add_up_to_one_that_moves() -> None:
    answer = check_jog(WALKER, standing(), [motor(2, 3, 0.0006), motor(2, 3, 0.0006)])
    assert (len(answer.way), answer.errors) == (1, ())


def test_a_step_out_of_range_names_the_motor_and_how_far_it_may_go() -> None:
    refused = check_jog(WALKER, standing(), [body(Axis.Z, 0.015)]).errors[0]
    assert refused.sentence == (
        "Motor 1 of foot 1 would go to 23.00 mm; its range is 0.5 to 19.5 mm. "
        "This step may have -7.5 to 11.5 mm."
    )


def test_a_foot_beyond_its_rods_is_refused_in_words() -> None:
    steps = [foot(2, Axis.Y, 0.02)] * 3
    refused = check_jog(WALKER, standing(0.01), steps).errors[0]
    assert (refused.foot, refused.value) == (1, None)
    assert "No rod of foot 2 is long enough" in refused.sentence


def test_a_foot_that_lifts_towards_the_mass_would_tip_the_robot() -> None:
    refused = check_jog(WALKER, standing(), [body(Axis.X, 0.006), foot(1, Axis.Z, 0.004)]).errors[0]
    assert refused.rule == "balance"
    assert refused.value == pytest.approx(-0.006)
    assert "feet 2, 3, 4" in refused.sentence
    assert check_jog(WALKER, standing(), [body(Axis.X, 0.006), foot(3, Axis.Z, 0.004)]).findings == ()


def test_a_robot_that_does_not_balance_may_be_moved_to_where_it_does() -> None:
    tipped = check_jog(WALKER, standing(), [body(Axis.X, 0.006), foot(1, Axis.Z, 0.004)])
    assert tipped.target is not None
    down = check_jog(WALKER, tipped.target, [foot(1, Axis.Z, -0.004)])
    assert down.errors == ()
    half = check_jog(WALKER, tipped.target, [foot(1, Axis.Z, -0.0015)])
    assert [f.severity for f in half.findings] == [Severity.WARNING]
    assert "does not balance" in half.findings[0].sentence


def test_a_motor_that_stands_beyond_its_range_is_named_and_not_moved_much() -> None:
    measured = standing()
    measured[1, 2] = 0.0199
    answer = check_jog(WALKER, measured, [motor(1, 1, 0.002)])
    assert "Motor 3 of foot 2 stands at 19.90 mm" in found(answer, "stroke").sentence
    assert answer.start[1, 2] == UPPER


def test_a_way_that_leaves_the_range_between_two_good_places_is_refused() -> None:
    """Past its own motor a foot needs that motor's stroke shorter than on either side."""
    side = np.array([-0.006, -WALKER.leg.reach_radius, 0.0])
    side[2] = -0.00055 - np.sqrt(WALKER.leg.link_length**2 - side[0] ** 2)
    start = standing()
    start[1] = strokes_from_foot(WALKER.leg, side)
    across = foot(2, Axis.X, 0.012)
    assert within_range(WALKER, jog_strokes(WALKER, start, [across]))
    answer = check_jog(WALKER, start, [across])
    assert answer.target is None
    assert "Motor 1 of foot 2 would go to 0.19 mm" in answer.errors[0].sentence


@pytest.mark.parametrize(
    ("step", "field"),
    [
        (JogStep(JogPart.FOOT, 0.001, 4, None, Axis.X), "foot"),
        (JogStep(JogPart.FOOT, 0.001, None, None, Axis.X), "foot"),
        (JogStep(JogPart.FOOT, 0.001, 0, 1, Axis.X), "motor"),
        (JogStep(JogPart.FOOT, 0.001, 0), "axis"),
        (JogStep(JogPart.MOTOR, 0.001, 0, 3), "motor"),
        (JogStep(JogPart.MOTOR, 0.001, 0, 0, Axis.Z), "axis"),
        (JogStep(JogPart.BODY, 0.001, 1, None, Axis.Z), "foot"),
        (JogStep(JogPart.BODY, 0.001), "axis"),
        (JogStep(JogPart.BODY, 0.021, axis=Axis.Z), "by"),
        (JogStep(JogPart.BODY, float("nan"), axis=Axis.Z), "by"),
    ],
)
def test_a_step_that_says_too_little_or_too_much_is_refused(step: JogStep, field: str) -> None:
    with pytest.raises(InputError) as refused:
        check_jog(WALKER, standing(), [step])
    assert refused.value.where == field


@pytest.mark.parametrize(("name", "rise"), [("deltawalker9", 5.0), ("deltawalker5", -0.4)])
def test_single_feet_lift_with_nine_motors_and_slide_with_five(name: str, rise: float) -> None:
    answer = check_jog(load_robot(name), standing(), [foot(1, Axis.Z, 0.006)])
    residual, lift = answer.findings
    assert "stays 4.5 mm off" in residual.sentence
    assert lift.value == pytest.approx(rise / 1000, abs=5e-5)
    assert ("slides rather than lifts" in lift.sentence) == (rise < 1.0)


def test_motors_of_one_actuator_move_together() -> None:
    five = load_robot("deltawalker5")
    answer = check_jog(five, standing(), [motor(1, 1, 0.003)])
    assert answer.target is not None
    np.testing.assert_allclose(answer.target[:, 0], 0.011)
    np.testing.assert_allclose(answer.target[:, 1:], 0.008)
    assert answer.findings == ()


@pytest.mark.parametrize("name", ROBOT_NAMES)
def test_every_robot_can_be_raised_by_hand(name: str) -> None:
    model = load_robot(name)
    answer = check_jog(model, np.full((model.leg_count, 3), 0.005), [body(Axis.Z, 0.004)])
    assert answer.target is not None
    np.testing.assert_allclose(answer.target, 0.009, atol=1e-12)
    assert answer.errors == ()
