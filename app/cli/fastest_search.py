"""`fastest --search` and `--front` in words: progress, a table, the front."""

import numpy as np

from app.cli.common.progress import rewrite_line
from app.fastest.search import Searched, travel_heading
from core.library.library import order_name
from core.pose_gaits.pace import pace_rank, pace_words
from core.pose_gaits.pose_problem import PoseProblem
from solver_jobs import SearchStep, TriedGait


def show_progress(part: str, step: SearchStep) -> None:
    """Shows a person at a terminal how far a search is."""
    fastest = "" if step.fastest is None else f", the fastest yet {_tried_pace(step.fastest)}"
    rewrite_line(f"{part}: {step.done} of {step.count}{fastest}", is_last=step.done == step.count)


def _tried_pace(tried: TriedGait) -> str:
    """How fast a gait that was tried is, in words."""
    gait = tried.result.gait
    return "none" if gait is None else pace_words(gait.pace, gait.problem.on_the_spot)


def search_lines(found: Searched) -> list[str]:
    """A search as a table for people, and the front as another."""
    count, every = len(found.tried), found.choices.order_count
    scope = "every foot order" if found.choices.is_complete else f"some of {every:,} foot orders"
    scope = "the foot order" if every == 1 else scope
    lines = [f"Tried {scope}, {count} gaits that differ, in mid-walk:"]
    for one in sorted(found.tried, key=lambda tried: pace_rank(tried.pace)):
        lines.append(f"  {_choice_words(one.problem):<38} {_outcome_words(one)}")
    if not found.front_count:
        return lines
    lines.append(f"No gait of {found.front_count} is faster with as much margin and as early a stop:")
    for one in found.front:
        bounds = one.problem.bounds
        asked = f"margin {bounds.margin * 1000:g} mm, stop bound {bounds.stop_bound:g} s"
        lines.append(f"  {asked:<38} {_tried_pace(one):<12} {_choice_words(one.problem)}")
    return lines


def _choice_words(problem: PoseProblem) -> str:
    order = "-".join(map(str, problem.order))
    name = order_name(problem.order)
    order += f" ({name})" if name else ""
    where = "" if problem.on_the_spot else f", heading {np.degrees(travel_heading(problem)):.0f}°"
    return f"{order}{where}{', overlapping' if problem.overlap else ''}"


def _outcome_words(tried: TriedGait) -> str:
    gait = tried.result.gait
    if gait is None:
        return tried.result.explanation[0] if tried.result.explanation else tried.result.status.value
    step = f"{np.degrees(gait.turn):.1f}°" if gait.problem.on_the_spot else f"{gait.step * 1000:.1f} mm"
    return f"{_tried_pace(tried):<12} {step} in {gait.problem.move_count} moves"
