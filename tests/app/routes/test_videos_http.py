"""Videos and setups by HTTP: upload, look, track; refusals that name what to do and leave nothing behind."""

from __future__ import annotations

import base64
import socket
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.request import Request, urlopen

import numpy as np
import pytest

from app.vision.video_io import read_picture
from tests.support.studio_process import StudioProcess, running_studio, wait_for
from tests.support.trials.rendered import LENS, SIZE, VIEW, write_video
from tests.support.trials.tracks import RATE, stepping_track

pytestmark = pytest.mark.heavy

TRACK = stepping_track((0.0085, 0.0085), 1)
FILMED = TRACK.feet[::2]
"""Twice as fast as the robot, which halves the film."""
CORNERS = np.array([[-0.04, -0.04], [0.04, -0.04], [0.04, 0.04], [-0.04, 0.04]])
SETUP: dict[str, Any] = {
    "name": "under the glass",
    "size": list(SIZE),
    "lens": {"matrix": LENS.matrix.tolist(), "distortion": LENS.distortion.tolist()},
    "points": [
        {"pixel": pixel.tolist(), "place_cm": (place * 100).tolist()}
        for pixel, place in zip(LENS.bent(VIEW.pixels(CORNERS)), CORNERS, strict=True)
    ],
}


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("data")


@pytest.fixture(scope="module")
def studio(data: Path) -> Iterator[StudioProcess]:
    with running_studio(data) as running:
        yield running


@pytest.fixture(scope="module")
def colours(studio: StudioProcess) -> list[Any]:
    found: list[Any] = studio.ask("GET", "/api/setups").content["defaults"]["colours"]
    return found


@pytest.fixture(scope="module")
def setup(studio: StudioProcess) -> str:
    answer = studio.ask("POST", "/api/setups", SETUP)
    assert answer.status == 201, answer.content
    return str(answer.content["id"])


