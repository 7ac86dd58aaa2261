"""Exports and imports over HTTP, from a real process."""

from __future__ import annotations

import json
import re
import urllib.error
import urllib.request
from collections.abc import Callable, Iterator
from email.message import Message
from pathlib import Path
from typing import Any

import pytest

from app.documents.gait_json import gait_content, gait_schema
from app.export.formats import ExportFormat
from core.library.library import library
from core.motion.phase_list import format_phases
from core.wire.trajectory_csv import format_companion, format_trajectory_csv, parse_trajectory_csv
from tests.support.reference import reference_path
from tests.support.studio_process import StudioProcess, running_studio, wait_for

TYPES = {
    "json": ("walk.gait.json", "application/json"),
    "csv": ("walk.csv", "text/csv"),
    "companion": ("walk.footfall.json", "application/json"),
    "waypoints": ("walk.waypoints.csv", "text/csv"),
    "npz": ("walk.npz", "application/octet-stream"),
    "phases": ("walk.phases.json", "application/json"),
    "svg": ("walk.svg", "image/svg+xml"),
    "png": ("walk.png", "image/png"),
    "html": ("walk.html", "text/html"),
}


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    with running_studio(tmp_path_factory.mktemp("data")) as running:
        yield running


def download(studio: StudioProcess, path: str) -> tuple[int, Message, bytes]:
    try:
        with urllib.request.urlopen(studio.url + path, timeout=60) as answer:
            return answer.status, answer.headers, answer.read()
    except urllib.error.HTTPError as error:
        with error:
            return error.code, error.headers, error.read()


def every_knot(studio: StudioProcess, gait_id: str) -> bytes:
    """A built-in gait's waypoints, one a knot, as a file."""
    document = gait_content(library()[gait_id].gait.with_options(merge=0.0, stop_bound=None))
    made = studio.ask("POST", "/api/gaits", {**document, "name": f"Every knot of {gait_id}"}).content["id"]
    return download(studio, f"api/gaits/{made}/export/waypoints")[2]


def listed(studio: StudioProcess) -> dict[str, Any]:
    return {gait["id"]: gait for gait in studio.ask("GET", "/api/gaits").content["gaits"]}


def test_the_description_of_the_interface_leads_to_the_published_schema(studio: StudioProcess) -> None:
    paths = studio.ask("GET", "/openapi.json").content["paths"]
    for path, verb in (("/api/gaits", "post"), ("/api/gaits/{gait_id}", "put")):
        schema = paths[path][verb]["requestBody"]["content"]["application/json"]["schema"]
        assert studio.ask("GET", schema["$ref"]).content == gait_schema()


def test_a_copy_of_a_gait_with_the_longest_name_is_made(studio: StudioProcess) -> None:
    long = studio.ask("POST", f"/api/gaits?copy_of=walk&name={'n' * 120}").content
    copy = studio.ask("POST", f"/api/gaits?copy_of={long['id']}")
    assert (copy.status, copy.content["name"]) == (201, "n" * 115 + " copy")
    assert copy.content["document"]["timeline"] == long["document"]["timeline"]


def test_a_result_that_is_not_saved_yet_shows_in_the_list(studio: StudioProcess) -> None:
    assert listed(studio)["c-gait"]["edited"] is False
    job = studio.ask("POST", "/api/jobs", {"kind": "optimise", "gait": "c-gait"}).content["id"]
    wait_for(lambda: studio.ask("GET", f"/api/jobs/{job}").content["ended"] is not None, "the job ended")
    assert listed(studio)["c-gait"]["edited"] is True


@pytest.mark.parametrize("form", list(ExportFormat))
def test_every_form_is_a_download_with_its_name_and_type(form: str, studio: StudioProcess) -> None:
    status, headers, content = download(studio, f"api/gaits/walk/export/{form}")
    name, media_type = TYPES[form]
    assert status == 200
    assert headers.get_content_type() == media_type
    assert headers.get_filename() == name
    assert headers.get_content_disposition() == "attachment"
    assert content


def test_trajectory_and_companion_belong_together(studio: StudioProcess) -> None:
    text, companion = (
        download(studio, f"api/gaits/walk/export/{form}")[2].decode() for form in ("csv", "companion")
    )
    assert parse_trajectory_csv(text, "walk.csv", companion).assumptions == ()


