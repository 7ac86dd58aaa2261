"""Where a robot really goes when its motors make given strokes, without its inertia.

At every moment the forces balance: the body rests on the feet that push the ground, and moves so that the
forces of its feet on the ground hold each other. Legs yield as the soft links of the physics let them: a foot
slides only where its leg is bent further than friction can hold it.
"""

from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from core.arrays import Bools, Floats, first_lowest
from core.motion.support_polygon import stability_margins
from core.physics.masses import default_physics, part_masses
from core.physics.motors import motor_speeds
from core.physics.ramp import MotorTrajectory, motor_trajectory
from core.robot.kinematics import feet_in_robot
from core.robot.leg import foot_jacobian
from core.robot.model import RobotModel
from core.wire.waypoints import Waypoints

EVERY = 5
"""Turns of the firmware's loop between two poses: 0.05 s."""
SUPPORT_ROUNDS = 20
"""Changes of the feet that push, at most; a foot more or less then carries next to nothing."""
ON_EDGE = 1e-9
"""Tolerance for a centre of mass outside a face, as part of its width."""
FLAT = 1e-6
"""Faces of a smaller area than this are lines, m²."""
FIT_ROUNDS = 40
"""Rounds of the fit of the body's place."""
NEAR = 1e-8
"""The body's place is known when it changes by less, m."""
STILL = 1e-12
"""Smallest distance that is divided by, m."""


@dataclass(frozen=True, eq=False)
class QuasiStaticMotion:
    """A robot's poses along its waypoints, in order.

    Args:
        moves: (m,) waypoint to which the robot is under way, or which it has just reached; 0 at first.
        reached: (count,) pose at which each waypoint is reached.
        middles: (m, 2) middle of all soles, from where it begins, in the axes of the robot as it begins, m.
        headings: (m,) turn of the body since the first pose, rad.
        standing: (m, legs) feet that push the ground; none where the robot falls.
        heights: (m, legs) of the feet over the ground, m; nan where the robot falls.
        lean: (m,) angle between the body's axis and the vertical, rad; nan where the robot falls.
        margins: (m,) distance of the centre of mass to the edge of the feet that stand, m; −inf where the
            robot falls.
        slides: (m, legs) way that each foot slides over the ground from the pose before, m.
    """

    moves: NDArray[np.int64]
    reached: NDArray[np.int64]
    middles: Floats
    headings: Floats
    standing: Bools
    heights: Floats
    lean: Floats
    margins: Floats
    slides: Floats


def quasi_static_motion(model: RobotModel, waypoints: Waypoints) -> QuasiStaticMotion:
    """Follows a robot along its waypoints, with its usual masses, soft links and friction.

    Args:
        model: the robot.
        waypoints: what its motors make.
    """
    physics = default_physics(model)
    masses = part_masses(model, physics)
    weight = masses.total(model) * physics.gravity
    driven = motor_trajectory(waypoints, motor_speeds(model, physics))
    rows = _rows(driven)
    feet = feet_in_robot(model, driven.strokes[rows])
    centre = masses.foot * feet[..., :2].sum(axis=1) / masses.total(model)
    upright, sideways = _stiffness(model, waypoints.strokes[0], physics.link_stiffness)
    loads, plane = _rest(feet, centre, weight / upright)
    standing = np.asarray(loads > 0.0)
    # A body that leans moves its platforms sideways; leans are small, so this is of first order.
    soles = feet[..., :2] + (feet[..., 2:] - model.sole_depth) * np.nan_to_num(plane[:, None, 1:])
    middles, headings, slides = _least_slides(soles, physics.friction * weight / sideways * loads)
    ground = plane[:, :1] + ((feet[..., :2] - centre[:, None]) * plane[:, None, 1:]).sum(axis=-1)
    return QuasiStaticMotion(
        moves=np.searchsorted(driven.arrivals, rows),
        reached=np.searchsorted(rows, driven.arrivals),
        middles=middles - middles[0],
        headings=headings,
        standing=standing,
        heights=feet[..., 2] - ground,
        lean=np.arctan(np.linalg.norm(plane[:, 1:], axis=1)),
        margins=stability_margins(centre, feet, standing),
        slides=slides,
    )


def _rows(driven: MotorTrajectory) -> NDArray[np.int64]:
    """Rows of the motors' course that are looked at: arrivals, and others where something moves."""
    rows = np.union1d(np.arange(0, len(driven.strokes), EVERY), driven.arrivals)
    moves = np.any(np.diff(driven.strokes[rows], axis=0) != 0.0, axis=(1, 2))
    return np.asarray(rows[np.append(True, moves) | np.isin(rows, driven.arrivals)])


def _stiffness(model: RobotModel, strokes: Floats, link: float) -> tuple[float, float]:
    """How hard a foot of (legs, 3) strokes is to push up and sideways, mean of all feet, N/m."""
    jacobian = foot_jacobian(model.leg, strokes)
    yields = np.einsum("lia,lja->lij", jacobian, jacobian).mean(axis=0) / link
    return 1.0 / float(yields[2, 2]), 2.0 / float(yields[0, 0] + yields[1, 1])


