"""Motor limits as rows: the strokes' speed and acceleration, linear about a motion that is nearly right."""

import numpy as np

from core.arrays import Floats
from core.motion.trajectory import Trajectory
from core.problem.initial_guess import Indices
from core.robot.kinematics import actuator_plane_pose, feet_in_modules
from core.robot.leg import squared_offsets, vertex_directions
from solver_jobs.live.linearisation import MM, Linearisation
from solver_jobs.live.rows import NOBODY, Rows, Term, make_rows
from solver_jobs.nlp.constraint import Family

INSIDE = 0.995
"""Share of a motor's limit that the rows allow, so that what they leave out of second order has room."""


def motor_rows(linearisation: Linearisation, about: Trajectory) -> list[Rows]:
    """Rows for the limits that are asked for.

    ḣ_i = j_i · (v_foot − v_body − ω × (p_foot − p_body)) − (ż_foot − ż_body), with j_i = ∂h_i/∂(x, y) and the
    arm p_foot − p_body of the given motion.

    Args:
        linearisation: the known part.
        about: a motion near the one sought, with velocities.
    """
    limits = linearisation.problem.limits
    slope = _slopes(linearisation, about)
    arm = (about.feet_world - about.body_world[:, None])[..., :2] * MM
    swept = np.stack([arm[..., 1], -arm[..., 0]], axis=-1) * linearisation.problem.heading_rate[:, None, None]
    rising = linearisation.climb[:, 1:] - linearisation.climb[:, :1]
    rest = np.einsum("nlia,nla->nli", slope, swept) - rising[..., None]
    found = []
    knot, foot, motor = (index.reshape(-1) for index in np.indices(rest.shape))
    feet = np.stack([foot, np.full(len(foot), NOBODY)], axis=-1)
    if limits.motor_speed is not None:
        most = limits.motor_speed * MM * INSIDE
        offset = rest[knot, foot, motor]
        terms = _rate(linearisation, slope, knot, foot, motor, 0.0 * offset + 1.0)
        found.append(
            make_rows(Family.MOTOR_SPEED, "mm/s", terms, (-most - offset, most - offset), knot, feet)
        )
    if limits.motor_acceleration is not None:
        inner = knot < linearisation.problem.knot_count - 1
        knot, foot, motor, feet = knot[inner], foot[inner], motor[inner], feet[inner]
        most = limits.motor_acceleration * MM * INSIDE * linearisation.intervals[knot]
        offset = rest[knot + 1, foot, motor] - rest[knot, foot, motor]
        one = np.ones(len(knot))
        terms = _rate(linearisation, slope, knot + 1, foot, motor, one) + _rate(
            linearisation, slope, knot, foot, motor, -one
        )
        found.append(
            make_rows(Family.MOTOR_ACCELERATION, "mm/s", terms, (-most - offset, most - offset), knot, feet)
        )
    return found


def _slopes(linearisation: Linearisation, about: Trajectory) -> Floats:
    """(n, legs, 3, 2) ∂h/∂(x, y) in the world's axes."""
    model = linearisation.problem.model
    pose = actuator_plane_pose(model, about.body_world, about.heading)
    module = feet_in_modules(model, about.feet_world, pose)
    arms = module[..., None, :2] - model.leg.reach_radius * vertex_directions()
    depth = np.sqrt(np.maximum(model.leg.link_length**2 - squared_offsets(model.leg, module), 1e-12))
    slope = arms / depth[..., None]
    angle = about.heading[:, None] + model.azimuths - np.pi / 2
    cosine, sine = np.cos(angle)[..., None], np.sin(angle)[..., None]
    x, y = slope[..., 0], slope[..., 1]
    return np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=-1)


def _rate(
    linearisation: Linearisation, slope: Floats, knot: Indices, foot: Indices, motor: Indices, factor: Floats
) -> list[Term]:
    """The part of a motor's rate that the unknowns make, times a factor."""
    terms: list[Term] = []
    for axis in (0, 1):
        part = slope[knot, foot, motor, axis] * factor
        terms.append(
            (linearisation.index[1, knot, foot + 1, axis], linearisation.known[1, knot, foot + 1, axis], part)
        )
        terms.append((linearisation.index[1, knot, 0, axis], linearisation.known[1, knot, 0, axis], -part))
    return terms
