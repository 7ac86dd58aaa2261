"""Gait documents: they come back as they were written, and say what is wrong with others."""

from __future__ import annotations

import json
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.documents import gait_content, gait_schema, motion_hash, parse_gait
from core.errors import InputError
from core.gait import Gait, GaitOptions, Orientation
from core.library import library
from core.motion_problem import Cost, Workspace
from core.timeline import ContactTimeline, bits_from_rows


@st.composite
def gaits(draw: st.DrawFn) -> Gait:
    robot, legs = draw(st.sampled_from([("deltawalker", 4), ("hexapod", 6), ("dodecapod", 12)]))
    samples = draw(st.integers(2, 60))
    row = st.text("01", min_size=samples, max_size=samples)
    rows = st.lists(row, min_size=legs, max_size=legs).map(lambda text: bits_from_rows(text, "t"))
    length = st.floats(-0.1, 0.1)
    return Gait(
        name=draw(st.text(min_size=1, max_size=20).filter(str.strip)),
        robot=robot,
        orientation=draw(st.sampled_from(list(Orientation))),
        direction=draw(st.integers(1, 4)),
        order=tuple(draw(st.permutations(range(1, legs + 1)))),
        step=(draw(length), draw(length), draw(length)),
        iterations=draw(st.integers(1, 20)),
        timeline=ContactTimeline(draw(rows), draw(rows), draw(st.floats(0.01, 5.0))),
        options=GaitOptions(
            clearance=draw(st.floats(0, 0.02)),
            margin=draw(st.floats(-0.05, 0.05)),
            workspace=draw(st.sampled_from(list(Workspace))),
            cost=draw(st.sampled_from(list(Cost))),
        ),
        notes=draw(st.text(max_size=40)),
    )


@given(gaits())
def test_a_document_comes_back_as_it_was_written(gait: Gait) -> None:
    assert parse_gait(json.dumps(gait_content(gait))) == gait


@pytest.mark.parametrize("gait_id", list(library()))
def test_built_in_gaits_come_back_with_their_segment_tables(gait_id: str) -> None:
    gait = library()[gait_id].gait
    assert parse_gait(json.dumps(gait_content(gait))) == gait


def test_name_and_notes_do_not_change_the_motion() -> None:
    content = gait_content(library()["walk"].gait)
    renamed = parse_gait(json.dumps({**content, "name": "other", "notes": "words"}))
    longer = parse_gait(json.dumps({**content, "step": [0.008, 0.008, 0.0]}))
    assert motion_hash(renamed) == motion_hash(library()["walk"].gait)
    assert motion_hash(longer) != motion_hash(renamed)


def test_the_schema_names_every_field_of_the_document() -> None:
    assert set(gait_schema()["properties"]) == set(gait_content(library()["walk"].gait))


def _with(path: str, value: Any) -> str:
    content = gait_content(library()["walk"].gait)
    *parents, last = path.split(".")
    place = content
    for parent in parents:
        place = place[parent]
    place[last] = value
    return json.dumps(content)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{", "is not JSON"),
        ("[" * 100_000, "nested too deeply"),
        ('{"version": ' + "9" * 5000 + "}", "is not JSON"),
        (_with("version", True), "version True"),
        (_with("name", "half \ud800"), "half a character"),
        (_with("name", "x" * 1000), "at most 120"),
        ("[]", 'must be "footfall-gait"'),
        (_with("format", "other"), 'must be "footfall-gait"'),
        (_with("version", 2), "version 2; this program reads version 1"),
        (_with("step", [0.01, 0.01]), "field step"),
        (_with("step", [0.5, 0.0, 0.0]), "at most 0.2 m"),
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
    ],
)
def test_what_is_wrong_is_named(text: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        parse_gait(text)