def _rest(feet: Floats, centre: Floats, sink: float) -> tuple[Floats, Floats]:
    """Sets a robot down on feet that yield upwards.

    Args:
        feet: (m, legs, 3) platforms in the robot's frame, m.
        centre: (m, 2) centre of mass, m.
        sink: by how much a foot yields that carries all, m.

    Returns:
        (m, legs) share of the weight that each foot carries, and (m, 3) the ground's height under the centre
        of mass and its rises along x and y, in the robot's frame. 0 and nan where it finds no rest.
    """
    away = feet.copy()
    away[..., :2] -= centre[:, None]
    face = _lowest_face(away)
    rests = np.asarray(face.any(axis=1))[:, None]
    rows = np.concatenate([np.ones((*face.shape, 1)), away[..., :2]], axis=-1)
    face = np.where(rests, face, True)
    pressed = _pressed(rows, feet[..., 2], face, sink)[1]
    # Feet as near to the ground as a leg yields may carry too, as all of a robot that stands evenly do.
    push = face | (pressed > -sink)
    for _ in range(SUPPORT_ROUNDS):
        pressed = _pressed(rows, feet[..., 2], push, sink)[1]
        more = np.asarray(pressed > 0.0)
        # With the centre of mass over an edge two feet carry all; the face itself stands for them.
        more = np.where((more.sum(axis=1) >= 3)[:, None], more, face)
        settled = (more == push).all(axis=1)
        if settled.all():
            break
        push = more
    push = np.where(settled[:, None], push, face)
    plane, pressed = _pressed(rows, feet[..., 2], push, sink)
    loads = np.maximum(pressed, 0.0) * push
    return (
        np.where(rests, loads / np.maximum(loads.sum(axis=1, keepdims=True), STILL), 0.0),
        np.where(rests, plane, np.nan),
    )


def _pressed(rows: Floats, heights: Floats, push: Bools, sink: float) -> tuple[Floats, Floats]:
    """The plane (m, 3) of the ground on which feet that push carry all, and how far it presses each, m."""
    pushing = rows * push[..., None]
    stiff = np.einsum("nli,nlj->nij", pushing, pushing)
    forces = np.einsum("nli,nl->ni", pushing, heights) + np.array([sink, 0.0, 0.0])
    plane = np.linalg.solve(stiff, forces[..., None])[..., 0]
    return plane, np.einsum("nli,ni->nl", rows, plane) - heights


def _lowest_face(away: Floats) -> Bools:
    """The three feet that carry a robot whose legs do not yield: the lowest face under the centre of mass.

    Args:
        away: (m, legs, 3) feet from the centre of mass, m.

    Returns:
        (m, legs) three of them; none where the centre of mass is beyond all feet.
    """
    faces = np.array(list(combinations(range(away.shape[1]), 3)))
    corners = away[:, faces]
    a, b, c = np.moveaxis(corners[..., :2], -2, 0)
    parts = np.stack([_cross(b, c), _cross(c, a), _cross(a, b)], axis=-1)
    area = parts.sum(axis=-1, keepdims=True)
    shares = np.where(np.abs(area) > FLAT, parts / np.where(area == 0.0, 1.0, area), -1.0)
    under = np.asarray((shares >= -ON_EDGE).all(axis=-1))
    depth = np.where(under, (shares * corners[..., 2]).sum(axis=-1), np.inf)
    face = faces[first_lowest(depth, axis=1)]
    carried = np.zeros(away.shape[:2], dtype=bool)
    carried[np.arange(len(away))[:, None], face] = np.asarray(under.any(axis=1))[:, None]
    return carried


def _cross(a: Floats, b: Floats) -> Floats:
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


def _least_slides(soles: Floats, holds: Floats) -> tuple[Floats, Floats, Floats]:
    """How the body moves while friction holds its feet, and how far they slide.

    Args:
        soles: (m, legs, 2) in the robot's frame with straight legs, m.
        holds: (m, legs) how far friction bends a leg before its foot slides, m; 0 in the air.

    Returns:
        (m, 2) middle of all soles, m, (m,) turns since the first pose, rad, and (m, legs) slides, m.
    """
    held, turn, origin = soles[0].copy(), 0.0, np.zeros(2)
    middles, turns, slides = [held.mean(axis=0)], [0.0], [np.zeros(len(held))]
    for there, hold in zip(soles[1:], holds[1:], strict=True):
        turn, origin = _balanced(there, held, hold, (turn, origin))
        placed = _turned(there, turn) + origin
        bent = placed - held
        far = np.hypot(bent[:, 0], bent[:, 1])
        kept = np.minimum(1.0, hold / np.maximum(far, STILL))
        now = placed - bent * kept[:, None]
        slides.append(np.where(hold > 0.0, np.hypot(*(now - held).T), 0.0))
        held = now
        middles.append(placed.mean(axis=0))
        turns.append(turn)
    return np.array(middles), np.array(turns), np.array(slides)


def _balanced(there: Floats, held: Floats, hold: Floats, first: tuple[float, Floats]) -> tuple[float, Floats]:
    """Turn and place of the body at which the forces on its feet balance: of those that slide, friction's."""
    turn, origin = first
    if not hold.any():
        return turn, origin
    for _ in range(FIT_ROUNDS):
        off = held - _turned(there, turn) - origin
        weights = np.minimum(1.0, hold / np.maximum(np.hypot(off[:, 0], off[:, 1]), STILL)) * (hold > 0.0)
        shares = weights / weights.sum()
        to, of = shares @ held, shares @ there
        a, b = held - to, there - of
        sine, cosine = shares @ (b[:, 0] * a[:, 1] - b[:, 1] * a[:, 0]), shares @ (b * a).sum(axis=1)
        before = origin
        turn = float(np.arctan2(sine, cosine))
        origin = to - _turned(of, turn)
        if np.abs(origin - before).max() < NEAR:
            break
    return turn, origin


def _turned(vectors: Floats, angle: float) -> Floats:
    """(..., 2) vectors turned by an angle, rad."""
    cosine, sine = np.cos(angle), np.sin(angle)
    return np.asarray(vectors @ np.array([[cosine, sine], [-sine, cosine]]))
