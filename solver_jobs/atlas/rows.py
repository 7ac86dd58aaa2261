"""The limits of many gaits as rows: how much room each has, and how the room changes with the unknowns."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from core.arrays import SAME, Floats, first_lowest
from core.pose_gaits.pose_problem import SWING_SHARE, PoseBounds
from core.robot.arms import arm_bars, nearest_points
from core.robot.shoes import neighbour_pairs
from solver_jobs.atlas.layout import MM, rotations
from solver_jobs.atlas.postures import PLACES, Poses, Postures, Within

ROOM = 0.05
"""Every row asks for this much more than its limit, mm: steps end a little off what they aim at, and between
the places of its rows a motion may come a little nearer to a limit."""
FAR_FEET = 38.0
"""Feet of neighbours that are farther apart do not bring their arms together, mm: of 6,000 postures with arms
within 0.5 mm the feet were at most 33 mm apart."""
CROSSED = -0.5
"""Bars whose nearest points lie so much on the wrong side of each other have passed each other."""
ARM_PLACES = (0, 1, 2)
"""Of `PLACES`, at which arms are looked at, besides the first pose of each move."""
LIKELY_BARS = 24
"""Pairs of bars whose distances are computed, those whose shadows are nearest."""
NEAR_DECIMALS = 6
"""Decimals to which shadows are compared, mm."""


@dataclass(frozen=True, eq=False)
class Family:
    """Rows of one limit for n gaits: room + slopes · change ≥ 0.

    Args:
        limit: as the checker calls it.
        room: (n, rows) mm.
        slopes: (n, rows, unknowns).
    """

    limit: str
    room: Floats
    slopes: Floats


def all_rows(postures: Postures, bounds: PoseBounds, poses: Poses, within: Within) -> list[Family]:
    """Every limit of every gait.

    Args:
        postures: of the gaits.
        bounds: limits that all have in common: slip, shoe and arm distance, range of heights.
        poses: where they are.
        within: the same within moves.
    """
    families = [*_motors(postures, poses), *_balance(postures, poses, within)]
    families += [*_slip(postures, bounds, within, poses), *_clearance(postures, poses, within)]
    families += _shoes(postures, bounds, poses, within)
    if bounds.arm_distance > 0.0:
        families.append(_arms(postures, bounds, poses, within))
    return families


def _motors(postures: Postures, poses: Poses) -> Iterator[Family]:
    """Moves within the stop bound, strokes within the motors' range."""
    count, unknowns = postures.asked.count, postures.layout.unknowns
    change = np.diff(poses.strokes, axis=1).reshape(count, -1)
    slopes = np.diff(poses.stroke_slopes, axis=1).reshape(count, -1, unknowns)
    longest = postures.asked.longest[:, None] - ROOM
    yield Family("stop bound", longest - change, -slopes)
    yield Family("stop bound", longest + change, slopes)
    stroke = postures.layout.model.stroke
    values = poses.strokes[:, :-1].reshape(count, -1)
    slopes = poses.stroke_slopes[:, :-1].reshape(count, -1, unknowns)
    yield Family("stroke", values - stroke.lower * MM - ROOM, slopes)
    yield Family("stroke", stroke.upper * MM - ROOM - values, -slopes)


def _balance(postures: Postures, poses: Poses, within: Within) -> Iterator[Family]:
    """The body inside every edge between standing neighbours, at both ends of each move and within."""
    layout = postures.layout
    edges = []
    for move in range(layout.move_count):
        standing = np.nonzero(~layout.moving[move])[0]
        edges += [(move, *edge) for edge in zip(standing, np.roll(standing, -1), strict=True)]
    move, first, second = np.array(edges).T
    corner, other = poses.feet[:, move, first, :2], poses.feet[:, move, second, :2]
    corner_map = postures.foot_map[:, move, first, :2]
    other_map = postures.foot_map[:, move, second, :2]
    length = np.linalg.norm(other - corner, axis=-1, keepdims=True)
    along = (other - corner) / length
    inward = np.stack([-along[..., 1], along[..., 0]], axis=-1)

    def family(body: Floats, body_slopes: Floats) -> Family:
        away = body - corner
        distance = (away * inward).sum(axis=-1)
        share = (away * along).sum(axis=-1, keepdims=True) / length
        moved = body_slopes - (1.0 - share)[..., None] * corner_map - share[..., None] * other_map
        slopes = (inward[..., None] * moved).sum(axis=-2)
        return Family("margin", distance - postures.asked.margin[:, None] - ROOM, slopes)

    body_map = layout.body_map[None, :, :2]
    yield family(poses.bodies[:, move, :2], body_map[:, move])
    yield family(poses.bodies[:, move + 1, :2], body_map[:, move + 1])
    for place in range(len(PLACES)):
        yield family(within.body[:, move, place, :2], within.body_slopes[:, move, place, :2])


