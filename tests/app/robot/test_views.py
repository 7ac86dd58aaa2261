"""What is shown of the robot: how long a stop may take, and how a run ended."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import pytest

from app.bridge.run import plan_moves
from app.bridge.states import JogProgress, LinkState, RobotSnapshot, RobotState, RunPhase, RunProgress
from app.emulator.profiles import ProfileName
from app.robot.run_summary import sent_waypoints
from app.robot.views import RunOrigin, robot_view, run_end, stop_seconds
from core.wire.robot_time import LONGEST_SCAN, OVERRUN, estimate_seconds, ramp_time
from tests.support.virtual_robot import VirtualRobot, make_plan

RUN = RunProgress("r", "Ada", RunPhase.STREAMING, 3, 3, 3, 9.0)
MOVING = RobotSnapshot(
    LinkState.READY, RobotState.MOVING, "", (0.0,) * 12, RUN, None, 0, "robot", None, LONGEST_SCAN, 1
)
ROWS_MM = [[2.0] * 12, [8.0] * 12, [9.2] * 12, [8.0] * 12]
"""Moves of 6, 1.2 and 1.2 mm."""


def test_the_stop_time_of_a_run_from_a_later_pose_holds_on_its_way_to_the_start_pose() -> None:
    plan = make_plan(ROWS_MM)
    plan = replace(plan, run_range=replace(plan.run_range, first=1))
    moves = plan_moves(plan, (0.5,) * 12)
    places = [(0.5,) * 12, *(move.target_mm for move in moves)]
    longest_mm = max(abs(b[0] - a[0]) for a, b in pairwise(places))
    stated = stop_seconds(sent_waypoints(plan.waypoints, plan.run_range), MOVING, plan.waypoints)
    assert longest_mm > 2.0
    assert stated >= LONGEST_SCAN + ramp_time((longest_mm + 1.0) / 1000.0)


@pytest.mark.heavy
@pytest.mark.parametrize("profile", [ProfileName.SLOW, ProfileName.PUBLISHED])
def test_motors_stand_within_the_stop_time_that_is_stated(profile: ProfileName) -> None:
    plan = make_plan([[float(h)] * 12 for h in (2.0, 5.7, 9.4, 5.7, 2.0, 5.7)])
    for number in range(60):
        robot = VirtualRobot(profile)
        robot.begin(plan)
        robot.wait(3.0 + number * 0.137)
        stated = stop_seconds(plan.waypoints, robot.snapshot)
        robot.stop("Grace")
        robot.wait(stated)
        stands = robot.strokes_mm
        robot.wait(1.0)
        assert robot.strokes_mm == pytest.approx(stands, abs=0.02)


def test_the_stop_time_of_a_reset_is_that_of_its_one_long_move() -> None:
    waypoints = make_plan(ROWS_MM[1:]).waypoints
    origin = RunOrigin("r", "walk", "Walk", waypoints, waypoints.durations)
    assert robot_view(MOVING, "robot", origin)["stop_seconds"] < 1.0
    reset = robot_view(replace(MOVING, run=None), "robot", origin)
    assert reset["stop_seconds"] == pytest.approx(LONGEST_SCAN + ramp_time(0.0195) + OVERRUN)


@pytest.mark.parametrize(
    ("shown", "reached", "state"),
    [
        (replace(MOVING, robot=RobotState.DONE), 3, "done"),
        (replace(MOVING, robot=RobotState.ARMED), 3, "done"),
        (replace(MOVING, robot=RobotState.DISARMED), 2, "stopped"),
        (replace(MOVING, robot=RobotState.FAULT), 2, "fault"),
        (replace(MOVING, robot=RobotState.FAULT, link=LinkState.LOST), 2, "lost"),
    ],
)
def test_how_a_run_ended_is_told_whatever_the_robot_was_made_to_do_since(
    shown: RobotSnapshot, reached: int, state: str
) -> None:
    assert run_end(shown, replace(RUN, reached=reached)) == state


def test_the_stop_time_of_a_jog_is_that_of_its_longest_move_and_it_is_not_paused() -> None:
    jogged = replace(MOVING, run=None, jog=JogProgress("foot 1", "Ada", 0, 2, 0.003))
    view = robot_view(jogged, "robot", None)
    assert view["stop_seconds"] == pytest.approx(LONGEST_SCAN + ramp_time(0.004) + OVERRUN)
    assert view["allowed"]["pause"] == "Only a run can be paused; Stop ends this."
    assert robot_view(MOVING, "robot", None)["allowed"]["pause"] is None
    paused = replace(MOVING, robot=RobotState.PAUSED)
    assert "A run is paused" in robot_view(paused, "robot", None)["allowed"]["jog"]


def test_the_time_left_falls_to_nothing_over_all_iterations() -> None:
    waypoints = make_plan(ROWS_MM[1:]).waypoints
    origin = RunOrigin("r", "walk", "Walk", waypoints, waypoints.durations)
    count = waypoints.count
    order = [(lap, index) for lap in (1, 2) for index in range(count)]
    left = []
    for reached, (_, index) in enumerate(order, start=1):
        # The next waypoint is on its way, of the last one there is none.
        lap, sent = order[min(reached, len(order) - 1)]
        run = replace(
            RUN, reached=reached, waypoint_reached=index, waypoint_sent=sent, iteration=lap, iterations=2
        )
        left.append(robot_view(replace(MOVING, run=run), "robot", origin)["run"]["seconds_left"])
    assert left[-1] == 0.0
    assert all(later < earlier for earlier, later in pairwise(left))
    assert left[0] == pytest.approx(estimate_seconds(waypoints) * 2 - origin.estimates[0], abs=0.02)
