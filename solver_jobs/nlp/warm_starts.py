"""Warm starts: the last solution of each problem shape, from which an edit goes on."""

from dataclasses import dataclass
from weakref import WeakKeyDictionary

import numpy as np

from core.arrays import Floats
from core.problem.motion_problem import MotionProblem, RestPose
from solver_jobs.nlp.attempts import Point
from solver_jobs.nlp.compiled_problem import CompiledProblem

MOST_CELLS_PER_FOOT = 4
"""An edit changes at most so many cells of the timeline a foot, on average."""

MOST_WAY = 0.0025
"""An edit moves start or goal of body and feet by at most this, m."""

MOST_TURN = 0.05
"""An edit changes the heading by at most this, rad."""

MOST_STRETCH = 0.1
"""An edit changes the time between knots by at most this share."""


@dataclass(frozen=True, eq=False)
class _Solved:
    problem: MotionProblem
    point: Point


class WarmStarts:
    """The last solution of each structure that is still kept."""

    def __init__(self) -> None:
        self._solved: WeakKeyDictionary[CompiledProblem, _Solved] = WeakKeyDictionary()

    def keep(self, compiled: CompiledProblem, problem: MotionProblem, point: Point) -> None:
        """Remembers a solution."""
        self._solved[compiled] = _Solved(problem, point)

    def near(self, compiled: CompiledProblem, problem: MotionProblem) -> Point | None:
        """The last solution of this shape, where its problem differs only a little."""
        solved = self._solved.get(compiled)
        return solved.point if solved is not None and differ_little(solved.problem, problem) else None


def differ_little(one: MotionProblem, other: MotionProblem) -> bool:
    """Whether two problems of one shape are within an edit of each other."""
    cells = int((one.timeline.stance != other.timeline.stance).sum())
    way = max(_distance(one.start, other.start), _distance(one.goal, other.goal))
    turn = float(np.abs(one.heading - other.heading).max())
    stretch = float(np.abs(np.log(one.intervals / other.intervals)).max())
    return (
        cells <= MOST_CELLS_PER_FOOT * one.timeline.leg_count
        and way <= MOST_WAY
        and turn <= MOST_TURN
        and stretch <= MOST_STRETCH
    )


def _distance(one: RestPose, other: RestPose) -> float:
    places: list[Floats] = [one.body_world - other.body_world, *(one.feet_world - other.feet_world)]
    return max(float(np.linalg.norm(place)) for place in places)
