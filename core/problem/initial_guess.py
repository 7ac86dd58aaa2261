"""The initial guess of a motion from its contact timeline: solvers start from it, the page shows it first.

It keeps the boundary, the timing and the clearance, and draws the body over the support polygons; it is a
drawing, not a solution: reach, speed and balance are not looked at.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from core.arrays import Bools, Floats, first_highest
from core.motion.contact_timeline import Swing
from core.motion.support_polygon import GRAVITY
from core.motion.trajectory import Trajectory
from core.problem.footholds import way_shares
from core.problem.motion_problem import MotionProblem
from core.problem.swing_height import held_climb, is_held
from core.robot.model import RobotModel

Indices = NDArray[np.intp]

INSET = 0.002
"""How far inside the support polygon the drawn body stays beyond the asked margin, m."""

SMOOTHING_ROUNDS = 25


def initial_guess(problem: MotionProblem) -> Trajectory:
    """Draws a motion: feet in arcs with the asked clearance, the body over the support polygons.

    The feet obey p(k+1) = p(k) + dt(k)·(v(k) + v(k+1))/2 exactly, stand still in stance, and share a
    foot's way evenly over its swings. Contact forces are those of standing still at each knot.

    Args:
        problem: what is asked.

    Returns:
        Trajectory with velocities and forces; contact at the last knot is stance for every foot that is not
        held up.
    """
    contact = closed_contact(problem)
    feet, feet_velocity = _feet(problem)
    body = _body(problem, feet, contact)
    body_velocity = np.gradient(body, problem.times, axis=0)
    body_velocity[[0, -1]] = 0.0
    return Trajectory(
        times=problem.times,
        body_world=body,
        heading=problem.heading,
        feet_world=feet,
        contact=contact,
        body_velocity=body_velocity,
        feet_velocity=feet_velocity,
        contact_forces=standing_forces(problem.model, body, feet, contact),
    )


def closed_contact(problem: MotionProblem) -> Bools:
    """(n, legs) stance of each foot; the last knot is the goal, where every foot stands or is held up."""
    contact = problem.timeline.contact.copy()
    contact[-1] = ~problem.held_end
    return contact


def problem_swings(problem: MotionProblem) -> tuple[Swing, ...]:
    """Every swing of the problem, none with the last knot, where all rests."""
    stance = problem.timeline.stance.copy()
    stance[:, -1] = True
    return replace(problem.timeline, stance=stance).swings()


def rise_times(swing: Swing, intervals: Floats) -> Floats:
    """How long speed can act to lift a foot to each knot of its swing and to bring it down again.

    Speed at a knot acts over half of both intervals beside it, and a foot rests beside its swing, so that a
    knot's height is at most the foot's speed times the shorter of both times.

    Args:
        swing: knots in the air; at the very first knot everything rests, so a swing there moves one later.
        intervals: (n − 1,) s.

    Returns:
        (knots from max(first, 1) to last,) the shorter of both, s.
    """
    times = np.append(0.0, np.cumsum(intervals))
    first = max(swing.first, 1)
    knots = times[first : swing.last + 1]
    up = knots - (times[first - 1] + times[first]) / 2
    down = (times[swing.last] + times[swing.last + 1]) / 2 - knots
    return np.asarray(np.minimum(up, down))


def clearance_knot(swing: Swing, intervals: Floats) -> int:
    """The knot of a swing that can rise highest, and is lifted to the clearance: as a rule the middle one."""
    # Where two can rise equally high, rounding must not choose; after the last one no knot is left to sink.
    lasting = np.round(rise_times(swing, intervals), 9)
    return max(swing.first, 1) + int((lasting[:-1] if len(lasting) > 1 else lasting).argmax())


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
    feet = np.repeat(problem.start.feet_world[None], problem.knot_count, axis=0)
    velocity = np.zeros_like(feet)
    swings = problem_swings(problem)
    shares = way_shares(problem, swings)
    for foot in range(problem.model.leg_count):
        own = [swing for swing in swings if swing.foot == foot]
        places = _places(problem, foot, shares[foot])
        for swing, before, after in zip(own, places[:-1], places[1:], strict=True):
            # At the very first knot everything rests, so a swing that begins there moves one knot later.
            first = max(swing.first, 1)
            span = slice(first, swing.last + 1)
            velocity[span, foot] = _flight(problem, swing, after - before)
            around = velocity[first - 1 : swing.last + 1, foot]
            steps = problem.intervals[first - 1 : swing.last, None] * (around[1:] + around[:-1]) / 2
            feet[span, foot] = before + np.cumsum(steps, axis=0)
            feet[swing.last + 1 :, foot] = after
    feet[-1] = problem.goal.feet_world
    return feet, velocity


def _places(problem: MotionProblem, foot: int, shares: Floats) -> Floats:
    """(swings + 1, 3) where a foot rests before, between and after its swings: on the ground in between."""
    start, goal = problem.start.feet_world[foot], problem.goal.feet_world[foot]
    places = start + (goal - start) * shares[:, None]
    places[1:-1, 2] = 0.0
    return np.asarray(places)


def _flight(problem: MotionProblem, swing: Swing, way: Floats) -> Floats:
    """(knots that it moves at, 3) velocities of a swing, m/s."""
    first = max(swing.first, 1)
    around = problem.intervals[first - 1 : swing.last + 1]
    # The time that a knot's velocity acts for: half of each interval beside it.
    shares = (around[1:] + around[:-1]) / 2
    middle = clearance_knot(swing, problem.intervals) - first
    if not is_held(problem, swing):
        return _arc(way, shares, problem.limits.clearance, middle)
    speeds = _arc(way * [1.0, 1.0, 0.0], shares, 0.0, middle)
    speeds[:, 2] = held_climb(float(way[2]), around, problem.limits.foot_speed)
    return speeds


def _arc(way: Floats, shares: Floats, clearance: float, middle: int) -> Floats:
    """(count, 3) velocities that travel `way` and rise to the clearance at the middle knot.

    Args:
        way: (3,) m.
        shares: (count,) the time that each velocity acts for, s.
        clearance: m.
        middle: number of the middle knot.
    """
    count = len(shares)
    index = np.arange(count)
    speed = np.sin(np.pi * (index + 1) / (count + 1))
    speeds = np.outer(speed / (speed @ shares), way)
    if count > 1:
        climb = np.cos(np.pi * (index + 0.5) / count)
        up, down = (
            np.where(index <= middle, np.abs(climb), 0.0),
            np.where(index > middle, -np.abs(climb), 0.0),
        )
        if count % 2 and 2 * middle == count - 1:
            up[middle] = 0.0
        rise = up @ shares - up[middle] * shares[middle] / 2
        speeds[:, 2] += clearance / rise * (up + down * (up @ shares) / -(down @ shares))
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
            worst = first_highest(lack, axis=1)
            push = np.maximum(lack[knots, worst], 0.0)
            push[[0, -1]] = 0.0
            path += push[:, None] * normals[knots, worst]
    body[:, :2] = path
    return body
