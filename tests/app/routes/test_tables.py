"""Segment tables over HTTP: made of a drawing, mended, and refused with a sentence."""

from __future__ import annotations

import json
from typing import Any

import pytest
from fastapi import FastAPI
from starlette.testclient import TestClient

from app.documents.gait_json import gait_content
from app.routes.gaits.segment_tables import router
from app.web.dependencies import install_error_handlers
from core.gait.gait import drawn_timeline
from core.library.library import library

MADE, REPAIRS, POSE = "/api/tables/made", "/api/tables/repairs", "/api/tables/pose"


@pytest.fixture(scope="module")
def client() -> TestClient:
    app = FastAPI()
    install_error_handlers(app)
    app.include_router(router)
    return TestClient(app)


def content(gait_id: str) -> dict[str, Any]:
    return gait_content(library()[gait_id].gait)


def test_a_table_is_made_of_a_drawing_with_room(client: TestClient) -> None:
    walk = library()["walk"].gait.with_options(phase_knots=6, closing_knots=6)
    feet = gait_content(walk)["timeline"] | {
        "feet": ["".join("01"[int(s)] for s in row) for row in drawn_timeline(walk).stance],
        "locked": None,
    }
    answer = client.post(MADE, json={"document": gait_content(walk) | {"timeline": feet}}).json()
    assert answer["sentence"] is None
    assert answer["table"]["samples_per_segment"] == 3


def test_a_drawing_without_room_says_why(client: TestClient) -> None:
    answer = client.post(MADE, json={"document": content("walk")}).json()
    assert answer["table"] is None
    assert "segments change at samples" in answer["sentence"]


def test_a_gait_that_has_a_table_keeps_it(client: TestClient) -> None:
    manual = content("walk-manual-0")
    assert client.post(MADE, json={"document": manual}).json()["table"] == manual["segment_table"]


def test_a_table_that_does_not_fit_is_mended_around_what_must_stay(client: TestClient) -> None:
    table = content("walk-manual-0")["segment_table"]
    table["feet"][0][3] = "Lift A"
    found = client.post(REPAIRS, json={"table": table, "kept": [[0, 3]]}).json()["repairs"]
    assert [(one["foot"], one["first"], one["inserted"]) for one in found] == [(0, 4, False), (0, 4, True)]
    assert all(one["table"]["feet"][0][3] == "Lift A" for one in found)
    assert found[1]["names"] == ["Push A"]


@pytest.mark.parametrize(
    ("path", "body", "words"),
    [
        (MADE, {}, "document"),
        (MADE, {"document": {"format": "nothing"}}, "not a gait document"),
        (REPAIRS, {"table": {}}, "samples_per_segment"),
        (REPAIRS, {"kept": []}, "table"),
    ],
)
def test_what_cannot_be_read_is_refused(
    client: TestClient, path: str, body: dict[str, Any], words: str
) -> None:
    answer = client.post(path, json=body)
    assert answer.status_code == 422
    assert words in answer.json()["error"]


def test_uneven_rows_are_refused(client: TestClient) -> None:
    table = content("walk-manual-0")["segment_table"]
    table["feet"][0].append("Wait A")
    answer = client.post(REPAIRS, json={"table": table})
    assert answer.status_code == 422
    assert "as many segments as foot 1" in answer.json()["error"]


def test_a_document_with_a_height_out_of_the_motors_travel_is_refused(client: TestClient) -> None:
    document = content("walk-manual-0")
    document["segment_table"]["definitions"]["z"]["Base"] = 0.099
    answer = client.post(MADE, json={"document": document})
    assert answer.status_code == 422
    assert "The height “Base” is 99 mm" in answer.json()["error"]
    document["segment_table"]["definitions"]["z"]["Base"] = 0.02
    assert client.post(MADE, json={"document": document}).status_code == 200


def test_a_pose_becomes_the_last_segment_and_says_what_names_cannot(client: TestClient) -> None:
    strokes = [8.0] * 3 + [11.0, 8.0, 8.0] + [8.0] * 6
    manual = content("walk-manual-0")
    answer = client.post(POSE, json={"document": manual, "strokes_mm": strokes}).json()
    assert answer["name"] == "Pose 1"
    assert answer["segment"] == len(manual["segment_table"]["feet"][0]) + 1
    assert [len(row) for row in answer["table"]["feet"]] == [answer["segment"]] * 4
    assert answer["table"]["definitions"]["z"]["Pose 1"] == 0.008
    assert [sentence[:19] for sentence in answer["sentences"]] == ["Foot 2 stands 4.7 m"]


@pytest.mark.parametrize(
    ("gait", "strokes", "where"),
    [
        ("walk-manual-0", [8.0] * 11, "strokes_mm"),
        ("walk-manual-0", [8.0] * 11 + [-1.0], "strokes_mm"),
        ("walk", [8.0] * 12, "segment_table"),
    ],
)
def test_a_pose_that_a_table_cannot_take_is_refused(
    client: TestClient, gait: str, strokes: list[float], where: str
) -> None:
    refused = client.post(POSE, json={"document": content(gait), "strokes_mm": strokes})
    assert (refused.status_code, refused.json()["where"]) == (422, where)


@pytest.mark.parametrize("field", ["feet", "link"])
def test_half_a_character_is_refused_with_a_sentence(client: TestClient, field: str) -> None:
    table = content("walk-manual-0")["segment_table"]
    table[field] = [["Zero A\ud800"]] + table["feet"][1:]
    sent = json.dumps({"table": table}).encode()
    answer = client.post(REPAIRS, content=sent, headers={"Content-Type": "application/json"})
    assert answer.status_code == 422
    assert "half a character" in answer.json()["error"]
    assert "table" in answer.json()["error"] or answer.json()["where"] == "table"
