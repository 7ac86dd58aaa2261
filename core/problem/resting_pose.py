"""The resting pose of the body while feet are held up: over the feet that stand."""

from itertools import combinations

import numpy as np

from core.arrays import Floats
from core.motion.support_polygon import support_polygon
from core.problem.motion_problem import RestPose

RESERVE = 0.001
"""A resting body stays this much further inside the support polygon than is asked, m."""


def resting_body(pose: RestPose, held: tuple[int, ...], margin: float) -> RestPose:
    """A pose whose body and held feet are shifted, no further than needed, over the standing feet.

    Args:
        pose: with the body in the middle of its modules.
        held: feet that are held up, counted from 1.
        margin: how far inside the support polygon the centre of mass has to be, m.

    Returns:
        The pose itself where it is balanced, or where the standing feet's polygon has no such place.
    """
    if not held:
        return pose
    up = np.isin(np.arange(len(pose.feet_world)) + 1, held)
    place = _nearest_within(
        support_polygon(pose.feet_world[~up, :2]), pose.body_world[:2], max(margin, 0.0) + RESERVE
    )
    if place is None:
        return pose
    shift = np.append(place - pose.body_world[:2], 0.0)
    return RestPose(pose.body_world + shift, pose.feet_world + np.where(up[:, None], shift, 0.0))


def _nearest_within(polygon: Floats, point: Floats, inset: float) -> Floats | None:
    """The place nearest to a point that is inside each edge by an inset; None where there is none.

    It is the point itself, its projection onto one edge moved inwards, or where two of those meet.

    Args:
        polygon: (m, 2) vertices counter-clockwise, m.
        point: (2,) m.
        inset: m.
    """
    if len(polygon) < 3:
        return None
    edges = np.roll(polygon, -1, axis=0) - polygon
    inward = np.stack([-edges[:, 1], edges[:, 0]], axis=-1) / np.linalg.norm(edges, axis=1, keepdims=True)
    least = (inward * polygon).sum(axis=1) + inset
    places = [point, *(point + inward * (least - inward @ point)[:, None])]
    for pair in combinations(range(len(edges)), 2):
        rows = list(pair)
        if abs(np.linalg.det(inward[rows])) > 1e-9:
            places.append(np.linalg.solve(inward[rows], least[rows]))
    within = [place for place in places if (inward @ place >= least - 1e-12).all()]
    return min(within, key=lambda place: float(np.linalg.norm(place - point)), default=None)
