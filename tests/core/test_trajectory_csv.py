"""Trajectory files: every layout of the lab reads, ours comes back to the last bit, bad ones are named."""

from __future__ import annotations

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from core.errors import InputError
from core.trajectory import Trajectory, difference_velocities
from core.trajectory_csv import format_companion, format_trajectory_csv, parse_trajectory_csv
from tests.reference import REFERENCE, reference_path

numbers = st.floats(-1e3, 1e3, allow_nan=False)


@st.composite
def trajectories(draw: st.DrawFn) -> Trajectory:
    n, legs = draw(st.integers(2, 8)), draw(st.sampled_from([4, 6, 12]))
    return Trajectory(
        times=np.cumsum(draw(arrays(np.float64, (n,), elements=st.floats(0.01, 5.0)))),
        body_world=draw(arrays(np.float64, (n, 3), elements=numbers)),
        heading=draw(arrays(np.float64, (n,), elements=st.floats(-3, 3))),
        feet_world=draw(arrays(np.float64, (n, legs, 3), elements=numbers)),
        contact=draw(arrays(np.bool_, (n, legs))),
        body_velocity=draw(arrays(np.float64, (n, 3), elements=numbers)),
        feet_velocity=draw(arrays(np.float64, (n, legs, 3), elements=numbers)),
    )


@given(trajectories())
def test_a_trajectory_with_its_companion_comes_back_to_the_last_bit(trajectory: Trajectory) -> None:
    text = format_trajectory_csv(trajectory)
    read = parse_trajectory_csv(text, "t.csv", format_companion(trajectory, text))
    assert read.assumptions == ()
    for name in vars(trajectory):
        before, after = getattr(trajectory, name), getattr(read.trajectory, name)
        assert (before is None and after is None) or np.array_equal(before, after), name


def published_names() -> list[str]:
    folder = REFERENCE / "trajectories"
    return sorted(str(p.relative_to(REFERENCE)) for p in folder.rglob("*.csv")) or ["trajectories/absent.csv"]


@pytest.mark.parametrize("name", published_names())
def test_every_published_trajectory_reads_and_is_written_the_same(name: str) -> None:
    path = reference_path(name)
    first = parse_trajectory_csv(path.read_text(), path.name)
    again = parse_trajectory_csv(format_trajectory_csv(first.trajectory), path.name)
    assert first.assumptions
    assert np.array_equal(first.trajectory.feet_world, again.trajectory.feet_world)
    assert np.array_equal(first.trajectory.body_world, again.trajectory.body_world)


def test_without_a_companion_contact_is_found_where_feet_rest_on_the_ground() -> None:
    path = reference_path("trajectories/direction1/walk_b.csv")
    contact = parse_trajectory_csv(path.read_text(), path.name).trajectory.contact
    assert (~contact).sum(axis=0).tolist() == [5, 5, 5, 5]
    assert contact.sum(axis=1).min() == 3


def test_a_companion_of_another_version_is_said_and_not_believed() -> None:
    times = np.array([0.0, 0.2, 0.4])
    positions = np.zeros((3, 4, 3))
    trajectory = Trajectory(times, np.zeros((3, 3)), np.ones(3), positions, np.ones((3, 4), dtype=np.bool_))
    companion = format_companion(trajectory, "another text")
    read = parse_trajectory_csv(format_trajectory_csv(trajectory), "t.csv", companion)
    assert "another version" in read.assumptions[0]
    assert read.trajectory.heading.tolist() == [0.0, 0.0, 0.0]


ROW = "0.0,0.1,0.2"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "holds no numbers"),
        ("\n".join([ROW] * 14), "14 rows of numbers"),
        ("\n".join([*[ROW] * 14, "0.0,0.1"]), "line 15: 2 numbers"),
        ("\n".join([*[ROW] * 14, "0.0,nan,0.2"]), "t.csv:15, column 2: nan is not a finite"),
        ("\n".join([*[ROW] * 14, "0.0,x,0.2"]), "t.csv:15, column 2: “x” is not a number"),
        ("\n".join(["0.5"] * 15), "one knot"),
    ],
)
def test_malformed_files_are_refused_by_line_and_column(text: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        parse_trajectory_csv(text, "t.csv")


def test_velocities_by_differences_are_exact_for_even_motion() -> None:
    times = np.array([0.0, 0.4, 1.0])
    positions = times[:, None] * np.array([[1.0, -2.0, 0.5]])
    assert difference_velocities(times, positions) == pytest.approx(np.tile([1.0, -2.0, 0.5], (3, 1)))


@pytest.mark.parametrize(
    ("field", "value"),
    [("legs", "four"), ("legs", 1e400), ("times", [0.0]), ("contact", [[1], [1, 0]]), ("heading", "north")],
)
def test_a_companion_that_does_not_fit_is_refused(field: str, value: object) -> None:
    times = np.array([0.0, 0.2, 0.4])
    feet = np.zeros((3, 4, 3))
    trajectory = Trajectory(times, np.zeros((3, 3)), np.ones(3), feet, np.ones((3, 4), dtype=np.bool_))
    text = format_trajectory_csv(trajectory)
    companion = {**json.loads(format_companion(trajectory, text)), field: value}
    with pytest.raises(InputError):
        parse_trajectory_csv(text, "t.csv", json.dumps(companion))
