"""The search for what would make a drawing walk."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from core.gait.gait import Gait
from core.robot.model import RobotModel
from solver_jobs.remedies.candidates import Candidates
from solver_jobs.remedies.remedy import Remedy, RemedySearch, rank
from solver_jobs.remedies.trial import InterruptedSearchError, Trial


def find_remedies(
    gait: Gait,
    model: RobotModel,
    go_on: Callable[[], bool],
    tell: Callable[[Remedy], object] = lambda remedy: None,
    *,
    tips: bool = False,
) -> RemedySearch:
    """Looks for changes that make a gait walk.

    Args:
        gait: one that has no motion, or one that tips in physics.
        model: its robot.
        go_on: asked before each try; false ends the search with what was found.
        tell: told of each remedy as it is found.
        tips: whether the gait has a motion and tips.
    """
    candidates = Candidates(gait, model, Trial(model, go_on), tips=tips)
    found: list[Remedy] = []
    complete = True
    try:
        for remedy in candidates.remedies():
            found.append(remedy)
            tell(remedy)
    except InterruptedSearchError:
        complete = False
    best_first = sorted(found, key=partial(rank, gait, model))
    return RemedySearch(tuple(best_first), complete, candidates.trouble)
