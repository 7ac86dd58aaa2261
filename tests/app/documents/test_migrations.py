"""Older documents come up to the present version step by step; unknown versions are refused."""

from __future__ import annotations

from typing import Any

import pytest

from app.documents.gait_json import gait_content
from app.documents.migrations import STEPS, VERSION, Step, migrated
from core.errors import InputError
from core.library.library import library

OLD: dict[str, Any] = {"version": 1, "title": "Walk", "step_mm": 10}


def _renamed(content: dict[str, Any]) -> dict[str, Any]:
    content["name"] = content.pop("title")
    return content


def _in_metres(content: dict[str, Any]) -> dict[str, Any]:
    content["step"] = content.pop("step_mm") / 1000
    return content


MADE_UP: dict[int, Step] = {1: _renamed, 2: _in_metres}


def test_a_document_of_an_older_version_goes_through_every_step() -> None:
    assert migrated(OLD, "old", MADE_UP, 3) == {"version": 3, "name": "Walk", "step": 0.01}
    assert OLD == {"version": 1, "title": "Walk", "step_mm": 10}


def test_a_document_between_goes_through_the_rest() -> None:
    middle = {"version": 2, "name": "Walk", "step_mm": 20}
    assert migrated(middle, "middle", MADE_UP, 3) == {"version": 3, "name": "Walk", "step": 0.02}


def test_a_document_of_the_present_version_stays_as_it_is() -> None:
    content = gait_content(library()["walk"].gait)
    assert migrated(content, "walk") is content
    present = {"version": 3}
    assert migrated(present, "new", MADE_UP, 3) is present


def test_the_chain_of_the_program_has_no_gap() -> None:
    assert sorted(STEPS) == list(range(VERSION - len(STEPS), VERSION))


@pytest.mark.parametrize("version", [4, 0, -1, True, "1", 1.0, None])
def test_an_unknown_version_is_refused_with_those_that_are_read(version: object) -> None:
    with pytest.raises(InputError, match=r"this program reads versions 1 to 3. Open it with") as refused:
        migrated({"version": version}, "file.json", MADE_UP, 3)
    assert refused.value.where == "file.json.version"


def test_a_version_before_the_chain_is_refused() -> None:
    with pytest.raises(InputError, match=r"has version 1; this program reads versions 2 to 3"):
        migrated(OLD, "old", {2: _in_metres}, 3)
    with pytest.raises(InputError, match=r"has version 1; this program reads version 3\. Open it"):
        migrated(OLD, "old", {1: _renamed}, 3)