def test_a_gait_without_a_plan_is_refused_with_the_reason(studio: StudioProcess) -> None:
    document = studio.ask("GET", "/api/gaits/walk").content
    document["timeline"]["feet"] = ["1" * 5 + "0" * 10 + "1" * 30] * 3 + ["1" * 45]
    gait_id = studio.ask("POST", "/api/gaits", {**document, "name": "Three fly"}).content["id"]
    for form in ("csv", "companion", "waypoints", "npz", "html"):
        status, _, content = download(studio, f"api/gaits/{gait_id}/export/{form}")
        assert status == 422, form
        assert json.loads(content)["error"].startswith("This gait has no motion to export: ")
    assert download(studio, f"api/gaits/{gait_id}/export/svg")[0] == 200


def test_unknown_gaits_and_forms_are_refused(studio: StudioProcess) -> None:
    assert download(studio, "api/gaits/nobody/export/svg")[0] == 404
    status, _, content = download(studio, "api/gaits/walk/export/pdf")
    assert status == 422
    assert "json" in json.loads(content)["error"]


def test_a_trajectory_becomes_a_gait_and_what_was_assumed_is_said(studio: StudioProcess) -> None:
    text = reference_path("trajectories/direction2/ambl_b.csv").read_bytes()
    path = "/api/gaits/import?file=ambl_b.csv&name=Lab%20amble"
    answer = studio.ask("POST", path, text, {"content-type": "text/csv"})
    assert answer.status == 201
    document = answer.content["document"]
    assert (document["name"], document["direction"], document["order"]) == ("Lab amble", 2, [3, 1, 4, 2])
    assert answer.content["remarks"][0].startswith("The motion of ambl_b.csv is kept as it stands")
    assert any("ambl_b.csv has no companion" in remark for remark in answer.content["remarks"])
    assert document["recorded"]["text"].encode() == text
    assert studio.ask("GET", f"/api/gaits/{answer.content['id']}").content == document


def with_count(text: str) -> str:
    """The text with a first column as pandas writes it."""
    return "".join(f"{at - 1},{line}\n" if at else f",{line}\n" for at, line in enumerate(text.splitlines()))


@pytest.mark.parametrize("form", ["csv", "waypoints"])
@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (
            lambda t: t.replace(",", ";").replace(".", ","),
            "Read with ; between the numbers and a decimal comma.",
        ),
        (lambda t: t.replace(",", "\t"), "Read with tabs between the numbers."),
        (with_count, "The first column counts the rows and was left out."),
    ],
    ids=["semicolons", "tabs", "count"],
)
def test_an_unusual_file_is_kept_as_it_is_and_exported_in_the_usual_form(
    change: Callable[[str], str], sentence: str, form: str, studio: StudioProcess
) -> None:
    csv = download(studio, "api/gaits/walk/export/csv")[2] if form == "csv" else every_knot(studio, "walk")
    usual = csv.decode()
    text = change(usual)
    answer = studio.ask("POST", "/api/gaits/import?file=mine.csv", text.encode())
    assert answer.status == 201
    assert sentence in answer.content["remarks"]
    assert answer.content["document"]["recorded"]["text"] == text
    exported = download(studio, f"api/gaits/{answer.content['id']}/export/{form}")[2].decode()
    assert exported == usual


def test_a_trajectory_with_its_companion_needs_no_assumption(studio: StudioProcess) -> None:
    path = reference_path("trajectories/direction1/walk_a.csv")
    trajectory = parse_trajectory_csv(path.read_text(), path.name).trajectory
    text = format_trajectory_csv(trajectory)
    pair = {"csv": text, "companion": format_companion(trajectory, text)}
    answer = studio.ask("POST", "/api/gaits/import?name=Walk%20a", pair)
    assert answer.status == 201
    assert not any("assumed" in remark for remark in answer.content["remarks"])
    assert answer.content["plan"]["source"] == "recorded"
    refused = studio.ask("POST", "/api/gaits/import", {"csv": text, "companions": ""})
    assert (refused.status, refused.content["where"]) == (422, "body.companions")


def test_a_name_that_is_taken_gets_a_number_and_no_name_is_that_of_the_file(studio: StudioProcess) -> None:
    waypoints = every_knot(studio, "walk")
    names = [
        studio.ask("POST", f"/api/gaits/import?{query}", waypoints).content["name"]
        for query in ("file=way.csv", "file=way.csv", "file=other.csv&name=way", "")
    ]
    assert names == ["way", "way 2", "way 3", "Imported gait"]


