"""The unknowns of a motion: their symbols, their place in the solver's vector, and the way back to SI.

The solver works in mm, mm/s and N. Point 0 is the body, points 1 to `legs` are the feet. A column holds one
knot: positions, velocities, forces. The forces of the last knot act on no interval; they are held fixed.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from casadi import SX, vec, vertcat

from core.arrays import Floats
from core.draft import Indices
from core.motion_problem import MotionProblem
from core.trajectory import Trajectory

MM = 1000.0
"""Millimetres in a metre."""


@dataclass(frozen=True, eq=False)
class MotionVector:
    """Numbers for every unknown, SI.

    Args:
        position: (n, 1 + legs, 3) m.
        velocity: (n, 1 + legs, 3) m/s.
        force: (n, legs, 3) N.
    """

    position: Floats
    velocity: Floats
    force: Floats

    def packed(self) -> Floats:
        """The solver's vector, a knot after the other, mm, mm/s and N."""
        n = len(self.position)
        parts = [self.position * MM, self.velocity * MM, self.force]
        return np.concatenate([part.reshape(n, -1) for part in parts], axis=1).reshape(-1)


def unpacked(vector: Floats, knots: int, legs: int) -> MotionVector:
    """Inverse of `MotionVector.packed`."""
    rows = vector.reshape(knots, -1)
    state = 3 * (legs + 1)
    return MotionVector(
        rows[:, :state].reshape(knots, legs + 1, 3) / MM,
        rows[:, state : 2 * state].reshape(knots, legs + 1, 3) / MM,
        rows[:, 2 * state :].reshape(knots, legs, 3),
    )


def vector_of_trajectory(trajectory: Trajectory) -> MotionVector:
    """The unknowns of a trajectory that has velocities and forces.

    Raises:
        ValueError: it lacks them.
    """
    known = (trajectory.body_velocity, trajectory.feet_velocity, trajectory.contact_forces)
    body_velocity, feet_velocity, forces = known
    if body_velocity is None or feet_velocity is None or forces is None:
        raise ValueError("The trajectory lacks velocities or contact forces.")
    return MotionVector(
        np.concatenate([trajectory.body_world[:, None], trajectory.feet_world], axis=1),
        np.concatenate([body_velocity[:, None], feet_velocity], axis=1),
        forces,
    )


def trajectory_of_vector(motion: MotionVector, like: Trajectory) -> Trajectory:
    """A trajectory of these numbers with the times, heading and contact of another."""
    return replace(
        like,
        body_world=motion.position[:, 0],
        feet_world=motion.position[:, 1:],
        body_velocity=motion.velocity[:, 0],
        feet_velocity=motion.velocity[:, 1:],
        contact_forces=motion.force,
    )


@dataclass(frozen=True, eq=False)
class Symbols:
    """Symbols of the unknowns and of what changes from problem to problem of one shape.

    Args:
        vector: every unknown in one column.
        position: 1 + legs matrices (3, n), mm.
        velocity: 1 + legs matrices (3, n), mm/s.
        force: legs matrices (3, n), N.
        sample_time: s.
        goal: (3·(1 + legs), 1) goal positions, mm.
        margin: stability margin, mm.
        successor: legs matrices (legs, n): 1 where foot j follows foot i round the standing feet.
    """

    vector: SX
    position: tuple[SX, ...]
    velocity: tuple[SX, ...]
    force: tuple[SX, ...]
    sample_time: SX
    goal: SX
    margin: SX
    successor: tuple[SX, ...]

    @property
    def parameters(self) -> SX:
        """Every parameter in one column, in the order of `parameter_values`."""
        return vertcat(self.sample_time, self.goal, self.margin, *(vec(part) for part in self.successor))


def make_symbols(legs: int, knots: int) -> Symbols:
    """Symbols for a number of legs and knots."""
    state = 3 * (legs + 1)
    columns = SX.sym("x", 2 * state + 3 * legs, knots)

    def points(first: int, count: int) -> tuple[SX, ...]:
        return tuple(columns[first + 3 * i : first + 3 * i + 3, :] for i in range(count))

    return Symbols(
        vector=columns.reshape((-1, 1)),
        position=points(0, legs + 1),
        velocity=points(state, legs + 1),
        force=points(2 * state, legs),
        sample_time=SX.sym("dt"),
        goal=SX.sym("goal", state),
        margin=SX.sym("margin"),
        successor=tuple(SX.sym(f"next{foot}", legs, knots) for foot in range(legs)),
    )


def parameter_values(problem: MotionProblem, successor: Indices) -> Floats:
    """Numbers for `Symbols.parameters`.

    Args:
        problem: the problem.
        successor: (n, legs) index of the next standing foot.
    """
    goal = np.concatenate([problem.goal.body_world[None], problem.goal.feet_world]).reshape(-1) * MM
    chosen = np.eye(problem.model.leg_count)[successor]
    head = [problem.timeline.sample_time, *goal, problem.limits.margin * MM]
    return np.concatenate([head, chosen.transpose(1, 0, 2).reshape(-1)])
