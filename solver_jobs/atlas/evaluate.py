"""The rows of some gaits of a space: each motion is searched for, and believed only from the checker."""

from collections import defaultdict
from collections.abc import Callable, Sequence

import numpy as np

from core.arrays import Floats
from core.atlas.point import AtlasPoint
from core.atlas.row import AtlasRow, RowStatus
from core.atlas.space import AtlasKind, AtlasSpace
from core.errors import FootfallError
from core.pose_gaits.pose_check import PoseCheck, check_poses
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import PoseProblem
from solver_jobs.atlas.draw import drawn_points
from solver_jobs.atlas.layout import MM, Asked, Layout
from solver_jobs.atlas.postures import Poses, Postures
from solver_jobs.atlas.search import KEPT, Found, Search

TOGETHER = 48
"""Gaits that are searched together; more need more memory, fewer more time."""
HEIGHT_ROOM = 2.0
"""How far the actuator plane of a pose may be from the height that is asked, mm."""
ARMS_FARTHER = 0.5
"""How much farther apart arms are kept where the check finds them too near within a move, mm: the search
looks at fewer places."""
WORDS = {
    "stop bound": "stop bound",
    "stroke": "motors' range",
    "margin": "margin",
    "slip": "slip",
    "clearance": "clearance",
    "shoe distance": "distance of shoes",
    "arm distance": "distance of arms",
    "body height": "body height",
}
MOST_NAMED = 2
"""Limits that a reason names."""


def evaluated(
    space: AtlasSpace, first: int, count: int, report: Callable[[float], bool] = lambda share: True
) -> list[AtlasRow]:
    """Rows of some gaits of a space, in the order of their numbers.

    Every gait starts cold and has limits of iterations, not of time: the rows do not depend on the machine's
    load.

    Args:
        space: what varies.
        first: number of the first one, from 0.
        count: how many.
        report: told the share that is done; False ends it with the rows that are known.
    """
    return evaluated_points(space, drawn_points(space, first, count), report)


def evaluated_points(
    space: AtlasSpace, points: Sequence[AtlasPoint], report: Callable[[float], bool] = lambda share: True
) -> list[AtlasRow]:
    """The same for gaits that are given."""
    rows: dict[int, AtlasRow] = {}
    if space.kind is AtlasKind.DRAWN:
        from solver_jobs.atlas.drawn_gaits import drawn_row

        for point in points:
            rows[point.number] = drawn_row(point, space.model(point.numbers))
            if not report(len(rows) / len(points)):
                break
        return [rows[number] for number in sorted(rows)]
    for batch in _batches(space, points, rows):
        for point, (_, row) in zip(batch, pose_gaits(space, batch), strict=True):
            rows[point.number] = row
        if not report(len(rows) / len(points)):
            break
    return [rows[number] for number in sorted(rows)]


def evaluated_alone(space: AtlasSpace, number: int) -> tuple[PoseGait | None, AtlasRow]:
    """One gait by itself: its motion, where it is a solved gait for the robot's clock, and its row.

    Args:
        space: that it is of.
        number: of the gait.
    """
    (point,) = drawn_points(space, number, 1)
    (row,) = evaluated_points(space, [point])
    if row.status is not RowStatus.SOLVED or space.kind is AtlasKind.DRAWN:
        return None, row
    return pose_gaits(space, [point])[0]


def _batches(
    space: AtlasSpace, points: Sequence[AtlasPoint], rows: dict[int, AtlasRow]
) -> list[list[AtlasPoint]]:
    """Gaits that can be searched together; what cannot even be asked has its row at once."""
    alike: dict[tuple[object, ...], list[AtlasPoint]] = defaultdict(list)
    for point in points:
        model = space.model(point.numbers)
        try:
            problem = point.pose_problem(model)
        except FootfallError as error:
            rows[point.number] = AtlasRow(point.number, RowStatus.INFEASIBLE, error.sentence)
            continue
        alike[point.numbers, problem.airborne.tobytes()].append(point)
    return [
        group[begin : begin + TOGETHER]
        for group in alike.values()
        for begin in range(0, len(group), TOGETHER)
    ]


