"""The search for changes that make a drawing walk."""

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
    """Finds changes that make a gait walk.

    Args:
        gait: a gait without a motion, or one that tips in physics.
        model: its robot.
        go_on: called before each trial; False ends the search with the remedies found so far.
        tell: called with each remedy as soon as it is found.
        tips: whether the gait has a motion but tips in physics.
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
