"""The benchmark's film: its feet are found where they were drawn."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from app.bench.page.film import draw_film, stepping_feet
from app.vision.tracking import track_video

pytestmark = [pytest.mark.heavy, pytest.mark.alone]


def test_the_feet_of_the_film_are_found_where_they_were_drawn(tmp_path: Path) -> None:
    film = draw_film(tmp_path / "film", (320, 240), stepping_feet(0.5))
    assert film.setup.doubt is None
    found = track_video(film.folder, film.setup.tracking())
    assert found is not None
    away = np.linalg.norm(found.track.feet - film.feet, axis=2)
    assert np.median(away) <= 0.0005
    assert not found.track.filled.any()
