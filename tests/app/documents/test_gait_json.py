"""Gait documents: they come back as they were written, and say what is wrong with others."""

from __future__ import annotations

import json
from dataclasses import asdict, replace
from typing import Any

import pytest
from hypothesis import given

from app.documents.gait_json import asked_hash, gait_content, motion_hash, parse_gait, require_size
from core.errors import InputError
from core.gait.gait import Gait
from core.gait.poses import PinnedPose
from core.gait.provenance import Provenance
from core.gait.recording import Recording, RecordingForm
from core.library.library import library
from core.problem.motion_problem import Cost
from tests.support.strategies import documents

PROVENANCE = Provenance("a" * 64, "b" * 64, "nlp", "IPOPT", "solved", 0.1, "2026-11-21T18:40:00+00:00", "1")
RECORDING = Recording("walk.csv", RecordingForm.TRAJECTORY, "1,2\n", "{}", ("Heading 0.",))


@given(documents())
def test_a_document_comes_back_as_it_was_written(gait: Gait) -> None:
    text = json.dumps(gait_content(gait))
    again = parse_gait(text)
    assert again == gait
    assert json.dumps(gait_content(again)) == text


@pytest.mark.parametrize("gait_id", list(library()))
def test_built_in_gaits_come_back_with_their_segment_tables(gait_id: str) -> None:
    gait = library()[gait_id].gait
    assert parse_gait(json.dumps(gait_content(gait))) == gait


def test_words_and_provenance_do_not_change_the_motion() -> None:
    gait = library()["walk"].gait
    content = gait_content(replace(gait, provenance=PROVENANCE))
    renamed = parse_gait(json.dumps({**content, "name": "other", "notes": "words"}))
    longer = parse_gait(json.dumps({**content, "step": [0.008, 0.008, 0.0]}))
    assert renamed.provenance == PROVENANCE
    assert motion_hash(renamed) == motion_hash(gait)
    assert motion_hash(longer) != motion_hash(renamed)


def test_pinned_poses_come_back_and_are_another_question() -> None:
    gait = library()["fast-c-gait"].gait
    assert gait.poses is not None
    pins = (PinnedPose(5, 0.001, -0.002), PinnedPose(9, 0.0, 0.0035))
    pinned = replace(gait, poses=replace(gait.poses, pinned=pins))
    assert parse_gait(json.dumps(gait_content(pinned))) == pinned
    assert "pinned" not in gait_content(gait)["poses"]
    assert len({motion_hash(gait), motion_hash(pinned)}) == len({asked_hash(gait), asked_hash(pinned)}) == 2
    assert motion_hash(gait.with_options(merge=0.001)) == motion_hash(gait)
    assert motion_hash(gait.with_options(stop_bound=1.4)) != motion_hash(gait)


def test_a_recorded_motion_is_another_motion_and_no_other_question() -> None:
    gait = library()["walk"].gait
    first, second = (replace(gait, recorded=replace(RECORDING, text=text)) for text in ("1\n", "2\n"))
    other_companion = replace(gait, recorded=replace(RECORDING, text="1\n", companion=None))
    assert len({motion_hash(g) for g in (gait, first, second, other_companion)}) == 4
    assert {asked_hash(g) for g in (gait, first, second, other_companion)} == {motion_hash(gait)}
    renamed = replace(first, recorded=replace(RECORDING, text="1\n", file="other.csv", assumed=()))
    assert motion_hash(renamed) == motion_hash(first)


def test_results_of_documents_without_a_recorded_motion_are_found_under_their_first_hash() -> None:
    """Studios in use keep results by this hash; the document has grown since."""
    first = "168b16bd57dca1ffe058de03554daf3b92be0bf46532d5d07756a3b6a3ca890f"
    assert motion_hash(library()["walk"].gait.with_options(margin=0.003, cost=Cost.GOAL)) == first


def test_a_recorded_text_that_was_changed_is_refused() -> None:
    content = gait_content(replace(library()["walk"].gait, recorded=RECORDING))
    content["recorded"]["text"] = "1,3\n"
    with pytest.raises(InputError, match=r"the text was changed since. Import walk.csv again") as refused:
        parse_gait(json.dumps(content))
    assert refused.value.where == "recorded.sha256"


def test_a_document_of_more_than_two_megabytes_is_refused_by_its_size() -> None:
    gait = library()["walk"].gait
    require_size(replace(gait, recorded=replace(RECORDING, text="1" * 1_990_000)), "long.csv")
    with pytest.raises(InputError, match=r"long.csv would make a gait document of 200\d kB; at most 2000 kB"):
        require_size(replace(gait, recorded=replace(RECORDING, text="1" * 2_000_000)), "long.csv")


def _with(path: str, value: Any) -> str:
    content = gait_content(library()["walk"].gait)
    *parents, last = path.split(".")
    place = content
    for parent in parents:
        place = place[parent]
    place[last] = value
    return json.dumps(content)


def _half_named() -> Any:
    table = gait_content(library()["walk-manual-0"].gait)["segment_table"]
    table["definitions"]["z"]["Half \ud800"] = 0.01
    return table


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{", "is not JSON"),
        ("[" * 100_000, "nested too deeply"),
        ('{"version": ' + "9" * 5000 + "}", r"line 1, column 13 \(version\): 9+… is not a finite number"),
        (_with("version", True), "version True"),
        (_with("name", "half \ud800"), "half a character"),
        (_with("segment_table", _half_named()), "half a character after “.*Half"),
        (_with("timeline.locked", []), "locked cells has shape"),
        (_with("name", "x" * 1000), "at most 120"),
        ("[]", 'must be "footfall-gait"'),
        (_with("format", "other"), 'must be "footfall-gait"'),
        (_with("version", 2), "version 2; this program reads version 1"),
        (_with("step", [0.01, 0.01]), "field step"),
        (_with("step", [0.5, 0.0, 0.0]), "The step is 500 mm; it must be at most 200 mm an iteration"),
        (_with("step", [float("nan"), 0.0, 0.0]), "step"),
        (_with("robot", "spider"), "no robot “spider”"),
        (_with("direction", 5), "direction is 5"),
        (_with("order", [1, 2, 3]), "must name each foot"),
        (_with("timeline.feet", ["111", "11", "111", "111"]), "foot 2"),
        (_with("timeline.feet", ["111"] * 6), "6 feet; deltawalker has 4"),
        (_with("options.clearance", 3.0), "clearance is 3.0"),
        (_with("options.colour", 1), "field options.colour"),
        (_with("iterations", 0), "iterations is 0"),
        (_with("name", " "), "no name"),
        (_with("recorded", {"file": "x", "form": "film", "text": "", "sha256": ""}), "recorded.form"),
        (_with("recorded", {"file": "", "form": "waypoints", "text": "", "sha256": ""}), "0 characters"),
        (_with("provenance", {**asdict(PROVENANCE), "motion": "xyz"}), "provenance.motion is no SHA-256"),
        (_with("provenance", {**asdict(PROVENANCE), "made": "yesterday"}), "provenance.made is “yesterday”"),
        (_with("provenance", {**asdict(PROVENANCE), "seconds": -1.0}), "provenance.seconds is -1.0"),
    ],
)
def test_what_is_wrong_is_named(text: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        parse_gait(text)
