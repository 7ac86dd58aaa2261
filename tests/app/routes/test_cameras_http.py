"""A video file served as a camera: live picture, unplugging, and recording with the run up to its trial."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from app.emulator.profiles import ProfileName
from app.vision.video_io import read_picture
from tests.app.routes.test_videos_http import FILMED, SETUP
from tests.support.patience import patient_robot
from tests.support.studio_process import StudioProcess, running_studio, wait_for
from tests.support.trials.rendered import SIZE, write_video
from tests.support.trials.tracks import RATE

pytestmark = [pytest.mark.heavy, pytest.mark.alone]

SLOW = 120.0
"""Longest wait on a machine that has much else to do, s."""

SPEED = 3.0
"""Of the emulated robot: its walk lasts long enough for a track, and no longer."""


@pytest.fixture(scope="module")
def film(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("video") / "walk.avi"
    write_video(path, FILMED, RATE)
    return path


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory, film: Path) -> Iterator[StudioProcess]:
    with patient_robot(SPEED, profile=ProfileName.PUBLISHED) as robot:
        words = ("--robot", robot.device, "--camera", f"Under the glass={film}", "--camera", f"Side={film}")
        with running_studio(tmp_path_factory.mktemp("data"), *words) as running:
            yield running


def camera(studio: StudioProcess, name: str = "under-the-glass") -> dict[str, Any]:
    cameras = studio.ask("GET", "/api/cameras").content["cameras"]
    found: dict[str, Any] = next(one for one in cameras if one["id"] == name)
    return found


def live(studio: StudioProcess, name: str) -> None:
    """Waits for a camera's first picture, whose process takes its time to start."""

    def is_there() -> bool:
        try:
            return bool(studio.blob(f"/api/cameras/{name}/picture.jpg"))
        except OSError:
            return False

    wait_for(is_there, f"the camera {name} is live", SLOW)


def test_a_file_is_a_camera_with_a_live_picture_and_tracking(studio: StudioProcess) -> None:
    assert (camera(studio)["kind"], camera(studio)["name"]) == ("file", "Under the glass")
    live(studio, "under-the-glass")
    picture = read_picture(studio.blob("/api/cameras/under-the-glass/picture.jpg"), "live")
    assert picture.shape == (SIZE[1], SIZE[0], 3)
    assert camera(studio)["state"] == "live"
    colours = studio.ask("GET", "/api/setups").content["defaults"]["colours"]
    body = {"foot": None, "colours": colours, "setup": SETUP}
    found = studio.ask("POST", "/api/cameras/under-the-glass/look", body).content
    assert all(foot["place_cm"] is not None for foot in found["feet"])


def test_an_unplugged_camera_is_said_and_comes_back(studio: StudioProcess, film: Path) -> None:
    live(studio, "side")
    away = film.with_suffix(".away")
    film.rename(away)
    try:
        wait_for(lambda: camera(studio, "side")["state"] == "unplugged", "it is unplugged", SLOW)
        answer = studio.ask("GET", "/api/cameras/side/picture.jpg")
        assert answer.status == 503
        assert "Plug" in answer.content["error"]
    finally:
        away.rename(film)
    wait_for(lambda: camera(studio, "side")["state"] == "live", "it is back", SLOW)


@pytest.mark.parametrize(
    ("name", "changes", "status", "words"),
    [
        ("none", {"records": True}, 404, "no camera none"),
        ("side", {"setup": "none"}, 404, "no setup none"),
        ("side", {"use": "under", "records": True}, 422, "has no setup"),
        ("side", {"use": "above"}, 422, "use"),
    ],
)
def test_what_a_camera_cannot_be_is_refused(
    studio: StudioProcess, name: str, changes: dict[str, Any], status: int, words: str
) -> None:
    answer = studio.ask("PUT", f"/api/cameras/{name}", changes)
    assert answer.status == status
    assert words in answer.content["error"]


def test_a_run_that_was_recorded_becomes_a_trial_beside_its_plan(studio: StudioProcess, film: Path) -> None:
    setup = studio.ask("POST", "/api/setups", SETUP).content["id"]
    under = {"use": "under", "setup": setup, "records": True}
    assert studio.ask("PUT", "/api/cameras/under-the-glass", under).content["records"]
    assert studio.ask("PUT", "/api/cameras/side", {"use": "side", "records": True}).content["records"]
    for name in ("under-the-glass", "side"):
        live(studio, name)
    run = walked(studio)
    wait_for(lambda: camera(studio)["recording"], "it records", SLOW)
    wait_for(lambda: studio.robot()["run"]["phase"] == "streaming", "the walk", SLOW)
    unplugged(studio, film)
    wait_for(lambda: studio.robot()["robot"] in ("done", "fault"), "the run ended", SLOW)
    assert studio.robot()["robot"] == "done", studio.robot()["sentence"]
    wait_for(lambda: kept(studio, run), "both recordings are kept", SLOW)
    videos = {one["camera"]: one for one in studio.ask("GET", f"/api/videos?run={run}").content["videos"]}
    assert videos["side"]["trial"] == ""
    recorded = videos["under-the-glass"]
    assert recorded["trial"], recorded["sentence"]
    trial = studio.ask("GET", f"/api/trials/{recorded['trial']}").content
    assert (trial["run"], trial["source"]["video"]) == (run, recorded["id"])
    assert trial["ends_from"] == "run"
    assert "gave no pictures from" in trial["remarks"][0]
    assert "missing or without any foot" in trial["remarks"][1]
    assert trial["expected_cm"] == pytest.approx(1.0, abs=0.05)
    assert trial["first_seconds"] > 0.0
    picture = read_picture(studio.blob(f"/api/videos/{recorded['id']}/picture.jpg?frame=3"), "3")
    assert np.ptp(picture) > 100


def walked(studio: StudioProcess) -> str:
    """Sends the walk; the run's id."""
    studio.ask("GET", "/api/gaits/walk/view")
    studio.ask("POST", "/api/gaits/walk/check")
    approved = studio.ask("POST", "/api/gaits/walk/approve", {"by": "Ada", "accept_warnings": True})
    assert approved.status == 200, approved.content
    assert studio.ask("POST", "/api/robot/connect").status == 200
    wait_for(lambda: studio.robot()["robot"] == "disarmed", "the robot is up", SLOW)
    assert studio.ask("POST", "/api/robot/arm", {"by": "Ada"}).status == 200
    sent = studio.ask("POST", "/api/robot/send", {"gait": "walk", "by": "Ada"})
    assert sent.status == 200, sent.content
    return str(studio.robot()["run"]["id"])


def unplugged(studio: StudioProcess, film: Path) -> None:
    """Takes both cameras away in the middle of the run, until that was noticed."""
    away = film.with_suffix(".away")
    film.rename(away)
    wait_for(lambda: camera(studio)["state"] == "unplugged", "it is unplugged", SLOW)
    away.rename(film)


def kept(studio: StudioProcess, run: str) -> bool:
    videos = studio.ask("GET", f"/api/videos?run={run}").content["videos"]
    return len(videos) == 2 and all(video["state"] == "kept" for video in videos)
