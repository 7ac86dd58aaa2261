"""The pictures of the documentation: each is shown somewhere, and each is made by the script."""

from __future__ import annotations

import re

import pytest
from PIL import Image

from tests.pictures.__main__ import NAMES, main
from tests.pictures.main_path import FILM
from tests.pictures.sitting import DOCS
from tests.support.studio_process import PROJECT

PICTURE = re.compile(r"!\[([^\]]*)\]\((?:docs/)?([\w-]+\.(?:png|webp|gif|jpg))\)")
MOST_STILL, MOST_MOVING = 150_000, 3_000_000
"""Bytes of a picture."""
FILM_SECONDS = (15, 27)


def shown() -> set[str]:
    """The names of the pictures that README and docs show."""
    texts = [path.read_text(encoding="utf-8") for path in (PROJECT / "README.md", *DOCS.glob("*.md"))]
    return {name for text in texts for _, name in PICTURE.findall(text)}


def test_the_pictures_that_are_shown_are_those_that_the_script_makes() -> None:
    kept = {path.name for path in DOCS.iterdir() if path.suffix in (".png", ".webp", ".gif", ".jpg")}
    assert shown() == set(NAMES) == kept


@pytest.mark.parametrize("name", NAMES)
def test_a_picture_is_small_enough_for_a_page(name: str) -> None:
    assert 5_000 < (DOCS / name).stat().st_size < (MOST_MOVING if name == FILM else MOST_STILL)


def test_the_moving_picture_moves_for_about_twenty_seconds_and_begins_again() -> None:
    with Image.open(DOCS / FILM) as film:
        frames = getattr(film, "n_frames", 1)
        total = 0
        for number in range(frames):
            film.seek(number)
            film.load()
            total += film.info["duration"]
        assert film.info["loop"] == 0
    assert frames > 50
    assert FILM_SECONDS[0] < total / 1000 < FILM_SECONDS[1]


def test_a_name_that_no_picture_has_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["nothing.png"]) == 2
    assert "studio.png" in capsys.readouterr().err
