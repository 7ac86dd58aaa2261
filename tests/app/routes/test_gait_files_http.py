"""A studio whose gait files are damaged, or changed by somebody else while it runs."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.support.studio_process import StudioProcess, running_studio


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("data")


@pytest.fixture(scope="module")
def studio(data: Path) -> Iterator[StudioProcess]:
    (data / "gaits").mkdir()
    os.mkfifo(data / "gaits" / "pipe.json")
    with running_studio(data) as running:
        yield running


def listed(studio: StudioProcess) -> dict[str, Any]:
    return {line["id"]: line for line in studio.ask("GET", "/api/gaits").content["gaits"]}


def test_a_pipe_among_the_gaits_holds_nothing_up(studio: StudioProcess) -> None:
    assert "pipe" in listed(studio)["pipe"]["problem"]
    assert studio.ask("GET", "/api/gaits/pipe/view").status == 422
    assert studio.ask("DELETE", "/api/gaits/pipe").status == 200
    assert "pipe" not in listed(studio)
    restored = studio.ask("POST", "/api/gaits/pipe/restore")
    assert (restored.status, restored.content) == (200, listed(studio)["pipe"])
    assert studio.ask("POST", "/api/gaits/pipe/restore").status == 422


@pytest.mark.parametrize("kind", ["cut off", "folder", "pipe", "link"])
def test_what_stands_in_the_trash_unreadable_is_back_with_its_problem(
    kind: str, studio: StudioProcess, data: Path
) -> None:
    path = data / "trash" / "broken.json"
    make: dict[str, Callable[[], object]] = {
        "cut off": lambda: path.write_text("{"),
        "folder": path.mkdir,
        "pipe": lambda: os.mkfifo(path),
        "link": lambda: path.symlink_to(data / "nothing"),
    }
    make[kind]()
    restored = studio.ask("POST", "/api/gaits/broken/restore")
    assert (restored.status, restored.content["id"]) == (200, "broken")
    assert "broken.json" in restored.content["problem"]
    assert restored.content == listed(studio)["broken"]
    path.write_text("{")  # another one, while the id is in use
    beside = studio.ask("POST", "/api/gaits/broken/restore")
    assert (beside.status, beside.content["id"]) == (200, "broken-2")
    for gait in ("broken", "broken-2"):
        assert studio.ask("DELETE", f"/api/gaits/{gait}").status == 200
        there = data / "trash" / f"{gait}.json"
        there.rmdir() if there.is_dir() else there.unlink()


def test_a_file_whose_name_is_no_id_is_refused_with_the_remedy(studio: StudioProcess, data: Path) -> None:
    path = data / "gaits" / "a b.json"
    path.write_text("{")
    refused = studio.ask("DELETE", "/api/gaits/a%20b.json")
    assert (refused.status, refused.content["error"]) == (404, listed(studio)["a b.json"]["problem"])
    assert "remove the file a b.json in the folder gaits" in refused.content["error"]
    path.unlink()


@pytest.mark.parametrize(("keep", "notes"), [("file", "theirs"), ("mine", "")])
def test_a_file_changed_outside_is_taken_over_or_set_aside(
    keep: str, notes: str, studio: StudioProcess, data: Path
) -> None:
    made = studio.ask("POST", f"/api/gaits?copy_of=walk&name=Copy%20{keep}", {}).content
    gait, path = made["id"], data / "gaits" / f"{made['id']}.json"
    path.write_text(json.dumps({**made["document"], "notes": "theirs"}))
    assert listed(studio)[gait]["outside"]
    assert studio.ask("GET", f"/api/gaits/{gait}/view").content["outside"]
    refused = studio.ask("POST", f"/api/gaits/{gait}/save")
    assert (refused.status, refused.content["where"]) == (409, gait)
    settled = studio.ask("POST", f"/api/gaits/{gait}/file", {"keep": keep})
    assert (settled.status, settled.content["document"]["notes"]) == (200, notes)
    assert (settled.content["outside"], settled.content["edited"]) == (None, False)
    assert json.loads(path.read_text())["notes"] == notes
    assert studio.ask("POST", f"/api/gaits/{gait}/save").status == 200


@pytest.mark.parametrize("content", [{}, {"keep": "both"}, {"keep": "file", "more": 1}])
def test_a_choice_that_is_none_is_refused(content: dict[str, Any], studio: StudioProcess) -> None:
    assert studio.ask("POST", "/api/gaits/walk/file", content).status == 422


def test_a_folder_that_is_gone_is_a_sentence_until_it_is_back(studio: StudioProcess, data: Path) -> None:
    (data / "gaits").rename(data / "elsewhere")
    try:
        refused = studio.ask("GET", "/api/gaits")
    finally:
        (data / "elsewhere").rename(data / "gaits")
    assert (refused.status, refused.content["where"]) == (503, str(data / "gaits"))
    assert "pipe" in listed(studio)


def test_a_file_under_a_deleted_gaits_name_is_a_new_gait(studio: StudioProcess, data: Path) -> None:
    made = studio.ask("POST", "/api/gaits?copy_of=walk&name=Gone", {}).content
    gait, path = made["id"], data / "gaits" / f"{made['id']}.json"
    kept = path.read_text()
    studio.ask("PUT", f"/api/gaits/{gait}", {**made["document"], "name": "Edited"})
    assert studio.ask("DELETE", f"/api/gaits/{gait}").status == 200
    path.write_text(kept)
    fresh = studio.ask("GET", f"/api/gaits/{gait}/view").content
    assert (fresh["name"], fresh["edited"]) == ("Gone", False)
    assert studio.ask("GET", f"/api/gaits/{gait}/versions").content["versions"] == []
    back = studio.ask("POST", f"/api/gaits/{gait}/restore").content
    assert (back["id"], studio.ask("GET", f"/api/gaits/{gait}/view").status) == (f"{gait}-2", 200)
