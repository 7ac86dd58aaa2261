"""A data folder full of atlas files of somebody else: the studio starts, lists them, and ends."""

from __future__ import annotations

import time
from collections.abc import Iterator
from urllib.parse import quote

import pytest

from tests.support.hostile_atlases import HARMLESS, HOSTILE, write_hostile
from tests.support.studio_process import StudioProcess, running_studio

START_SECONDS, LIST_SECONDS = 5.0, 1.0
OF_40 = 40 / len(HOSTILE)
KINDS = sorted(set(HOSTILE) - HARMLESS)


@pytest.fixture(scope="module")
def studio(tmp_path_factory: pytest.TempPathFactory) -> Iterator[StudioProcess]:
    data = tmp_path_factory.mktemp("data")
    (data / "atlases").mkdir()
    write_hostile(data / "atlases")
    begin = time.monotonic()
    with running_studio(data) as running:
        assert (time.monotonic() - begin) * OF_40 < START_SECONDS
        yield running


def test_the_list_comes_soon_with_a_line_for_each(studio: StudioProcess) -> None:
    seconds = []
    for _ in range(3):
        begin = time.monotonic()
        answer = studio.ask("GET", "/api/atlases")
        seconds.append(time.monotonic() - begin)
        assert answer.status == 200
        assert set(HOSTILE) <= {one["name"] for one in answer.content["atlases"]}
    assert min(seconds) * OF_40 < LIST_SECONDS


@pytest.mark.parametrize("kind", KINDS)
def test_each_is_refused_with_a_sentence(studio: StudioProcess, kind: str) -> None:
    path = f"/api/atlases/{quote(kind)}"
    assert studio.ask("GET", path).status == 200
    for ask in ("export?format=csv", "export?format=html", "map", "front"):
        answer = studio.ask("GET", f"{path}/{ask}")
        assert answer.status == 422, answer.content
        assert answer.content["error"]


@pytest.mark.parametrize(
    "kind", ["view endless", "folder", "pipe", "written ahead", "space deep", "link to nothing"]
)
def test_each_is_not_gone_on_with_and_can_be_deleted_and_brought_back(
    studio: StudioProcess, kind: str
) -> None:
    path = f"/api/atlases/{quote(kind)}"
    assert studio.ask("POST", "/api/atlases", {"name": kind, "count": 1}).status == 422
    assert studio.ask("DELETE", path).status == 200
    assert studio.ask("GET", path).status == 404
    assert studio.ask("POST", f"{path}/restore").status == 200


@pytest.mark.parametrize("body", [b"[" * 200_000, b'{"name": ' * 100_000, b'{"name": "x", "count": 1e999}'])
def test_a_body_that_is_too_deep_or_absurd_is_refused(studio: StudioProcess, body: bytes) -> None:
    assert studio.ask("POST", "/api/atlases", body).status == 422


@pytest.mark.parametrize(
    "space",
    ["a." * 40_000 + "b = 1", "a = " + "[" * 40_000, "[vary]\nstep_x = [1e-300, 1e300]", "a = 1" * 30_000],
)
def test_a_space_that_is_too_deep_or_absurd_is_refused(studio: StudioProcess, space: str) -> None:
    answer = studio.ask("POST", "/api/atlases", {"name": "new", "space": space})
    assert answer.status == 422
    assert studio.ask("GET", "/api/atlases/new").status == 404