@pytest.fixture(scope="module")
def video(studio: StudioProcess, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    path = tmp_path_factory.mktemp("video") / "walk.avi"
    write_video(path, FILMED, RATE)
    answer = studio.ask("POST", "/api/videos?name=walk%20on%20glass.avi", path.read_bytes())
    assert answer.status == 201, answer.content
    kept: dict[str, Any] = answer.content
    return kept


def test_an_uploaded_video_tells_its_facts_and_shows_any_picture(
    studio: StudioProcess, video: dict[str, Any]
) -> None:
    assert (video["frames"], video["size"]) == (len(FILMED), list(SIZE))
    assert video["rate"] == pytest.approx(RATE)
    shown = read_picture(studio.blob(f"/api/videos/{video['id']}/picture.jpg?frame=200&most=320"), "200")
    assert shown.shape == (240, 320, 3)
    assert studio.ask("GET", f"/api/videos/{video['id']}/picture.jpg?frame=100000").status == 422
    assert [one["id"] for one in studio.ask("GET", "/api/videos").content["videos"]] == [video["id"]]


def test_a_file_that_is_sent_again_is_not_kept_twice(
    studio: StudioProcess, video: dict[str, Any], data: Path
) -> None:
    content = studio.blob(f"/api/videos/{video['id']}/file")
    again = studio.ask("POST", "/api/videos?name=other%20name.avi", content)
    assert (again.status, again.content["again"], again.content["id"]) == (200, True, video["id"])
    assert len(studio.ask("GET", "/api/videos").content["videos"]) == 1
    assert len(list((data / "videos").iterdir())) == 1
    other = studio.ask("POST", "/api/videos?name=longer.avi", content + b"\0")
    assert (other.status, other.content["again"]) == (201, False)
    studio.ask("DELETE", f"/api/videos/{other.content['id']}")


def test_many_pictures_are_looked_through_for_a_board_a_few_at_a_time(
    studio: StudioProcess, video: dict[str, Any]
) -> None:
    path, asked = f"/api/videos/{video['id']}/boards", {"columns": 4, "rows": 3}
    frames: list[int] | None = [7] * 100
    looked = 0
    while frames:
        answer = studio.ask("POST", path, {**asked, "frames": frames}).content
        looked += len(answer["boards"])
        assert answer["boards"]
        assert frames == [board["frame"] for board in answer["boards"]] + answer["left"]
        frames = answer["left"]
    assert looked == 100
    assert studio.ask("POST", path, {**asked, "frames": [0]}).content["left"] == []


def test_what_tracking_finds_in_a_picture_is_told_with_places_and_refusals(
    studio: StudioProcess, video: dict[str, Any], colours: list[Any]
) -> None:
    body = {"foot": 1, "colours": colours, "setup": SETUP}
    path = f"/api/videos/{video['id']}/look?frame=0"
    found = studio.ask("POST", path, body).content
    places = np.array([foot["place_cm"] for foot in found["feet"]])
    np.testing.assert_allclose(places, TRACK.feet[0] * 100, atol=0.06)
    assert found["spots"][found["chosen"]]["fit"]
    assert found["picture"].startswith("data:image/jpeg;base64,")
    small = studio.ask("POST", path, {**body, "limits": {"most_area": 100.0}}).content
    assert small["feet"] == [None] * 4
    assert "above 100" in small["spots"][0]["reason"]


def test_a_video_becomes_a_trial_beside_its_gaits_plan(
    studio: StudioProcess, video: dict[str, Any], setup: str
) -> None:
    order = {"setup": setup, "name": "filmed", "expected_cm": 1.0, "gait": "walk"}
    job = studio.ask("POST", f"/api/videos/{video['id']}/track", order).content["id"]
    wait_for(lambda: studio.ask("GET", f"/api/jobs/{job}").content["ended"] is not None, "the end", 90)
    ended = studio.ask("GET", f"/api/jobs/{job}").content
    assert (ended["state"], ended["kind"], ended["share"]) == ("done", "track", 1.0), ended
    trial = studio.ask("GET", f"/api/trials/{ended['result']['trial']}").content
    assert trial["figures"]["net_distance"] == pytest.approx(1.2, abs=0.03)
    assert trial["source"]["setup_revision"] == 1
    assert trial["ends_from"] == "tracks"
    assert ended["video_name"] == "walk on glass.avi"
    (listed,) = studio.ask("GET", "/api/videos").content["videos"]
    assert listed["trials"] == [{"id": trial["id"], "name": "filmed"}]


def test_tracking_that_is_cancelled_leaves_no_trial(
    studio: StudioProcess, video: dict[str, Any], setup: str
) -> None:
    order = {"setup": setup, "name": "cancelled", "expected_cm": 1.0}
    path = f"/api/videos/{video['id']}/track"
    first, second = (studio.ask("POST", path, order).content["id"] for _ in range(2))
    for job in (second, first):
        studio.ask("DELETE", f"/api/jobs/{job}")
        wait_for(lambda job=job: studio.ask("GET", f"/api/jobs/{job}").content["ended"], "its end", 90)  # type: ignore[misc]
    assert studio.ask("GET", f"/api/jobs/{second}").content["state"] == "cancelled"
    state = studio.ask("GET", f"/api/jobs/{first}").content["state"]
    names = [trial["name"] for trial in studio.ask("GET", "/api/trials").content["trials"]]
    assert names.count("cancelled") == (state == "done")


def test_a_setup_moves_on_by_revisions_is_deleted_and_comes_back(studio: StudioProcess) -> None:
    first = studio.ask("POST", "/api/setups", {**SETUP, "name": "side"}).content
    path = f"/api/setups/{first['id']}"
    changed = studio.ask("PUT", path, {"revision": 1, "setup": {**SETUP, "name": "other"}})
    assert changed.content["revision"] == 2
    late = studio.ask("PUT", path, {"revision": 1, "setup": SETUP})
    assert late.status == 409
    assert "has revision 2" in late.content["error"]
    assert studio.ask("GET", f"{path}?revision=1").content["setup"]["name"] == "side"
    assert studio.ask("DELETE", path).status == 200
    assert first["id"] not in [one["id"] for one in studio.ask("GET", "/api/setups").content["setups"]]
    assert studio.ask("POST", f"{path}/restore").content["setup"]["name"] == "other"


def test_a_setup_says_how_well_its_points_agree_and_where_the_grid_lies(studio: StudioProcess) -> None:
    view = studio.ask("POST", "/api/setups/check", SETUP).content
    assert (view["ready"], view["revision"]) == (True, 0)
    assert view["view"]["worst_mm"] < 0.01
    assert view["view"]["mm_per_pixel"] == pytest.approx(0.25, rel=0.1)
    assert len(view["view"]["grid"]) == 22
    few = studio.ask("POST", "/api/setups/check", {**SETUP, "points": SETUP["points"][:3]}).content
    assert not few["ready"]
    assert "3 points are clicked" in few["missing"][0]


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "is empty"),
        (b"no video at all", "cannot be read"),
        (b"RIFF\0\0\0\0AVI junk" * 100, "cannot be read"),
    ],
)
def test_what_is_no_video_is_refused_and_leaves_nothing(
    studio: StudioProcess, data: Path, content: bytes, words: str
) -> None:
    before = sorted(path.name for path in (data / "videos").iterdir())
    answer = studio.ask("POST", "/api/videos?name=notes.avi", content)
    assert answer.status == 422
    assert words in answer.content["error"]
    assert "notes.avi" in answer.content["error"]
    assert sorted(path.name for path in (data / "videos").iterdir()) == before


