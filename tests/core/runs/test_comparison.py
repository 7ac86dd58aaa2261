"""Two runs, waypoint by waypoint."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.runs.analysis import run_errors
from core.runs.comparison import compare_runs
from core.runs.pose import RanPlan
from core.runs.reading import RunSeries, read_run
from tests.support.ran_robot import ROBOT, ran


def series(share: float = 1.0, slower: float = 1.0) -> RunSeries:
    """The run as far as a share of its time, each second as long as `slower` seconds."""
    done = ran()
    end = done.began + (done.robot.now - done.began) * share
    pieces = [replace(p, time=p.time * slower) for p in done.robot.pieces if p.time <= end]
    return read_run(pieces, done.way.waypoints)


def test_a_run_is_like_itself() -> None:
    both = compare_runs(series(), series())
    count = ran().way.waypoints.count
    assert both.indices.tolist() == list(range(count))
    assert set(both.laps.tolist()) == {0}
    assert (both.one.seconds == both.other.seconds).all()
    assert (np.diff(both.one.seconds) > 0).all()
    assert both.one.measured_mm.shape == both.one.target_mm.shape == (count, 12)


def test_a_stopped_run_is_compared_as_far_as_it_came() -> None:
    whole, part = series(), series(0.4)
    both = compare_runs(whole, part)
    reached = sum(command.is_reached for command in part.commands)
    assert 3 < len(both.indices) == reached < ran().way.waypoints.count
    assert both.one.seconds == pytest.approx(both.other.seconds)
    done = ran()
    plan = RanPlan(ROBOT, done.way.waypoints, done.way.times, done.trajectory)
    errors = [run_errors(plan, one.series) for one in (both.one, both.other)]
    assert errors[0].seconds == pytest.approx(errors[1].seconds) == pytest.approx(both.one.seconds[-1])
    assert errors[0].arrived == errors[1].arrived == reached
    assert errors[0].foot_largest == pytest.approx(errors[1].foot_largest)


def test_a_slower_run_takes_longer_to_each_waypoint() -> None:
    both = compare_runs(series(), series(slower=1.5))
    assert both.other.seconds == pytest.approx(1.5 * both.one.seconds)
    assert both.other.move_seconds == pytest.approx(1.5 * both.one.move_seconds)
    assert (both.one.error_mm == both.other.error_mm).all()


def test_a_run_that_began_later_is_compared_from_there() -> None:
    whole = series()
    late = replace(
        whole,
        commands=tuple(
            replace(c, index=-1, measured_mm=()) if c.index in (0, 1) else c for c in whole.commands
        ),
    )
    both = compare_runs(whole, late)
    assert both.indices[0] == 2
    assert both.one.seconds[0] == both.one.move_seconds[0] == both.other.seconds[0]


def test_runs_that_reached_nothing_in_common_have_nothing_to_compare() -> None:
    whole = series()
    none = replace(whole, commands=())
    both = compare_runs(whole, none)
    assert both.indices.shape == both.one.seconds.shape == both.other.error_mm.shape == (0,)
