"""Figures of the published data beside a row: runs and tracks by our definitions, motions in our physics."""

import math
from pathlib import Path

import numpy as np

from app.common.json import Json
from app.export.trajectory_files import read_text
from app.published.columns import Who, has_data
from app.published.figures import (
    PACE,
    STANDING,
    TRACKING,
    Tools,
    fall_sentence,
    figures_content,
    physics_of,
    tracking_figures,
    walk_ways,
    ways_content,
)
from app.published.problems import published_problem, walker
from app.published.reference import MANUAL_FEET, PublishedRun, Reference
from app.published.walk_figures import movement_figures, track_of_motion
from app.published.walked import walked_motion
from core.library.library import library
from core.published.tables import Kind, PublishedRow, PublishedTable, RowGait
from core.vision.track import FootTrack
from core.vision.track_csv import FRAME_RATE, read_track_csv
from core.wire.robot_time import estimate_seconds


def reference_files(table: PublishedTable, row: PublishedRow, reference: Reference) -> tuple[Path, ...]:
    """The published files behind a row; none where there are none."""
    gait, found = row.gait, []
    if has_data(table, Who.RUN):
        found += reference.run_paths(gait.family, gait.step, gait.version)
    if has_data(table, Who.TRACK):
        found += reference.track_paths(gait.family, gait.step)
    motion = recorded_path(table, row, reference)
    if motion is not None:
        found.append(motion)
    return tuple(path for path in found if path.is_file())


def recorded_path(table: PublishedTable, row: PublishedRow, reference: Reference) -> Path | None:
    """The file of a row's published motion; None where there is none."""
    if not has_data(table, Who.RECORDED):
        return None
    path = reference.trajectory_path(row.gait.family, row.gait.step, row.gait.motion_iterations)
    return path if path.is_file() else None


def reference_figures(table: PublishedTable, row: PublishedRow, reference: Reference, tools: Tools) -> Json:
    """Reads and simulates what was published of a row, and gives the content that is kept.

    Raises:
        InputError: a file cannot be read, or is no such table.
    """
    figures: Json = {}
    ways: Json = {}
    sentence = ""
    if has_data(table, Who.RUN):
        figures[Who.RUN], ways[Who.RUN], sentence = _run(table, row, reference)
    if has_data(table, Who.TRACK):
        tracks = [_track(path) for path in reference.track_paths(row.gait.family, row.gait.step)]
        if tracks:
            figures[Who.TRACK] = movement_figures(tracks, _wanted(row.gait), row.gait.iterations)
    if recorded_path(table, row, reference) is not None:
        figures[Who.RECORDED], ways[Who.RECORDED], sentence = _recorded(table, row.gait, reference, tools)
    kept = {who: way for who, way in ways.items() if way}
    return figures_content({who: part for who, part in figures.items() if part}, sentence, kept)


def _wanted(gait: RowGait) -> float:
    return gait.step * gait.iterations


def _run(table: PublishedTable, row: PublishedRow, reference: Reference) -> tuple[Json, Json, str]:
    """The published simulation by the table's definition, its ways, and a remark."""
    run = reference.run(row.gait.family, row.gait.step, row.gait.version, walker())
    if run is None:
        return {}, {}, "No run of it was published."
    shared = {
        "body_mm": run.body_error * 1000,
        "lean_deg": float(np.degrees(run.tilts.max())),
        "goes_mm": _goes(run),
    }
    feet = run.feet_error[:MANUAL_FEET] if table.kind is Kind.STANDING else run.feet_error
    ways = ways_content(run.wanted_body, run.wanted_feet, run.body, run.feet)
    definition = STANDING if table.kind is Kind.STANDING else TRACKING
    return {definition: {"feet_mm": float(feet.mean()) * 1000, **shared}}, ways, ""


def _goes(run: PublishedRun) -> float:
    return float(math.hypot(*(run.body[-1, :2] - run.body[0, :2]))) * 1000


def _track(path: Path) -> FootTrack:
    return read_track_csv(read_text(path), path.name, frame_rate=FRAME_RATE).track


def _recorded(
    table: PublishedTable, gait: RowGait, reference: Reference, tools: Tools
) -> tuple[Json, Json, str]:
    """The published motion in our physics, its ways, and a remark on what was cut off its strokes."""
    own = gait.motion_iterations
    problem, cut = published_problem(reference, gait.family, gait.step, physics_of(table.kind), own)
    words = (
        f"Strokes of the published motion are kept within the motors' range, by up to {cut * 1000:.1f} mm."
    )
    words = words if cut > 0.0 else ""
    if table.kind is Kind.PACE:
        seconds = estimate_seconds(problem.waypoints)
        return {PACE: {"seconds": seconds, "speed_mm_s": gait.step * 1000 / seconds}}, {}, words
    motion = tools.simulate(problem)
    walk = walked_motion(problem, motion, 0.0)
    words = " ".join(filter(None, (words, fall_sentence("The published motion", walk))))
    if table.kind is Kind.TRACKING:
        return tracking_figures(walk), walk_ways(walk), words
    track = track_of_motion(motion, library()[gait.family].gait.orientation, gait.iterations // own)
    return movement_figures([track], _wanted(gait), gait.iterations), {}, words
