"""When iterations of a run ended, by its plan's steps and what the robot said."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.motion.trajectory import Trajectory
from core.runs.iterations import iteration_arrivals, plan_ends
from core.runs.pose import RanPlan
from core.runs.reading import RunSeries, SentWaypoint
from tests.support.ran_robot import ROBOT, ran


@pytest.fixture(scope="module")
def plan() -> RanPlan:
    done = ran()
    return RanPlan(ROBOT, done.way.waypoints, done.way.times, done.trajectory)


def twice(trajectory: Trajectory) -> Trajectory:
    """The contacts of a walk, one after the other; where the feet are does not matter here."""
    later = trajectory.times[1:] + trajectory.times[-1]
    both = {
        name: np.concatenate([getattr(trajectory, name), getattr(trajectory, name)[1:]])
        for name in ("body_world", "heading", "feet_world", "contact")
    }
    return Trajectory(times=np.concatenate([trajectory.times, later]), **both)


def series(arrived: list[tuple[int, int, float]]) -> RunSeries:
    strokes = (0.0,) * 12
    commands = tuple(SentWaypoint(0.0, strokes, index, lap, time, strokes) for lap, index, time in arrived)
    return RunSeries(np.zeros(0), np.zeros((0, 12)), np.zeros(0, dtype=np.int64), commands)


def test_one_iteration_ends_with_the_plan(plan: RanPlan) -> None:
    ends = plan_ends(plan.trajectory)
    assert ends is not None
    np.testing.assert_allclose(ends, [plan.trajectory.times[-1]])


def test_of_two_iterations_the_first_ends_between_its_last_landing_and_the_next_lift(plan: RanPlan) -> None:
    ends = plan_ends(twice(plan.trajectory))
    assert ends is not None
    assert len(ends) == 2
    assert ends[0] == pytest.approx(plan.trajectory.times[-1], rel=0.2)


def test_a_plan_without_steps_tells_no_iterations(plan: RanPlan) -> None:
    still = replace(plan.trajectory, contact=np.ones_like(plan.trajectory.contact))
    assert plan_ends(still) is None
    assert iteration_arrivals(replace(plan, trajectory=still), series([])) is None


def test_laps_that_were_not_brought_to_an_end_are_left_out(plan: RanPlan) -> None:
    last = plan.waypoints.count - 1
    run = series([(0, 0, 1.0), (0, last, 9.0), (1, 0, 10.0), (1, last - 1, 17.0)])
    arrived = iteration_arrivals(plan, run)
    assert arrived is not None
    np.testing.assert_allclose(arrived, [9.0])
