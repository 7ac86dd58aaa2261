"""The published schema: it is sound, it says every unit, and every document of the program keeps to it."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given

from app.documents.gait_json import gait_content, gait_schema, parse_gait
from core.errors import InputError
from core.gait.gait import Gait
from core.library.library import library
from tests.support.command import run
from tests.support.json_schema import TYPES, violations
from tests.support.strategies import documents

SCHEMA = gait_schema()


def broken(content: Any) -> list[str]:
    return list(violations(SCHEMA, content, SCHEMA))


def nodes(schema: Any, name: str = "") -> Iterator[tuple[str, dict[str, Any]]]:
    """Every schema within the schema, with the name of its field."""
    if isinstance(schema, list):
        for one in schema:
            yield from nodes(one, name)
    elif isinstance(schema, dict):
        yield name, schema
        for word, inner in schema.items():
            if word in ("properties", "$defs"):
                for field, one in inner.items():
                    yield from nodes(one, field)
            elif word in ("items", "prefixItems", "anyOf", "additionalProperties"):
                yield from nodes(inner, name)


@pytest.mark.parametrize("gait_id", list(library()))
def test_every_library_document_keeps_to_the_schema(gait_id: str) -> None:
    assert broken(gait_content(library()[gait_id].gait)) == []


@given(documents())
def test_every_document_that_is_written_keeps_to_the_schema(gait: Gait) -> None:
    assert broken(json.loads(json.dumps(gait_content(gait)))) == []


def test_the_schema_is_json_schema() -> None:
    assert SCHEMA["$schema"] == "https://json-schema.org/draft/2020-12/schema"
    found = list(nodes(SCHEMA))
    assert len(found) > 100
    for name, node in found:
        assert node.get("type", "object") in TYPES, name
        assert set(node.get("required", [])) <= set(node.get("properties", {})), name
        if "$ref" in node:
            assert node["$ref"].removeprefix("#/$defs/") in SCHEMA["$defs"], name
        if node.get("type") == "object" and "properties" in node:
            assert node["additionalProperties"] is False, name


def test_every_object_and_field_has_a_title_and_a_description() -> None:
    for name, node in nodes(SCHEMA):
        if node.get("type") == "object" and "properties" in node:
            assert node["title"], name
            assert node["description"], name
            for field, one in node["properties"].items():
                assert one.get("description"), f"{name}.{field}"
                named = SCHEMA["$defs"][one["$ref"].removeprefix("#/$defs/")] if "$ref" in one else one
                assert named["title"], f"{name}.{field}"


def test_every_measured_number_says_its_unit() -> None:
    numbers = {
        field: node["properties"][field]
        for _, node in nodes(SCHEMA)
        for field in node.get("properties", {})
        if '"number"' in json.dumps(node["properties"][field])
    }
    assert {"sample_time", "step", "clearance", "motor_acceleration", "z", "seconds"} <= set(numbers)
    unitless = [
        field
        for field, one in numbers.items()
        if not any(
            unit in one["description"] for unit in (", m", ", s", ", rad", " m ", "no unit", "multiple")
        )
    ]
    assert unitless == []


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("version", 2),
        ("direction", "north"),
        ("order", ["1"]),
        ("step", [0.1, 0.1]),
        ("step", [0.1, 0.1, 0.1, 0.1]),
        ("orientation", "FX"),
        ("timeline", {"sample_time": 0.4, "feet": []}),
        ("timeline", {"sample_time": True, "feet": ["1"]}),
        ("options", {"colour": 1}),
        ("options", {"clearance": 0.0201}),
        ("options", {"stop_bound": 0.79}),
        ("options", {"phase_knots": 51}),
        ("options", {"closing_knots": 101}),
        ("recorded", {"file": "x"}),
        ("provenance", {}),
        ("colour", "red"),
    ],
)
def test_what_the_schema_forbids_is_refused_by_the_program_as_well(field: str, value: Any) -> None:
    content = {**gait_content(library()["walk"].gait), field: value}
    assert broken(content)
    with pytest.raises(InputError):
        parse_gait(json.dumps(content))


def test_fields_may_be_left_out_where_the_schema_says_so() -> None:
    gait = library()["walk"].gait
    content = gait_content(gait)
    least = {name: content[name] for name in SCHEMA["required"]}
    assert broken(least) == []
    assert parse_gait(json.dumps(least)) == replace(gait, notes="", options=type(gait.options)())


def test_the_command_line_prints_the_schema(capsys: pytest.CaptureFixture[str]) -> None:
    for words in ((), ("--json",)):
        status, out, _ = run(capsys, "gaits", "--schema", *words)
        assert (status, json.loads(out)) == (0, SCHEMA)
