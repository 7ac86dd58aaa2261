"""A gait that could not be shown is not stored, and no file of the data folder takes the list away."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.support.studio_process import StudioProcess, running_studio

TOO_MANY: list[tuple[str, Any]] = [
    ("phase_knots", 51),
    ("phase_knots", 1000),
    ("phase_knots", 10**9),
    ("phase_knots", 2**70),
    ("closing_knots", 10**9),
    ("closing_knots", -1),
    ("body_speed", 1e308),
]


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("data")


@pytest.fixture(scope="module")
def studio(data: Path) -> Iterator[StudioProcess]:
    with running_studio(data) as running:
        yield running


def listed(studio: StudioProcess) -> dict[str, Any]:
    answer = studio.ask("GET", "/api/gaits")
    assert answer.status == 200
    return {line["id"]: line for line in answer.content["gaits"]}


@pytest.mark.parametrize(("option", "value"), TOO_MANY)
def test_an_edit_that_could_not_be_shown_is_refused_and_not_stored(
    option: str, value: object, studio: StudioProcess
) -> None:
    before = studio.ask("GET", "/api/gaits/walk/view").content
    document = before["document"]
    document["options"] = {**document["options"], option: value}
    answer = studio.ask("PUT", "/api/gaits/walk", document)
    assert answer.status == 422
    assert option in answer.content["error"] or option.replace("_", " ") in answer.content["error"]
    after = studio.ask("GET", "/api/gaits/walk/view").content
    assert (after["revision"], after["document"]["options"]) == (
        before["revision"],
        studio.document("walk")["options"],
    )
    assert after["document"]["options"][option] != value
    assert listed(studio)["walk"]["edited"] is before["edited"]


def test_a_file_whose_gait_could_not_be_shown_leaves_the_list_whole(
    studio: StudioProcess, data: Path
) -> None:
    names = set(listed(studio))
    document = studio.document("walk")
    document["options"]["phase_knots"] = 10**9
    path = data / "gaits" / "too-long.json"
    path.write_text(json.dumps(document))
    assert names <= set(listed(studio))
    path.unlink()


def test_phases_that_could_not_be_drawn_are_no_hindrance_to_a_timeline_drawn_by_hand(
    studio: StudioProcess,
) -> None:
    made = studio.ask("POST", "/api/gaits?copy_of=walk&name=By%20hand", {}).content
    document = made["document"]
    document["iterations"] = 20
    document["options"]["phase_knots"] = 50
    answer = studio.ask("PUT", f"/api/gaits/{made['id']}", document)
    assert answer.status == 200
    assert listed(studio)[made["id"]]["source"] == "drawn"


@pytest.mark.parametrize("revision", [2**63, 2**70, -1, 0])
@pytest.mark.parametrize(
    "path",
    ["/api/gaits/walk?revision={}", "/api/gaits/walk/versions/{}", "/api/gaits/walk/versions/{}/difference"],
)
def test_a_revision_that_no_store_can_hold_is_refused(
    path: str, revision: int, studio: StudioProcess
) -> None:
    method = "PUT" if "?" in path else "GET"
    answer = studio.ask(method, path.format(revision), studio.document("walk") if method == "PUT" else None)
    assert answer.status == 422


def test_an_approval_in_an_invisible_name_is_refused(studio: StudioProcess) -> None:
    verdict = studio.ask("POST", "/api/gaits/walk/check").content
    asked = {"by": "\u200b\u2060 \u3164", "verdict_hash": verdict["hash"], "accept_warnings": True}
    answer = studio.ask("POST", "/api/gaits/walk/approve", asked)
    assert answer.status == 409
    assert answer.content["where"] == "by"
    assert studio.ask("GET", "/api/gaits/walk/view").content["approval"] is None
