"""Texts that a database cannot keep whole are refused where they come in, and spoil nothing."""

from __future__ import annotations

from typing import Any

import pytest

from tests.support.studio_process import StudioProcess


@pytest.fixture(scope="module")
def studio(lent_studio: StudioProcess) -> StudioProcess:
    return lent_studio


@pytest.mark.parametrize(
    ("method", "path", "content", "headers", "where"),
    [
        ("POST", "/api/gaits/walk/versions", {"name": "a\0b"}, {}, "body.name"),
        ("PUT", "/api/runs/none/note", {"note": "a\0b"}, {}, "body.note"),
        ("POST", "/api/learning/none/set", {"name": "a\0"}, {}, "body.name"),
        ("POST", "/api/gaits/walk/undo", None, {"X-Footfall-Name": "A%00da"}, "x-footfall-name"),
        ("PUT", "/api/gaits/walk?label=a%00b", {}, {}, "query.label"),
    ],
)
def test_a_text_with_nul_is_refused(
    studio: StudioProcess, method: str, path: str, content: Any, headers: dict[str, str], where: str
) -> None:
    answer = studio.ask(method, path, content, headers)
    assert (answer.status, answer.content["where"]) == (422, where), answer


def test_a_stop_by_a_name_with_nul_is_carried_out(studio: StudioProcess) -> None:
    assert studio.ask("POST", "/api/robot/stop?by=A%00da").status == 200
    assert studio.ask("GET", "/api/health").content["storage"]["sentence"] is None
