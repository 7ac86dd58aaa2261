"""What each motor can do, under a set of physics parameters."""

import numpy as np

from core.arrays import Floats
from core.errors import InputError
from core.physics.parameters import PhysicsSet
from core.robot.model import RobotModel
from core.wire.robot_time import RAMP_SPEED

LEAST_SHARE = 0.05
"""Smallest share of its speed with which a motor is still one that moves."""


def motor_speeds(model: RobotModel, physics: PhysicsSet) -> Floats:
    """(legs, 3) largest speed of each motor, m/s.

    Raises:
        InputError: a motor has so little speed that it never arrives, or there is no such motor.
    """
    shares = physics.motor_speed * _shares(model, physics)
    if not (shares >= LEAST_SHARE).all():
        raise InputError(
            f"A motor has {shares.min():g} of its speed; each needs at least {LEAST_SHARE:g}.", "motor_speed"
        )
    return np.asarray(RAMP_SPEED * shares)


def motor_force_limits(model: RobotModel, physics: PhysicsSet) -> Floats:
    """(legs, 3) the most that each motor pushes or pulls, N.

    Raises:
        InputError: a motor has no force, or there is no such motor.
    """
    limits = physics.motor_force * _shares(model, physics)
    if not (limits > 0).all():
        raise InputError(f"A motor has {limits.min():g} N; each needs more than 0.", "motor_force")
    return np.asarray(limits)


def _shares(model: RobotModel, physics: PhysicsSet) -> Floats:
    """(legs, 3) 1, and the weak motor's share."""
    shares = np.ones(model.motor_count)
    if physics.weak_motor is not None:
        if not 0 <= physics.weak_motor < model.motor_count:
            raise InputError(
                f"Motor {physics.weak_motor + 1} is to be weak; the robot has {model.motor_count} motors.",
                "weak_motor",
            )
        shares[physics.weak_motor] = physics.weak_share
    return shares.reshape(-1, 3)
