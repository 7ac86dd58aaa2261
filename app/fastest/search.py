"""Searches over foot orders, directions and overlaps, and the front of margin and stop bound."""

import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from app.common.json import Json
from core.gait.foot_orders import order_title
from core.gait.gait import Gait, Orientation
from core.gait.poses import Poses
from core.pose_gaits.choices import Choice, Choices, choices
from core.pose_gaits.front import MARGINS, STOP_BOUNDS, FrontPoint, front
from core.pose_gaits.gait_poses import USUAL_STEP, with_pose_timeline
from core.pose_gaits.pace import pace_rank
from core.pose_gaits.pose_gait import PoseGait
from core.pose_gaits.pose_problem import PoseProblem
from core.robot.model import RobotModel
from solver_jobs import FastestSearch, SearchStep, TriedGait

FOOT_ORDERS, BOUNDS = "Foot orders", "Margins and stop bounds"
"""The two parts of a search, in words."""
Report = Callable[[str, SearchStep], object]
"""Called with the part and its progress after each answer."""

FRONT_CHOICES = 3
"""So many of the fastest choices are tried at the front's other margins and stop bounds."""


@dataclass(frozen=True, eq=False)
class Searched:
    """The result of a search.

    Args:
        choices: orders, directions and overlaps.
        tried: each of them in mid-walk at the margin and the stop bound that were asked.
        front: gaits that nobody would leave aside, the fastest first; empty where none was asked for.
        others: gaits that were tried at the front's other margins and stop bounds.
    """

    choices: Choices
    tried: tuple[TriedGait, ...]
    front: tuple[TriedGait, ...] = ()
    others: tuple[TriedGait, ...] = ()

    @property
    def front_count(self) -> int:
        """Gaits among which the front was looked for; 0 where none was asked for."""
        return len(self.tried) + len(self.others) if self.others else 0

    @property
    def ranked(self) -> list[tuple[Choice, TriedGait]]:
        """The choices that have a gait, the fastest first."""
        pairs = [
            pair
            for pair in zip(self.choices.tried, self.tried, strict=True)
            if pair[1].result.gait is not None
        ]
        return sorted(pairs, key=lambda pair: pace_rank(pair[1].pace))


def searched(
    search: FastestSearch,
    problem: PoseProblem,
    order: tuple[int, ...] | None,
    has_front: bool,
    report: Report,
    ending: threading.Event | None = None,
) -> Searched:
    """Tries every choice for a problem in mid-walk, and for a front also other margins and stop bounds.

    Args:
        search: the processes.
        problem: what is asked; its order and heading are chosen.
        order: the only foot order to try, or None.
        has_front: whether a front is asked for.
        report: called after each answer, from this thread.
        ending: set by another thread to cancel it.

    Raises:
        StateError: a process ended twice.
    """
    problem = replace(problem, cycles=None, pinned=())
    chosen = choices(problem, order)
    problems = [choice.of(problem) for choice in chosen.tried]
    tried = search.solve(problems, lambda step: report(FOOT_ORDERS, step), ending=ending)
    known = Searched(chosen, tuple(tried))
    if not has_front:
        return known
    problems, near = _front_problems(problem, known)
    others = search.solve(problems, lambda step: report(BOUNDS, step), near, ending)
    return with_front(known, others)


def _front_problems(problem: PoseProblem, known: Searched) -> tuple[list[PoseProblem], list[PoseGait | None]]:
    """What is tried for a front, and where each begins: beside the gait that is known of its choice."""
    grid = [
        replace(problem.bounds, margin=margin, stop_bound=bound)
        for margin in MARGINS
        for bound in STOP_BOUNDS
    ]
    pairs = [
        (choice, tried.result.gait, bounds)
        for bounds in grid
        for choice, tried in known.ranked[:FRONT_CHOICES]
        if bounds != problem.bounds
    ]
    problems = [choice.of(replace(problem, bounds=bounds)) for choice, _, bounds in pairs]
    return problems, [gait for _, gait, _ in pairs]


def with_front(known: Searched, others: Sequence[TriedGait]) -> Searched:
    """A search with the gaits that no other one of them beats in speed, margin and stop bound at once."""
    found = [one for one in (*known.tried, *others) if one.result.gait is not None]
    points = [FrontPoint(one.problem.bounds.margin, one.problem.bounds.stop_bound, one.pace) for one in found]
    kept = tuple(found[place] for place in front(points))
    return replace(known, front=kept, others=tuple(others))


def chosen_gait(gait: Gait, choice: Choice, model: RobotModel) -> Gait:
    """A document with poses that asks for a choice."""
    poses = gait.poses or Poses()
    step = gait.step
    if any(step[:2]):
        length = float(np.hypot(*step[:2])) or USUAL_STEP
        step = (length * float(np.cos(choice.heading)), length * float(np.sin(choice.heading)), step[2])
    name = order_title(model, choice.order) or "-".join(map(str, choice.order))
    chosen = replace(
        gait,
        name=f"{name}, fastest",
        notes="",
        order=choice.order,
        direction=1,
        orientation=Orientation.FBS if choice.heading == 0.0 else Orientation.FB,
        step=step,
        poses=replace(poses, overlap=choice.overlap),
    )
    return with_pose_timeline(chosen, model)


def search_content(found: Searched) -> Json:
    """A search as JSON content, SI."""
    return {
        "orders": found.choices.order_count,
        "complete": found.choices.is_complete,
        "tried": [tried_content(one) for one in found.tried],
        "front": [tried_content(one) for one in found.front],
        "front_tried": found.front_count,
    }


def tried_content(tried: TriedGait) -> Json:
    """A gait that was tried as JSON content, SI."""
    problem, result = tried.problem, tried.result
    gait = result.gait
    return {
        "order": list(problem.order),
        "heading": travel_heading(problem),
        "overlap": problem.overlap,
        "margin": problem.bounds.margin,
        "stop_bound": problem.bounds.stop_bound,
        "status": result.status.value,
        "moves": None if gait is None else gait.problem.move_count,
        "step": None if gait is None else gait.step,
        "on_the_spot": problem.on_the_spot,
        "turn": None if gait is None else gait.turn,
        "speed": None if gait is None else gait.speed,
        "turn_rate": None if gait is None else gait.turn_rate,
        "seconds": result.seconds,
        "explanation": list(result.explanation),
    }


def travel_heading(problem: PoseProblem) -> float:
    """Direction half way through a cycle, rad from x."""
    return problem.heading + (0.0 if problem.on_the_spot else problem.turn / 2.0)
