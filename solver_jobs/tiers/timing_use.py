"""A fastest timing made usable: an ordinary timeline of whole samples that the exact tier has solved."""

from dataclasses import replace

import numpy as np

from core.problem.motion_check import check_motion
from solver_jobs.nlp.attempts import Progress
from solver_jobs.nlp.timing import TimingResult, rounded_timeline
from solver_jobs.results.motion import SolveStatus
from solver_jobs.tiers.exact_from_live import solve_by_both

SAMPLE_TIMES = np.arange(0.15, 0.405, 0.01)
"""Sample times that are tried, s."""

MOST_TRIES = 5
"""Shortest timelines that are tried."""


def made_usable(timing: TimingResult, progress: Progress) -> TimingResult:
    """The shortest timeline of whole samples whose phases are at least as long as found, and that works.

    Args:
        timing: a solved search.
        progress: told of each iteration; false cancels.

    Returns:
        The timing with its usable motion; without one where none of the shortest works.
    """
    timelines = [rounded_timeline(timing, round(float(seconds), 3)) for seconds in SAMPLE_TIMES]
    for timeline in sorted(timelines, key=lambda one: float(one.times[-1]))[:MOST_TRIES]:
        problem = replace(timing.problem, timeline=timeline, durations=None, heading_profile=None)
        result = solve_by_both(problem, progress)
        if result.status is SolveStatus.CANCELLED:
            return replace(timing, status=SolveStatus.CANCELLED, explanation=result.explanation)
        if result.status is SolveStatus.SOLVED and check_motion(problem, result.trajectory).confirmed:
            return replace(timing, usable=result, usable_timeline=timeline)
    return timing
