"""Atlases over HTTP: their list, fronts and files, deleting, bad input."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest

from app.atlas.atlas_file import AtlasFile
from core.atlas.space import default_space
from solver_jobs import evaluated_chunk
from tests.support.studio_process import StudioProcess, running_studio


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A data folder with a small atlas."""
    folder, space = tmp_path_factory.mktemp("data"), default_space("deltawalker").drawn_by(7)
    (folder / "atlases").mkdir()
    with closing(AtlasFile(folder / "atlases" / "small.sqlite", space)) as atlas:
        atlas.add(evaluated_chunk(space.content(), 0, 24))
    return folder


@pytest.fixture(scope="module")
def studio(data: Path) -> Iterator[StudioProcess]:
    with running_studio(data) as running:
        yield running


@pytest.fixture
def made() -> str:
    """Name of the small atlas."""
    return "small"


def test_an_atlas_is_listed_with_what_it_has(studio: StudioProcess, made: str) -> None:
    listed = {one["name"]: one for one in studio.ask("GET", "/api/atlases").content["atlases"]}
    one = listed[made]
    assert (one["robot"], one["kind"], one["seed"], one["gaits"]) == ("deltawalker", "fast", 7, 24)
    assert one["solved"] + one["infeasible"] + one["failed"] == 24
    assert 0.0 < one["fastest"] < 0.004
    assert not one["robot_changed"]
    assert one == studio.ask("GET", f"/api/atlases/{made}").content


def test_its_front_and_files_have_its_gaits(studio: StudioProcess, made: str) -> None:
    front = studio.ask("GET", f"/api/atlases/{made}/front").content["front"]
    assert [row["speed"] for row in front] == sorted((row["speed"] for row in front), reverse=True)
    table = studio.text(f"/api/atlases/{made}/export?format=csv")
    assert len(table.splitlines()) == 1 + 24
    page = studio.text(f"/api/atlases/{made}/map")
    assert page == studio.text(f"/api/atlases/{made}/export?format=html")
    assert "<html" in page


def test_an_atlas_is_deleted_and_brought_back(studio: StudioProcess, made: str) -> None:
    before = studio.ask("GET", f"/api/atlases/{made}").content
    assert studio.ask("DELETE", f"/api/atlases/{made}").status == 200
    assert studio.ask("GET", f"/api/atlases/{made}").status == 404
    assert studio.ask("POST", f"/api/atlases/{made}/restore").content == before
    again = studio.ask("POST", f"/api/atlases/{made}/restore")
    assert (again.status, "No atlas" in again.content["error"]) == (404, True)


@pytest.mark.parametrize(
    ("body", "words"),
    [
        ({"name": ""}, "name"),
        ({"name": "../x"}, "letters, digits"),
        ({"name": "x", "count": 0}, "count"),
        ({"name": "x", "robot": "nobody"}, "nobody"),
        ({"name": "x", "space": "[vary]\nsped = [1, 2]"}, "sped"),
        ({"name": "x", "space": "robot = 'deltawalker'\n[vary]\nstep_x = [0.02, 0.01]"}, "step_x"),
        ({"name": "small", "robot": "deltawalker", "seed": 8}, "another space"),
    ],
)
def test_bad_input_is_refused_with_a_sentence(
    studio: StudioProcess, made: str, body: dict[str, Any], words: str
) -> None:
    answer = studio.ask("POST", "/api/atlases", body)
    assert answer.status == 422
    assert words in answer.content["error"]
    assert studio.ask("GET", "/api/atlases/x").status == 404


def test_a_file_that_is_no_atlas_is_listed_with_what_is_wrong(
    studio: StudioProcess, data: Path, made: str
) -> None:
    (data / "atlases" / "broken.sqlite").write_text("nothing of the kind, and no header " * 9)
    listed = {one["name"]: one for one in studio.ask("GET", "/api/atlases").content["atlases"]}
    assert "is no atlas" in listed["broken"]["trouble"]
    assert listed[made]["gaits"] == 24
    assert studio.ask("GET", "/api/atlases/broken/front").status == 422
