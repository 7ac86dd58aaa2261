"""Trajectory and waypoint files on disk."""

from __future__ import annotations

from pathlib import Path

from app.store.files import write_atomically
from core.errors import InputError
from core.trajectory import Trajectory
from core.trajectory_csv import TrajectoryFile, format_companion, format_trajectory_csv, parse_trajectory_csv
from core.waypoints import Waypoints, format_waypoint_csv, parse_waypoint_csv

LOWEST_BODY = 0.005
"""A centre of mass is never lower all the time, m."""
COMPANION_SUFFIX = ".footfall.json"


def read_text(path: Path) -> str:
    """A text file's content.

    Raises:
        InputError: it is absent, not readable, or no text.
    """
    try:
        return path.read_text("utf-8-sig")
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror}.", str(path)) from error
    except UnicodeDecodeError as error:
        raise InputError(f"{path} is not a text file in UTF-8.", str(path)) from error


def companion_path(path: Path) -> Path:
    """`X.footfall.json` beside `X.csv`."""
    return path.with_name(path.stem + COMPANION_SUFFIX)


def read_trajectory(path: Path) -> TrajectoryFile:
    """Reads a trajectory CSV and its companion where there is one.

    Raises:
        InputError: it is malformed, or not in the world's frame.
    """
    companion = companion_path(path)
    companion_text = read_text(companion) if companion.exists() else None
    read = parse_trajectory_csv(read_text(path), path.name, companion_text)
    if (read.trajectory.body_world[:, 2] < LOWEST_BODY).all():
        raise InputError(
            f"{path.name}: the body's height is 0 throughout, as in files whose feet are given from their "
            "own modules' centres. A trajectory has the height of the centre of mass in its third row.",
            str(path),
        )
    return read


def write_trajectory(path: Path, trajectory: Trajectory) -> None:
    """Writes a trajectory CSV and its companion, each whole or not at all."""
    text = format_trajectory_csv(trajectory)
    write_atomically(companion_path(path), format_companion(trajectory, text))
    write_atomically(path, text)


def read_waypoints(path: Path) -> Waypoints:
    """Reads a waypoint CSV."""
    return parse_waypoint_csv(read_text(path), name=path.name)


def write_waypoints(path: Path, waypoints: Waypoints) -> None:
    """Writes a waypoint CSV whole or not at all."""
    write_atomically(path, format_waypoint_csv(waypoints))