def _slip(postures: Postures, bounds: PoseBounds, within: Within, poses: Poses) -> Iterator[Family]:
    """Standing feet stay by their footholds in the middle of a move, where they are farthest off."""
    layout, middle = postures.layout, len(PLACES) // 2
    move, leg = np.nonzero(~layout.moving)
    away = within.feet[:, move, middle, leg] - poses.feet[:, move, leg]
    slopes = within.foot_slopes[:, move, middle, leg] - postures.foot_map[:, move, leg]
    most = np.array([bounds.slip, bounds.slip, bounds.slip / 2.0]) * MM - ROOM
    count, unknowns = postures.asked.count, layout.unknowns
    for sign in (1.0, -1.0):
        room = (most - sign * away).reshape(count, -1)
        yield Family("slip", room, (-sign * slopes).reshape(count, -1, unknowns))


def _clearance(postures: Postures, poses: Poses, within: Within) -> Iterator[Family]:
    """Swinging feet over the plane of the standing ones, at their poses and within moves.

    The plane is taken to lie at the standing feet's mean height; they differ by less than the slip.
    """
    layout = postures.layout
    floors = layout.floors(postures.asked)
    pose, leg = np.array(list(layout.air_places)).T
    height = poses.feet[:, pose, leg, 2] - floors[:, pose, leg]
    yield Family("clearance", height - ROOM, postures.foot_map[:, pose, leg, 2])
    move, leg = np.nonzero(layout.moving)
    standing = ~layout.moving[move][:, :, None]
    weights = standing / standing.sum(axis=1, keepdims=True)
    for place, share in enumerate(PLACES):
        feet, slopes = within.feet[:, :, place, :, 2][:, move], within.foot_slopes[:, :, place, :, 2][:, move]
        plane, plane_slopes = (feet * weights[..., 0]).sum(axis=-1), (slopes * weights).sum(axis=-2)
        straight = (1 - share) * floors[:, move, leg] + share * floors[:, move + 1, leg]
        height = within.feet[:, move, place, leg, 2] - plane
        height_slopes = within.foot_slopes[:, move, place, leg, 2] - plane_slopes
        yield Family("clearance", height - SWING_SHARE * straight - ROOM, height_slopes)


def _shoes(postures: Postures, bounds: PoseBounds, poses: Poses, within: Within) -> Iterator[Family]:
    """Middles of feet that can meet keep apart."""
    legs = postures.layout.legs
    near = [pair for pair in combinations(range(legs), 2) if min(np.ptp(pair), legs - np.ptp(pair)) <= 2]
    first, second = np.array(near).T
    count, unknowns = postures.asked.count, postures.layout.unknowns
    places = [(poses.feet[:, :-1], postures.foot_map[:, :-1])]
    places += [(within.feet[:, :, k], within.foot_slopes[:, :, k]) for k in range(len(PLACES))]
    for feet, slopes in places:
        between = feet[:, :, first, :2] - feet[:, :, second, :2]
        distance = np.linalg.norm(between, axis=-1)
        unit = between / distance[..., None]
        changes = slopes[:, :, first, :2] - slopes[:, :, second, :2]
        rows = (unit[..., None] * changes).sum(axis=-2).reshape(count, -1, unknowns)
        least = bounds.shoe_distance * MM + ROOM
        yield Family("shoe distance", (distance - least).reshape(count, -1), rows)


