"""Files of frame times: read in each usual form, refused by file and line, laid over a track."""

from __future__ import annotations

import numpy as np
import pytest

from core.errors import InputError
from core.trials.iterations import find_iterations, iteration_movements
from core.vision.frame_times import read_frame_times
from core.vision.track import FootTrack
from core.vision.track_csv import parse_track_csv
from tests.support.trials.tracks import stepping_track


@pytest.mark.parametrize(
    "text",
    [
        "0.1\n0.2\n0.5\n",
        "0.1,\n0.2,\n0.5,\n",
        "time\n0.1\n0.2\n0.5\n\n",
        "Frame, Time (s)\n1,0.1\n2,0.2\n3,0.5\n",
        "frame;time_s\n1;0,1\n2;0,2\n3;0,5\n",
        ",pts_time\n0,0.1\n1,0.2\n2,0.5\n",
    ],
)
def test_times_are_read_a_line_each_or_from_the_column_of_that_name(text: str) -> None:
    assert read_frame_times(text, "t.csv").times.tolist() == [0.1, 0.2, 0.5]


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("0.0\n0.2\n0.2\n", "t.csv:3: 0.2 s does not come after 0.2 s"),
        ("time\n0.0\n-1\n", "t.csv:3: -1 s does not come after 0 s"),
        ("0\nnan\n", "t.csv:2, column 1: nan is not a finite"),
        ("0\n1e999\n", "t.csv:2, column 1: 1e999 is not a finite"),
        ("0\n2e10\n", "t.csv:2: 2e\\+10 s is farther"),
        ("0\nsoon\n", "t.csv:2, column 1: “soon” is not a number"),
        ("frame,time\n0,0.1\n1,x\n", "t.csv:3, column 2: “x” is not a number"),
        ("frame,time\n0,0.1\n1\n", "t.csv, line 3: 0 numbers"),
        ("0,08\n0,16\n", "t.csv:1: no column is called time"),
        ("t,time\n0,1\n1,2\n", "t.csv:1: several columns are called time"),
        ("0\n77\n154\n", "t.csv:2: 77 s comes 77 s after the time before"),
        (
            "0\n1e-9\n2e-9\n",
            "t.csv:2: 1e-09 s comes 1e-09 s after the time before; between two frames are 0.001",
        ),
        ("0\n0.1\n0.2\n1000\n", "t.csv:4: 1000 s comes 999.8 s after"),
        ("0\n", "holds 1 times"),
        ("", "holds 0 times"),
    ],
)
def test_what_is_no_list_of_times_is_refused_by_file_and_line(text: str, sentence: str) -> None:
    with pytest.raises(InputError, match=sentence):
        read_frame_times(text, "t.csv")


def test_gaps_are_filled_by_straight_lines_over_the_times() -> None:
    track = parse_track_csv("X_D1,Y_D1\n0,0\n,\n4,8\n", "made.csv")
    timed = read_frame_times("0\n0.1\n0.4\n", "t.csv").timed(track, "made.csv")
    assert timed.feet[1, 0] * 100 == pytest.approx([1.0, 2.0])
    assert timed.filled.ravel().tolist() == [False, True, False]


def test_there_is_a_time_for_each_frame() -> None:
    with pytest.raises(InputError, match=r"t.csv has 2 times, and made.csv has 3 frames"):
        read_frame_times("0\n1\n", "t.csv").timed(parse_track_csv("X_D1,Y_D1\n0,0\n1,1\n4,8\n"), "made.csv")


def test_a_rate_that_varies_moves_no_end_of_an_iteration() -> None:
    even = stepping_track((0.012, 0.002), 3)
    sparse = np.concatenate([np.arange(0, 500, 4), np.arange(500, even.times.size)])
    track = FootTrack(even.times[sparse], even.feet[sparse], even.filled[sparse])
    found = find_iterations(track, 3)
    assert found.is_clear
    assert track.times[list(found.ends)] == pytest.approx([32.0, 64.0, 96.0], abs=1.0)
    parts = iteration_movements(track, found.ends, 0.012)
    assert [part.mean.net_distance for part in parts] == pytest.approx([0.01217] * 3, abs=1e-4)
