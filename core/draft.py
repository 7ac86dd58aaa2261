"""A first drawing of a motion from its contact timeline: what a solver starts from and the page shows first.

It keeps the boundary, the timing and the clearance, and draws the body over the support polygons; it is a
drawing, not a solution: reach, speed and balance are not looked at.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from core.arrays import Bools, Floats
from core.motion_problem import MotionProblem
from core.robot import RobotModel
from core.support import GRAVITY
from core.timeline import Swing
from core.trajectory import Trajectory

Indices = NDArray[np.intp]

INSET = 0.002
"""How far inside the support polygon the drawn body stays beyond the asked margin, m."""

SMOOTHING_ROUNDS = 25


def initial_motion(problem: MotionProblem) -> Trajectory:
    """Draws a motion: feet in arcs with the asked clearance, the body over the support polygons.

    The feet obey p(k+1) = p(k) + dt·(v(k) + v(k+1))/2 exactly, stand still in stance, and share a foot's way
    evenly over its swings. Contact forces are those of standing still at each knot.

    Args:
        problem: what is asked.

    Returns:
        Trajectory with velocities and forces; contact at the last knot is stance for every foot.
    """
    contact = closed_contact(problem)
    feet, feet_velocity = _feet(problem)
    body = _body(problem, feet, contact)
    body_velocity = np.gradient(body, problem.timeline.sample_time, axis=0)
    body_velocity[[0, -1]] = 0.0
    return Trajectory(
        times=problem.timeline.times,
        body_world=body,
        heading=np.zeros(problem.knot_count),
        feet_world=feet,
        contact=contact,
        body_velocity=body_velocity,
        feet_velocity=feet_velocity,
        contact_forces=standing_forces(problem.model, body, feet, contact),
    )


def closed_contact(problem: MotionProblem) -> Bools:
    """(n, legs) stance of each foot; the last knot is the goal, and stance for every foot."""
    contact = problem.timeline.contact.copy()
    contact[-1] = True
    return contact


def problem_swings(problem: MotionProblem) -> tuple[Swing, ...]:
    """Every swing of the problem, the last knot being stance."""
    return replace(problem.timeline, stance=closed_contact(problem).T).swings()


def clearance_knot(swing: Swing) -> int:
    """The knot of a swing that is lifted to the clearance: the middle one."""
    return (swing.first + swing.last) // 2


def next_standing(model: RobotModel, contact: Bools) -> Indices:
    """(n, legs) index of the next standing foot counter-clockwise round the ring, at each knot.

    Where no other foot stands it is the neighbour, so that an edge between two places always exists.
    """
    ring = np.argsort(np.mod(model.azimuths, 2 * np.pi))
    standing = contact[:, ring]
    following = np.tile(np.roll(ring, -1), (len(contact), 1))
    for shift in range(contact.shape[1] - 1, 0, -1):
        stands = np.roll(standing, -shift, axis=1)
        following = np.where(stands, np.roll(ring, -shift), following)
    found = np.empty_like(following)
    found[:, ring] = following
    return found


def standing_forces(model: RobotModel, body_world: Floats, feet_world: Floats, contact: Bools) -> Floats:
    """Vertical forces of the least norm that carry the resting robot at each knot: ΣF = Mg, no torque.

    Args:
        model: the robot.
        body_world: (n, 3) m.
        feet_world: (n, legs, 3) m.
        contact: (n, legs).

    Returns:
        (n, legs, 3) N; 0 in the air. A share is negative where the body lies outside the support polygon.
    """
    lever = feet_world[..., :2] - body_world[:, None, :2]
    rows = np.concatenate([np.ones((*contact.shape, 1)), lever], axis=-1) * contact[..., None]
    wanted = np.array([model.total_model_mass * GRAVITY, 0.0, 0.0])
    forces = np.zeros_like(feet_world)
    forces[..., 2] = np.where(contact, np.linalg.pinv(np.swapaxes(rows, 1, 2), rcond=1e-9) @ wanted, 0.0)
    return forces


def _feet(problem: MotionProblem) -> tuple[Floats, Floats]:
    n, dt = problem.knot_count, problem.timeline.sample_time
    feet = np.repeat(problem.start.feet_world[None], n, axis=0)
    velocity = np.zeros_like(feet)
    swings = problem_swings(problem)
    for foot, (start, goal) in enumerate(zip(problem.start.feet_world, problem.goal.feet_world, strict=True)):
        own = [swing for swing in swings if swing.foot == foot]
        for number, swing in enumerate(own):
            before = start + (goal - start) * (number / len(own))
            after = goal if number + 1 == len(own) else start + (goal - start) * ((number + 1) / len(own))
            # At the very first knot everything rests, so a swing that begins there moves one knot later.
            first = max(swing.first, 1)
            speeds = _arc(after - before, swing.last - first + 1, dt, problem.limits.clearance)
            velocity[first : swing.last + 1, foot] = speeds
            feet[first : swing.last + 1, foot] = before + dt * (np.cumsum(speeds, axis=0) - speeds / 2)
            feet[swing.last + 1 :, foot] = after
    feet[-1] = problem.goal.feet_world
    return feet, velocity


def _arc(way: Floats, count: int, dt: float, clearance: float) -> Floats:
    """(count, 3) velocities that travel `way` and rise to the clearance at the middle knot."""
    index = np.arange(count)
    share = np.sin(np.pi * (index + 1) / (count + 1))
    speeds = np.outer(share / share.sum(), way) / dt
    if count > 1:
        climb = np.cos(np.pi * (index + 0.5) / count)
        height = dt * (np.cumsum(climb) - climb / 2)[(count - 1) // 2]
        speeds[:, 2] += climb * clearance / height
    return speeds


def _body(problem: MotionProblem, feet: Floats, contact: Bools) -> Floats:
    """A path from start to goal, smoothed and pushed into the support polygons by turns."""
    share = np.linspace(0.0, 1.0, problem.knot_count)[:, None]
    body = problem.start.body_world + share * (problem.goal.body_world - problem.start.body_world)
    corners = feet[..., :2]
    following = np.take_along_axis(corners, next_standing(problem.model, contact)[..., None], axis=1)
    edges = following - corners
    lengths = np.maximum(np.linalg.norm(edges, axis=-1), 1e-9)
    normals = np.stack([-edges[..., 1], edges[..., 0]], axis=-1) / lengths[..., None]
    offsets = (normals * corners).sum(axis=-1) + problem.limits.margin + INSET
    offsets[~contact] = -np.inf
    knots = np.arange(problem.knot_count)
    path = body[:, :2].copy()
    for _ in range(SMOOTHING_ROUNDS):
        path[1:-1] = (path[:-2] + 2 * path[1:-1] + path[2:]) / 4
        for _ in range(2):
            lack = offsets - (normals @ path[..., None])[..., 0]
            worst = lack.argmax(axis=1)
            push = np.maximum(lack[knots, worst], 0.0)
            push[[0, -1]] = 0.0
            path += push[:, None] * normals[knots, worst]
    body[:, :2] = path
    return body
