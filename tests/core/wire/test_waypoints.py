"""Waypoints: files, hashes, and how long the robot takes."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from app.emulator.firmware import Firmware
from app.emulator.profiles import PROFILES, ProfileName
from core.arrays import Floats
from core.errors import InputError
from core.gait.manual_motion import manual_motion
from core.library.library import library
from core.robot.model import load_robot
from core.wire.messages import encode_waypoint
from core.wire.robot_time import estimate_seconds
from core.wire.waypoint_path import waypoints_from_trajectory
from core.wire.waypoints import Waypoints, format_waypoint_csv, parse_waypoint_csv

strokes = st.integers(1, 12).flatmap(
    lambda n: arrays(np.float64, (n, 4, 3), elements=st.floats(0.0005, 0.0195))
)


def waypoints_of(values: Floats) -> Waypoints:
    return Waypoints(values, np.full(len(values), 0.4))


@given(strokes)
def test_a_waypoint_file_comes_back_with_the_same_hash(values: Floats) -> None:
    waypoints = waypoints_of(values)
    read = parse_waypoint_csv(format_waypoint_csv(waypoints))
    assert read.content_hash == waypoints.content_hash
    assert np.abs(read.strokes - waypoints.strokes).max() <= 0.5e-7 + 1e-12


def test_a_change_that_is_sent_changes_the_hash() -> None:
    values = np.full((2, 4, 3), 0.01)
    changed = values.copy()
    changed[1, 2, 0] += 1e-7
    assert waypoints_of(values).content_hash != waypoints_of(changed).content_hash


def test_the_estimate_is_near_what_the_emulated_board_takes() -> None:
    motion = manual_motion(library()["walk-manual-0"].gait, load_robot("deltawalker")).trajectory
    waypoints = waypoints_from_trajectory(load_robot("deltawalker"), motion)
    board = Firmware(PROFILES[ProfileName.PUBLISHED], tuple(waypoints.strokes_mm[0]))
    program = board.run()
    while not board.completions:
        next(program)
    start = board.now
    for index, (strokes, duration) in enumerate(zip(waypoints.strokes, waypoints.durations, strict=True), 2):
        board.board.inbox += encode_waypoint(strokes, float(duration))
        while len(board.completions) < index:
            next(program)
            board.board.take_sent()
    assert estimate_seconds(waypoints) == pytest.approx(board.now - start, rel=0.1)


HEADER = "duration_s," + ",".join(f"h{i}" for i in range(1, 13))
GOOD = "0.4," + ",".join(["5.0000"] * 12)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "line 1: the header must read"),
        (HEADER, "no waypoint"),
        (f"{HEADER}\n{GOOD}\n{GOOD},5.0", "way.csv, line 3: 14 numbers; a row has 13"),
        (f"{HEADER}\n{GOOD.replace('0.4', 'soon')}", "way.csv:2, column 1: “soon” is not a number"),
        (f"{HEADER}\n{GOOD.replace('5.0000', 'nan', 1)}", "way.csv:2, column 2: nan is not a finite"),
        (f"{HEADER}\n{GOOD.replace('0.4', '-1')}", "duration is negative"),
    ],
)
def test_malformed_waypoint_files_are_refused_by_line_and_column(text: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        parse_waypoint_csv(text, name="way.csv")


@pytest.mark.parametrize("stroke", [1e308, -1e308, 0.21, 10.0])
def test_a_number_that_is_no_stroke_is_no_waypoint(stroke: float) -> None:
    strokes = np.full((2, 4, 3), 0.01)
    strokes[1, 2, 0] = stroke
    with pytest.raises(InputError, match=r"Waypoint 2, motor 1 of foot 3: .* is no stroke"):
        Waypoints(strokes, np.ones(2))


def test_more_waypoints_than_a_run_has_are_refused() -> None:
    with pytest.raises(InputError, match="20001 waypoints; at most 20000"):
        Waypoints(np.zeros((20_001, 4, 3)), np.ones(20_001))
