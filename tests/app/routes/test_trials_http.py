"""Trials by HTTP: a track beside the gait's plan, in the scene, in bands, with photos; refusals."""

from __future__ import annotations

from typing import Any

import pytest

from core.vision.track_csv import format_track_csv
from tests.core.vision.test_image_header import picture
from tests.support.studio_process import StudioProcess
from tests.support.trials.tracks import stepping_track

CSV = format_track_csv(stepping_track((0.0085, 0.0085), 1))
TRIAL: dict[str, Any] = {"name": "on glass", "csv": CSV, "expected_cm": 1.0}
PLANNED = {**TRIAL, "gait": "walk"}


@pytest.fixture(scope="module")
def studio(lent_studio: StudioProcess) -> StudioProcess:
    return lent_studio


def test_a_trial_is_kept_beside_its_gaits_plan_and_can_be_changed(studio: StudioProcess) -> None:
    answer = studio.ask("POST", "/api/trials", {**TRIAL, "gait": "walk"})
    assert answer.status == 201
    trial = answer.content
    assert trial["gait_name"] == "Walk 10 mm"
    assert trial["figures"]["net_distance"] == pytest.approx(1.2, abs=0.02)
    assert trial["plan"]["figures"]["net_distance"] == pytest.approx(1.0, abs=0.01)
    path = f"/api/trials/{trial['id']}"
    change = {"revision": trial["revision"], "note": "new tape"}
    assert studio.ask("PUT", path, change).content["note"] == "new tape"
    assert studio.ask("PUT", path, change).status == 409
    assert [line["id"] for line in studio.ask("GET", "/api/trials").content["trials"]] == [trial["id"]]
    assert studio.ask("DELETE", path).status == 200
    assert studio.ask("GET", "/api/trials").content["trials"] == []
    assert "Bring it back" in studio.ask("PUT", path, {**change, "revision": 2}).content["error"]
    assert studio.ask("POST", f"{path}/restore").content["note"] == "new tape"


@pytest.mark.parametrize(
    ("changes", "status", "words"),
    [
        ({"csv": "X\n"}, 422, "line 1: the header"),
        ({"expected_cm": 0.0}, 422, "expected_cm"),
        ({"iterations": 40}, 422, "too few for 40 iterations"),
        ({"gait": "none"}, 404, "none"),
        ({"run": "none"}, 404, "none"),
    ],
)
def test_what_cannot_be_kept_is_refused_with_a_sentence(
    studio: StudioProcess, changes: dict[str, Any], status: int, words: str
) -> None:
    answer = studio.ask("POST", "/api/trials", {**TRIAL, **changes})
    assert answer.status == status
    assert words in answer.content["error"]


def test_a_track_in_another_form_is_the_same_trial_and_the_answer_says_so(studio: StudioProcess) -> None:
    usual = studio.ask("POST", "/api/trials", TRIAL).content
    text = CSV.replace(",", ";").replace(".", ",")
    found = studio.ask("POST", "/api/trials", {**TRIAL, "csv": text}).content
    assert usual["remarks"] == []
    assert found["remarks"] == ["Read with ; between the numbers and a decimal comma."]
    assert found["figures"] == usual["figures"]
    for trial in (usual, found):
        assert studio.ask("DELETE", f"/api/trials/{trial['id']}").status == 200


def test_an_unknown_trial_is_not_found(studio: StudioProcess) -> None:
    assert studio.ask("GET", "/api/trials/none").status == 404


@pytest.fixture(scope="module")
def path(studio: StudioProcess) -> str:
    return f"/api/trials/{studio.ask('POST', '/api/trials', PLANNED).content['id']}"


def test_plan_and_track_stand_beside_each_other_before_physics_is_there(
    studio: StudioProcess, path: str
) -> None:
    assert [row["source"] for row in studio.ask("GET", f"{path}/beside").content["rows"]] == [
        "planned",
        "tracked",
    ]
    begun = studio.ask("POST", f"{path}/simulation")
    assert begun.status == 202
    assert begun.content["state"] in ("running", "done")


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


@pytest.mark.parametrize("what", ["beside", "scene", "photos", "report"])
def test_beside_an_unknown_trial_there_is_nothing(studio: StudioProcess, what: str) -> None:
    assert studio.ask("GET", f"/api/trials/none/{what}").status == 404


def test_reports_come_as_files(studio: StudioProcess, path: str) -> None:
    assert studio.text(f"{path}/report").startswith("<!doctype html>")
    assert "Gaits compared" in studio.text("/api/trials/report")


def test_frame_times_time_a_track_and_are_kept_with_it(studio: StudioProcess) -> None:
    count = CSV.count("\n") - 1
    times = [frame / 13.0 if frame < 100 else 100 / 13.0 + (frame - 100) / 20.0 for frame in range(count)]
    body = {**TRIAL, "frame_times": "time (s)\n" + "\n".join(map(repr, times))}
    trial = studio.ask("POST", "/api/trials", body).content
    assert trial["seconds"] == pytest.approx(times[-1])
    assert studio.ask("GET", f"/api/trials/{trial['id']}").content["seconds"] == trial["seconds"]
    assert (trial["source"], trial["remarks"]) == (None, [])
    assert studio.ask("DELETE", f"/api/trials/{trial['id']}").status == 200
    refusals: dict[str, dict[str, Any]] = {
        "frame times of on glass:2: 0 s does not come after": {"frame_times": "0\n0\n"},
        f"has 2 times, and on glass has {count} frames": {"frame_times": "0\n0.1\n"},
        "holds 0 times": {"frame_times": ""},
        "either frame_rate or frame_times": {"frame_times": "0\n0.1\n", "frame_rate": 13.0},
    }
    for sentence, changes in refusals.items():
        answer = studio.ask("POST", "/api/trials", {**TRIAL, **changes})
        assert answer.status == 422
        assert sentence in answer.content["error"]
