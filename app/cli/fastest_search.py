"""`fastest --search` and `--front`: foot orders, directions, overlaps, the price of margin and stop bound."""

import sys
from collections.abc import Callable
from contextlib import closing
from dataclasses import dataclass, replace

import numpy as np

from app.common.json import Json
from core.gait.gait import Gait, Orientation
from core.gait.poses import Poses
from core.library.library import Group, library
from core.pose_gaits.choices import Choice, Choices, choices
from core.pose_gaits.front import MARGINS, STOP_BOUNDS, FrontPoint, front
from core.pose_gaits.gait_poses import USUAL_STEP, with_pose_timeline
from core.pose_gaits.pose_problem import PoseProblem
from core.robot.model import RobotModel
from solver_jobs import FastestSearch, SearchStep, TriedGait

FRONT_CHOICES = 3
"""So many of the fastest choices are tried at the front's other margins and stop bounds."""


@dataclass(frozen=True, eq=False)
class Searched:
    """The result of a search.

    Args:
        choices: orders, directions and overlaps.
        tried: each of them in mid-walk at the margin and the stop bound that were asked.
        front: gaits that nobody would leave aside, the fastest first; empty where none was asked for.
        front_count: gaits that were tried for it.
    """

    choices: Choices
    tried: tuple[TriedGait, ...]
    front: tuple[TriedGait, ...] = ()
    front_count: int = 0

    @property
    def ranked(self) -> list[tuple[Choice, TriedGait]]:
        """The choices that have a gait, the fastest first."""
        pairs = [
            pair
            for pair in zip(self.choices.tried, self.tried, strict=True)
            if pair[1].result.gait is not None
        ]
        return sorted(pairs, key=lambda pair: -pair[1].pace)


def searched(problem: PoseProblem, order: tuple[int, ...] | None, has_front: bool) -> Searched:
    """Tries every choice for a problem in mid-walk, and for a front also other margins and stop bounds.

    Args:
        problem: what is asked; its order and heading are chosen.
        order: the only foot order to try, or None.
        has_front: whether a front is asked for.
    """
    problem = replace(problem, cycles=None, pinned=())
    chosen = choices(problem, order)
    with closing(FastestSearch(niceness=0)) as search:
        tried = search.solve([choice.of(problem) for choice in chosen.tried], _progress("Foot orders"))
        known = Searched(chosen, tuple(tried))
        return _with_front(search, problem, known) if has_front else known


def _with_front(search: FastestSearch, problem: PoseProblem, known: Searched) -> Searched:
    """The same with the front; each search for it begins beside the gait that is known of its choice."""
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
    others = search.solve(problems, _progress("Margins and stop bounds"), near=[gait for _, gait, _ in pairs])
    found = [one for one in (*known.tried, *others) if one.result.gait is not None]
    points = [FrontPoint(one.problem.bounds.margin, one.problem.bounds.stop_bound, one.pace) for one in found]
    kept = tuple(found[place] for place in front(points))
    return replace(known, front=kept, front_count=len(known.tried) + len(others))


def chosen_gait(gait: Gait, choice: Choice, model: RobotModel) -> Gait:
    """A document with poses that asks for a choice."""
    poses = gait.poses or Poses()
    step = gait.step
    if any(step[:2]):
        length = float(np.hypot(*step[:2])) or USUAL_STEP
        step = (length * float(np.cos(choice.heading)), length * float(np.sin(choice.heading)), step[2])
    name = order_name(choice.order)
    chosen = replace(
        gait,
        name=f"{library()[name].gait.name}, fastest"
        if name
        else f"{'-'.join(map(str, choice.order))}, fastest",
        notes="",
        order=choice.order,
        direction=1,
        orientation=Orientation.FBS if choice.heading == 0.0 else Orientation.FB,
        step=step,
        poses=replace(poses, overlap=choice.overlap),
    )
    return with_pose_timeline(chosen, model)


