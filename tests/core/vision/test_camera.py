"""The platform in the picture: its view from clicked points, colours within bounds, false sights."""

from __future__ import annotations

import numpy as np
import pytest

from core.errors import InputError
from core.vision.camera import BlobLimits, ColourRange, Lens, PlatformView, view_of_points
from core.vision.outliers import find_outliers
from tests.support.trials.tracks import stepping_track

CORNERS = np.array([[-0.05, -0.05], [0.05, -0.05], [0.05, 0.05], [-0.05, 0.05]])
TILTED = np.array([[900.0, 40.0, 320.0], [-30.0, -950.0, 240.0], [0.4, -0.2, 1.0]])


def pixels_of(places: np.ndarray) -> np.ndarray:
    turned = np.column_stack([places, np.ones(len(places))]) @ TILTED.T
    return np.asarray(turned[:, :2] / turned[:, 2:])


@pytest.mark.parametrize("extra", [0, 5])
def test_clicked_corners_tell_every_other_place(extra: int) -> None:
    known = np.concatenate([CORNERS, np.random.default_rng(2).uniform(-0.06, 0.06, (extra, 2))])
    view = view_of_points(pixels_of(known), known)
    others = np.random.default_rng(1).uniform(-0.08, 0.08, (20, 2))
    np.testing.assert_allclose(view.places(pixels_of(others)), others, atol=1e-9)


def test_a_foot_that_is_not_seen_has_no_place() -> None:
    view = view_of_points(pixels_of(CORNERS), CORNERS)
    assert np.isnan(view.places(np.array([[np.nan, np.nan]]))).all()


@pytest.mark.parametrize(
    ("pixels", "words"),
    [
        (CORNERS[:3], "at least four"),
        (np.array([[0.0, 0], [1, 1], [2, 2], [3, 3]]), "lie on a line"),
        (np.zeros((4, 2)), "upon each other"),
    ],
)
def test_points_that_tell_no_plane_are_refused(pixels: np.ndarray, words: str) -> None:
    with pytest.raises(InputError, match=words):
        view_of_points(pixels, CORNERS[: len(pixels)])


def test_a_colour_outside_its_circle_is_refused() -> None:
    with pytest.raises(InputError, match="between 0 and 1"):
        ColourRange((0.2, 1.5))


def test_a_lens_needs_focal_lengths() -> None:
    with pytest.raises(InputError, match="focal lengths"):
        Lens(np.zeros((3, 3)), np.zeros(5))


def test_only_what_lies_far_from_its_neighbours_is_false() -> None:
    track = stepping_track((0.012, 0.0), 1, noise=0.0005)
    feet = np.array(track.feet)
    feet[200, 1] += 0.03
    feet[100:110, 3] = np.nan
    assert [tuple(place) for place in np.argwhere(find_outliers(track.times, feet))] == [(200, 1)]


LENS = Lens(
    np.array([[620.0, 0.0, 320.0], [0.0, 610.0, 240.0], [0.0, 0.0, 1.0]]),
    np.array([-0.35, 0.08, 1e-3, -8e-4, 0.0]),
)


def test_a_lens_undoes_what_it_bends() -> None:
    pixels = np.random.default_rng(3).uniform([0, 0], [640, 480], (50, 2))
    np.testing.assert_allclose(LENS.bent(LENS.straight(pixels)), pixels, atol=0.01)


def test_where_a_lens_has_no_inverse_there_is_no_pixel() -> None:
    assert np.isnan(LENS.straight(np.array([[2000.0, 1500.0]]))).all()


def test_places_and_pixels_are_each_others_inverse() -> None:
    view = view_of_points(pixels_of(CORNERS), CORNERS)
    np.testing.assert_allclose(view.pixels(CORNERS), pixels_of(CORNERS), atol=1e-6)


@pytest.mark.parametrize("flat", [CORNERS * [1.0, 0.0], CORNERS @ [[1.0, 1.0], [0.0, 0.0]]])
def test_places_on_a_line_are_refused(flat: np.ndarray) -> None:
    with pytest.raises(InputError, match="lie on a line"):
        view_of_points(pixels_of(CORNERS), flat)


def test_a_pixel_on_the_horizon_shows_no_place() -> None:
    view = PlatformView(np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.01, 0.0, -1.0]]))
    assert np.isnan(view.places(np.array([100.0, 20.0]))).all()


def test_two_points_whose_places_are_exchanged_are_refused() -> None:
    with pytest.raises(InputError, match="exchanged"):
        view_of_points(pixels_of(CORNERS), CORNERS[[1, 0, 2, 3]])


@pytest.mark.parametrize(
    ("area", "fill", "words"),
    [
        (10.0, 1.0, "below 60"),
        (30_000.0, 1.0, "above 20000"),
        (100.0, 0.2, "20% of its circle"),
        (100.0, 0.9, None),
    ],
)
def test_a_spot_is_refused_with_its_number(area: float, fill: float, words: str | None) -> None:
    refusal = BlobLimits().refusal(area, fill)
    assert refusal is None if words is None else words in str(refusal)


@pytest.mark.parametrize("limits", [(0.0, 10.0, 0.5), (20.0, 10.0, 0.5), (1.0, 10.0, 1.5)])
def test_limits_that_no_spot_can_keep_are_refused(limits: tuple[float, float, float]) -> None:
    with pytest.raises(InputError):
        BlobLimits(*limits)
