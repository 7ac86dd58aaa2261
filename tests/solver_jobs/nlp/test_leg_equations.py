"""The leg's equations in CasADi against those in numpy: value and Jacobian."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from casadi import SX, Function, jacobian, vertcat

from core.arrays import Floats
from core.robot.leg import foot_from_strokes as numpy_foot
from core.robot.leg import foot_jacobian
from core.robot.leg import squared_offsets as numpy_offsets
from core.robot.leg import stroke_rates as numpy_rates
from core.robot.leg import strokes_from_foot as numpy_strokes
from core.robot.model import load_robot
from solver_jobs.nlp.leg_equations import (
    foot_from_strokes,
    motor_arms,
    squared_offsets,
    stroke_rates,
    strokes_from_foot,
)

LEG = load_robot("deltawalker").leg
REACH, LINK = LEG.reach_radius, LEG.link_length


def random_strokes(count: int = 200) -> Floats:
    return np.random.default_rng(20250301).uniform(0.0005, 0.0195, size=(count, 3))


def compiled(equation: Callable[[list[SX]], list[SX]]) -> tuple[Function, Function]:
    """A function of a (3,) vector and its Jacobian."""
    symbol = SX.sym("x", 3)
    value = vertcat(*equation([symbol[0], symbol[1], symbol[2]]))
    return Function("value", [symbol], [value]), Function("slope", [symbol], [jacobian(value, symbol)])


def differences(function: Callable[[Floats], Floats], point: Floats, step: float = 1e-6) -> Floats:
    """(3, 3) Jacobian by central differences."""
    columns = [(function(point + e) - function(point - e)) / (2 * step) for e in step * np.eye(3)]
    return np.stack(columns, axis=-1)


def test_forward_kinematics_agrees_in_value_and_jacobian() -> None:
    value, slope = compiled(lambda strokes: foot_from_strokes(REACH, LINK, strokes))
    for strokes in random_strokes():
        np.testing.assert_allclose(np.array(value(strokes)).ravel(), numpy_foot(LEG, strokes), atol=1e-14)
        analytic = np.array(slope(strokes))
        np.testing.assert_allclose(analytic, foot_jacobian(LEG, strokes), atol=1e-10)
        np.testing.assert_allclose(analytic, differences(lambda h: numpy_foot(LEG, h), strokes), atol=1e-5)


def test_inverse_kinematics_agrees_in_value_and_jacobian() -> None:
    value, slope = compiled(lambda foot: strokes_from_foot(REACH, LINK, foot))
    for foot in numpy_foot(LEG, random_strokes()):
        np.testing.assert_allclose(np.array(value(foot)).ravel(), numpy_strokes(LEG, foot), atol=1e-14)
        wanted = differences(lambda p: numpy_strokes(LEG, p), foot)
        np.testing.assert_allclose(np.array(slope(foot)), wanted, atol=1e-5)


def test_squared_offsets_agree() -> None:
    value, _ = compiled(lambda foot: squared_offsets(motor_arms(REACH, foot)))
    for foot in numpy_foot(LEG, random_strokes(20)):
        np.testing.assert_allclose(np.array(value(foot)).ravel(), numpy_offsets(LEG, foot), atol=1e-17)


def test_motor_speeds_agree() -> None:
    rng = np.random.default_rng(4)
    symbol = SX.sym("x", 6)
    place, velocity = ([symbol[i + k] for k in range(3)] for i in (0, 3))
    value = Function("rates", [symbol], [vertcat(*stroke_rates(LINK, motor_arms(REACH, place), velocity))])
    for foot in numpy_foot(LEG, random_strokes(20)):
        speed = rng.normal(0.0, 0.01, 3)
        found = np.array(value(np.append(foot, speed))).ravel()
        np.testing.assert_allclose(found, numpy_rates(LEG, foot, speed), atol=1e-16)
