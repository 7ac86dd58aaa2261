"""The platform in the picture: its view from clicked points, colours within bounds, false sights."""

from __future__ import annotations

import numpy as np
import pytest

from core.errors import InputError
from core.trials.camera import ColourRange, Lens, view_of_points
from core.trials.false_sights import false_sights
from tests.core.trials.tracks import stepping_track

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
    assert [tuple(place) for place in np.argwhere(false_sights(track.times, feet))] == [(200, 1)]
