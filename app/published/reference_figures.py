"""Figures of the published data beside a row: runs and tracks by our definitions, motions in our physics."""

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from app.common.json import Json
from app.published.columns import Who, has_data
from app.published.figures import (
    PACE,
    STANDING,
    TRACKING,
    Tools,
    fall_sentence,
    figures_content,
    joined,
    physics_of,
    tracking_figures,
    walk_ways,
    ways_content,
)
from app.published.problems import published_problem, walker
from app.published.reference import MANUAL_FEET, PublishedRun, Reference, is_missing, read_published
from app.published.walk_figures import movement_figures, track_of_motion
from app.published.walked import walked_motion
from core.errors import InputError
from core.library.library import library
from core.published.tables import Kind, PublishedRow, PublishedTable
from core.trials.iterations import find_iterations
from core.vision.track import FootTrack
from core.vision.track_csv import FRAME_RATE, read_track_csv
from core.wire.robot_time import estimate_seconds

NOUNS = {Who.RUN: "run", Who.TRACK: "foot track", Who.RECORDED: "motion"}
"""Of a column of the published data, what is in its files."""


def reference_files(
    table: PublishedTable, row: PublishedRow, reference: Reference
) -> dict[Who, tuple[Path, ...]]:
    """The published files of each column of a row, whether they are there or not; tracks that are there."""
    gait = row.gait
    files: dict[Who, tuple[Path, ...]] = {}
    if has_data(table, Who.RUN):
        files[Who.RUN] = reference.run_paths(gait.family, gait.step, gait.version)
    if has_data(table, Who.TRACK):
        files[Who.TRACK] = reference.track_paths(gait.family, gait.step)
    if has_data(table, Who.RECORDED):
        files[Who.RECORDED] = (reference.trajectory_path(gait.family, gait.step, gait.motion_iterations),)
    return files


def recorded_path(table: PublishedTable, row: PublishedRow, reference: Reference) -> Path | None:
    """The file of a row's published motion; None where there is none."""
    paths = reference_files(table, row, reference).get(Who.RECORDED, ())
    return next((path for path in paths if not is_missing(path)), None)


def reference_figures(
    table: PublishedTable, row: PublishedRow, who: Who, reference: Reference, tools: Tools
) -> Json:
    """Reads or simulates what was published of a row, and gives the content that is kept.

    Args:
        table: of the row.
        row: which one.
        who: the column.
        reference: the published data.
        tools: what solves and simulates.

    Raises:
        InputError: a file cannot be read, or is no such table.
        UnreachableError: a foot of the published motion cannot go where it is wanted.
    """
    files = reference_files(table, row, reference)[who]
    missing = [str(path.relative_to(reference.folder)) for path in files if is_missing(path)]
    if missing or not files:
        which = f" ({', '.join(missing)})" if missing else ""
        return figures_content({}, f"Its published {NOUNS[who]} is not in this folder{which}.")
    if who is Who.RUN:
        return _run(table, row, reference)
    return _tracks(row, files) if who is Who.TRACK else _recorded(table, row, reference, tools)


def _wanted(row: PublishedRow) -> float:
    return row.gait.step * row.gait.iterations


def _run(table: PublishedTable, row: PublishedRow, reference: Reference) -> Json:
    """The published simulation by the table's definition, and its ways."""
    run = reference.run(row.gait.family, row.gait.step, row.gait.version, walker())
    is_standing = table.kind is Kind.STANDING
    feet = run.feet_error[:MANUAL_FEET] if is_standing else run.feet_error
    figures: dict[str, float | None] = {
        "feet_mm": float(feet.mean()) * 1000,
        "body_mm": run.body_error * 1000,
        "lean_deg": float(np.degrees(run.tilts.max())),
        "goes_mm": _goes(run),
    }
    ways = ways_content(run.wanted_body, run.wanted_feet, run.body, run.feet)
    return figures_content({STANDING if is_standing else TRACKING: figures}, "", ways)


def _goes(run: PublishedRun) -> float:
    return float(math.hypot(*(run.body[-1, :2] - run.body[0, :2]))) * 1000


def _tracks(row: PublishedRow, paths: Sequence[Path]) -> Json:
    tracks = [_track(path, row.gait.iterations) for path in paths]
    return figures_content(movement_figures(tracks, _wanted(row), row.gait.iterations))


def _track(path: Path, iterations: int) -> FootTrack:
    text, legs = read_published(path), walker().leg_count
    try:
        track = read_track_csv(text, str(path), frame_rate=FRAME_RATE).track
        find_iterations(track, iterations)
    except InputError as error:
        named = "" if str(path) in error.sentence else f"{path}: "
        raise InputError(f"{named}{error.sentence}", str(path)) from error
    if track.foot_count != legs:
        raise InputError(
            f"{path} has {track.foot_count} feet; {legs} are expected. Take the file from the published "
            "data.",
            str(path),
        )
    return track


def _recorded(table: PublishedTable, row: PublishedRow, reference: Reference, tools: Tools) -> Json:
    """The published motion in our physics, its ways, and a remark on what was cut off its strokes."""
    gait, own = row.gait, row.gait.motion_iterations
    problem, cut = published_problem(reference, gait.family, gait.step, physics_of(table.kind), own)
    sentence = ""
    if cut > 0.0:
        sentence = (
            "Strokes of the published motion are kept within the motors' range, by up to "
            f"{cut * 1000:.1f} mm."
        )
    if table.kind is Kind.PACE:
        seconds = estimate_seconds(problem.waypoints)
        return figures_content(
            {PACE: {"seconds": seconds, "speed_mm_s": gait.step * 1000 / seconds}}, sentence
        )
    motion = tools.simulate(problem)
    walk = walked_motion(problem, motion)
    sentence = joined(sentence, fall_sentence("The published motion", walk))
    if table.kind is Kind.TRACKING:
        return figures_content(tracking_figures(walk), sentence, walk_ways(walk))
    track = track_of_motion(motion, library()[gait.family].gait.orientation, gait.iterations // own)
    return figures_content(movement_figures([track], _wanted(row), gait.iterations), sentence)
