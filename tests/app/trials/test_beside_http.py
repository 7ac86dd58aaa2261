"""What stands beside trials by HTTP: plan, physics, scene, bands, photos; refusals that name the field."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from core.trials.track_csv import format_track_csv
from tests.core.trials.test_picture_size import picture
from tests.core.trials.tracks import stepping_track
from tests.studio_process import StudioProcess, running_studio, wait_for

TRIAL: dict[str, Any] = {
    "name": "on glass",
    "csv": format_track_csv(stepping_track((0.0085, 0.0085), 1)),
    "expected_cm": 1.0,
    "gait": "walk",
}


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    with running_studio(tmp_path_factory.mktemp("data")) as running:
        yield running


@pytest.fixture(scope="module")
def path(studio: StudioProcess) -> str:
    return f"/api/trials/{studio.ask('POST', '/api/trials', TRIAL).content['id']}"


def test_physics_is_asked_for_what_was_sent_and_comes_beside_the_trial(
    studio: StudioProcess, path: str
) -> None:
    assert [row["source"] for row in studio.ask("GET", f"{path}/beside").content["rows"]] == [
        "planned",
        "tracked",
    ]
    begun = studio.ask("POST", f"{path}/simulation")
    assert (begun.status, begun.content["state"]) == (202, "running")

    def is_done() -> bool:
        return bool(studio.ask("GET", f"{path}/beside").content["simulation"]["state"] == "done")

    wait_for(is_done, "the simulation is done", 120.0)
    simulated = studio.ask("GET", f"{path}/beside").content["rows"][1]
    assert simulated["source"] == "simulated"
    assert simulated["net_distance"] == pytest.approx(1.0, abs=0.1)


def test_a_track_in_the_scene_and_a_band_of_one_trial_lie_in_the_plans_frame(
    studio: StudioProcess, path: str
) -> None:
    scene = studio.ask("GET", f"{path}/scene").content
    assert (scene["robot"], scene["laps"], len(scene["feet"])) == ("deltawalker", 1, 4)
    trial = scene["id"]
    band = studio.ask("GET", f"/api/trials/band?trial={trial}").content
    assert band["feet"][0]["place"]["mean"]["x"][0] == pytest.approx(scene["feet"][0][0][0] * 100, abs=0.01)
    assert studio.ask("GET", f"/api/trials/band?trial={trial}&trial={trial}").status == 422
    assert studio.ask("GET", "/api/trials/band?trial=none").status == 404


def test_a_photo_is_kept_captioned_deleted_and_brought_back(studio: StudioProcess, path: str) -> None:
    kind = {"content-type": "image/png"}
    added = studio.ask("POST", f"{path}/photos?name=tape.png", picture("PNG", (300, 100)), kind)
    assert (added.status, added.content["width"]) == (201, 300)
    photo = f"{path}/photos/{added.content['id']}"
    assert studio.ask("PUT", photo, {"caption": " new tape "}).content["caption"] == "new tape"
    assert studio.blob(f"{photo}/picture?small=true").startswith(b"\xff\xd8")
    assert studio.ask("DELETE", photo).content["deleted"]
    assert studio.ask("GET", f"{path}/photos").content["photos"] == []
    assert studio.ask("POST", f"{photo}/restore").content["caption"] == "new tape"


def test_what_is_no_photo_is_refused_with_a_sentence(studio: StudioProcess, path: str) -> None:
    refused = studio.ask("POST", f"{path}/photos?name=notes.txt", b"no picture")
    assert refused.status == 422
    assert refused.content["error"].startswith("notes.txt is no PNG or JPEG picture")
    assert studio.ask("POST", "/api/trials/none/photos", picture("PNG", (3, 3))).status == 404
    assert studio.ask("PUT", f"{path}/photos/none", {"caption": "lost"}).status == 404


@pytest.mark.parametrize("path", ["beside", "scene", "photos"])
def test_beside_an_unknown_trial_there_is_nothing(studio: StudioProcess, path: str) -> None:
    assert studio.ask("GET", f"/api/trials/none/{path}").status == 404
