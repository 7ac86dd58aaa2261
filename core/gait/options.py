"""Options of a gait: limits and cost for the optimiser, and how the result is sent."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from core.errors import InputError
from core.motion.heading_profile import HeadingProfile
from core.problem.motion_problem import PLANE_HEIGHTS, Boundary, Cost, MotionLimits, Workspace


@dataclass(frozen=True)
class OptionBounds:
    """The values that an option may have.

    Args:
        least: smallest value, in the unit that a person reads.
        most: largest value, likewise.
        factor: from SI to that unit.
        unit: with the blank before it; empty where there is none.
    """

    least: float
    most: float
    factor: int = 1
    unit: str = ""

    @property
    def least_si(self) -> float:
        """Smallest value, SI."""
        return self.least if self.factor == 1 else self.least / self.factor

    @property
    def most_si(self) -> float:
        """Largest value, SI."""
        return self.most if self.factor == 1 else self.most / self.factor

    def sentence(self, name: str, value: float) -> str | None:
        """What is wrong with a value, SI, of the option of that name; None where it is allowed."""
        shown = value * self.factor
        if self.least <= shown <= self.most:  # which no number that is not finite is
            return None
        number = f"{shown:d}" if isinstance(shown, int) else f"{shown:g}"
        allowed = f"it must lie between {self.least:g} and {self.most:g}{self.unit}"
        words, field = sayable(name), name.replace("_", " ")
        called = words if words == field else f"{words} ({name})"
        return f"The {called} is {number}{self.unit}; {allowed}."


def sayable(name: str) -> str:
    """What sentences call an option of that name."""
    return {"phase_knots": "phase length", "closing_knots": "final stance"}.get(name, name.replace("_", " "))


LEAST_PHASE_KNOTS, MOST_PHASE_KNOTS = 2, 50
"""Knots that a stance phase or a swing of a drawn timeline may have."""
MOST_CLOSING_KNOTS = 100
"""Knots that the closing stance of a drawn timeline may have."""

OPTION_BOUNDS: Mapping[str, OptionBounds] = MappingProxyType(
    {
        "clearance": OptionBounds(0.0, 20.0, 1000, " mm"),
        "margin": OptionBounds(0.0, 50.0, 1000, " mm"),
        "body_speed": OptionBounds(0.5, 1000.0, 1000, " mm/s"),
        "foot_speed": OptionBounds(0.5, 1000.0, 1000, " mm/s"),
        "plane_height": OptionBounds(30.0, 100.0, 1000, " mm"),
        "end_plane_height": OptionBounds(30.0, 100.0, 1000, " mm"),
        "friction": OptionBounds(0.01, 10.0),
        "motor_speed": OptionBounds(0.5, 1000.0, 1000, " mm/s"),
        "motor_acceleration": OptionBounds(0.5, 10000.0, 1000, " mm/s²"),
        "merge": OptionBounds(0.0, 5.0, 1000, " mm"),
        "stop_bound": OptionBounds(0.8, 10.0, 1, " s"),
        "phase_knots": OptionBounds(LEAST_PHASE_KNOTS, MOST_PHASE_KNOTS, 1, " samples"),
        "closing_knots": OptionBounds(0, MOST_CLOSING_KNOTS, 1, " samples"),
    }
)
"""Bounds of every option that is a number, by its name."""


@dataclass(frozen=True)
class GaitOptions:
    """What the optimiser is asked, and how its answer is sent, SI; defaults as in the contract.

    Args:
        clearance: how high the highest knot of each swing is at least.
        margin: how far inside the support polygon the centre of pressure stays.
        body_speed: limit of the body's speed.
        foot_speed: limit of each foot's speed.
        plane_height: actuator plane at the start.
        end_plane_height: actuator plane at the goal; None as at the start.
        workspace: which form of reach holds.
        cost: what is minimised.
        phase_knots: samples of each stance phase and of each swing of a drawn timeline.
        closing_knots: knots after the last swing of a drawn timeline.
        friction: coefficient of each foot's friction cone; None for none.
        motor_speed: limit of each motor's speed; None for none.
        motor_acceleration: limit of each motor's acceleration; None for none.
        boundary: from rest to rest, or a cycle.
        turning: when a gait with yaw turns the body.
        merge: distance in motor space within which waypoints are left out; 0 for one waypoint a sample.
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
    foot_speed: float = 0.015

    def __post_init__(self) -> None:
        for name, bounds in OPTION_BOUNDS.items():
            value = getattr(self, name)
            sentence = None if value is None else bounds.sentence(name, value)
            if sentence is not None:
                raise InputError(sentence, name)

    def motion_limits(self, heights: Iterable[float] = ()) -> MotionLimits:
        """The limits of a motion with these options.

        Args:
            heights: of actuator planes that the motion has to reach, m; they widen its range.
        """
        lowest, highest = PLANE_HEIGHTS
        reached = tuple(heights)
        return MotionLimits(
            foot_speed=self.foot_speed,
            body_speed=self.body_speed,
            clearance=self.clearance,
            margin=self.margin,
            workspace=self.workspace,
            friction=self.friction,
            motor_speed=self.motor_speed,
            motor_acceleration=self.motor_acceleration,
            plane_height=(min((lowest, *reached)), max((highest, *reached))),
        )
