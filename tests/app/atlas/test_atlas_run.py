"""A run: the file that it makes, going on with it, and what it refuses."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Generator, Iterator
from contextlib import closing
from pathlib import Path

import pytest

from app.atlas.atlas_file import CHUNK, AtlasFile
from app.atlas.export import export_atlas
from app.atlas.front import atlas_front
from app.atlas.opening import opened_point
from app.atlas.run import DoneChunk, LocalEngine, Progress, run_atlas
from core.atlas.row import RowStatus
from core.atlas.space import AtlasSpace, default_space, space_from_table
from core.errors import InputError, NotFoundError, StateError, StorageError
from solver_jobs import Chunk, evaluated_chunk

SPACE = default_space("deltawalker")
COUNT = 24


class HereEngine:
    """Evaluates in this process."""

    def run(
        self, space: AtlasSpace, chunks: list[Chunk], go_on: Callable[[], bool]
    ) -> Generator[DoneChunk | None]:
        for chunk in chunks:
            if not go_on():
                return
            yield DoneChunk(chunk, evaluated_chunk(space.content(), chunk.first, chunk.count))


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("atlas") / "atlas.sqlite"


@pytest.fixture(scope="module")
def atlas(path: Path) -> Iterator[AtlasFile]:
    made = AtlasFile(path, SPACE)
    run_atlas(made, COUNT, HereEngine())
    yield made
    made.close()


def test_every_gait_has_a_row_and_its_parameters(atlas: AtlasFile) -> None:
    counts = atlas.counts()
    assert sum(counts.values()) == COUNT
    assert counts[RowStatus.SOLVED] >= 3
    for row, parameters in atlas.entries(RowStatus.SOLVED):
        assert set(parameters) >= {"order", "step_x", "margin", "stop_bound"}
        assert row.least_margin >= parameters["margin"] - 1e-4
        assert row.stop_seconds > 0.0


def test_a_run_goes_on_where_it_was_and_ends_with_the_same_hash(atlas: AtlasFile, tmp_path: Path) -> None:
    told: list[Progress] = []
    parts = AtlasFile(tmp_path / "parts.sqlite", SPACE)
    first = run_atlas(parts, 10, HereEngine(), told.append)
    assert (first.evaluated, first.done) == (10, 10)
    parts.close()
    again = AtlasFile(tmp_path / "parts.sqlite", SPACE)
    assert run_atlas(again, COUNT, HereEngine()).evaluated == COUNT - 10
    assert run_atlas(again, COUNT, HereEngine()).evaluated == 0
    assert again.hash == atlas.hash
    again.close()
    assert told[-1].done == told[-1].count == 10


def test_chunks_are_what_lacks(tmp_path: Path) -> None:
    empty = AtlasFile(tmp_path / "empty.sqlite", SPACE)
    assert empty.missing(CHUNK + 5) == [Chunk(0, CHUNK), Chunk(CHUNK, 5)]
    empty.close()


@pytest.mark.heavy
def test_a_wish_to_end_keeps_what_is_done(tmp_path: Path) -> None:
    asked = iter([True, False])
    part = AtlasFile(tmp_path / "part.sqlite", SPACE)
    progress = run_atlas(part, CHUNK + 4, HereEngine(), go_on=lambda: next(asked, False))
    assert progress.evaluated == CHUNK
    assert part.missing(CHUNK + 4) == [Chunk(CHUNK, 4)]
    part.close()


def test_worker_processes_give_the_same_rows(atlas: AtlasFile, tmp_path: Path) -> None:
    other = AtlasFile(tmp_path / "workers.sqlite", SPACE)
    run_atlas(other, COUNT, LocalEngine(2))
    assert other.hash == atlas.hash
    other.close()


def test_a_gait_that_is_opened_agrees_with_its_row(atlas: AtlasFile) -> None:
    for row in list(atlas.rows())[:8]:
        opened = opened_point(atlas, row.number)
        assert opened.agrees, opened.difference
        assert (opened.cycle is not None) == (row.status is RowStatus.SOLVED)


def test_a_row_that_differs_is_said(atlas: AtlasFile) -> None:
    row = next(atlas.rows(RowStatus.SOLVED))
    connection = sqlite3.connect(atlas.path)
    with connection:
        connection.execute("UPDATE gaits SET speed = speed * 1.1 WHERE id = ?", (row.number,))
    try:
        opened = opened_point(atlas, row.number)
        assert not opened.agrees
        assert opened.difference is not None
        assert "mm/s in the atlas, and now it makes" in opened.difference
    finally:
        with connection:
            connection.execute("UPDATE gaits SET speed = ? WHERE id = ?", (row.speed, row.number))
        connection.close()


def test_no_gait_beats_one_of_the_front(atlas: AtlasFile) -> None:
    front = atlas_front(atlas)
    best = [(parameters["margin"], row.speed) for row, parameters in front]
    for row, parameters in atlas.entries(RowStatus.SOLVED):
        mine = (parameters["margin"], row.speed)
        assert not any(mine[0] >= m and mine[1] >= s and mine != (m, s) for m, s in best)
    soonest = atlas_front(atlas, "stop_seconds", "speed")
    assert [row.speed for row, _ in soonest] == sorted((row.speed for row, _ in soonest), reverse=True)
    assert [r.stop_seconds for r, _ in soonest] == sorted((r.stop_seconds for r, _ in soonest), reverse=True)
    with pytest.raises(InputError, match="y is stride; it must be one of seconds, speed"):
        atlas_front(atlas, "margin", "stride")


def test_it_is_written_as_csv_and_as_parquet(atlas: AtlasFile, tmp_path: Path) -> None:
    assert export_atlas(atlas, tmp_path / "all.csv") == COUNT
    lines = (tmp_path / "all.csv").read_text().splitlines()
    assert len(lines) == COUNT + 1
    assert lines[0].startswith("id,status,reason,seconds,speed")
    from pyarrow import parquet

    export_atlas(atlas, tmp_path / "all.parquet")
    table = parquet.read_table(tmp_path / "all.parquet")
    assert table.num_rows == COUNT
    assert table.column("status").to_pylist() == [row.status.value for row in atlas.rows()]
    with pytest.raises(InputError, match=r"must end in \.csv, \.parquet or \.html"):
        export_atlas(atlas, tmp_path / "all.xlsx")


def test_files_that_are_no_atlas_of_this_space_are_refused(
    path: Path, atlas: AtlasFile, tmp_path: Path
) -> None:
    assert atlas.path == path
    other = space_from_table({"vary": {"step_x": [0.01, 0.02]}}, "a file")
    with pytest.raises(InputError, match="is an atlas of another space"):
        AtlasFile(path, other)
    text = tmp_path / "text.sqlite"
    text.write_text("not a database, and long enough to be looked at as one " * 40)
    with pytest.raises((InputError, StorageError), match=r"text\.sqlite"):
        AtlasFile(text)
    strange = tmp_path / "strange.sqlite"
    with sqlite3.connect(strange) as connection:
        connection.execute("CREATE TABLE things (name TEXT)")
    with pytest.raises(InputError, match="is no atlas"):
        AtlasFile(strange)
    with pytest.raises(NotFoundError, match="There is no atlas"):
        AtlasFile(tmp_path / "none.sqlite")
    with pytest.raises(NotFoundError, match="has no gait 999; it has 24 gaits"):
        atlas.entry(999)


def test_an_atlas_of_another_format_or_version_is_refused(tmp_path: Path) -> None:
    old = tmp_path / "old.sqlite"
    AtlasFile(old, SPACE).close()
    connection = sqlite3.connect(old)
    with connection:
        connection.execute("UPDATE about SET value = '0.0.1' WHERE key = 'program'")
    AtlasFile(old).close()  # it can still be looked at
    with pytest.raises(InputError, match=r"was made by version 0\.0\.1"):
        AtlasFile(old, SPACE)
    with connection:
        connection.execute("UPDATE about SET value = '2' WHERE key = 'version'")
    connection.close()
    with pytest.raises(InputError, match="is an atlas of format 2, and this program reads 1"):
        AtlasFile(old)


def test_reading_an_atlas_that_is_gone_makes_no_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    gone = tmp_path / "gone.sqlite"
    monkeypatch.setattr(Path, "exists", lambda path: True)
    with pytest.raises(StorageError):
        AtlasFile(gone)
    assert not list(tmp_path.iterdir())


def test_a_database_of_something_else_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "other.sqlite"
    with closing(sqlite3.connect(path)) as other, other:
        other.execute("CREATE TABLE about (key TEXT, value TEXT)")
        other.execute("INSERT INTO about VALUES ('format', 'footfall-atlas')")
    with pytest.raises(InputError, match="is no atlas"):
        AtlasFile(path)


@pytest.mark.heavy
def test_a_full_disk_keeps_what_was_computed(tmp_path: Path) -> None:
    small = AtlasFile(tmp_path / "small.sqlite", SPACE)
    run_atlas(small, 4, HereEngine())
    small._connection.set_authorizer(None)
    small._connection.execute("PRAGMA max_page_count = 1")
    with pytest.raises(StorageError, match="its disk is full"):
        run_atlas(small, 200, HereEngine())
    assert sum(small.counts().values()) == 4
    small.close()


def test_an_engine_that_cannot_go_on_keeps_what_was_computed(tmp_path: Path) -> None:
    class Breaks(HereEngine):
        def run(
            self, space: AtlasSpace, chunks: list[Chunk], go_on: Callable[[], bool]
        ) -> Generator[DoneChunk | None]:
            yield DoneChunk(chunks[0], evaluated_chunk(space.content(), 0, 5))
            raise StateError("The cluster went away.")

    broken = AtlasFile(tmp_path / "broken.sqlite", SPACE)
    with pytest.raises(StateError):
        run_atlas(broken, 5, Breaks())
    assert sum(broken.counts().values()) == 5
    broken.close()
