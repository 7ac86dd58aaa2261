"""The time of each frame of a film, from a file: one time a line, or a column of a table (s)."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from core.arrays import Floats
from core.errors import InputError
from core.text.tables import Table, read_table
from core.vision.track import FootTrack, filled_track

NAMES = ("time", "times", "t", "seconds", "timestamp", "pts_time")
"""Names of a column of times, without its unit."""
UNIT = re.compile(r"(?:[ _]+s|[ _]*[(\[]s[)\]])$")
"""The unit s behind a column's name: `time (s)`, `time [s]`, `time s`, `time_s`."""
LATEST = 1e10
"""No time is farther from 0 than this, s; seconds since 1970 are nearer."""
INTERVALS = (0.001, 10.0)
"""Bounds of the time between two frames, s."""


@dataclass(frozen=True, eq=False)
class FrameTimes:
    """The times of a film's frames.

    Args:
        name: of the file, for messages.
        times: (n,) s, rising.
        notes: sentences on what was unusual in the file's form.
    """

    name: str
    times: Floats
    notes: tuple[str, ...]

    def timed(self, track: FootTrack, name: str) -> FootTrack:
        """The track at these times; its gaps are filled anew.

        Args:
            track: frames in order.
            name: of its file, for the message.

        Raises:
            InputError: there are more or fewer times than frames.
        """
        if self.times.size != track.times.size:
            raise InputError(
                f"{self.name} has {self.times.size} times, and {name} has {track.times.size} frames. Give "
                "one time for each frame.",
                self.name,
            )
        return timed_track(track, self.times)


def timed_track(track: FootTrack, times: Floats) -> FootTrack:
    """A track at other times, with its gaps filled by straight lines over those.

    Args:
        track: frames in order.
        times: (n,) s, one for each frame, increasing.
    """
    feet = np.where(track.filled[..., None], np.nan, track.feet)
    return filled_track(times, feet)


def read_frame_times(text: str, name: str) -> FrameTimes:
    """Reads a file of frame times: one time a line, or a table with a column that its header calls `time`.

    Args:
        text: the file's text.
        name: the file's name, for messages.

    Raises:
        InputError: naming line and column of the first thing that is wrong.
    """
    table = read_table(text, name)
    column, first = _place(table)
    left_out = table.columns_left_out + column
    cells = [row[column : column + 1] for row in table.rows]
    times = replace(table, rows=cells, columns_left_out=left_out).numbers(first, 1).ravel()
    if times.size < 2:
        raise InputError(f"{name} holds {times.size} times; a track needs at least two.", name)
    _require_order(times, name, table.lines[first:])
    return FrameTimes(name, times, table.notes)


def _require_order(times: Floats, name: str, lines: Sequence[int]) -> None:
    """Makes sure that times rise by a film's steps.

    Raises:
        InputError: naming the line of the first one that does not.
    """
    far = np.abs(times) > LATEST
    shortest, longest = INTERVALS
    intervals = np.diff(times, prepend=times[0] - shortest)
    slack = np.spacing(np.abs(times))
    odd = (intervals < shortest - slack) | (intervals > longest + slack)
    for index in np.flatnonzero(far | odd)[:1].tolist():
        place, here = f"{name}:{lines[index]}", f"{times[index]:.10g} s"
        if far[index]:
            fault = f"{here} is farther from 0 than {LATEST:g} s"
        elif intervals[index] <= 0.0:
            fault = f"{here} does not come after {times[index - 1]:.10g} s, the time before"
        else:
            fault = (
                f"{here} comes {intervals[index]:.4g} s after the time before; between two frames are "
                f"{shortest:g} to {longest:g} s"
            )
        raise InputError(f"{place}: {fault}. Give the frames' times in order, in seconds.", place)


def _place(table: Table) -> tuple[int, int]:
    """Column of the times, and the row with which they begin."""
    head = [UNIT.sub("", cell.lower()) for cell in table.head]
    columns = [column for column, cell in enumerate(head) if cell in NAMES]
    if len(columns) == 1:
        return columns[0], 1
    if len(head) <= 1 and not columns:
        return 0, 0
    place = f"{table.name}:{table.lines[0]}"
    raise InputError(
        f"{place}: {'several columns are' if columns else 'no column is'} called time. Call the column of "
        "the frames' times so, or write one time a line.",
        place,
    )
