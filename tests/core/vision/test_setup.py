"""A camera's setup: what it still needs, which clicked point does not fit, which pictures it is for."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.errors import InputError
from core.vision.camera import FOOT_COLOURS
from core.vision.setup import CameraSetup
from tests.core.vision.test_camera import CORNERS, LENS, pixels_of

SIZE = (640, 480)
STRAIGHT = pixels_of(CORNERS)
SETUP = CameraSetup("glass", SIZE, LENS, LENS.bent(STRAIGHT), CORNERS)


def test_clicked_points_are_found_at_their_places_through_the_lens() -> None:
    assert SETUP.off.max() < 1e-6
    assert SETUP.doubt is None
    np.testing.assert_allclose(SETUP.tracking().places(LENS.bent(STRAIGHT)), CORNERS, atol=1e-6)
    np.testing.assert_allclose(SETUP.outline, LENS.bent(STRAIGHT), atol=1e-3)


def test_a_point_that_does_not_fit_the_others_is_named() -> None:
    more = np.concatenate([CORNERS, [[0.0, 0.0], [0.03, 0.0], [0.0, 0.03], [-0.02, 0.01], [0.01, -0.04]]])
    wrong = more.copy()
    wrong[5] += [0.03, 0.0]
    setup = CameraSetup("glass", SIZE, None, pixels_of(more), wrong)
    assert setup.doubt is not None
    assert "Point 6 is" in setup.doubt


def test_a_setup_without_points_says_what_is_missing_and_does_not_track() -> None:
    setup = CameraSetup("glass", SIZE, LENS)
    assert "0 points are clicked" in setup.missing[0]
    with pytest.raises(InputError, match="“glass” is not complete: 0 points"):
        setup.tracking()


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"size": None}, "belong to pictures of one size"),
        ({"size": (100, 100)}, r"Point 1 at .* lies outside"),
        ({"colours": FOOT_COLOURS[:3]}, "3 colours are given"),
    ],
)
def test_what_no_setup_can_have_is_refused(changes: dict[str, object], words: str) -> None:
    with pytest.raises(InputError, match=words):
        replace(SETUP, **changes)  # type: ignore[arg-type]
