"""Parameters of the physics that no data sheet gives, and how far each may lie from its default."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from core.arrays import Floats
from core.physics.parameters import PhysicsSet


@dataclass(frozen=True)
class FitParameter:
    """A parameter in units of what is thought of it before any trial: z = 0 is its default, 1 its spread.

    Args:
        name: of the field of `PhysicsSet`, or of a part of it.
        title: what a person reads.
        unit: in which it is shown.
        scale: shown value of an SI value.
        spread: what its default may well be off, in its own terms (see `value`).
        low: smallest z.
        high: largest z.
        read: its value in a set.
        write: the set with another value.
        is_inverse: whether z counts in the value's inverse, as of a stiffness whose compliance moves feet.
    """

    name: str
    title: str
    unit: str
    scale: float
    spread: float
    low: float
    high: float
    read: Callable[[PhysicsSet], float]
    write: Callable[[PhysicsSet, float], PhysicsSet]
    is_inverse: bool = False

    def value(self, physics: PhysicsSet, z: float) -> float:
        """The value at z beside a set's, SI."""
        default = self.read(physics)
        return 1.0 / (1.0 / default + self.spread * z) if self.is_inverse else default + self.spread * z


FIT_PARAMETERS = (
    FitParameter(
        "link_stiffness",
        "Link stiffness",
        "kN/m",
        1e-3,
        0.4e-3,
        -0.09,
        2.3,
        lambda physics: physics.link_stiffness,
        lambda physics, value: replace(physics, link_stiffness=value),
        is_inverse=True,
    ),
    FitParameter(
        "friction",
        "Friction",
        "",
        1.0,
        0.2,
        -2.5,
        2.0,
        lambda physics: physics.friction,
        lambda physics, value: replace(physics, friction=value),
    ),
    FitParameter(
        "cable_drag",
        "Cable drag",
        "N",
        1.0,
        0.5,
        0.0,
        2.4,
        lambda physics: physics.cable_drag,
        lambda physics, value: replace(physics, cable_drag=value),
    ),
    FitParameter(
        "centre_offset_x",
        "Centre of mass, x",
        "mm",
        1e3,
        0.004,
        -2.0,
        2.0,
        lambda physics: physics.centre_offset[0],
        lambda physics, value: replace(physics, centre_offset=(value, physics.centre_offset[1])),
    ),
    FitParameter(
        "centre_offset_y",
        "Centre of mass, y",
        "mm",
        1e3,
        0.004,
        -2.0,
        2.0,
        lambda physics: physics.centre_offset[1],
        lambda physics, value: replace(physics, centre_offset=(physics.centre_offset[0], value)),
    ),
    FitParameter(
        "backlash",
        "Backlash",
        "mm",
        1e3,
        0.0005,
        0.0,
        2.4,
        lambda physics: physics.backlash,
        lambda physics, value: replace(physics, backlash=value),
    ),
    FitParameter(
        "motor_speed",
        "Motor speed",
        "%",
        1e2,
        0.1,
        -2.5,
        0.0,
        lambda physics: physics.motor_speed,
        lambda physics, value: replace(physics, motor_speed=value),
    ),
)
"""What is fitted. Spreads are estimates: links of 20 kN/m may well have 2.2 (T 5.1 blames deformed links and
gives no figure); grip tape on acrylic; a cable that hangs or drags; a board and plugs that lie anywhere; play
of gear and hinges; a supply that sags."""


def physics_at(
    physics: PhysicsSet, z: Floats, parameters: Sequence[FitParameter] = FIT_PARAMETERS
) -> PhysicsSet:
    """A set with its parameters at a point.

    Args:
        physics: whose values are the defaults.
        z: (parameters,).
        parameters: which.
    """
    changed = physics
    for parameter, place in zip(parameters, z, strict=True):
        if place != 0.0:
            changed = parameter.write(changed, parameter.value(physics, float(place)))
    return changed


def box(parameters: Sequence[FitParameter] = FIT_PARAMETERS) -> tuple[Floats, Floats]:
    """(parameters,) smallest and largest z."""
    return np.array([one.low for one in parameters]), np.array([one.high for one in parameters])
