"""Waypoints become the motion that they came from: solved gaits, turns, and gaits made by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.errors import InputError
from core.gait.gait import motion_problem
from core.gait.manual_motion import manual_motion
from core.library.library import library
from core.motion.trajectory import Trajectory
from core.recorded.waypoint_motion import motion_of_waypoints
from core.robot.model import RobotModel, load_robot
from core.wire.waypoint_path import waypoints_from_trajectory
from core.wire.waypoints import Waypoints, format_waypoint_csv, read_waypoint_csv
from solver_jobs import solve_exact, solve_live

ROUNDING = 2e-6
"""What 4 decimals of a millimetre leave of a motion, m."""
MODEL = load_robot("deltawalker")


def written(model: RobotModel, trajectory: Trajectory) -> tuple[str, Waypoints]:
    """A waypoint file's text and what is read of it."""
    text = format_waypoint_csv(waypoints_from_trajectory(model, trajectory))
    return text, read_waypoint_csv(text).waypoints


def solved(gait_id: str) -> Trajectory:
    gait = library()[gait_id].gait
    return solve_live(motion_problem(gait, MODEL)).trajectory


def distance(first: Trajectory, second: Trajectory) -> float:
    feet = np.abs(first.feet_world - second.feet_world).max()
    return float(max(feet, np.abs(first.body_world - second.body_world).max()))


@pytest.mark.parametrize("gait_id", ["walk", "amble", "s-gait", "c-gait", "rotate"])
def test_the_motion_of_a_solved_gait_comes_back_and_goes_out_the_same(gait_id: str) -> None:
    trajectory = solved(gait_id)
    text, waypoints = written(MODEL, trajectory)
    motion = motion_of_waypoints(MODEL, waypoints)
    assert distance(motion.trajectory, trajectory) < ROUNDING
    assert np.abs(motion.trajectory.heading - trajectory.heading).max() < 1e-4
    assert (motion.trajectory.contact == trajectory.contact).all()
    assert motion.trajectory.times == pytest.approx(trajectory.times)
    assert written(MODEL, motion.trajectory)[0] == text


def test_the_exact_tiers_motion_comes_back_within_what_it_lets_feet_sink() -> None:
    trajectory = solve_exact(motion_problem(library()["walk"].gait, MODEL)).trajectory
    text, waypoints = written(MODEL, trajectory)
    motion = motion_of_waypoints(MODEL, waypoints)
    assert distance(motion.trajectory, trajectory) < 0.0005
    assert np.abs(motion.trajectory.feet_world[..., 2][motion.trajectory.contact]).max() <= 0.00025 + 1e-9
    assert written(MODEL, motion.trajectory)[0] == text


@pytest.mark.parametrize("gait_id", ["walk-manual-0", "amble-manual-1"])
def test_a_gait_made_by_hand_moves_as_its_segment_table_says(gait_id: str) -> None:
    trajectory = manual_motion(library()[gait_id].gait, MODEL).trajectory
    motion = motion_of_waypoints(MODEL, written(MODEL, trajectory)[1])
    assert distance(motion.trajectory, trajectory) < ROUNDING
    assert "as in gaits made by hand" in motion.assumptions[1]


def test_a_turn_is_said_and_so_is_a_kept_heading() -> None:
    turning, straight = (motion_of_waypoints(MODEL, written(MODEL, solved(g))[1]) for g in ("rotate", "walk"))
    assert "the body turns, by 15.0° in all" in turning.assumptions[1]
    assert "the body keeps its heading" in straight.assumptions[1]


@pytest.mark.parametrize("robot", ["hexapod", "dodecapod"])
def test_rings_of_other_sizes_stand_where_they_stand(robot: str) -> None:
    model = load_robot(robot)
    strokes = np.full((3, model.leg_count, 3), 0.005)
    strokes[1] = 0.007
    text = format_waypoint_csv(Waypoints(strokes, np.full(3, 0.5)))
    motion = motion_of_waypoints(model, read_waypoint_csv(text).waypoints)
    assert motion.trajectory.leg_count == model.leg_count
    assert motion.trajectory.body_world[:, 2] - motion.trajectory.body_world[0, 2] == pytest.approx(
        [0.0, 0.002, 0.0]
    )
    assert motion.trajectory.contact.all()


@pytest.mark.parametrize(
    ("durations", "interval", "words"),
    [
        ([9.0, 0.5, 0.5, 0.5], 0.5, None),
        ([0.4, 0.4, 0.8, 0.8], 0.8, "The durations are 0.4 to 0.8 s"),
        ([0.0, 0.0, 0.0, 0.0], 0.4, "The durations are 0 to 0 s"),
        ([0.0, 0.0, 0.2, 0.2], 0.2, "each waypoint takes 0.2 s here"),
    ],
)
def test_time_is_even_and_what_was_assumed_of_it_is_said(
    durations: list[float], interval: float, words: str | None
) -> None:
    motion = motion_of_waypoints(MODEL, Waypoints(np.full((4, 4, 3), 0.005), np.array(durations)))
    assert np.diff(motion.trajectory.times) == pytest.approx([interval] * 3)
    assert len(motion.assumptions) == (2 if words is None else 3)
    assert words is None or words in motion.assumptions[2]


@pytest.mark.parametrize("count", [1, 2001])
def test_one_waypoint_is_no_motion_and_neither_are_thousands(count: int) -> None:
    with pytest.raises(InputError, match=f"has 2 to 2000 waypoints; the file has {count}"):
        motion_of_waypoints(MODEL, Waypoints(np.full((count, 4, 3), 0.005), np.ones(count)))


@pytest.mark.parametrize("stroke", [1e297, -0.21])
def test_a_number_that_is_no_stroke_is_named(stroke: float) -> None:
    strokes = np.full((4, 4, 3), 0.005)
    strokes[1, 2, 0] = stroke
    with pytest.raises(InputError, match=r"Waypoint 2, motor 1 of foot 3: .* mm is no stroke; .* ±200 mm"):
        motion_of_waypoints(MODEL, Waypoints(strokes, np.ones(4)))


def test_strokes_at_which_no_leg_can_be_assembled_are_named() -> None:
    waypoints = written(MODEL, solved("walk"))[1]
    strokes = waypoints.strokes.copy()
    strokes[7, 2] = [0.0, 0.1, 0.2]
    with pytest.raises(InputError, match="Waypoint 8, foot 3: its three rods do not meet"):
        motion_of_waypoints(MODEL, replace(waypoints, strokes=strokes))


@pytest.mark.parametrize(
    ("text", "legs"),
    [("duration_s,h1,h2,h3\n1,2,3,4\n", 1), ("\ufeffduration_s,h1,h2,h3,h4,h5,h6\r\n1,2,3,4,5,6,7", 2)],
)
def test_the_header_says_the_number_of_feet(text: str, legs: int) -> None:
    assert read_waypoint_csv(text).waypoints.strokes.shape == (1, legs, 3)


@pytest.mark.parametrize("text", ["duration_s\n", "duration_s,h1,h2\n", "duration_s,h1,h3,h2\n", ""])
def test_another_header_is_refused(text: str) -> None:
    with pytest.raises(InputError, match="line 1: the header must read duration_s,h1,"):
        read_waypoint_csv(text, "way.csv")
