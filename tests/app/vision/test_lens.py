"""A lens is found again from pictures of a checkerboard; what cannot be used is said."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from app.vision.checkerboard import LARGEST_LOOKED, CalibratedLens, board_corners, lens_of_corners
from app.vision.video_io import Picture, jpeg, read_picture
from core.arrays import Floats
from core.errors import InputError
from tests.support.trials.rendered import LENS, SIZE, distorting_maps

CORNERS = (8, 5)
SQUARE = 40


def board() -> Picture:
    columns, rows = CORNERS[0] + 1, CORNERS[1] + 1
    dark = (np.add.outer(np.arange(rows), np.arange(columns)) % 2).astype(np.uint8)
    squares = np.kron(255 * (1 - dark), np.ones((SQUARE, SQUARE), dtype=np.uint8))
    return np.asarray(cv2.cvtColor(np.pad(squares, 30, constant_values=255), cv2.COLOR_GRAY2BGR), np.uint8)


def seen_from(turn: Floats, shift: Floats) -> Picture:
    """The board turned (rad) and moved (in squares) before the camera, through its lens."""
    flat = board()
    height, width = flat.shape[:2]
    edges = np.array([[0, 0], [width, 0], [width, height], [0, height]], dtype=np.float64)
    places = np.column_stack([(edges - [width / 2, height / 2]) / SQUARE, np.zeros(4)])
    pixels, _ = cv2.projectPoints(places, turn, shift, LENS.matrix, np.zeros(5))
    to_picture = cv2.getPerspectiveTransform(
        edges.astype(np.float32), np.asarray(pixels).reshape(4, 2).astype(np.float32)
    )
    straight = cv2.warpPerspective(flat, to_picture, SIZE, borderValue=(90, 90, 90))
    return np.asarray(cv2.remap(straight, *distorting_maps(), cv2.INTER_LINEAR), dtype=np.uint8)


def lens_of_pictures(pictures: list[Picture]) -> CalibratedLens:
    boards = [board_corners(picture, CORNERS) for picture in pictures]
    return lens_of_corners([board for board in boards if board is not None], SIZE, CORNERS)


def test_a_lens_is_found_again_from_its_pictures() -> None:
    turns = [(0.0, 0.0, 0.0), (0.4, 0.0, 0.1), (-0.35, 0.2, 0.0), (0.1, -0.45, 0.2), (0.2, 0.4, -0.3)]
    shifts = [(0, 0, 12), (-2, 1, 14), (2, -1, 13), (1.5, 1.2, 14), (-1.5, -1.2, 13)]
    pictures = [seen_from(np.array(t), np.array(s, dtype=float)) for t, s in zip(turns, shifts, strict=True)]
    found = lens_of_pictures(pictures)
    lens = found.lens
    assert max(found.each) < 0.5
    assert found.unexplained < 0.5
    np.testing.assert_allclose(lens.matrix[[0, 1], [0, 1]], 620.0, rtol=0.03)
    grid = np.stack(np.meshgrid([100.0, 320.0, 540.0], [80.0, 240.0, 400.0]), axis=-1).reshape(-1, 1, 2)
    ours, real = (
        cv2.undistortPoints(grid, one.matrix, one.distortion, P=LENS.matrix) for one in (lens, LENS)
    )
    assert np.linalg.norm(np.asarray(ours) - np.asarray(real), axis=-1).max() < 3.0


def test_a_board_in_a_large_picture_is_looked_for_in_a_small_one(monkeypatch: pytest.MonkeyPatch) -> None:
    looked: list[tuple[int, ...]] = []
    search = cv2.findChessboardCornersSB

    def watched(picture: Picture, corners: tuple[int, int]) -> object:
        looked.append(picture.shape)
        return search(picture, corners)

    monkeypatch.setattr(cv2, "findChessboardCornersSB", watched)
    large = np.kron(board(), np.ones((8, 8, 1), dtype=np.uint8))
    found = board_corners(large, CORNERS)
    assert found is not None
    assert max(looked[0]) <= LARGEST_LOOKED < max(large.shape)
    side = 8 * SQUARE
    grid = np.stack(np.meshgrid(np.arange(1, CORNERS[0] + 1), np.arange(1, CORNERS[1] + 1)), axis=-1)
    edges = (grid * side + 8 * 30 - 0.5).reshape(-1, 2)
    np.testing.assert_allclose(np.sort(found.reshape(-1, 2), axis=0), np.sort(edges, axis=0), atol=0.3)


def test_pictures_without_a_board_are_counted_in_the_refusal() -> None:
    plain = np.full((SIZE[1], SIZE[0], 3), 128, dtype=np.uint8)
    with pytest.raises(InputError, match="found in 1 pictures"):
        lens_of_pictures([plain, seen_from(np.zeros(3), np.array([0.0, 0.0, 12.0])), plain])


def test_boards_that_tell_no_lens_are_refused() -> None:
    count = CORNERS[0] * CORNERS[1]
    point = np.full((count, 1, 2), 50.0, dtype=np.float32)
    chance = np.random.default_rng(1).uniform(0.0, 400.0, (3, count, 1, 2)).astype(np.float32)
    for boards in ([point] * 3, list(chance)):
        with pytest.raises(InputError, match="lens cannot be computed"):
            lens_of_corners(boards, SIZE, CORNERS)


def test_a_picture_comes_back_and_other_files_are_refused() -> None:
    assert read_picture(jpeg(board()), "board.jpg").shape == board().shape
    for content in (b"", b"no picture"):
        with pytest.raises(InputError, match="no picture"):
            read_picture(content, "notes.txt")
