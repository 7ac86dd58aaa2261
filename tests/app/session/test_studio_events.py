"""What pages are told of a change: the whole view of the changed gait, and of others only what changed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from app.gaits.open_gait import OpenGait
from app.gaits.sequence_documents import PartReference, made_sequence
from app.studio.studio import Studio

DEADLINE = 60


@pytest.fixture
def studio(tmp_path: Path) -> Iterator[Studio]:
    opened = Studio(tmp_path, "emulator")
    yield opened
    opened.close()


def stepped(studio: Studio, gait_id: str, step_mm: float) -> OpenGait:
    gait = studio.gaits.document(gait_id)
    return studio.gaits.edit(gait_id, replace(gait, step=(step_mm / 1000, 0.0, 0.0)), "Step", None)


def test_an_edit_of_a_part_tells_an_open_sequence_only_how_its_parts_stand(
    studio: Studio, monkeypatch: pytest.MonkeyPatch
) -> None:
    part = "walk-manual-0"

    def made() -> OpenGait:
        parts = [PartReference(part, 2), PartReference("amble-manual-0", 1)]
        return studio.gaits.create(made_sequence("Tour", parts, studio.gaits.document, ""))

    tour = studio.change(made).result(DEADLINE)["id"]
    told: list[dict[str, Any]] = []
    publish = studio.hub.publish

    def noted(event: dict[str, Any], page: str | None = None) -> None:
        told.append(event)
        publish(event, page)

    monkeypatch.setattr(studio.hub, "publish", noted)
    for step_mm in (6.0, 7.0):
        studio.change(partial(stepped, studio, part, step_mm)).result(DEADLINE)
    of_tour = [event for event in told if tour in (event.get("id"), event.get("view", {}).get("id"))]
    assert of_tour == [{"type": "sources", "id": tour, "revision": 1, "sources": ["changed", "same"]}]
    assert [event["view"]["id"] for event in told if event["type"] == "gait"] == [part, part]
