"""Recorded motions whose heights are in another frame."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.errors import InputError
from core.gait.gait import motion_problem
from core.library.library import library
from core.motion.trajectory import Trajectory
from core.recorded.frame_offsets import frame_offsets, raised_motion
from core.robot.model import load_robot
from core.wire.trajectory_csv import format_trajectory_csv, parse_trajectory_csv
from solver_jobs import solve_live
from tests.support.reference import reference_path, reference_rows

MODEL = load_robot("deltawalker")
NAMES = (
    "direction1/walk_a",
    "direction1/adjs_d",
    "direction4/mtri_c",
    "rotation/rots_d",
    "rotation/rots_dance",
)
"""Files that reach the workspace's limits most and least, straight and turning."""


def read(name: str) -> Trajectory:
    path = reference_path(f"trajectories/{name}.csv")
    return parse_trajectory_csv(path.read_text("utf-8-sig"), path.name).trajectory


def simulated(name: str) -> Trajectory:
    """A published simulation, whose first row counts its samples."""
    text = "\n".join(",".join(map(repr, row)) for row in reference_rows(name)[-15:].tolist())
    return parse_trajectory_csv(text, name).trajectory


def shifted(trajectory: Trajectory, body_mm: float, feet_mm: float) -> Trajectory:
    """As a file with other heights and without companion is read."""
    feet = trajectory.feet_world + [0.0, 0.0, feet_mm / 1000]
    moved = replace(
        trajectory, body_world=trajectory.body_world + [0.0, 0.0, body_mm / 1000], feet_world=feet
    )
    return parse_trajectory_csv(format_trajectory_csv(moved), "shifted.csv").trajectory


def test_no_published_trajectory_is_reported() -> None:
    names = sorted(reference_path("trajectories").rglob("*.csv"))
    assert len(names) > 70
    reported = {
        path.name: frame_offsets(
            MODEL, parse_trajectory_csv(path.read_text("utf-8-sig"), path.name).trajectory
        )
        for path in names
    }
    assert [name for name, offsets in reported.items() if offsets is not None] == []


@pytest.mark.parametrize("folder", ["simulation_optimised/simulated", "simulation_manual/simulated"])
def test_every_published_simulation_has_the_body_s_actuator_plane(folder: str) -> None:
    for path in sorted(reference_path(folder).glob("*.csv")):
        trajectory = simulated(f"{folder}/{path.name}")
        offsets = frame_offsets(MODEL, trajectory)
        assert offsets is not None, path.name
        assert (offsets.body, offsets.feet) == (0.020, 0.0), path.name
        assert frame_offsets(MODEL, raised_motion(trajectory, offsets.body, offsets.feet)) is None


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize(
    ("body_mm", "feet_mm", "words"),
    [
        (
            -20,
            0,
            "The heights of the body are 20 mm too low; they are probably given for the actuator plane ",
        ),
        (20, 0, "The heights of the body are 20 mm too high; they are probably raised twice"),
        (18, 0, "The heights of the body are 18 mm too high; they are probably measured from the floor"),
        (-18, 0, "The heights of the body are 18 mm too low; they are probably reduced by the depth"),
        (0, -18, "The heights of the feet are 18 mm too low; they are probably reduced by the depth"),
        (0, 18, "The heights of the feet are 18 mm too high; they are probably measured from the floor"),
        (-18, -18, "All heights are 18 mm too low; they are probably reduced by the depth of the sole."),
        (18, 18, "All heights are 18 mm too high; they are probably measured from the floor"),
        (-38, -18, "The heights of the body are 38 mm too low; they are probably given for the actuator "),
        (-2, 18, "The heights of the feet are 18 mm too high"),
        (-20, -18, "The heights of the body are 20 mm too low"),
        (-20, 18, "The heights of the body are 20 mm too low"),
    ],
)
def test_shifted_heights_are_recognised_and_put_right(
    name: str, body_mm: float, feet_mm: float, words: str
) -> None:
    right = read(name)
    other = shifted(right, body_mm, feet_mm)
    offsets = frame_offsets(MODEL, other)
    assert offsets is not None
    assert (offsets.body, offsets.feet) == pytest.approx((-body_mm / 1000, -feet_mm / 1000))
    assert words in offsets.sentence
    own = raised_motion(other, offsets.body, offsets.feet)
    assert frame_offsets(MODEL, own) is None
    np.testing.assert_allclose(own.body_world, right.body_world, atol=1e-12)
    np.testing.assert_allclose(own.feet_world, right.feet_world, atol=1e-12)
    np.testing.assert_array_equal(own.contact, right.contact)


@pytest.mark.parametrize("robot", ["deltawalker9", "hexapod"])
@pytest.mark.parametrize(("body", "feet"), [(0.0, 0.0), (-1.0, 0.0), (0.0, -1.0)])
def test_other_robots_have_their_own_depth_of_the_sole(robot: str, body: float, feet: float) -> None:
    model = load_robot(robot)
    legs = model.leg_count
    x, y, _ = model.module_centres_robot.T
    standing = np.stack([x, y, np.zeros(legs)], axis=-1)
    motion = Trajectory(
        times=np.array([0.0, 0.4]),
        body_world=np.array([[0.0, 0.0, 0.0735 + body * model.com_height]] * 2),
        heading=np.zeros(2),
        feet_world=np.array([standing + [0.0, 0.0, feet * model.sole_depth]] * 2),
        contact=np.ones((2, legs), dtype=np.bool_),
    )
    offsets = frame_offsets(model, motion)
    if body == feet == 0.0:
        assert offsets is None
        return
    assert offsets is not None
    assert (offsets.body, offsets.feet) == (-body * model.com_height, -feet * model.sole_depth)
    assert raised_motion(motion, offsets.body, offsets.feet).contact.all()


def test_the_program_s_own_plans_are_not_reported() -> None:
    for gait_id in ("walk", "rotate"):
        problem = motion_problem(library()[gait_id].gait, MODEL)
        assert frame_offsets(MODEL, solve_live(problem).trajectory) is None


@pytest.mark.parametrize(("body_mm", "feet_mm"), [(-40, 0), (60, 0), (0, 9), (0, -26)])
def test_heights_that_no_frame_explains_are_left_alone(body_mm: float, feet_mm: float) -> None:
    assert frame_offsets(MODEL, shifted(read(NAMES[0]), body_mm, feet_mm)) is None


def test_a_motion_of_another_robot_is_refused() -> None:
    with pytest.raises(InputError, match="has 4 feet, the robot 6"):
        frame_offsets(load_robot("hexapod"), read(NAMES[0]))
