"""From the unknowns of the convex problem to a whole motion with contact forces."""

from itertools import combinations

import numpy as np

from core.arrays import Bools, Floats
from core.motion.support_polygon import GRAVITY
from core.motion.trajectory import Trajectory
from core.problem.initial_guess import Indices, standing_forces
from core.problem.motion_problem import GENTLE_FOOT_SHARE, Cost, MotionProblem
from solver_jobs.live.linearisation import MM, Linearisation

SHARE_DECIMALS = 6
"""Decimals to which shares of the load are compared: at the edge of the support one is 0 but for rounding,
and by symmetry two are equal."""


def trajectory_of(linearisation: Linearisation, x: Floats) -> Trajectory:
    """The motion with forces: all forces of a knot are parallel, so that they turn nothing about the body.

    With the vertical shares λ_z of the feet that put the centre of pressure in its place,
    λ = λ_z · (Σ m a_xy / Σ m (g + a_z), 1) gives every row of (3.2) and (3.15).

    Args:
        linearisation: the known part.
        x: the unknowns.
    """
    problem = linearisation.problem
    values = (
        np.where(linearisation.index >= 0, x[np.maximum(linearisation.index, 0)], linearisation.known) / MM
    )
    position = np.concatenate([values[0], linearisation.height[..., None] / MM], axis=-1)
    velocity = np.concatenate([values[1], linearisation.climb[..., None] / MM], axis=-1)
    body, feet = position[:, 0], position[:, 1:]
    forces = np.zeros_like(feet)
    forces[:-1] = _contact_forces(linearisation, body, feet, velocity)
    forces[-1] = standing_forces(problem.model, body[-1:], feet[-1:], linearisation.contact[-1:])[0]
    return Trajectory(
        times=problem.times,
        body_world=body,
        heading=problem.heading,
        feet_world=feet,
        contact=linearisation.contact,
        body_velocity=velocity[:, 0],
        feet_velocity=velocity[:, 1:],
        contact_forces=forces,
    )


def _contact_forces(linearisation: Linearisation, body: Floats, feet: Floats, velocity: Floats) -> Floats:
    """(n − 1, legs, 3) N."""
    model = linearisation.problem.model
    masses = np.array([model.masses.body] + [model.masses.foot] * model.leg_count)
    change = np.einsum("p,kpa->ka", masses, np.diff(velocity, axis=0)) / linearisation.intervals[:, None]
    upward = change[:, 2] + masses.sum() * GRAVITY
    pressure = body[:-1, :2] - body[:-1, 2:] * change[:, :2] / upward[:, None]
    shares = vertical_shares(feet[:-1, :, :2], linearisation.contact[:-1], pressure)
    resultant = np.concatenate([change[:, :2], upward[:, None]], axis=1)
    return np.asarray(shares[..., None] * resultant[:, None])


def vertical_shares(feet_xy: Floats, contact: Bools, pressure: Floats) -> Floats:
    """Shares of the load that put the centre of pressure in its place, of the least norm where that pushes.

    Args:
        feet_xy: (n, legs, 2) m.
        contact: (n, legs).
        pressure: (n, 2) m.

    Returns:
        (n, legs) that sum to 1; negative only where the centre of pressure lies outside the support.
    """
    offset = feet_xy - pressure[:, None]
    rows = np.concatenate([np.ones((*contact.shape, 1)), offset], axis=-1) * contact[..., None]
    # A foot's offset is small beside 1; in decimetres both count alike.
    rows[..., 1:] *= 10.0
    least = np.linalg.pinv(np.swapaxes(rows, 1, 2), rcond=1e-9)[..., 0]
    shares = np.where(contact, least, 0.0)
    pulls = (shares.round(SHARE_DECIMALS) < 0).any(axis=1)
    for knot in np.nonzero(pulls & (contact.sum(axis=1) > 3))[0]:
        standing = np.nonzero(contact[knot])[0]
        shares[knot] = _three_feet(rows[knot], standing, shares[knot])
    return np.asarray(shares)


def _three_feet(rows: Floats, standing: Indices, otherwise: Floats) -> Floats:
    """Shares of the three feet whose smallest share is the largest."""
    triples = np.array(list(combinations(standing.tolist(), 3)))
    systems = np.swapaxes(rows[triples], 1, 2)
    regular = np.abs(np.linalg.det(systems)) > 1e-9
    if not regular.any():
        return otherwise
    triples = triples[regular]
    found = np.linalg.solve(systems[regular], np.broadcast_to([[1.0], [0.0], [0.0]], (len(triples), 3, 1)))
    best = int(found[..., 0].min(axis=1).round(SHARE_DECIMALS).argmax())
    shares = np.zeros_like(otherwise)
    shares[triples[best]] = found[best, :, 0]
    return shares


def motion_cost(problem: MotionProblem, motion: Trajectory) -> float:
    """The cost of a motion over every knot, SI: (3.4), ½ Σ ‖x − x_g‖², or the gentle one."""
    if problem.cost is Cost.GENTLE:
        body, feet = (
            0.0 if v is None else float((v**2).sum()) for v in (motion.body_velocity, motion.feet_velocity)
        )
        return (body + GENTLE_FOOT_SHARE * feet) / 2
    wanted = ((motion.body_world, problem.goal.body_world), (motion.feet_world, problem.goal.feet_world))
    total = sum(float(((points - goal) ** 2).sum()) for points, goal in wanted)
    speeds = (motion.body_velocity, motion.feet_velocity)
    return (total + sum(float((speed**2).sum()) for speed in speeds if speed is not None)) / 2