def _arms(postures: Postures, bounds: PoseBounds, poses: Poses, within: Within) -> Family:
    """Arms of neighbouring legs keep apart where their feet are near enough to bring them together.

    Every row is of the nearest two bars of a pair of legs; where the feet are far apart it has room and no
    slope.
    """
    layout, model = postures.layout, postures.layout.model
    pairs = neighbour_pairs(layout.legs)
    count, unknowns = postures.asked.count, layout.unknowns
    places = list(ARM_PLACES)
    feet = np.concatenate([poses.feet[:, :-1, None], within.feet[:, :, places]], axis=2)
    apart = np.linalg.norm(feet[:, :, :, pairs[:, 0], :2] - feet[:, :, :, pairs[:, 1], :2], axis=-1)
    room = np.full(apart.shape, FAR_FEET)
    rows = np.zeros((*apart.shape, unknowns))
    gait, move, place, pair = np.nonzero(apart < FAR_FEET)
    for number, chosen in enumerate([place == k for k in range(len(places) + 1)]):
        at = gait[chosen], move[chosen]
        if not len(at[0]):
            continue
        if number == 0:
            strokes, stroke_slopes = poses.strokes[at], poses.stroke_slopes[at]
            headings = poses.headings[at]
            from_body = postures.away_map[at]
        else:
            inside = (*at, np.full(len(at[0]), places[number - 1]))
            strokes, stroke_slopes = within.strokes[inside], within.stroke_slopes[inside]
            headings = within.headings[inside]
            from_body = within.foot_slopes[inside] - within.body_slopes[inside][:, None]
        legs = pairs[pair[chosen]]
        of = np.arange(len(legs))[:, None], legs
        bars = arm_bars(model, strokes / MM)[of] * MM
        centres = model.module_centres_robot[legs]
        towards = centres[:, 0] - centres[:, 1]
        towards = towards / np.linalg.norm(towards, axis=-1, keepdims=True)
        gap, slope = _gap(bars, from_body[of], stroke_slopes[of], headings, towards)
        where = (*at, place[chosen], pair[chosen])
        room[where] = gap - (model.shape.rod_diameter + bounds.arm_distance) * MM - ROOM
        rows[where] = slope
    return Family("arm distance", room.reshape(count, -1), rows.reshape(count, -1, unknowns))


def _gap(
    bars: Floats, foot_slopes: Floats, stroke_slopes: Floats, headings: Floats, towards: Floats
) -> tuple[Floats, Floats]:
    """Least distance of the middle lines of two legs' bars, and its slope.

    Args:
        bars: (n, 2, 3, 4, 2, 3) both ends of the bars of both legs in the robot's frame, mm.
        foot_slopes: (n, 2, 3, unknowns) of the feet from the body, in the world.
        stroke_slopes: (n, 2, 3, unknowns).
        headings: (n,) rad.
        towards: (n, 3) unit vector from the second leg's module to the first one's.

    Returns:
        (n,) mm, below 0 where the bars have passed each other, and (n, unknowns).
    """
    count = len(bars)
    index = np.arange(count)
    flat = bars.reshape(count, 2, -1, 2, 3)
    # Bars are at least as far apart as their shadows on the line between the modules.
    shadows = (flat * towards[:, None, None, None]).sum(axis=-1)
    near = shadows[:, 0].min(axis=-1)[:, :, None] - shadows[:, 1].max(axis=-1)[:, None]
    likely = np.argpartition(near.reshape(count, -1).round(NEAR_DECIMALS), LIKELY_BARS, axis=1)[
        :, :LIKELY_BARS
    ]
    one, other = np.divmod(likely, flat.shape[2])
    nearest = nearest_points(flat[index[:, None], 0, one], flat[index[:, None], 1, other])
    best = first_lowest(nearest.distances, SAME * MM, axis=1)
    points = nearest.first[index, best], nearest.second[index, best]
    chosen = one[index, best], other[index, best]
    between = points[0] - points[1]
    distance = np.linalg.norm(between, axis=-1)
    unit = between / np.maximum(distance, 1e-9)[:, None]
    # Bars that have passed each other have to go back: they are so much in one another, and farther.
    passed = np.where((unit * towards).sum(axis=-1) < CROSSED, -1.0, 1.0)
    unit, distance = passed[:, None] * unit, passed * distance
    in_world = (rotations(headings) @ unit[..., None])[..., 0]
    slope = np.zeros((count, foot_slopes.shape[-1]))
    for side, sign in ((0, 1.0), (1, -1.0)):
        arm, kind = np.divmod(chosen[side], bars.shape[3])
        ends = flat[index, side, chosen[side]]
        length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=-1)
        along = np.linalg.norm(points[side] - ends[:, 0], axis=-1) / np.maximum(length, 1e-9)
        # A rod goes from knee to platform; the other two bars are at the knee and at the platform.
        of_foot = np.select([kind <= 1, kind == 2], [along, np.zeros(count)], 1.0)[:, None]
        foot = (in_world[:, :, None] * foot_slopes[:, side]).sum(axis=1)
        knee = -unit[:, 2:] * stroke_slopes[index, side, arm]
        slope += sign * (of_foot * foot + (1.0 - of_foot) * knee)
    return distance, slope
