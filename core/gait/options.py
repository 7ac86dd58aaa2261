"""Options of a gait: limits and cost for the optimiser, and how the result is sent."""

from dataclasses import dataclass

import numpy as np

from core.errors import InputError
from core.motion.heading_profile import HeadingProfile
from core.problem.motion_problem import Boundary, Cost, Workspace

_OPTION_BOUNDS: dict[str, tuple[float, float, float, str]] = {
    "clearance": (1000.0, 0.0, 20.0, " mm"),
    "margin": (1000.0, -50.0, 50.0, " mm"),
    "body_speed": (1000.0, 0.5, 1000.0, " mm/s"),
    "plane_height": (1000.0, 30.0, 100.0, " mm"),
    "end_plane_height": (1000.0, 30.0, 100.0, " mm"),
    "friction": (1.0, 0.01, 10.0, ""),
    "motor_speed": (1000.0, 0.5, 1000.0, " mm/s"),
    "motor_acceleration": (1000.0, 0.5, 10000.0, " mm/s²"),
    "merge": (1000.0, 0.0, 5.0, " mm"),
    "stop_bound": (1.0, 0.8, 10.0, " s"),
}
"""Factor from SI to what a person reads, least, most, unit."""

LEAST_PHASE_KNOTS, MOST_PHASE_KNOTS = 2, 50
"""Knots that a stance phase or a swing of a drawn timeline may have."""
MOST_CLOSING_KNOTS = 100
"""Knots that the closing stance of a drawn timeline may have."""


@dataclass(frozen=True)
class GaitOptions:
    """What the optimiser is asked, and how its answer is sent, SI; defaults as in the contract.

    Args:
        clearance: how high the highest knot of each swing is at least.
        margin: how far inside the support polygon the centre of pressure stays.
        body_speed: limit of the body's speed.
        plane_height: actuator plane at the start.
        end_plane_height: actuator plane at the goal; None as at the start.
        workspace: which form of reach holds.
        cost: what is minimised.
        phase_knots: knots of each stance phase and of each swing of a drawn timeline.
        closing_knots: knots after the last swing of a drawn timeline.
        friction: coefficient of each foot's friction cone; None for none.
        motor_speed: limit of each motor's speed; None for none.
        motor_acceleration: limit of each motor's acceleration; None for none.
        boundary: from rest to rest, or a cycle.
        turning: when a gait with yaw turns the body.
        merge: distance in motor space within which waypoints are left out; 0 for one waypoint a knot.
        stop_bound: how long the robot may be deaf for Stop, s; None for as long as a move takes.
    """

    clearance: float = 0.003
    margin: float = 0.0
    body_speed: float = 0.015
    plane_height: float = 0.0535
    workspace: Workspace = Workspace.STROKE
    cost: Cost = Cost.GOAL
    phase_knots: int = 5
    closing_knots: int = 5
    end_plane_height: float | None = None
    friction: float | None = None
    motor_speed: float | None = None
    motor_acceleration: float | None = None
    boundary: Boundary = Boundary.REST
    turning: HeadingProfile = HeadingProfile.STEADY
    merge: float = 0.001
    stop_bound: float | None = 1.0

    def __post_init__(self) -> None:
        for name, (factor, lower, upper, unit) in _OPTION_BOUNDS.items():
            if getattr(self, name) is None:
                continue
            value = getattr(self, name) * factor
            if not (np.isfinite(value) and lower <= value <= upper):
                words = name.replace("_", " ")
                raise InputError(
                    f"The {words} is {value:g}{unit}; it must lie between {lower:g} and {upper:g}{unit}.",
                    name,
                )
        _require_knots("phase_knots", self.phase_knots, LEAST_PHASE_KNOTS, MOST_PHASE_KNOTS)
        _require_knots("closing_knots", self.closing_knots, 0, MOST_CLOSING_KNOTS)


def _require_knots(name: str, knots: int, least: int, most: int) -> None:
    if not least <= knots <= most:
        raise InputError(f"{name} is {knots}; it must lie between {least} and {most}.", name)
