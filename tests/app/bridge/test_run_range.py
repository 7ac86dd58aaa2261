"""Runs that begin at a later pose, and runs that repeat a gait."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.bridge.run_range import MOST_ITERATIONS, RunRange, beginnings, why_not_repeated
from app.bridge.states import RobotState, RunPhase, RunPlan
from core.errors import InputError
from tests.support.virtual_robot import VirtualRobot, make_plan

ROUND = [[4.0] * 12, [6.0] * 12, [3.0, 8.0] * 6, [4.6] * 12]
"""Ends 0.6 mm from where it begins."""
HOLDS = [True, False, False, True]


def with_course(plan: RunPlan, first: int = 0, iterations: int = 1) -> RunPlan:
    return replace(plan, run_range=RunRange(first, iterations))


def taken_mm(robot: VirtualRobot) -> list[list[float]]:
    return [[round(h, 4) for h in m.strokes_mm] for m in robot.firmware.messages if m.strokes_mm is not None]


@given(st.integers(1, 30), st.integers(1, 5), st.data())
def test_the_order_ends_with_the_last_waypoint_in_each_iteration(
    count: int, iterations: int, data: st.DataObject
) -> None:
    first = data.draw(st.integers(0, count - 1))
    order = RunRange(first, iterations).order(count)
    assert order[0] == first
    assert order.count(count - 1) == iterations
    assert len(order) == count * iterations - first
    assert all(b == (a + 1) % count for a, b in pairwise(order))


def test_a_run_from_a_later_pose_goes_there_slowly_and_sends_the_rest() -> None:
    robot = VirtualRobot(strokes_mm=(0.5,) * 12)
    robot.begin(with_course(make_plan(ROUND, [True, False, True, True]), first=2))
    assert robot.snapshot.run is not None
    assert robot.snapshot.run.phase is RunPhase.START_POSE
    done = robot.until_robot(RobotState.DONE, RobotState.FAULT)
    assert done.robot is RobotState.DONE, done.last_error
    assert taken_mm(robot)[-2:] == ROUND[2:]
    assert [4.0] * 12 not in taken_mm(robot)
    assert done.run is not None
    assert (done.run.reached, done.run.count, done.run.waypoint_reached) == (2, 2, 3)


def test_a_gait_is_repeated_waypoint_by_waypoint() -> None:
    robot = VirtualRobot(strokes_mm=(4.0,) * 12)
    robot.begin(with_course(make_plan(ROUND, HOLDS), iterations=3))
    second = robot.until(lambda s: s.run is not None and s.run.sent == 6)
    assert second.run is not None
    assert (second.run.iteration, second.run.iterations, second.run.waypoint_sent) == (2, 3, 1)
    done = robot.until_robot(RobotState.DONE, RobotState.FAULT)
    assert done.robot is RobotState.DONE, done.last_error
    assert taken_mm(robot)[-12:] == ROUND * 3
    assert done.run is not None
    assert (done.run.reached, done.run.count, done.run.iteration) == (12, 12, 3)


def test_a_repeated_run_pauses_in_its_second_iteration_and_goes_on() -> None:
    robot = VirtualRobot(strokes_mm=(4.0,) * 12)
    robot.begin(with_course(make_plan(ROUND, HOLDS), first=3, iterations=3))
    robot.until(lambda s: s.run is not None and s.run.sent == 3)
    robot.machine.pause("Ada")
    paused = robot.until_robot(RobotState.PAUSED)
    assert paused.run is not None
    assert (paused.run.iteration, paused.run.waypoint_reached, paused.run.reached) == (2, 3, 5)
    robot.machine.resume("Ada", robot.now)
    assert robot.until_robot(RobotState.DONE, RobotState.FAULT).robot is RobotState.DONE


def test_a_fault_names_waypoint_and_iteration() -> None:
    robot = VirtualRobot(strokes_mm=(4.0,) * 12)
    robot.begin(with_course(make_plan(ROUND, HOLDS), iterations=2))
    robot.until(lambda s: s.run is not None and s.run.sent == 6)
    robot.to_robot = lambda data: data.replace(b"3.0000", b"3.0010", 1)
    failed = robot.until_robot(RobotState.FAULT)
    assert failed.last_error is not None
    assert "At waypoint 3 of 4, iteration 2 of 2." in failed.last_error


@pytest.mark.parametrize(
    ("run_range", "field", "words"),
    [
        (RunRange(first=2), "from", "At waypoint 3 a foot is in the air.* Begin at waypoint 1 or 4"),
        (RunRange(first=4), "from", "There is no waypoint 5; there are 4"),
        (RunRange(first=-1), "from", "There is no waypoint 0"),
        (RunRange(iterations=0), "iterations", "0 iterations cannot be sent; choose 1 to 100"),
        (RunRange(iterations=MOST_ITERATIONS + 1), "iterations", "101 iterations"),
    ],
)
def test_a_course_that_cannot_be_is_refused_with_what_would_do(
    run_range: RunRange, field: str, words: str
) -> None:
    with pytest.raises(InputError, match=words) as refused:
        replace(make_plan(ROUND, HOLDS), run_range=run_range)
    assert refused.value.where == field


def test_a_gait_that_does_not_end_as_it_begins_is_not_repeated() -> None:
    rows = np.array(ROUND)
    rows[-1, 7] = 5.3
    plan = make_plan(rows.tolist(), HOLDS)
    with pytest.raises(InputError, match=r"motor 8 .* ends 1\.30 mm from its start \(limit 1\.00 mm\)"):
        with_course(plan, iterations=2)
    assert why_not_repeated(plan.waypoints) is not None
    assert why_not_repeated(make_plan(ROUND).waypoints) is None


def test_runs_begin_at_the_first_waypoint_or_with_all_feet_down() -> None:
    assert beginnings([False, True, False, True]) == [0, 1, 3]
