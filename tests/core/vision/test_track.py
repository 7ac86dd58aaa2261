"""Foot tracks: gaps are filled and stay marked, files in cm and pixels read, bad ones are named."""

from __future__ import annotations

import numpy as np
import pytest

from core.errors import InputError
from core.vision.track_csv import PixelScale, format_track_csv, parse_track_csv

HEADER = "X_D1, Y_D1, X_D2, Y_D2"


def text(*rows: str) -> str:
    return "\n".join([HEADER, *rows]) + "\n"


def test_centimetres_become_metres_and_a_zero_is_a_position() -> None:
    track = parse_track_csv(text("2.60,-3.00,0.00,0.00", "2.70,-3.00,0.10,0.00"), frame_rate=10.0)
    np.testing.assert_allclose(track.feet[:, 0], [[0.026, -0.03], [0.027, -0.03]])
    np.testing.assert_allclose(track.times, [0.0, 0.1])
    assert track.gaps == ()


def test_a_gap_is_filled_by_a_straight_line_and_marked() -> None:
    track = parse_track_csv(text("1,0,0,0", "1,0,,", "1,0,,", "1,0,3,6"))
    np.testing.assert_allclose(track.feet[1:3, 1], [[0.01, 0.02], [0.02, 0.04]])
    assert track.gaps == ((1, 1, 2),)


def test_a_gap_at_an_end_keeps_the_nearest_position() -> None:
    track = parse_track_csv(text(",,1,1", "2,3,1,1", ",,1,1"))
    np.testing.assert_allclose(track.feet[:, 0], [[0.02, 0.03]] * 3)
    assert track.gaps == ((0, 0, 0), (0, 2, 2))


def test_in_pixels_zero_zero_is_a_gap_and_y_is_turned_up() -> None:
    scale = PixelScale(0.001, (100.0, 50.0))
    track = parse_track_csv(text("110,40,90,50", "0,0,90,0", "130,40,90,50"), pixels=scale)
    np.testing.assert_allclose(track.feet[:, 0], [[0.01, 0.01], [0.02, 0.01], [0.03, 0.01]])
    np.testing.assert_allclose(track.feet[1, 1], [-0.01, 0.05])
    assert track.gaps == ((0, 1, 1),)


def test_a_written_track_reads_back_with_its_gaps() -> None:
    track = parse_track_csv(text("1,0,0,0", "1.5,0,,", "2,0,3,6"))
    again = parse_track_csv(format_track_csv(track))
    np.testing.assert_allclose(again.feet, track.feet, atol=5e-7)
    assert again.gaps == track.gaps


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("", "line 1: the header"),
        ("X, Y\n1,2\n", "line 1: the header"),
        (text("1,2,3,4"), "holds 1 frames"),
        (text("1,2,3,4", "1,2,3"), "track, line 3: 3 numbers; a row has 4"),
        (text("1,2,3,4", "1,2,three,4"), "track:3, column 3: “three”"),
        (text("1,2,3,4", "1,2,nan,4"), "track:3, column 3: nan"),
        (text("1,2,,", "1,2,,"), "foot 2 is seen in no frame"),
    ],
)
def test_what_is_wrong_in_a_file_is_named(content: str, words: str) -> None:
    with pytest.raises(InputError, match=words):
        parse_track_csv(content)


def test_a_pixel_needs_a_size() -> None:
    with pytest.raises(InputError, match="must be more than 0"):
        PixelScale(0.0, (0.0, 0.0))