def pose_gaits(space: AtlasSpace, points: Sequence[AtlasPoint]) -> list[tuple[PoseGait | None, AtlasRow]]:
    """Motions and rows of gaits whose feet take turns alike.

    Args:
        space: that they are of.
        points: of one robot and one layout.

    Returns:
        Of each gait its motion, if the checker confirms one, and its row.
    """
    model = space.model(points[0].numbers)
    problems = [point.pose_problem(model) for point in points]
    layout = Layout(problems[0])
    asked = _asked(points, problems)
    search, postures = Search(layout, asked, problems[0].bounds, HEIGHT_ROOM), Postures(layout, asked)
    found = search.run()
    answers: list[tuple[PoseGait | None, AtlasRow]] = [
        (None, _infeasible(point, found, place)) for place, point in enumerate(points)
    ]
    poses, too_near = postures.poses(found.unknowns), []
    for place in np.nonzero(found.residual < KEPT)[0].tolist():
        gait = _gait(points[place], problems[place], poses, place)
        check = check_poses(gait)
        answers[place] = _checked(points[place], gait, check)
        if check.figures.arm_distance < problems[place].bounds.arm_distance:
            too_near.append(place)
    if too_near:
        farther = search.with_arms_farther(found, too_near, ARMS_FARTHER)
        poses = postures.poses(farther.unknowns)
        for place in too_near:
            gait = _gait(points[place], problems[place], poses, place)
            if farther.residual[place] < KEPT and (check := check_poses(gait)).confirmed:
                answers[place] = _checked(points[place], gait, check)
    return answers


def _gait(point: AtlasPoint, problem: PoseProblem, poses: Poses, place: int) -> PoseGait:
    """The motion of one of many gaits."""
    return PoseGait(
        problem,
        point.step,
        poses.bodies[place] / MM,
        poses.headings[place],
        poses.feet[place] / MM,
        poses.strokes[place] / MM,
    )


def _asked(points: Sequence[AtlasPoint], problems: Sequence[PoseProblem]) -> Asked:
    def column(values: list[float]) -> Floats:
        return np.array(values, dtype=np.float64)

    return Asked(
        heading=column([problem.heading for problem in problems]),
        step=column([point.step * MM for point in points]),
        turn=column([point.turn for point in points]),
        height=column([point.height * MM for point in points]),
        clearance=column([point.clearance * MM for point in points]),
        margin=column([point.margin * MM for point in points]),
        longest=column([problem.largest_move * MM for problem in problems]),
    )


def _infeasible(point: AtlasPoint, found: Found, place: int) -> AtlasRow:
    limits = [WORDS[limit] for limit in found.limits[place] if limit in WORDS][:MOST_NAMED]
    reason = " and ".join(limits) or "no single limit"
    return AtlasRow(point.number, RowStatus.INFEASIBLE, f"Prevented by: {reason}.")


def _checked(point: AtlasPoint, gait: PoseGait, check: PoseCheck) -> tuple[PoseGait | None, AtlasRow]:
    if not check.confirmed:
        reason = f"The check does not confirm it. {check.findings[0].sentence}"
        return None, AtlasRow(point.number, RowStatus.FAILED, reason)
    return gait, pose_row(point.number, gait, check)


def pose_row(number: int, gait: PoseGait, check: PoseCheck) -> AtlasRow:
    """The row of a motion that the checker confirms."""
    stroke = gait.problem.model.stroke
    used = check.figures.stroke_most - check.figures.stroke_least
    return AtlasRow(
        number,
        RowStatus.SOLVED,
        seconds=gait.seconds,
        speed=gait.speed,
        turn_rate=gait.turn_rate,
        least_margin=check.figures.margin,
        body_move=float(np.linalg.norm(np.diff(gait.bodies, axis=0), axis=1).max()),
        stroke_use=used / (stroke.upper - stroke.lower),
        stop_seconds=check.figures.stop_seconds,
    )