def test_the_list_says_what_every_gait_is_made_of(studio: StudioProcess) -> None:
    gaits = listed(studio)
    assert gaits["walk"]["source"] == "optimised"
    assert gaits["walk-manual-0"]["source"] == "manual"
    assert gaits["textbook-trot"]["source"] == "drawn"
    waypoints = every_knot(studio, "amble")
    assert studio.ask("POST", "/api/gaits/import?file=amble.csv", waypoints).content["source"] == "recorded"


def test_optimise_replaces_a_recorded_motion_and_says_where_the_result_is_from(studio: StudioProcess) -> None:
    waypoints = every_knot(studio, "s-gait")
    gait = studio.ask("POST", "/api/gaits/import?file=s.csv", waypoints).content["id"]
    job = studio.ask("POST", "/api/jobs", {"kind": "optimise", "gait": gait}).content["id"]
    wait_for(lambda: studio.ask("GET", f"/api/jobs/{job}").content["ended"] is not None, "the job ended")
    view = studio.ask("GET", f"/api/gaits/{gait}/view").content
    assert studio.ask("GET", f"/api/jobs/{job}").content["fresh"]
    assert (view["plan"]["source"], view["source"], view["undo"]) == ("optimised", "optimised", "Optimise")
    assert view["provenance"]["matches"]
    assert view["provenance"]["at_hand"]
    assert view["document"]["recorded"] is None
    assert studio.ask("POST", f"/api/gaits/{gait}/save").content["edited"] is False
    assert listed(studio)[gait]["edited"] is False
    back = studio.ask("POST", f"/api/gaits/{gait}/undo").content
    assert (back["plan"]["source"], back["provenance"]) == ("recorded", None)


def test_a_file_too_large_for_a_document_is_refused_by_its_name(studio: StudioProcess) -> None:
    waypoints = every_knot(studio, "walk")
    header, *rows = waypoints.splitlines(keepends=True)
    answer = studio.ask("POST", "/api/gaits/import?file=long.csv", header + b"".join(rows * 500))
    assert (answer.status, answer.content["where"]) == (422, "long.csv")
    sentence = r"long\.csv would make a gait document of 20\d\d kB; at most 2000 kB are"
    assert re.match(sentence, answer.content["error"])


def test_a_phase_list_becomes_a_gait(studio: StudioProcess) -> None:
    timeline = library()["walk"].gait.timeline
    body = format_phases(timeline).encode()
    answer = studio.ask("POST", "/api/gaits/import?name=Phases&sample_time=0.2", body)
    assert answer.status == 201
    assert answer.content["document"]["timeline"]["sample_time"] == 0.2
    assert len(answer.content["document"]["timeline"]["feet"][0]) == 2 * timeline.sample_count
    refused = studio.ask("POST", "/api/gaits/import?sample_time=0.3", body)
    assert refused.status == 422
    assert "must be a whole number" in refused.content["error"]


@pytest.mark.parametrize(
    ("body", "message"),
    [
        (b"", "mine.csv holds no numbers"),
        (b"\xff\xfe", "mine.csv is not text in UTF-8"),
        (b"1,2\n3,x", "mine.csv:2, column 2: “x” is not a number"),
        (b"0.1,1_0\n", "mine.csv:1, column 2: “1_0” is not a number; write it without _"),
        ("duration_s,h1,h2,h3\n１,1,1,1\n".encode(), "mine.csv:2, column 1: “１” is not a number"),
        (
            "0.1,0.2\n".encode("utf-16"),
            "mine.csv is not text in UTF-8: it is text in UTF-16. Save it as UTF-8",
        ),
        (b"PK\x03\x04\0", "mine.csv is not text in UTF-8: it is a spreadsheet or a ZIP file"),
        (
            b'{"format": "footfall-phases", "sample_time": NaN}',
            "column 46 (sample_time): NaN is not a finite",
        ),
        (b'{"csv": "0.1,0.2", "companion": 1e999}', "mine.csv, field companion: "),
        (b'{"format": "other"}', "mine.csv has the format 'other'"),
        (b'{"format"', "mine.csv is not JSON"),
        (b"{" * 200_000, "mine.csv is"),
    ],
)
def test_what_is_no_gait_is_refused_by_place(body: bytes, message: str, studio: StudioProcess) -> None:
    answer = studio.ask("POST", "/api/gaits/import?file=mine.csv", body)
    assert answer.status == 422
    assert message in answer.content["error"]


def test_the_manual_gait_of_a_saved_file_is_exported_too(studio: StudioProcess, tmp_path: Path) -> None:
    page = tmp_path / "page.html"
    page.write_bytes(download(studio, "api/gaits/walk-manual-0/export/html")[2])
    assert page.read_text().startswith("<!doctype html>")
