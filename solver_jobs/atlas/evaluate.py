"""The rows of some gaits of a space: each motion is searched for, and believed only from the checker."""

from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from core.arrays import Floats
from core.atlas.point import AtlasPoint
from core.atlas.row import AtlasRow, RowStatus
from core.atlas.space import AtlasKind, AtlasSpace
from core.errors import FootfallError
from core.pose_gaits.pose_check import PoseCheck, check_poses
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import PoseBounds, PoseProblem
from solver_jobs.atlas.draw import drawn_points
from solver_jobs.atlas.layout import MM, Asked, Layout
from solver_jobs.atlas.postures import Postures
from solver_jobs.atlas.search import KEPT, Found, Search

TOGETHER = 48
"""Gaits that are searched together; more need more memory, fewer more time."""
HEIGHT_ROOM = 2.0
"""How far the actuator plane of a pose may be from the height that is asked, mm."""
ARMS_FARTHER = 0.0005
"""How much farther apart arms are kept in a second search, m, where the checker finds them too near within a
move: the search looks at fewer places."""
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
    answers = _searched(points, problems, problems[0].bounds)
    missed = [place for place, (_, row) in enumerate(answers) if row.status is RowStatus.FAILED]
    if missed:
        bounds = problems[0].bounds
        farther = replace(bounds, arm_distance=bounds.arm_distance + ARMS_FARTHER)
        again = _searched([points[place] for place in missed], [problems[place] for place in missed], farther)
        for place, answer in zip(missed, again, strict=True):
            if answer[1].status is RowStatus.SOLVED:
                answers[place] = answer
    return answers


def _searched(
    points: Sequence[AtlasPoint], problems: Sequence[PoseProblem], bounds: PoseBounds
) -> list[tuple[PoseGait | None, AtlasRow]]:
    """Motions and rows as the search finds them within bounds; the checker holds them to their own ones."""
    layout = Layout(problems[0])
    asked = _asked(points, problems)
    found = Search(layout, asked, bounds, HEIGHT_ROOM).run()
    poses = Postures(layout, asked).poses(found.unknowns)
    answers: list[tuple[PoseGait | None, AtlasRow]] = []
    for place, (point, problem) in enumerate(zip(points, problems, strict=True)):
        if not found.residual[place] < KEPT:
            answers.append((None, _infeasible(point, found, place)))
            continue
        gait = PoseGait(
            problem,
            point.step,
            poses.bodies[place] / MM,
            poses.headings[place],
            poses.feet[place] / MM,
            poses.strokes[place] / MM,
        )
        answers.append(_checked(point, gait))
    return answers


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


def _checked(point: AtlasPoint, gait: PoseGait) -> tuple[PoseGait | None, AtlasRow]:
    check = check_poses(gait)
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
