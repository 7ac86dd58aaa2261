"""Trajectory CSV in and out, in the layouts of the lab's own files.

30 rows × N knots: body xyz (z of the centre of mass), feet 1 to 4 xyz, then their velocities, SI, under a
header `Column1,…,ColumnN`. Older files have a first line 0, 1, 2, … or words, and no velocities. What the
layout cannot say travels in a companion JSON bound by the CSV's hash.

The lab's scripts have no heading: their feet are those of a body that keeps it. So where the body turns, the
feet are turned back about its place by its heading, and inverse kinematics of the CSV alone, at heading 0,
gives the strokes of the motion: the return of a rotation in place is feet that move back. Places of the body
are the world's. The companion has the heading and says so (`feet_axes`: `body`), by which the feet are turned
to where they are in the world. A companion without it belongs to a file whose feet are the world's.
"""

import hashlib
import json
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from core.arrays import FARTHEST, Bools, Floats, frozen_floats
from core.errors import InputError
from core.motion.trajectory import Trajectory, difference_velocities, turned_about_body
from core.text.decoding import without_mark
from core.text.documents import NotJsonError, as_written, json_content, json_numbers, json_truths
from core.text.numbers import plain_number
from core.text.tables import Table, read_table
from core.wire.waypoints import is_waypoint_text

COMPANION_FORMAT = "footfall-trajectory"
WORLD_AXES, BODY_AXES = "world", "body"
"""Axes of the feet's places as seen from the body: the world's, or those that turn with its heading."""
VERSIONS = {WORLD_AXES: 1, BODY_AXES: 2}
"""Version of the companion by its feet's axes; programs that know only version 1 then assume heading 0."""
DEFAULT_INTERVAL = 0.4
"""Time between knots where no companion says otherwise, s."""
RINGS = (4, 6, 12)
"""Numbers of feet that a file may have without a companion; how many rows it has tells which."""
STANDING_HEIGHT = 0.00025 + 1e-6
"""A foot at rest below this height stands, where no companion says: 0.25 mm and the checks' tolerance, m."""


@dataclass(frozen=True)
class CsvLayout:
    """How a trajectory CSV is laid out.

    Args:
        header: the first line as it stands; None where numbers begin at once.
        has_velocities: whether rows of velocities follow the positions.
    """

    header: str | None
    has_velocities: bool


@dataclass(frozen=True, eq=False)
class TrajectoryFile:
    """A trajectory as read, and what had to be assumed.

    Args:
        trajectory: the motion.
        assumptions: sentences; empty where the companion said everything.
        layout: of the file; written in it again, every number is the same to the last bit.
        has_companion: whether times, heading and contact were stated, not assumed.
        robot: name of the robot that the motion was made for; None where no companion names it.
        is_usual: whether the file has commas between its numbers and decimal points, as the lab's have.
    """

    trajectory: Trajectory
    assumptions: tuple[str, ...]
    layout: CsvLayout
    has_companion: bool
    robot: str | None = None
    is_usual: bool = True


def standard_layout(knots: int) -> CsvLayout:
    """`Column1,…,ColumnN` over positions and velocities, as in the lab's files of direction 1."""
    return CsvLayout(",".join(f"Column{k + 1}" for k in range(knots)), has_velocities=True)


def format_trajectory_csv(trajectory: Trajectory, layout: CsvLayout | None = None) -> str:
    """Writes header and rows; numbers so that they read back to the last bit, where the body does not turn.

    Args:
        trajectory: the motion in the world; feet are written in the axes of the body.
        layout: of the file; the standard one where None.
    """
    layout = layout or standard_layout(trajectory.knot_count)
    unturned = turned_about_body(trajectory, -trajectory.heading)
    columns = _positions(unturned)
    if layout.has_velocities:
        columns = np.concatenate([columns, _velocities(unturned)], axis=1)
    lines = [] if layout.header is None else [layout.header]
    lines += [",".join(repr(float(v)) for v in row) for row in columns.T]
    return "\n".join(lines) + "\n"


def _positions(trajectory: Trajectory) -> Floats:
    flat = trajectory.feet_world.reshape(trajectory.knot_count, -1)
    return np.concatenate([trajectory.body_world, flat], axis=1)


def _velocities(trajectory: Trajectory) -> Floats:
    body_velocity = trajectory.body_velocity
    feet_velocity = trajectory.feet_velocity
    if body_velocity is None:
        body_velocity = difference_velocities(trajectory.times, trajectory.body_world)
    if feet_velocity is None:
        feet_velocity = difference_velocities(trajectory.times, trajectory.feet_world)
    return np.concatenate([body_velocity, feet_velocity.reshape(trajectory.knot_count, -1)], axis=1)


