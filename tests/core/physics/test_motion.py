"""Simulated time on the plan's axis: waypoints lie where the plan has them, whatever the firmware took."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from core.physics.motion import plan_times
from tests.support.simulated_walk import SAMPLES_A_MOVE, followed, walk_problem


def test_arrivals_lie_at_the_plans_times_and_all_between_evenly() -> None:
    problem, motion = walk_problem(), followed(walk_problem())
    times = plan_times(problem, motion)
    assert np.allclose(times[motion.arrivals], problem.times)
    middle = SAMPLES_A_MOVE // 2
    assert np.isclose(times[middle], problem.times[:2].mean())


def test_a_move_that_broke_off_leads_to_its_waypoint() -> None:
    problem, motion = walk_problem(), followed(walk_problem())
    broken = replace(motion, arrivals=motion.arrivals[:5], ended_early="It fell.")
    times = plan_times(problem, broken)
    assert times[motion.arrivals[4]] == problem.times[4]
    assert times[-1] == problem.times[5]
    assert (np.diff(times) >= 0).all()


def test_of_waypoints_reached_at_one_sample_the_last_one_counts() -> None:
    problem, motion = walk_problem(), followed(walk_problem())
    arrivals = motion.arrivals.copy()
    arrivals[3] = arrivals[4]
    times = plan_times(problem, replace(motion, arrivals=arrivals))
    assert times[arrivals[4]] == problem.times[4]


def test_time_stands_before_the_first_arrival_and_after_the_last() -> None:
    problem, motion = walk_problem(), followed(walk_problem())
    late = replace(motion, arrivals=np.clip(motion.arrivals, 10, len(motion.times) - 5))
    times = plan_times(problem, late)
    assert (times[:11] == problem.times[0]).all()
    assert (times[-5:] == problem.times[-1]).all()


def test_a_run_that_ended_at_an_arrival_ends_at_its_waypoint() -> None:
    problem, motion = walk_problem(), followed(walk_problem(), moves=6)
    assert plan_times(problem, motion)[-1] == problem.times[6]
