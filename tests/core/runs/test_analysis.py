"""Runs read from bytes: an emulated robot in its own time, with errors that are known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.runs.analysis import move_begins, plan_times, run_errors
from core.runs.pose import RanPlan, measured_motion
from core.runs.reading import START, RunBytes, RunSeries, read_run
from core.wire.messages import encode_stop, encode_waypoint
from tests.support.ran_robot import ROBOT, TimedRobot, ran


@pytest.fixture(scope="module")
def plan() -> RanPlan:
    done = ran()
    return RanPlan(ROBOT, done.way.waypoints, done.way.times, done.trajectory)


@pytest.fixture(scope="module")
def robot() -> TimedRobot:
    """A robot that has run the whole plan."""
    return ran().robot


@pytest.fixture(scope="module")
def series(robot: TimedRobot, plan: RanPlan) -> RunSeries:
    return read_run(robot.pieces, plan.waypoints)


def ideal(plan: RanPlan, off_mm: np.ndarray | float = 0.0, laps: int = 1) -> RunSeries:
    """A run of a robot that arrives exactly, but for what its strokes are off."""
    lines: list[RunBytes] = [RunBytes(0.0, False, b"\r\n")]
    time = 0.0
    rows = [row for _ in range(laps) for row in range(plan.waypoints.count)]
    for row in rows:
        numbers = plan.waypoints.strokes_mm[row]
        message = encode_waypoint(plan.waypoints.strokes[row], float(plan.waypoints.durations[row]))
        point = "".join(f"{h:.4f} " for h in numbers)
        told = "".join(f"{h:.4f}," for h in numbers + off_mm)
        answer = (
            f"new data tf 1\r\n{message[1:-1].decode()}\r\np durations i1.00\r\n"
            f"Trajectory Point 0: \tp 1.00 {point}\r\nend of all available trajectories\r\n"
        )
        lines += [
            RunBytes(time, True, message),
            RunBytes(time + 0.5, False, answer.encode()),
            RunBytes(time + 1.0, False, f"j,{told}\r\n".encode()),
        ]
        time += 2.0
    return read_run(lines, plan.waypoints)


def test_every_waypoint_is_found_with_its_arrival(series: RunSeries, plan: RanPlan) -> None:
    streamed = series.streamed
    assert [c.index for c in streamed] == list(range(plan.waypoints.count))
    assert all(c.is_reached for c in streamed)
    assert series.commands[0].index == START  # the slow way to the start pose comes first
    for command in streamed[1:]:
        assert command.target_mm == pytest.approx(plan.waypoints.strokes_mm[command.index])
        assert command.sent < command.arrived


def test_a_clear_after_a_stop_is_no_part_of_the_run(robot: TimedRobot, plan: RanPlan) -> None:
    end = robot.pieces[-1].time
    cleared = [
        RunBytes(end + 1.0, True, encode_stop()),
        RunBytes(end + 9.0, True, encode_waypoint(np.full(12, 0.0071), 1.0)),
    ]
    series = read_run([*robot.pieces, *cleared], plan.waypoints)
    assert [c.index for c in series.streamed] == list(range(plan.waypoints.count))


def test_measured_strokes_are_the_emulated_motors(series: RunSeries, robot: TimedRobot) -> None:
    assert len(series.times) > 100
    assert (np.diff(series.times) >= 0).all()
    np.testing.assert_allclose(series.measured_mm[-1], robot.strokes_mm, atol=0.05)


def test_tracking_errors_are_those_of_the_threshold(series: RunSeries, plan: RanPlan) -> None:
    errors = run_errors(plan, series)
    assert 0 < errors.motor_largest.max() <= 0.0012  # the firmware leaves a motor within 1 mm where it is
    assert (errors.motor_mean <= errors.motor_largest).all()
    assert errors.seconds == pytest.approx(errors.estimate, rel=0.2)
    assert errors.start_seconds > 1
    assert 0 < errors.foot_largest.max() < 0.01
    assert (errors.foot_path < 0.02).all()


def test_an_exact_run_has_no_errors(plan: RanPlan) -> None:
    series = ideal(plan)
    errors = run_errors(plan, series)
    assert errors.arrived == plan.waypoints.count
    assert errors.seconds == pytest.approx(2.0 * plan.waypoints.count - 1.0)
    for figures in (errors.motor_largest, errors.foot_largest):
        assert figures.max() < 2e-6
    assert errors.body_largest < 2e-6
    assert errors.foot_path.max() < 2e-6
    np.testing.assert_allclose(plan_times(plan, series), plan.times, atol=1e-9)


def test_a_known_offset_of_one_motor_is_found(plan: RanPlan) -> None:
    off = np.zeros(12)
    off[4] = 0.7
    errors = run_errors(plan, ideal(plan, off))
    assert errors.motor_mean[4] == pytest.approx(0.0007, abs=1e-7)
    assert errors.motor_largest.argmax() == 4
    others = np.delete(errors.motor_largest, 4)
    assert others.max() < 1e-7
    assert errors.foot_largest.argmax() == 1  # motor 5 is the second of foot 2
    assert 1e-4 < errors.foot_largest[1] < 2e-3


def test_all_motors_too_far_out_lift_the_body_and_no_foot(plan: RanPlan) -> None:
    """Equal strokes more on every motor move all feet of the robot's frame down alike: that is the body."""
    errors = run_errors(plan, ideal(plan, 0.5))
    assert errors.body_largest == pytest.approx(0.0005, abs=2e-5)
    assert errors.foot_largest.max() < 1e-4


def test_a_turned_robot_is_measured_as_turned(plan: RanPlan) -> None:
    trajectory = plan.trajectory
    turned = replace(
        trajectory, heading=trajectory.heading + 0.02, body_world=trajectory.body_world + [0.003, 0.0, 0.001]
    )
    strokes = turned.strokes(ROBOT)
    motion = measured_motion(plan, strokes, trajectory.times, trajectory.times)
    np.testing.assert_allclose(motion.pose.heading, turned.heading, atol=1e-9)
    np.testing.assert_allclose(motion.pose.position_world, turned.pose(ROBOT).position_world, atol=1e-9)
    np.testing.assert_allclose(motion.feet_world, trajectory.feet_world, atol=1e-9)


def test_laps_are_counted(plan: RanPlan) -> None:
    series = ideal(plan, laps=3)
    assert {c.lap for c in series.commands} == {0, 1, 2}
    errors = run_errors(plan, series)
    assert errors.arrived == 3 * plan.waypoints.count
    assert errors.foot_largest.max() < 2e-6


def test_a_run_that_breaks_off_keeps_what_it_measured(robot: TimedRobot, plan: RanPlan) -> None:
    pieces = robot.pieces[: len(robot.pieces) // 2]
    series = read_run(pieces, plan.waypoints)
    errors = run_errors(plan, series)
    assert 0 < errors.arrived < plan.waypoints.count
    times = plan_times(plan, series)
    known = np.isfinite(times)
    assert (times[known] >= move_begins(plan, series)[known] - 1e-9).all()


def test_nothing_heard_is_nothing_known(plan: RanPlan) -> None:
    errors = run_errors(plan, read_run([], plan.waypoints))
    assert errors.arrived == 0
    assert np.isnan(errors.motor_largest).all()
    assert np.isnan(errors.foot_path).all()
