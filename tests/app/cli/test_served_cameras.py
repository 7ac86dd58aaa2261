"""Cameras on the command line, and those that Linux lists."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.cameras.service import devices
from app.cli.served_cameras import served_cameras
from core.errors import InputError


def test_a_file_is_served_under_its_name(tmp_path: Path) -> None:
    film = tmp_path / "walk.avi"
    film.touch()
    (found,) = served_cameras([f"Under the glass={film}"])
    assert (found.id, found.name, found.path) == ("under-the-glass", "Under the glass", str(film))


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["walk.avi"], "write NAME=VIDEO"),
        (["under=/none/walk.avi"], "There is no file"),
        (["=a"], "no camera"),
        (["Video0=walk.avi"], "give “walk.avi” another name"),
    ],
)
def test_a_camera_that_cannot_be_served_is_refused(words: list[str], said: str) -> None:
    with pytest.raises(InputError, match=said):
        served_cameras(words)


def test_two_cameras_of_one_name_are_refused(tmp_path: Path) -> None:
    film = tmp_path / "walk.avi"
    film.touch()
    with pytest.raises(InputError, match="a name of its own"):
        served_cameras([f"side={film}", f"Side={film}"])


def test_of_a_camera_with_several_entries_the_one_with_pictures_is_listed(tmp_path: Path) -> None:
    for number, index in (("video0", "0"), ("video1", "1"), ("video2", "0")):
        entry = tmp_path / number
        entry.mkdir()
        (entry / "index").write_text(f"{index}\n")
        (entry / "name").write_text("Lab camera\n")
    (tmp_path / "video3").mkdir()
    assert [(one.id, one.path) for one in devices(tmp_path)] == [
        ("video0", "/dev/video0"),
        ("video2", "/dev/video2"),
    ]
