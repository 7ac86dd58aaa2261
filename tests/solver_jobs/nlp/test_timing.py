"""The shortest timing: what it reaches, what it keeps, what it refuses."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from core.errors import InputError
from core.motion.contact_timeline import timeline_from_order
from core.problem.motion_check import check_motion
from core.problem.motion_problem import MotionProblem, Workspace
from solver_jobs import Iterate, SolveStatus
from solver_jobs.nlp.motion_nlp import solve_motion
from solver_jobs.nlp.timing import TimingResult, fastest_timing, phase_spans, rounded_timeline
from solver_jobs.tiers.timing_use import made_usable
from tests.support.solvers.cases import BARE, gait_problem


def limited_walk() -> MotionProblem:
    """10 mm with margin, clearance and motor limits."""
    problem = gait_problem("walk", 0.010, Workspace.STROKE)
    limits = replace(problem.limits, margin=0.003, motor_speed=0.015, motor_acceleration=0.015)
    return replace(problem, limits=limits)


@cache
def fastest_walk() -> TimingResult:
    return fastest_timing(limited_walk())


@pytest.mark.heavy
def test_the_fastest_walk_keeps_every_limit_in_less_than_half_the_time() -> None:
    timing = fastest_walk()
    assert timing.status is SolveStatus.SOLVED, timing.explanation
    assert timing.total_seconds <= 6.5
    assert timing.drawn_seconds == pytest.approx(17.6)
    assert timing.trajectory.times[-1] == pytest.approx(timing.total_seconds)
    check = check_motion(timing.problem, timing.trajectory)
    assert check.confirmed, check.violations
    assert check.min_cop_margin > 0.003 - 1e-6


def test_no_phase_is_shorter_than_the_smallest_and_together_they_are_the_whole() -> None:
    timing = fastest_walk()
    seconds = np.array([phase.seconds for phase in timing.phases])
    assert seconds.min() >= 0.2 - 1e-9
    assert seconds.sum() == pytest.approx(timing.total_seconds)
    assert [(phase.first, phase.last) for phase in timing.phases] == [(5 * k, 5 * k + 4) for k in range(9)]


@pytest.mark.heavy
def test_a_longer_smallest_phase_is_kept_and_costs_time() -> None:
    timing = fastest_timing(limited_walk(), smallest_phase=0.5)
    assert timing.status is SolveStatus.SOLVED
    assert min(phase.seconds for phase in timing.phases) >= 0.5 - 1e-9
    assert timing.total_seconds > fastest_walk().total_seconds + 0.5


@pytest.mark.heavy
def test_the_same_motion_hurried_by_a_tenth_breaks_a_limit() -> None:
    timing = fastest_walk()
    hurried = replace(timing.problem, durations=timing.problem.intervals * 0.9)
    assert solve_motion(hurried).status is SolveStatus.INFEASIBLE


@pytest.mark.heavy
def test_a_step_too_long_for_the_drawn_phases_gets_longer_ones() -> None:
    problem = replace(gait_problem("walk", 0.032, Workspace.STROKE), model=BARE)
    assert solve_motion(problem).status is SolveStatus.INFEASIBLE
    timing = fastest_timing(problem)
    assert timing.status is SolveStatus.SOLVED
    assert check_motion(timing.problem, timing.trajectory).confirmed


@pytest.mark.heavy
def test_what_no_timing_makes_possible_is_explained() -> None:
    timing = fastest_timing(replace(gait_problem("walk", 0.060, Workspace.STROKE), model=BARE))
    assert timing.status is SolveStatus.INFEASIBLE
    assert "no motion even at 4× the time" in timing.explanation[0]
    assert "reach" in timing.explanation[1]
    assert timing.total_seconds == timing.drawn_seconds


@pytest.mark.heavy
def test_a_turned_problem_gets_the_turned_timing() -> None:
    problem = limited_walk()
    timing = fastest_timing(problem.turned(1))
    found, wanted = ([p.seconds for p in t.phases] for t in (timing, fastest_walk()))
    np.testing.assert_allclose(found, wanted, atol=1e-6)
    assert check_motion(timing.problem, timing.trajectory).confirmed


def test_the_last_knot_alone_is_no_phase() -> None:
    timeline = timeline_from_order(4, (3, 2, 4, 1), closing_knots=0)
    short = replace(gait_problem("walk", 0.010, Workspace.STROKE), timeline=timeline)
    assert phase_spans(short)[-1] == (35, 38)


def test_cancel_ends_the_search() -> None:
    seen: list[float] = []

    def progress(iterate: Iterate) -> bool:
        seen.append(iterate.objective)
        return len(seen) < 30

    timing = fastest_timing(limited_walk(), progress=progress)
    assert timing.status is SolveStatus.CANCELLED
    assert len(seen) == timing.iterations == 30
    assert seen[0] == pytest.approx(17.6)


def test_a_smallest_phase_of_nothing_is_refused() -> None:
    with pytest.raises(InputError, match="above 0 s"):
        fastest_timing(limited_walk(), smallest_phase=0.0)


@pytest.mark.parametrize("sample_time", [0.05, 0.2])
def test_a_rounded_timeline_gives_every_phase_at_least_its_time(sample_time: float) -> None:
    timing = fastest_walk()
    timeline = rounded_timeline(timing, sample_time)
    total = (timeline.sample_count - 1) * sample_time
    assert timing.total_seconds <= total < timing.total_seconds + len(timing.phases) * sample_time
    spans = phase_spans(replace(timing.problem, timeline=timeline, durations=None))
    for phase, (first, last) in zip(timing.phases, spans, strict=True):
        end = min(last + 1, timeline.sample_count - 1)
        assert (end - first) * sample_time >= phase.seconds - 1e-6
        np.testing.assert_array_equal(
            timeline.stance[:, first], timing.problem.timeline.stance[:, phase.first]
        )


def test_a_rounded_timeline_is_an_ordinary_gait() -> None:
    timeline = rounded_timeline(fastest_walk(), 0.2)
    problem = replace(limited_walk(), timeline=timeline)
    result = solve_motion(problem)
    assert result.status is SolveStatus.SOLVED
    assert check_motion(problem, result.trajectory).confirmed


@pytest.mark.heavy
def test_a_usable_timeline_is_the_shortest_that_the_exact_tier_solves() -> None:
    timing = made_usable(fastest_walk(), lambda iterate: True)
    timeline = timing.usable_timeline
    assert timeline is not None
    assert timing.usable is not None
    assert fastest_walk().total_seconds <= timeline.times[-1] <= 7.0
    problem = replace(limited_walk(), timeline=timeline)
    assert check_motion(problem, timing.usable.trajectory).confirmed


@pytest.mark.heavy
def test_a_cancelled_search_gives_no_timeline() -> None:
    timing = made_usable(fastest_walk(), lambda iterate: False)
    assert timing.status is SolveStatus.CANCELLED
    assert timing.usable is None
