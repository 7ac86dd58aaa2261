"""The unknowns of a motion: their symbols, their place in the solver's vector, and the way back to SI.

The solver works in mm, mm/s and N. Point 0 is the body, points 1 to `legs` are the feet. A column holds one
knot: positions, velocities, forces. The forces of the last knot act on no interval; they are held fixed.
Where friction is asked for, a foot's unknowns are not λ but (λ_x/λ_z, λ_y/λ_z, λ_z): its slope and its load.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from casadi import SX, cos, horzcat, repmat, sin, vec, vertcat

from core.arrays import Floats
from core.motion.trajectory import Trajectory
from core.problem.initial_guess import Indices
from core.problem.motion_problem import MotionProblem

MM = 1000.0
"""Millimetres in a metre."""

LEAST_LOAD = 1e-6
"""Loads below this, N, have no slope to speak of."""


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


def slopes_of_forces(motion: MotionVector) -> MotionVector:
    """Each foot's force as slope and load; the slope of a foot without load is 0."""
    load = motion.force[..., 2:]
    carries = np.abs(load) > LEAST_LOAD
    slope = np.where(carries, motion.force[..., :2] / np.where(carries, load, 1.0), 0.0)
    return replace(motion, force=np.concatenate([slope, load], axis=-1))


def forces_of_slopes(motion: MotionVector) -> MotionVector:
    """Inverse of `slopes_of_forces` where feet carry load."""
    load = motion.force[..., 2:]
    return replace(motion, force=np.concatenate([motion.force[..., :2] * load, load], axis=-1))


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
        given_intervals: (1, n − 1) time from each knot to the next as the problem has it, s.
        position: 1 + legs matrices (3, n), mm.
        velocity: 1 + legs matrices (3, n), mm/s.
        force: legs matrices (3, n), N.
        slope: legs matrices (2, n), sideways force over load; empty where forces are unknowns themselves.
        intervals: the same as it acts, which differs where timing is sought.
        heading: (1, n) turn of the body at each knot, rad.
        heading_rate: (1, n) speed of turning at each knot, rad/s.
        goal: (3·(1 + legs), 1) goal positions, mm.
        margin: stability margin, mm.
        friction: coefficient of the friction cones.
        successor: legs matrices (legs, n): 1 where foot j follows foot i round the standing feet.
    """

    vector: SX
    given_intervals: SX
    position: tuple[SX, ...]
    velocity: tuple[SX, ...]
    force: tuple[SX, ...]
    slope: tuple[SX, ...]
    intervals: SX
    heading: SX
    heading_rate: SX
    goal: SX
    margin: SX
    friction: SX
    successor: tuple[SX, ...]

    @property
    def parameters(self) -> SX:
        """Every parameter in one column, in the order of `parameter_values`."""
        numbers = (self.given_intervals.T, self.heading.T, self.goal, self.margin, self.friction)
        return vertcat(*numbers, *(vec(part) for part in self.successor))

    @cached_property
    def turn(self) -> tuple[SX, SX]:
        """(1, n) cosine and sine of the heading."""
        return cos(self.heading), sin(self.heading)


def axes_of(vectors: SX) -> tuple[SX, SX, SX]:
    """The rows of a (3, k) matrix."""
    return vectors[0, :], vectors[1, :], vectors[2, :]


def change_between_knots(values: SX) -> SX:
    """(rows, n − 1) each knot's values less those of the knot before."""
    return values[:, 1:] - values[:, :-1]


def per_interval(changes: SX, symbols: Symbols) -> SX:
    """(rows, n − 1) changes from sample to sample, divided by the time between them."""
    return changes / repmat(symbols.intervals, changes.shape[0], 1)


def rate_of(heading: SX, intervals: SX) -> SX:
    """(1, n) speed of turning, rad/s: central differences of the second order, one-sided at the ends."""
    slopes = change_between_knots(heading) / intervals
    before, after = intervals[:, :-1], intervals[:, 1:]
    inner = (after * slopes[:, :-1] + before * slopes[:, 1:]) / (before + after)
    return horzcat(slopes[:, 0], inner, slopes[:, -1])


def make_symbols(legs: int, knots: int, *, slopes: bool = False) -> Symbols:
    """Symbols for a number of legs and knots, with forces or their slopes and loads as unknowns."""
    state = 3 * (legs + 1)
    columns = SX.sym("x", 2 * state + 3 * legs, knots)

    def points(first: int, count: int) -> tuple[SX, ...]:
        return tuple(columns[first + 3 * i : first + 3 * i + 3, :] for i in range(count))

    force = points(2 * state, legs)
    slope: tuple[SX, ...] = ()
    if slopes:
        slope = tuple(f[:2, :] for f in force)
        force = tuple(vertcat(f[0, :] * f[2, :], f[1, :] * f[2, :], f[2, :]) for f in force)
    intervals, heading = SX.sym("dt", 1, knots - 1), SX.sym("heading", 1, knots)
    return Symbols(
        vector=columns.reshape((-1, 1)),
        given_intervals=intervals,
        position=points(0, legs + 1),
        velocity=points(state, legs + 1),
        force=force,
        slope=slope,
        intervals=intervals,
        heading=heading,
        heading_rate=rate_of(heading, intervals),
        goal=SX.sym("goal", state),
        margin=SX.sym("margin"),
        friction=SX.sym("friction"),
        successor=tuple(SX.sym(f"next{foot}", legs, knots) for foot in range(legs)),
    )


def stretched(symbols: Symbols, phase_of_interval: tuple[int, ...]) -> Symbols:
    """The same with a further unknown a phase, by which its given intervals are multiplied.

    Args:
        symbols: of a problem.
        phase_of_interval: (n − 1) number of the phase that each interval belongs to, from 0.
    """
    stretch = SX.sym("stretch", max(phase_of_interval) + 1)
    intervals = symbols.given_intervals * stretch[list(phase_of_interval)].T
    return replace(
        symbols,
        vector=vertcat(symbols.vector, stretch),
        intervals=intervals,
        heading_rate=rate_of(symbols.heading, intervals),
    )


def parameter_values(problem: MotionProblem, successor: Indices) -> Floats:
    """Numbers for `Symbols.parameters`.

    Args:
        problem: the problem.
        successor: (n, legs) index of the next standing foot.
    """
    goal = np.concatenate([problem.goal.body_world[None], problem.goal.feet_world]).reshape(-1) * MM
    chosen = np.eye(problem.model.leg_count)[successor]
    numbers = [*goal, problem.limits.margin * MM, problem.limits.friction or 0.0]
    nexts = chosen.transpose(1, 0, 2).reshape(-1)
    return np.concatenate([problem.intervals, problem.heading, numbers, nexts])
