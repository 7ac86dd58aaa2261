"""Trajectory and waypoint files on disk."""

import os
import stat
from pathlib import Path

from app.store.named_file import file_path, is_plain, open_file_number, write_named
from core.errors import InputError
from core.motion.trajectory import Trajectory
from core.motion.trajectory_npz import MotionFile, parse_npz
from core.text.decoding import MOST_BYTES, require_size, text_of, without_mark
from core.wire.trajectory_csv import (
    TrajectoryFile,
    format_companion,
    format_trajectory_csv,
    parse_trajectory_csv,
)
from core.wire.waypoints import Waypoints, parse_waypoint_csv

LOWEST_BODY = 0.005
"""A centre of mass is never lower all the time, m."""
COMPANION_SUFFIX = ".footfall.json"


def read_text(path: Path) -> str:
    """A text file's content, without the mark of byte order.

    Raises:
        InputError: it is absent, not readable, too large, or no text in UTF-8.
    """
    return without_mark(read_whole_text(path))


def read_whole_text(path: Path) -> str:
    """A text file's content to the last character, whatever ends its lines (see `read_text`).

    A pipe is read where it is an open file of this process, such as /dev/stdin; any other might never answer.
    """
    return text_of(read_bytes(path, reads_open_files=True), str(path))


def read_bytes(path: Path, *, reads_open_files: bool = False) -> bytes:
    """The bytes of a plain file; links are followed.

    Args:
        path: the file.
        reads_open_files: whether it may be an open file of this process, of any kind.

    Raises:
        InputError: it is absent, no plain file, not readable or too large.
    """
    try:
        is_open = reads_open_files and open_file_number(path) is not None
        # Opened without O_NONBLOCK, a pipe would wait for somebody who writes into it.
        flags = os.O_RDONLY | os.O_CLOEXEC | (0 if is_open else os.O_NONBLOCK)
        with open(os.open(path, flags), "rb") as file:
            state = os.fstat(file.fileno())
            if not (is_open or stat.S_ISREG(state.st_mode)):
                raise InputError(f"{path} is no plain file. Put a file in its place.", str(path))
            require_size(state.st_size, str(path))
            content = file.read(MOST_BYTES + 1)
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror}.", str(path)) from error
    require_size(len(content), str(path))
    return content


def companion_path(path: Path) -> Path:
    """`X.footfall.json` beside `X.csv`."""
    return path.with_name(path.stem + COMPANION_SUFFIX)


def finds_companion(path: Path) -> bool:
    """Whether a companion stands beside a file.

    Raises:
        InputError: something is there that is no file, such as a pipe, on which reading would wait.
    """
    companion = companion_path(path)
    if companion.is_symlink() or companion.exists():
        if companion.is_file():
            return True
        raise InputError(f"{companion} is no file. Move it elsewhere.", str(companion))
    return False


def require_unread(output: Path | None, read: Path | None, *, has_companion: bool = False) -> None:
    """Makes sure that a command does not write over what it reads, under whatever name.

    Args:
        output: file to write; None for none.
        read: file that is read, with its companion; None for none.
        has_companion: whether a companion is written too.

    Raises:
        InputError: it would.
    """
    if output is None or read is None:
        return
    output = file_path(output)
    is_recorded = read.suffix not in (".json", ".npz")
    for source in (read, companion_path(read)) if is_recorded and read.name else (read,):
        for written in (output, companion_path(output)) if has_companion else (output,):
            if _is_same_file(written, source):
                which = "" if written is output else f" (companion of {output})"
                raise InputError(
                    f"{written}{which} is the file that is read; choose another name.", str(written)
                )


def _is_same_file(one: Path, other: Path) -> bool:
    try:
        return is_plain(one) and one.samefile(other)
    except OSError:  # one of them is not there; reading and writing say more
        return False


def write_with_companion(path: Path, content: str | bytes, companion: str | bytes) -> None:
    """Writes a file that a person names, and beside a plain one its companion: both whole, or none.

    What is no plain file, such as /dev/stdout or a pipe, has no place beside it, and gets no companion.
    """
    path = file_path(path)
    write_named(path, content, companion_path(path), companion)


def read_trajectory(path: Path) -> TrajectoryFile:
    """Reads a trajectory CSV and its companion where there is one.

    Raises:
        InputError: it is malformed, or not in the world's frame.
    """
    companion_text = read_text(companion_path(path)) if finds_companion(path) else None
    return parse_world_trajectory(read_text(path), path.name, companion_text)


def parse_world_trajectory(text: str, name: str, companion_text: str | None = None) -> TrajectoryFile:
    """Reads the text of a trajectory CSV in the world's frame.

    Args:
        text: the CSV's text.
        name: the file's name, for messages.
        companion_text: text of the companion JSON, where there is one.

    Raises:
        InputError: it is malformed, or not in the world's frame.
    """
    read = parse_trajectory_csv(text, name, companion_text)
    require_world_frame(read.trajectory, name)
    return read


def require_world_frame(trajectory: Trajectory, name: str) -> None:
    """A motion's body is somewhere above the ground, as in the world's frame.

    Raises:
        InputError: it is not.
    """
    if (trajectory.body_world[:, 2] < LOWEST_BODY).all():
        raise InputError(
            f"{name}: the body's height is 0 throughout, as in files whose feet are given from their "
            "own modules' centres. A trajectory has the height of the centre of mass in its third row.",
            name,
        )


def write_trajectory(path: Path, trajectory: Trajectory, robot: str) -> None:
    """Writes a trajectory CSV and its companion, which names the robot (see `write_with_companion`)."""
    text = format_trajectory_csv(trajectory)
    write_with_companion(path, text, format_companion(trajectory, text, robot))


def read_motion_npz(path: Path) -> MotionFile:
    """Reads a motion from an NPZ.

    Raises:
        InputError: it cannot be read, or is no motion.
    """
    try:
        return parse_npz(path.read_bytes(), path.name)
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror}.", str(path)) from error


def read_waypoints(path: Path) -> Waypoints:
    """Reads a waypoint CSV."""
    return parse_waypoint_csv(read_text(path), name=path.name)