def format_companion(trajectory: Trajectory, csv_text: str, robot: str | None = None) -> str:
    """JSON with what the CSV cannot say, bound to it by hash.

    Args:
        trajectory: as it stands in the CSV.
        csv_text: the CSV's text.
        robot: name of the robot that the motion was made for; None where it is not known.
    """
    axes = BODY_AXES if trajectory.heading.any() else WORLD_AXES
    content: dict[str, Any] = {
        "format": COMPANION_FORMAT,
        "version": VERSIONS[axes],
        "csv_sha256": _digest(csv_text),
        "legs": trajectory.leg_count,
        **({} if axes == WORLD_AXES else {"feet_axes": axes}),
        **({} if robot is None else {"robot": robot}),
        "times": trajectory.times.tolist(),
        "heading": trajectory.heading.tolist(),
        "contact": trajectory.contact.astype(int).tolist(),
    }
    return json.dumps(content) + "\n"


def bound_companion(companion: str, csv_text: str) -> str:
    """A companion of a CSV for the same numbers in another text.

    Args:
        companion: text of the companion.
        csv_text: the CSV's new text.
    """
    return json.dumps({**json.loads(companion), "csv_sha256": _digest(csv_text)}) + "\n"


def _digest(text: str) -> str:
    """SHA-256 of the text with line ends of any system, which copying a file may change."""
    return hashlib.sha256(text.replace("\r\n", "\n").encode()).hexdigest()


def parse_trajectory_csv(text: str, name: str, companion_text: str | None = None) -> TrajectoryFile:
    """Reads a trajectory file in any of the lab's layouts.

    Args:
        text: the CSV's text.
        name: the file's name, for messages.
        companion_text: text of the companion JSON, where there is one.

    Raises:
        InputError: naming line and column of what is wrong.
    """
    if is_waypoint_text(text):
        raise InputError(
            f"{name} is a waypoint file (line 1 begins with duration_s); a trajectory is wanted here.",
            f"{name}:1",
        )
    text = without_mark(text)
    cells, header, table = _parse_table(text, name)
    companion, assumptions = _companion(companion_text, text, name)
    rows = table.shape[0]
    legs = _leg_count(companion, rows, name)
    size = 3 + 3 * legs
    if rows not in (size, 2 * size):
        possible = RINGS if companion is None else (legs,)
        found = f"{rows} rows of numbers from line {cells.lines[0 if header is None else 1]} on"
        raise InputError(f"{name}: {found}; {_wanted(possible)}.{_other_file(table)}", name)
    if table.shape[1] < 2:
        raise InputError(f"{name}: one sample; a trajectory needs at least two columns.", name)
    try:
        layout = CsvLayout(header, has_velocities=rows == 2 * size)
        read = _assemble(table, legs, companion, [*cells.notes, *assumptions], layout)
        return replace(read, is_usual=not cells.notes)
    except (ValueError, OverflowError) as error:
        raise InputError(
            f"The companion of {name} does not fit it: {error}. Write the file anew.", name
        ) from error


def _wanted(possible: tuple[int, ...]) -> str:
    """How many rows a file of so many feet has, in words."""
    return "; ".join(
        f"{legs} feet have {3 + 3 * legs} (positions) or {6 + 6 * legs} (positions and velocities)"
        for legs in possible
    )


def _other_file(table: Floats) -> str:
    """Which other file a table may be that is no trajectory; empty where it is like none."""
    motors = table.shape[1] - 1
    if motors in [3 * legs for legs in RINGS]:
        return (
            f" If these are waypoints of {motors} motors, the first line must read duration_s,h1,…,h{motors}."
        )
    return ""


def _leg_count(companion: dict[str, Any] | None, rows: int, name: str) -> int:
    """The companion's number of feet; without one that of the rows, and 4 where they fit no ring."""
    if companion is None:
        return next((legs for legs in RINGS if rows in (3 + 3 * legs, 6 + 6 * legs)), RINGS[0])
    legs = companion.get("legs")
    if isinstance(legs, bool) or not isinstance(legs, int) or not 1 <= legs <= 100:
        raise InputError(
            f"The companion of {name} says {as_written(legs)} legs; it must be a whole number.", name
        )
    return legs


