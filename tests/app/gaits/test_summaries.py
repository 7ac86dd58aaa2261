"""The list of gaits: read once a file, right after every change, and small on the wire after an edit."""

from __future__ import annotations

import asyncio
import json
import os
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from app.bench.page.gait_list import fill
from app.documents.stored_gait import StoredGait
from app.gaits.live_plans import LivePlans
from app.gaits.service import GaitService
from app.gaits.summaries import GaitSummaries
from app.session.event_hub import Subscriber
from app.store.database import Database
from app.store.gait_files import GaitFiles
from app.studio.studio import Studio
from core.errors import InputError
from core.library.library import library
from solver_jobs import SolveStatus
from tests.app.gaits.test_service import WALK, edit
from tests.support.live_tiers import FixedTier
from tests.support.own_loop import run_apart

COUNT = 30


class CountedFiles(GaitFiles):
    """Gait files that count how often one is read."""

    def __init__(self, data: Path) -> None:
        super().__init__(data)
        self.read_ids: list[str] = []

    def stored(self, gait_id: str) -> StoredGait:
        self.read_ids.append(gait_id)
        return super().stored(gait_id)


@pytest.fixture
def files(tmp_path: Path) -> CountedFiles:
    fill(tmp_path, COUNT)
    return CountedFiles(tmp_path)


def open_service(files: GaitFiles, database: Database) -> GaitService:
    return GaitService(files, database, LivePlans(FixedTier(SolveStatus.INFEASIBLE)).solve_for)


@pytest.fixture
def service(files: CountedFiles, database: Database) -> GaitService:
    return open_service(files, database)


def line(gaits: GaitSummaries, gait_id: str) -> dict[str, Any]:
    return next(line for line in gaits.lines() if line["id"] == gait_id)


def test_every_file_is_read_once(service: GaitService, files: CountedFiles) -> None:
    gaits = GaitSummaries(service)
    lines = gaits.lines()
    assert len(lines) == COUNT + len(library())
    assert sorted(files.read_ids) == sorted(files.ids())
    assert gaits.lines() == lines
    assert len(files.read_ids) == COUNT


def test_a_line_follows_edits_saves_and_other_programs(
    service: GaitService, files: CountedFiles, tmp_path: Path, database: Database
) -> None:
    gaits = GaitSummaries(service)
    assert line(gaits, "trial-0001")["edited"] is False
    gait = service.open_gait("trial-0001").gait
    service.edit("trial-0001", replace(gait, name="Better"), "Name", None)
    assert (line(gaits, "trial-0001")["name"], line(gaits, "trial-0001")["edited"]) == ("Better", True)
    restarted = GaitSummaries(open_service(files, database))
    assert (line(restarted, "trial-0001")["name"], line(restarted, "trial-0001")["edited"]) == (
        "Better",
        True,
    )
    service.save("trial-0001")
    assert line(gaits, "trial-0001")["edited"] is False
    path = tmp_path / "gaits" / "trial-0002.json"
    content = json.loads(path.read_text())
    path.write_text(json.dumps({**content, "name": "By git"}))
    os.utime(path, ns=(1, 1))
    assert line(gaits, "trial-0002")["name"] == "By git"
    edit(service, WALK)
    assert line(gaits, WALK)["edited"] is True


def test_gaits_come_go_and_come_back(service: GaitService) -> None:
    gaits = GaitSummaries(service)
    before = len(gaits.lines())
    made = service.create(replace(library()[WALK].gait, name="New"))
    assert not gaits.has(made.id)
    assert line(gaits, made.id)["kind"] == "saved"
    edit(service, made.id)
    assert line(gaits, made.id)["edited"] is True
    service.delete(made.id)
    assert len(gaits.lines()) == before
    assert not gaits.has(made.id)
    service.restore(made.id)
    assert line(gaits, made.id)["edited"] is True


@pytest.mark.parametrize("content", ["{", "[]", '{"format": "footfall-gait", "version": 99}', ""])
def test_a_damaged_file_is_marked_until_it_is_mended(
    service: GaitService, tmp_path: Path, content: str
) -> None:
    path = tmp_path / "gaits" / "trial-0003.json"
    whole = path.read_text()
    path.write_text(content)
    gaits = GaitSummaries(service)
    assert len(gaits.lines()) == COUNT + len(library())
    assert "trial-0003.json" in line(gaits, "trial-0003")["problem"]
    assert gaits.troubles().keys() == {"trial-0003"}
    with pytest.raises(InputError, match=r"trial-0003\.json"):
        service.open_gait("trial-0003")
    path.write_text(whole)
    assert line(gaits, "trial-0003")["name"] == "Trial 3"


def test_a_look_at_the_files_gives_nobody_a_list(service: GaitService) -> None:
    gaits = GaitSummaries(service)
    gaits.lines()
    made = service.create(replace(library()[WALK].gait, name="New"))
    gaits.troubles()
    assert not gaits.has(made.id)


def test_after_an_edit_pages_are_sent_one_gait_and_not_the_list(
    tmp_path: Path,
) -> None:
    fill(tmp_path, COUNT)
    studio = Studio(tmp_path, "emulator")
    try:
        told = run_apart(_told(studio))
    finally:
        studio.close()
    assert [event["type"] for event in told] == ["gait", "gait", "gaits"]
    assert told[0]["view"]["edited"] is True
    assert len(told[2]["gaits"]) == COUNT + len(library()) + 1


async def _told(studio: Studio) -> list[dict[str, Any]]:
    """What a page hears of an edit and of a new gait."""
    subscriber: Subscriber = studio.hub.subscribe("page")
    await asyncio.wrap_future(studio.call(studio.hello))

    def act() -> None:
        gait = studio.gaits.open_gait("trial-0001").gait
        studio.publisher.publish_gait(
            studio.gaits.edit("trial-0001", replace(gait, name="Better"), "Name", None)
        )
        studio.publisher.publish_gait(studio.gaits.create(replace(gait, name="Another")))

    await asyncio.wrap_future(studio.call(act))
    events: list[dict[str, Any]] = []
    while len(events) < 3:
        text = await asyncio.wait_for(subscriber.next(), 10)
        event = json.loads(text or "{}")
        events += [event] if event.get("type") in ("gait", "gaits") else []
    studio.hub.unsubscribe(subscriber)
    return events