def _progress(what: str) -> Callable[[SearchStep], None]:
    """Shows a person at a terminal how far the search is."""
    if not sys.stderr.isatty():
        return lambda step: None

    def tell(step: SearchStep) -> None:
        fastest = "" if step.fastest is None else f", the fastest yet {pace_words(step.fastest)}"
        sys.stderr.write(f"\r\033[K{what}: {step.done} of {step.count}{fastest}")
        sys.stderr.write("\n" if step.done == step.count else "")
        sys.stderr.flush()

    return tell


def pace_words(tried: TriedGait) -> str:
    """How fast a gait is, in words."""
    gait = tried.result.gait
    if gait is None:
        return "none"
    if gait.problem.on_the_spot:
        return f"{abs(np.degrees(gait.turn_rate)):.2f}°/s"
    return f"{gait.speed * 1000:.2f} mm/s"


def search_content(found: Searched) -> Json:
    """A search as JSON content, SI."""
    return {
        "orders": found.choices.order_count,
        "complete": found.choices.is_complete,
        "tried": [_tried_content(one) for one in found.tried],
        "front": [_tried_content(one) for one in found.front],
        "front_tried": found.front_count,
    }


def _tried_content(tried: TriedGait) -> Json:
    problem, result = tried.problem, tried.result
    gait = result.gait
    return {
        "order": list(problem.order),
        "heading": _travel_heading(problem),
        "overlap": problem.overlap,
        "margin": problem.bounds.margin,
        "stop_bound": problem.bounds.stop_bound,
        "status": result.status.value,
        "moves": None if gait is None else gait.problem.move_count,
        "step": None if gait is None else gait.step,
        "turn": None if gait is None else gait.turn,
        "speed": None if gait is None else gait.speed,
        "turn_rate": None if gait is None else gait.turn_rate,
        "seconds": result.seconds,
        "explanation": list(result.explanation),
    }


def _travel_heading(problem: PoseProblem) -> float:
    return problem.heading + (0.0 if problem.on_the_spot else problem.turn / 2.0)


def search_lines(found: Searched) -> list[str]:
    """A search as a table for people, and the front as another."""
    count, every = len(found.tried), found.choices.order_count
    scope = "every foot order" if found.choices.is_complete else f"some of {every:,} foot orders"
    scope = "the foot order" if every == 1 else scope
    lines = [f"Tried {scope}, {count} gaits that differ, in mid-walk:"]
    for one in sorted(found.tried, key=lambda tried: -tried.pace):
        lines.append(f"  {_choice_words(one.problem):<38} {_outcome_words(one)}")
    if not found.front_count:
        return lines
    lines.append(f"No gait of {found.front_count} is faster with as much margin and as early a stop:")
    for one in found.front:
        bounds = one.problem.bounds
        asked = f"margin {bounds.margin * 1000:g} mm, stop bound {bounds.stop_bound:g} s"
        lines.append(f"  {asked:<38} {pace_words(one):<12} {_choice_words(one.problem)}")
    return lines


def _choice_words(problem: PoseProblem) -> str:
    order = "-".join(map(str, problem.order))
    name = order_name(problem.order)
    order += f" ({name})" if name else ""
    where = "" if problem.on_the_spot else f", heading {np.degrees(_travel_heading(problem)):.0f}°"
    return f"{order}{where}{', overlapping' if problem.overlap else ''}"


def order_name(order: tuple[int, ...]) -> str | None:
    """Id of the optimised gait with this circular foot order, or None."""
    for entry in library().values():
        own = entry.gait.order
        is_straight = entry.group is Group.OPTIMISED and entry.gait.step[2] == 0.0
        if is_straight and order in [own[first:] + own[:first] for first in range(len(own))]:
            return entry.id
    return None


def _outcome_words(tried: TriedGait) -> str:
    gait = tried.result.gait
    if gait is None:
        return tried.result.explanation[0] if tried.result.explanation else tried.result.status.value
    step = f"{np.degrees(gait.turn):.1f}°" if gait.problem.on_the_spot else f"{gait.step * 1000:.1f} mm"
    return f"{pace_words(tried):<12} {step} in {gait.problem.move_count} moves"
