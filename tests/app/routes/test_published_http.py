"""The published experiments by HTTP: tables, the folder of the published data, and gaits that open."""

from __future__ import annotations

from typing import Any

import pytest

from tests.support.studio_process import StudioProcess


@pytest.fixture(scope="module")
def studio(lent_studio: StudioProcess) -> StudioProcess:
    return lent_studio


def test_every_table_is_listed_and_has_its_printed_figures(studio: StudioProcess) -> None:
    listed = studio.ask("GET", "/api/published").content
    assert listed["reference"] == {"folder": "", "sentence": ""}
    assert {table["state"] for table in listed["tables"]} == {"none"}
    table = studio.ask("GET", "/api/published/t5-5").content
    keys = {column["key"] for column in table["columns"]}
    assert {"published.distance_cm", "ours.distance_cm", "movement"} <= keys
    first = table["rows"][0]
    assert set(first["cells"]) == keys
    assert (first["id"], first["cells"]["published.distance_cm"]) == ("walk-10-step", 1.2)
    assert (first["cells"]["ours.distance_cm"], first["opens"], first["has_plot"]) == (None, ["ours"], False)


def test_a_row_opens_its_gait_once(studio: StudioProcess) -> None:
    opened = studio.ask("POST", "/api/published/t5-2/amble-1/open", {"source": "ours"})
    assert opened.status == 201
    assert opened.content["name"] == "Amble version 1 × 3 (T 5.2)"
    assert opened.content["document"]["iterations"] == 3
    again = studio.ask("POST", "/api/published/t5-2/amble-1/open", {})
    assert again.content["id"] == opened.content["id"]
    changed = {**opened.content["document"], "step": [0.004, 0.004, 0.0]}
    revision = opened.content["revision"]
    assert studio.ask("PUT", f"/api/gaits/{opened.content['id']}?revision={revision}", changed).status == 200
    third = studio.ask("POST", "/api/published/t5-2/amble-1/open", {})
    assert third.content["id"] != opened.content["id"]


@pytest.mark.parametrize(
    ("method", "path", "body", "status", "words"),
    [
        ("GET", "t9", None, 404, "no published table “t9”"),
        ("POST", "t9/compute", None, 404, "no published table"),
        ("POST", "t4-2/walk-11/open", {}, 404, "T 4.2 has no row “walk-11”"),
        ("POST", "t4-2/walk-10/open", {"source": "published"}, 404, "is not at hand"),
        ("POST", "t4-2/walk-10/open", {"source": "theirs"}, 422, "source"),
        ("GET", "t4-2/walk-10/plot.svg", None, 404, "no plot of Walk 10 mm"),
        ("PUT", "reference", {"folder": "/nowhere/at/all"}, 422, "There is no folder /nowhere/at/all"),
        ("PUT", "reference", {"folder": "\0"}, 422, "U+0000"),
        ("PUT", "reference", {}, 422, "folder"),
    ],
)
def test_what_cannot_be_is_refused_in_a_sentence(
    studio: StudioProcess, method: str, path: str, body: dict[str, Any] | None, status: int, words: str
) -> None:
    answer = studio.ask(method, f"/api/published/{path}", body)
    assert answer.status == status
    assert words in answer.content["error"]


def test_a_table_that_is_not_computed_has_nothing_to_cancel(studio: StudioProcess) -> None:
    line = studio.ask("DELETE", "/api/published/t4-2/compute")
    assert (line.status, line.content["state"], line.content["done"]) == (200, "none", 0)
