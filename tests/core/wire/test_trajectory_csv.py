"""Trajectory files: every layout of the lab reads, ours comes back to the last bit, bad ones are named."""

from __future__ import annotations

import json
import math
import re
from contextlib import suppress
from dataclasses import replace
from hashlib import sha256
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from core.errors import InputError
from core.gait.gait import motion_problem
from core.library.library import library
from core.motion.trajectory import Trajectory, difference_velocities
from core.robot.model import load_robot
from core.wire.trajectory_csv import (
    CsvLayout,
    bound_companion,
    format_companion,
    format_trajectory_csv,
    parse_trajectory_csv,
)
from solver_jobs import solve_live
from tests.support.reference import REFERENCE, reference_path

MODEL = load_robot("deltawalker")


@st.composite
def trajectories(draw: st.DrawFn, most_turn: float = 0.0, most: float = 1e3) -> Trajectory:
    n, legs = draw(st.integers(2, 8)), draw(st.sampled_from([4, 6, 12]))
    numbers = st.floats(-most, most, allow_nan=False)
    return Trajectory(
        times=np.cumsum(draw(arrays(np.float64, (n,), elements=st.floats(0.01, 5.0)))),
        body_world=draw(arrays(np.float64, (n, 3), elements=numbers)),
        heading=draw(arrays(np.float64, (n,), elements=st.floats(-most_turn, most_turn))),
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


@given(trajectories(most_turn=3.0, most=0.2))
def test_a_motion_that_turns_comes_back_by_its_companion(trajectory: Trajectory) -> None:
    text = format_trajectory_csv(trajectory)
    read = parse_trajectory_csv(text, "t.csv", format_companion(trajectory, text)).trajectory
    assert np.array_equal(read.heading, trajectory.heading)
    assert np.array_equal(read.contact, trajectory.contact)
    for name in ("times", "body_world", "feet_world", "body_velocity", "feet_velocity"):
        np.testing.assert_allclose(getattr(read, name), getattr(trajectory, name), atol=1e-11, err_msg=name)


def turning_motion(**asked: Any) -> Trajectory:
    """A solved gait of the library whose heading changes."""
    gait = replace(library()[asked.pop("gait_id")].gait, **asked)
    return solve_live(motion_problem(gait, MODEL)).trajectory


TURNING: list[dict[str, Any]] = [
    {"gait_id": "rotate"},
    {"gait_id": "rotate", "step": (0.0, 0.0, -0.2)},
    {"gait_id": "walk", "step": (0.005, 0.005, 0.1)},
]


@pytest.mark.parametrize("asked", TURNING)
def test_the_file_alone_gives_the_planned_strokes_at_heading_0(asked: dict[str, Any]) -> None:
    motion = turning_motion(**asked)
    text = format_trajectory_csv(motion)
    alone = parse_trajectory_csv(text, "turn.csv").trajectory
    assert not alone.heading.any()
    assert np.array_equal(alone.body_world, motion.body_world)
    np.testing.assert_allclose(alone.strokes(MODEL), motion.strokes(MODEL), atol=1e-12)
    assert alone.contact.any(axis=1).all()
    whole = parse_trajectory_csv(text, "turn.csv", format_companion(motion, text)).trajectory
    assert np.array_equal(whole.heading, motion.heading)
    np.testing.assert_allclose(whole.feet_world, motion.feet_world, atol=1e-12)
    np.testing.assert_allclose(whole.strokes(MODEL), motion.strokes(MODEL), atol=1e-12)


def test_a_rotation_ends_with_feet_that_move_back_as_in_the_lab_s_own_files() -> None:
    motion = turning_motion(gait_id="rotate")
    alone = parse_trajectory_csv(format_trajectory_csv(motion), "turn.csv").trajectory
    path = reference_path("trajectories/rotation/rots_a.csv")
    lab = parse_trajectory_csv(path.read_text(), path.name).trajectory
    for file in (alone, lab):
        np.testing.assert_allclose(file.feet_world[-1], file.feet_world[0], atol=1e-6)
        assert file.contact[-1].all()
    # Before the return every foot is 15 degrees farther, in both to the same side.
    turned = [file.feet_world[knot, 0, :2] for file, knot in ((alone, 39), (lab, 39))]
    angles = np.degrees([np.arctan2(y, x) for x, y in turned])
    np.testing.assert_allclose(angles, 15.0, atol=0.05)


def test_a_companion_without_axes_of_the_feet_has_them_in_the_world() -> None:
    motion = turning_motion(gait_id="rotate")
    still = replace(motion, heading=np.zeros(motion.knot_count))
    text = format_trajectory_csv(still)
    old = {**json.loads(format_companion(still, text)), "heading": motion.heading.tolist()}
    assert (old["version"], "feet_axes" in old) == (1, False)
    read = parse_trajectory_csv(text, "old.csv", json.dumps(old)).trajectory
    assert np.array_equal(read.feet_world, motion.feet_world)
    assert np.array_equal(read.heading, motion.heading)


def test_a_companion_is_bound_to_the_same_numbers_under_another_header() -> None:
    motion = turning_motion(gait_id="rotate")
    text = format_trajectory_csv(motion)
    other = text.replace("Column1,", "First,")
    companion = bound_companion(format_companion(motion, text), other)
    read = parse_trajectory_csv(other, "turn.csv", companion)
    assert read.assumptions == ()
    assert np.array_equal(read.trajectory.heading, motion.heading)


def test_unknown_axes_of_the_feet_are_refused() -> None:
    motion = turning_motion(gait_id="rotate")
    text = format_trajectory_csv(motion)
    companion = {**json.loads(format_companion(motion, text)), "feet_axes": "leg"}
    assert companion["version"] == 2
    with pytest.raises(InputError, match='feet_axes is "leg"'):
        parse_trajectory_csv(text, "turn.csv", json.dumps(companion))


@given(trajectories(), st.booleans())
def test_without_a_companion_the_number_of_rows_tells_how_many_feet_there_are(
    trajectory: Trajectory, has_velocities: bool
) -> None:
    text = format_trajectory_csv(trajectory, CsvLayout("Column1", has_velocities))
    read = parse_trajectory_csv(text, "t.csv")
    assert np.array_equal(read.trajectory.feet_world, trajectory.feet_world)
    assert format_trajectory_csv(read.trajectory, read.layout) == text


def published_names() -> list[str]:
    folder = REFERENCE / "trajectories"
    return sorted(str(p.relative_to(REFERENCE)) for p in folder.rglob("*.csv")) or ["trajectories/absent.csv"]


def numbers_of(text: str, first_line: int) -> list[list[str]]:
    """Every number of a file as the 16 hexadecimal digits of its double."""
    rows = text.replace("\r\n", "\n").rstrip("\n").split("\n")[first_line:]
    return [[np.float64(field).tobytes().hex() for field in row.rstrip(",").split(",")] for row in rows]


@pytest.mark.parametrize("name", published_names())
def test_a_published_file_that_is_read_and_written_is_the_same_to_the_last_bit(name: str) -> None:
    path = reference_path(name)
    text = path.read_text("utf-8-sig")
    read = parse_trajectory_csv(text, path.name)
    written = format_trajectory_csv(read.trajectory, read.layout)
    assert read.assumptions
    assert numbers_of(written, 1) == numbers_of(text, 1)
    assert written.split("\n")[0] == text.replace("\r\n", "\n").split("\n")[0]


@pytest.mark.parametrize(
    ("name", "first", "rows"),
    [
        ("trajectories/direction1/walk_a.csv", "Column1,Column2", 30),
        ("trajectories/direction3/walk_a.csv", "0.0000", 15),
        ("trajectories/rotation/rots_a.csv", "0.0000", 15),
        ("trajectories/rotation/rots_dance.csv", "zero,pos 15", 15),
    ],
)
def test_a_layout_is_known_and_written_again(name: str, first: str, rows: int) -> None:
    path = reference_path(name)
    read = parse_trajectory_csv(path.read_text(), path.name)
    written = format_trajectory_csv(read.trajectory, read.layout)
    assert written.startswith(first)
    assert len(written.rstrip("\n").split("\n")) == rows + 1
    assert read.layout.has_velocities == (rows == 30)


@given(trajectories(), st.sampled_from([None, "Column1,Column2", "zero,pos 15,zero"]), st.booleans())
def test_every_layout_reads_back_as_itself(trajectory: Trajectory, header: str | None, moving: bool) -> None:
    layout = CsvLayout(header, moving)
    text = format_trajectory_csv(trajectory, layout)
    first = 0 if header is None else 1
    if header is None and text.split("\n")[0] == ",".join(f"{k}.0" for k in range(trajectory.knot_count)):
        return  # a body that moves 0, 1, 2, … m cannot be told from the lab's counting header
    read = parse_trajectory_csv(text, "t.csv", format_companion(trajectory, text))
    assert read.layout == layout
    assert numbers_of(format_trajectory_csv(read.trajectory, read.layout), first) == numbers_of(text, first)


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
        ("\n".join([ROW] * 41), r"41 rows .* 6 feet have 21 \(positions\) or 42 .*; 12 feet have 39"),
        ("\n".join([*[ROW] * 14, "0.0,0.1"]), "line 15: 2 numbers"),
        ("\n".join([*[ROW] * 14, "0.0,nan,0.2"]), "t.csv:15, column 2: nan is not a finite"),
        ("\n".join([*[ROW] * 14, "0.0,x,0.2"]), "t.csv:15, column 2: “x” is not a number"),
        ("\n".join([*[ROW] * 14, "0.0,1_0,0.2"]), "t.csv:15, column 2: “1_0” is not a number"),
        (
            f"{ROW}\n" + ";".join(["0.1234"] * 9),
            "t.csv:2, column 1: “(0.1234;){5}0.123…” is not a number. Sep",
        ),
        ("\n".join([*[ROW] * 7, "", *[ROW] * 8]), "t.csv:8, column 1: “” is not a number"),
        ("Column1,Column2\n1,2\n1,1e400", "t.csv:3, column 2: 1e400 is not a finite"),
        ("Column1,Column2\n1,2\n-1e300,1", "t.csv:3, column 1: -1e300 is no position or speed of a gait"),
        ("\n".join(["duration_s,h1,h2", *[ROW] * 15]), "is a waypoint file"),
        ("\n".join(["0.5"] * 15), "one sample"),
    ],
)
def test_malformed_files_are_refused_by_line_and_column(text: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        parse_trajectory_csv(text, "t.csv")


@given(st.text(st.sampled_from("0123456789.,-+eE_ \n\rnaifC\u0661"), max_size=60))
def test_any_text_is_read_or_refused_with_a_sentence(text: str) -> None:
    with suppress(InputError):
        assert parse_trajectory_csv(text, "t.csv").trajectory.knot_count >= 2


@pytest.mark.parametrize(
    ("field", "value", "words"),
    [
        ("contact", 2, "does not fit it: “contact” has 2; it may have 0 and 1, or true and false. Write"),
        ("contact", 0.5, "does not fit it: “contact” has 0.5; it may have 0 and 1, or true and false. Write"),
        (
            "times",
            "0.4",
            "does not fit it: “times” must have numbers and has other values, such as",
        ),
        ("heading", [0], "does not fit it: the lists of “heading” differ in length. Write"),
        ("times", None, "does not fit it: “times” is missing. Write"),
        ("feet_axes", ["a"], 'does not fit it: feet_axes is ["a"]; it must be one of'),
        ("legs", True, "says true legs"),
    ],
)
def test_a_value_of_a_companion_that_does_not_fit_is_named(field: str, value: object, words: str) -> None:
    motion = turning_motion(gait_id="rotate")
    text = format_trajectory_csv(motion)
    content = json.loads(format_companion(motion, text))
    if value is None:
        del content[field]
    elif field in ("legs", "feet_axes"):
        content[field] = value
    elif field == "contact":
        content[field][0][0] = value
    else:
        content[field][0] = value
    with pytest.raises(InputError, match=re.escape(words)):
        parse_trajectory_csv(text, "t.csv", json.dumps(content))


@pytest.mark.parametrize("content", ["[]", "3", '"a"', "null"])
def test_a_companion_that_is_no_object_is_said_to_be_none(content: str) -> None:
    read = parse_trajectory_csv(format_trajectory_csv(turning_motion(gait_id="rotate")), "t.csv", content)
    assert read.assumptions[0].startswith("The companion of t.csv is no JSON object (“{…}”); assumed: ")


@given(
    st.recursive(
        st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
        lambda inner: (
            st.lists(inner, max_size=4)
            | st.dictionaries(st.sampled_from(["legs", "times", "heading", "contact"]), inner, max_size=4)
        ),
        max_leaves=8,
    )
)
def test_any_companion_is_believed_refused_or_set_aside(content: object) -> None:
    text = "\n".join([ROW] * 15) + "\n"
    bound = {"format": "footfall-trajectory", "version": 1, "csv_sha256": sha256(text.encode()).hexdigest()}
    if isinstance(content, dict):
        content = {**content, **bound}
    with suppress(InputError):
        read = parse_trajectory_csv(text, "t.csv", json.dumps(content))
        assert read.has_companion or read.assumptions


def test_velocities_by_differences_are_exact_for_even_motion() -> None:
    times = np.array([0.0, 0.4, 1.0])
    positions = times[:, None] * np.array([[1.0, -2.0, 0.5]])
    assert difference_velocities(times, positions) == pytest.approx(np.tile([1.0, -2.0, 0.5], (3, 1)))


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("legs", "four"),
        ("legs", 1e400),
        ("times", [0.0]),
        ("times", ["0.0", "0.2", "0.4"]),
        ("times", ["0.0", "0.2", "1_0"]),
        ("times", [0.0, 0.2, math.nan]),
        ("contact", [[1], [1, 0]]),
        ("contact", [["0"] * 4] * 3),
        ("heading", "north"),
        ("heading", ["1", "1", "1"]),
    ],
)
def test_a_companion_that_does_not_fit_is_refused(field: str, value: object) -> None:
    times = np.array([0.0, 0.2, 0.4])
    feet = np.zeros((3, 4, 3))
    trajectory = Trajectory(times, np.zeros((3, 3)), np.ones(3), feet, np.ones((3, 4), dtype=np.bool_))
    text = format_trajectory_csv(trajectory)
    companion = {**json.loads(format_companion(trajectory, text)), field: value}
    with pytest.raises(InputError):
        parse_trajectory_csv(text, "t.csv", json.dumps(companion))