def _assemble(
    table: Floats,
    legs: int,
    companion: dict[str, Any] | None,
    assumptions: list[str],
    layout: CsvLayout,
) -> TrajectoryFile:
    n, size = table.shape[1], 3 + 3 * legs
    columns = table.T
    body, feet = columns[:, :3], columns[:, 3:size].reshape(n, legs, 3)
    times = json_numbers(companion or {"times": np.arange(n) * DEFAULT_INTERVAL}, "times")
    if layout.has_velocities:
        body_velocity = columns[:, size : size + 3]
        feet_velocity = columns[:, size + 3 :].reshape(n, legs, 3)
    else:
        body_velocity = difference_velocities(times, body)
        feet_velocity = difference_velocities(times, feet)
        assumptions.append("Velocities are missing; they are differences of the positions.")
    contact = json_truths(companion, "contact") if companion else standing_feet(feet)
    trajectory = Trajectory(times, body, np.zeros(n), feet, contact, body_velocity, feet_velocity)
    if companion:
        trajectory = _headed(trajectory, companion)
    robot = None if companion is None or companion.get("robot") is None else str(companion["robot"])
    return TrajectoryFile(trajectory, tuple(assumptions), layout, companion is not None, robot)


def _headed(trajectory: Trajectory, companion: dict[str, Any]) -> Trajectory:
    """The motion in the world, with the heading that the companion states."""
    heading = json_numbers(companion, "heading")
    axes = companion.get("feet_axes", WORLD_AXES)
    if not isinstance(axes, str) or axes not in VERSIONS:
        raise ValueError(f"feet_axes is {as_written(axes)}; it must be one of {', '.join(VERSIONS)}")
    if axes == WORLD_AXES:
        return replace(trajectory, heading=heading)
    turns = frozen_floats(heading, (trajectory.knot_count,), "heading", FARTHEST)
    return turned_about_body(trajectory, turns)


def standing_feet(feet: Floats) -> Bools:
    """Contact from positions: a foot stands where it lies low and keeps still towards a neighbouring knot.

    Both are judged by `STANDING_HEIGHT`. Where no foot would stand though all lie low, all stand: the body
    turns on them, and its file has no heading.

    Args:
        feet: (n, legs, 3) platform centres in the world, m.

    Returns:
        (n, legs).
    """
    low = np.abs(feet[..., 2]) <= STANDING_HEIGHT
    still = np.linalg.norm(np.diff(feet, axis=0), axis=-1) <= STANDING_HEIGHT
    padded = np.concatenate([still[:1] & False, still, still[:1] & False])
    stands = low & (padded[1:] | padded[:-1])
    turns = low.all(axis=1) & ~stands.any(axis=1)
    return np.asarray(stands | turns[:, None])


def _companion(text: str | None, csv_text: str, name: str) -> tuple[dict[str, Any] | None, list[str]]:
    assumed = (
        f"{DEFAULT_INTERVAL} s between samples, heading 0, and a foot stands where it rests within "
        f"{STANDING_HEIGHT * 1000:.2f} mm of z = 0."
    )
    if text is None:
        return None, [f"{name} has no companion file; assumed: {assumed}"]
    try:
        content = json_content(text, f"The companion of {name}")
        if not isinstance(content, dict):
            return None, [f"The companion of {name} is no JSON object (“{{…}}”); assumed: {assumed}"]
        if content.get("format") != COMPANION_FORMAT or content.get("version") not in VERSIONS.values():
            return None, [f"The companion of {name} is of an unknown format; assumed: {assumed}"]
    except NotJsonError:
        return None, [f"The companion of {name} is not JSON; assumed: {assumed}"]
    if content.get("csv_sha256") != _digest(csv_text):
        return None, [f"The companion of {name} belongs to another version of it; assumed: {assumed}"]
    return content, []


def _parse_table(text: str, name: str) -> tuple[Table, str | None, Floats]:
    """The cells, the first line where it is a header, and (rows, knots) numbers."""
    cells = read_table(text, name)
    first = 1 if _is_header(cells.head) else 0
    if len(cells.rows) - first >= 3 + 3 * RINGS[0]:
        # No motion's first sample has x, y and z of body and feet count on.
        cells = cells.without_count(first)
        first = 1 if _is_header(cells.head) else 0
    if len(cells.rows) <= first:
        raise InputError(f"{name} holds no numbers; a trajectory file has 15 or 30 rows of them.", name)
    table = cells.numbers(first)
    for row, column in np.argwhere(np.abs(table) > FARTHEST)[:1].tolist():
        number = cells.rows[first + row][column].strip()
        fault = f"{number} is no position or speed of a gait; it must lie within ±{FARTHEST:g} m or m/s"
        raise cells.refusal(first + row, column, fault)
    line = ",".join(cells.head) if cells.notes else text.replace("\r\n", "\n").partition("\n")[0]
    return cells, line if first else None, table


def _is_header(cells: list[str]) -> bool:
    """Whether a row is words (`Column1,…`) or counts 0, 1, 2, … as the lab's files do."""
    numbers = []
    for cell in cells:
        with suppress(ValueError):
            numbers.append(plain_number(cell))
    return not numbers or (len(numbers) > 1 and numbers == list(range(len(cells))))
