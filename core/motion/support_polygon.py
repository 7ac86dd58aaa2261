"""Support polygon, static stability margin and centre of pressure."""

import numpy as np

from core.arrays import Bools, Floats
from core.errors import InputError
from core.motion.trajectory import Trajectory
from core.robot.model import RobotModel

GRAVITY = 9.81
"""Standard gravity as the published program has it, m/s²."""


SHORTEST_EDGE = 1e-12
"""Edges shorter than this count as points, m."""


def support_polygon(points: Floats) -> Floats:
    """Convex hull of standing feet, counter-clockwise (Andrew's monotone chain).

    Args:
        points: (k, 2) ground projections, m.

    Returns:
        (m, 2) vertices; fewer than three where the feet do not span an area.
    """
    ordered = sorted({(float(x), float(y)) for x, y in points})
    if len(ordered) < 3:
        return np.array(ordered).reshape(-1, 2)
    lower = _half_hull(ordered)
    upper = _half_hull(ordered[::-1])
    return np.array(lower[:-1] + upper[:-1])


def _half_hull(ordered: list[tuple[float, float]]) -> list[tuple[float, float]]:
    chain: list[tuple[float, float]] = []
    for point in ordered:
        while len(chain) >= 2 and _turn(chain[-2], chain[-1], point) <= 0:
            chain.pop()
        chain.append(point)
    return chain


def _turn(a: tuple[float, float], b: tuple[float, float], c: tuple[float, float]) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def polygon_margin(polygon: Floats, point: Floats) -> float:
    """Signed distance of a point to a convex polygon's edge: positive inside, m.

    Outside, and for a polygon without area, it is minus the distance to the nearest edge or vertex.

    Args:
        polygon: (m, 2) vertices counter-clockwise.
        point: (2,).
    """
    if len(polygon) == 0:
        return float("-inf")
    starts = polygon
    edges = np.roll(polygon, -1, axis=0) - starts
    lengths = np.linalg.norm(edges, axis=1)
    has_side = lengths > SHORTEST_EDGE
    lengths = np.maximum(lengths, SHORTEST_EDGE)
    relative = point - starts
    left = (edges[:, 0] * relative[:, 1] - edges[:, 1] * relative[:, 0]) / lengths
    inside = float(np.where(has_side, left, np.inf).min())
    if len(polygon) >= 3 and 0 <= inside < np.inf:
        return inside
    fraction = np.clip((relative * edges).sum(axis=1) / lengths**2, 0.0, 1.0)
    nearest = starts + fraction[:, None] * edges
    return -float(np.linalg.norm(point - nearest, axis=1).min())


def stability_margins(points_xy: Floats, feet_world: Floats, contact: Bools) -> Floats:
    """Margin of a ground point at each knot; with the centre of mass it is the static stability margin.

    Args:
        points_xy: (n, 2) m.
        feet_world: (n, legs, 3) m.
        contact: (n, legs) true where a foot stands.

    Returns:
        (n,) signed distance to the support polygon's edge, m.
    """
    corners = np.asarray(feet_world[..., :2], dtype=np.float64)
    points = np.asarray(points_xy, dtype=np.float64)
    legs = corners.shape[1]
    # Every pair of feet once: the line the other way round has the other side on its left.
    start, end = np.triu_indices(legs, 1)
    a, edge = corners[:, start], corners[:, end] - corners[:, start]
    length = np.linalg.norm(edge, axis=-1)
    both = contact[:, start] & contact[:, end] & (length > SHORTEST_EDGE)
    length = np.maximum(length, SHORTEST_EDGE)
    # Signed distance of every standing foot, and of the point, to the left of every line between two feet.
    sides = np.where(contact[:, None, :], _left_of(a, edge, length, corners[:, None]), 0.0)
    leftmost, rightmost = sides.max(axis=-1), sides.min(axis=-1)
    on_left, on_right = both & (rightmost >= -SHORTEST_EDGE), both & (leftmost <= SHORTEST_EDGE)
    here = _left_of(a, edge, length, points[:, None, None])[..., 0]
    inside = np.where(on_left, here, np.where(on_right, -here, np.inf)).min(axis=-1, initial=np.inf)
    area = ((on_left & (leftmost > SHORTEST_EDGE)) | (on_right & (rightmost < -SHORTEST_EDGE))).any(axis=-1)
    nearest = _nearest_distance(points, corners, contact, a, edge, both)
    return np.asarray(np.where(area & (inside >= 0), inside, -nearest))


def _left_of(start: Floats, edge: Floats, length: Floats, points: Floats) -> Floats:
    """(n, edges, k) distance of points to the left of lines."""
    offset = points - start[:, :, None]
    return np.asarray(
        (edge[:, :, None, 0] * offset[..., 1] - edge[:, :, None, 1] * offset[..., 0]) / length[..., None]
    )


def _nearest_distance(
    points: Floats, corners: Floats, contact: Bools, start: Floats, edge: Floats, both: Bools
) -> Floats:
    """(n,) distance of a point to the nearest standing foot or line between two, inf where none stands."""
    squared = np.maximum((edge**2).sum(axis=-1), SHORTEST_EDGE**2)
    fraction = np.clip(((points[:, None] - start) * edge).sum(axis=-1) / squared, 0.0, 1.0)
    to_edges = np.linalg.norm(points[:, None] - start - fraction[..., None] * edge, axis=-1)
    to_feet = np.linalg.norm(points[:, None] - corners, axis=-1)
    found = np.concatenate([np.where(both, to_edges, np.inf), np.where(contact, to_feet, np.inf)], axis=1)
    return np.asarray(found.min(axis=1))


def centre_of_pressure(
    body_world: Floats,
    body_acceleration: Floats,
    feet_acceleration: Floats,
    body_mass: float,
    foot_mass: float,
) -> Floats:
    """Centre of pressure (docs/sources.md): p_xy − z_b · Σ m_i a_i,xy / Σ m_i (g + a_i,z).

    Args:
        body_world: (n, 3) the body's point, z above the standing feet's platforms, m.
        body_acceleration: (n, 3) m/s².
        feet_acceleration: (n, legs, 3) m/s².
        body_mass: kg.
        foot_mass: of each foot, kg.

    Returns:
        (n, 2) m.
    """
    inertia = body_mass * body_acceleration + foot_mass * feet_acceleration.sum(axis=1)
    total = body_mass + foot_mass * feet_acceleration.shape[1]
    vertical = inertia[:, 2] + total * GRAVITY
    return np.asarray(body_world[:, :2] - body_world[:, 2:3] * inertia[:, :2] / vertical[:, None])


def trajectory_pressure(model: RobotModel, trajectory: Trajectory) -> Floats:
    """Centre of pressure of a motion with velocities, from each knot to the next.

    Args:
        model: for the masses of the optimisation's model.
        trajectory: n knots, with velocities.

    Returns:
        (n − 1, 2) m.

    Raises:
        InputError: velocities are missing.
    """
    if trajectory.body_velocity is None or trajectory.feet_velocity is None:
        raise InputError("The centre of pressure needs velocities.", "trajectory")
    steps = np.diff(trajectory.times)
    return centre_of_pressure(
        trajectory.body_world[:-1],
        np.diff(trajectory.body_velocity, axis=0) / steps[:, None],
        np.diff(trajectory.feet_velocity, axis=0) / steps[:, None, None],
        model.masses.body,
        model.masses.foot,
    )
