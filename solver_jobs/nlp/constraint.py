"""What a constraint is: bounds on the unknowns themselves, or rows of a function of them.

The contact sequence enters only through bounds, so that one structure serves every timeline of its shape.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from enum import StrEnum
from typing import ClassVar, Protocol

import numpy as np
from casadi import SX

from core.arrays import Bools, Floats
from core.motion.contact_timeline import Swing
from core.problem.initial_guess import Indices, closed_contact, next_standing, problem_swings
from core.problem.motion_problem import MotionProblem
from core.robot.model import RobotModel
from solver_jobs.nlp.variables import MotionVector, Symbols

CROSSING_TOLERANCE = 1e-9
"""Bounds that cross by less than this (m, m/s, N) are taken to meet."""


class Family(StrEnum):
    """The family of a constraint."""

    BOUNDARY = "boundary"
    DYNAMICS = "dynamics"
    BODY_HEIGHT = "body_height"
    FOOT_HEIGHT = "foot_height"
    FOOT_SPEED = "foot_speed"
    BODY_SPEED = "body_speed"
    GROUNDED_VELOCITY = "grounded_velocity"
    GROUNDED_HEIGHT = "grounded_height"
    CONTACT_FORCE = "contact_force"
    FLOATING_FORCE = "floating_force"
    BODY_TORQUE = "body_torque"
    WORKSPACE = "workspace"
    CLEARANCE = "clearance"
    MARGIN = "margin"
    FRICTION = "friction"
    MOTOR_SPEED = "motor_speed"
    MOTOR_ACCELERATION = "motor_acceleration"
    SHOE_DISTANCE = "shoe_distance"


@dataclass(frozen=True, eq=False)
class Situation:
    """A problem with what several constraints derive from its timeline.

    Args:
        problem: the problem.
        contact: (n, legs) stance; at the last knot of every foot that is not held up.
        swings: every swing.
        successor: (n, legs) next standing foot round the ring.
    """

    problem: MotionProblem
    contact: Bools
    swings: tuple[Swing, ...]
    successor: Indices


def situation_of(problem: MotionProblem) -> Situation:
    """Derives the situation of a problem."""
    contact = closed_contact(problem)
    return Situation(problem, contact, problem_swings(problem), next_standing(problem.model, contact))


@dataclass(frozen=True)
class BoundConflict:
    """Bounds that contradict each other.

    Args:
        family: whose bound crossed what was there before.
        knot: 0-based.
        gap: by how much, SI.
    """

    family: Family
    knot: int
    gap: float


@dataclass(frozen=True, eq=False)
class Box:
    """Lower and upper bounds of every unknown, SI, tightened by one constraint after the other."""

    lower: MotionVector
    upper: MotionVector
    conflicts: list[BoundConflict] = field(default_factory=list)

    def meet_crossed_bounds(self, family: Family) -> None:
        """Notes where bounds have crossed, and lets them meet there."""
        for part in ("position", "velocity", "force"):
            lower, upper = getattr(self.lower, part), getattr(self.upper, part)
            gap = lower - upper
            crossed = gap > 0
            if not crossed.any():
                continue
            worst = np.unravel_index(int(gap.argmax()), gap.shape)
            if gap[worst] > CROSSING_TOLERANCE:
                self.conflicts.append(BoundConflict(family, int(worst[0]), float(gap[worst])))
            upper[crossed] = lower[crossed]


def open_box(knots: int, legs: int) -> Box:
    """A box without walls."""

    def filled(value: float) -> MotionVector:
        state = (knots, legs + 1, 3)
        return MotionVector(np.full(state, value), np.full(state, value), np.full((knots, legs, 3), value))

    return Box(filled(-np.inf), filled(np.inf))


class BoundConstraint(Protocol):
    """A demand on single unknowns."""

    @property
    def family(self) -> Family:
        """Which demand it is."""

    def tighten(self, box: Box, situation: Situation) -> None:
        """Narrows the box, SI."""


class RowConstraint(ABC):
    """A demand on functions of the unknowns; a row of numbers a knot."""

    family: ClassVar[Family]
    """Which demand it is."""

    unit: ClassVar[str] = "mm"
    """Unit of `excess`."""

    per_unit: ClassVar[float] = 1.0
    """About how much the rows change where `excess` changes by 1, near the bound."""

    rows_per_foot: ClassVar[int] = 0
    """How many rows of a knot belong to each foot, foot after foot; 0 where they are the body's."""

    @abstractmethod
    def rows(self, symbols: Symbols, model: RobotModel) -> SX:
        """(rows a knot, knots) in the solver's scale; knots count from the first."""

    @abstractmethod
    def bounds(self, situation: Situation) -> tuple[Floats, Floats]:
        """Lower and upper bounds, each broadcasting to (knots, rows a knot)."""

    def excess(self, values: Floats, lower: Floats, upper: Floats) -> Floats:
        """How far values (knots, rows a knot) lie outside their bounds, in `unit`."""
        return outside(values, lower, upper)


class SquaredRows(RowConstraint):
    """Rows that are the square of what is bounded from above, which has no root without a derivative."""

    def excess(self, values: Floats, lower: Floats, upper: Floats) -> Floats:
        """How far the roots of the values lie above the roots of their bounds, in `unit`."""
        return outside(np.sqrt(np.maximum(values, 0.0)), -np.inf, np.sqrt(upper))


def outside(values: Floats, lower: Floats | float, upper: Floats) -> Floats:
    """Distance of values to the interval between their bounds, 0 inside."""
    return np.asarray(np.maximum(np.maximum(lower - values, values - upper), 0.0))