def test_an_upload_that_breaks_off_leaves_nothing(studio: StudioProcess, data: Path) -> None:
    before = sorted(path.name for path in (data / "videos").iterdir())
    host, port = studio.url.removeprefix("http://").strip("/").split(":")
    with socket.create_connection((host, int(port))) as line:
        head = (
            f"POST /api/videos?name=a.avi HTTP/1.1\r\nHost: {host}:{port}\r\nContent-Length: 5000000\r\n\r\n"
        )
        line.sendall(head.encode() + b"\0" * 2_000_000)
        wait_for(lambda: any((data / "videos").glob(".*.partial")), "the upload is on its way")
    wait_for(lambda: sorted(p.name for p in (data / "videos").iterdir()) == before, "it is gone")


@pytest.mark.parametrize(
    ("changes", "status", "words"),
    [
        ({"setup": "none"}, 404, "no setup none"),
        ({"expected_cm": -1}, 422, "expected_cm"),
        ({"gait": "none"}, 404, "none"),
    ],
)
def test_tracking_that_cannot_be_done_is_refused(
    studio: StudioProcess, video: dict[str, Any], setup: str, changes: dict[str, Any], status: int, words: str
) -> None:
    order = {"setup": setup, "name": "filmed", "expected_cm": 1.0, **changes}
    answer = studio.ask("POST", f"/api/videos/{video['id']}/track", order)
    assert answer.status == status
    assert words in answer.content["error"]


def test_a_setup_of_another_camera_is_refused_before_tracking(
    studio: StudioProcess, video: dict[str, Any]
) -> None:
    other = studio.ask("POST", "/api/setups", {**SETUP, "size": [1280, 720]}).content["id"]
    order = {"setup": other, "name": "filmed", "expected_cm": 1.0}
    answer = studio.ask("POST", f"/api/videos/{video['id']}/track", order)
    assert answer.status == 422
    assert "1280 × 720 px; these have 640 × 480" in answer.content["error"]


def test_a_picture_without_a_board_is_said_and_few_boards_make_no_lens(
    studio: StudioProcess, video: dict[str, Any]
) -> None:
    picture = studio.blob(f"/api/videos/{video['id']}/picture.jpg")
    board = studio.ask("POST", "/api/boards?columns=8&rows=5&name=a.jpg", picture).content
    assert (board["found"], board["size"]) == (False, list(SIZE))
    lens = studio.ask("POST", "/api/lens", {"columns": 8, "rows": 5, "boards": [board] * 3})
    assert lens.status == 422
    assert "found in 0 pictures" in lens.content["error"]


@pytest.mark.parametrize(
    ("picture", "words"),
    [
        (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR" + (30_000).to_bytes(4, "big") * 2, "30000 × 30000 pixels"),
        (b"no picture", "PNG or JPEG"),
    ],
)
def test_a_picture_that_cannot_be_read_is_refused(studio: StudioProcess, picture: bytes, words: str) -> None:
    answer = studio.ask("POST", "/api/boards?columns=8&rows=5&name=a.png", picture)
    assert answer.status == 422
    assert words in answer.content["error"]


def test_a_straightened_picture_comes_back(studio: StudioProcess, video: dict[str, Any]) -> None:
    picture = studio.blob(f"/api/videos/{video['id']}/picture.jpg")
    address = "data:image/jpeg;base64," + base64.b64encode(picture).decode()
    shown = studio.ask("POST", "/api/lens/look", {"lens": SETUP["lens"], "picture": address}).content
    content = base64.b64decode(shown["picture"].partition(",")[2])
    assert read_picture(content, "straight").shape == (480, 640, 3)
    assert studio.ask("POST", "/api/lens/look", {"lens": SETUP["lens"], "picture": "x,*"}).status == 422


def test_a_video_is_played_picture_by_picture(studio: StudioProcess, video: dict[str, Any]) -> None:
    last = video["frames"] - 3
    address = f"{studio.url}api/videos/{video['id']}/stream?from_frame={last}&speed=20"
    with urlopen(Request(address), timeout=30) as answer:
        assert "boundary=picture" in answer.headers["content-type"]
        assert 1 <= answer.read().count(b"--picture") <= 3


def test_a_deleted_video_comes_back(studio: StudioProcess, video: dict[str, Any]) -> None:
    path = f"/api/videos/{video['id']}"
    assert studio.ask("DELETE", path).status == 200
    assert studio.ask("GET", "/api/videos").content["videos"] == []
    assert studio.ask("POST", f"{path}/restore").content["deleted"] is False
