"""Films of phones and action cameras by HTTP: times that are uneven, codecs that are not read."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest

from app.vision.video_io import read_picture
from tests.support.studio_process import StudioProcess, running_studio
from tests.support.trials import films
from tests.support.trials.retimed import retimed

pytestmark = pytest.mark.heavy


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("data")


@pytest.fixture(scope="module")
def studio(data: Path) -> Iterator[StudioProcess]:
    with running_studio(data) as running:
        yield running


def test_pictures_of_an_uneven_film_are_found_and_named_by_their_own_times(
    studio: StudioProcess, tmp_path: Path
) -> None:
    path = tmp_path / "phone.mp4"
    content = retimed(films.film(path), [1] * 30 + [3] * 30)
    answer = studio.ask("POST", "/api/videos?name=my%20phone.mp4", content)
    assert answer.status == 201, answer.content
    assert answer.content["rate"] == pytest.approx(59 / 3.9, rel=1e-3)
    video = f"/api/videos/{answer.content['id']}"
    times = studio.ask("GET", f"{video}/times").content["times"]
    assert (times[29], times[30], times[59]) == (0.9667, 1.0, 3.9)
    for seconds, number in ((0.5, 15), (1.0, 30), (2.5, 45), (3.9, 59)):
        picture = studio.blob(f"{video}/picture.jpg?seconds={seconds}")
        assert films.number_of(read_picture(picture, "picture")) == number
    late = studio.ask("GET", f"{video}/picture.jpg?seconds=9")
    assert late.status == 422
    assert "there is no picture at 9.00 s" in late.content["error"]


def test_a_film_whose_pictures_an_earlier_version_counted_too_high_is_played_and_searched(
    studio: StudioProcess, data: Path, tmp_path: Path
) -> None:
    content = films.film(tmp_path / "t.mp4", count=30)
    video = studio.ask("POST", "/api/videos?name=old.mp4", content).content["id"]
    for method, path, body in (
        ("GET", "stream?from_frame=45", None),
        ("GET", "picture.jpg?frame=45", None),
        ("POST", "boards", {"columns": 4, "rows": 3, "frames": [45]}),
        ("POST", "boards", {"columns": 4, "rows": 3}),
    ):
        with closing(sqlite3.connect(data / "studio.sqlite3")) as database, database:
            database.execute(
                "UPDATE video SET content=json_set(content, '$.frames', 60) WHERE id=?", (video,)
            )
        answer = studio.ask(method, f"/api/videos/{video}/{path}", body)
        if body is None or "frames" in body:
            assert (answer.status, answer.content["where"]) == (422, "frame")
            assert "picture 45" in answer.content["error"]
        else:
            assert answer.content["boards"]
    assert studio.ask("GET", f"/api/videos/{video}").content["frames"] == 30


def test_an_upload_of_a_codec_that_is_not_read_names_it_and_the_way_out_and_leaves_nothing(
    studio: StudioProcess, data: Path, tmp_path: Path
) -> None:
    before = sorted((data / "videos").iterdir())
    content = films.with_codec(films.film(tmp_path / "t.mp4"), b"av01")
    answer = studio.ask("POST", "/api/videos?name=action%20cam.mp4", content)
    assert (answer.status, answer.content["where"]) == (422, "file")
    assert answer.content["error"].startswith("None of the 60 pictures of action cam.mp4 decodes: ")
    assert 'ffmpeg -i "action cam.mp4"' in answer.content["error"]
    assert sorted((data / "videos").iterdir()) == before
