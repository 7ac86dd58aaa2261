"""Atlas files of somebody else: the list, the commands and Python refuse each with a sentence, and soon."""

from __future__ import annotations

import csv
import sqlite3
import time
from contextlib import closing
from pathlib import Path

import pytest

import footfall
from app.atlas.atlas_file import AtlasFile
from app.atlas.export import export_atlas
from app.atlas.library import AtlasLibrary
from core.atlas.physics_row import PhysicsRow
from core.atlas.row import RowStatus
from core.atlas.space import default_space
from core.errors import InputError, StorageError
from tests.support.command import run
from tests.support.hostile_atlases import FORMULA, HARMLESS, HOSTILE, write_atlas, write_hostile

KINDS = sorted(set(HOSTILE) - HARMLESS)
LIST_SECONDS = 1.0
OF_40 = 40 / len(HOSTILE)


@pytest.fixture(scope="module")
def hostile(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    return write_hostile(tmp_path_factory.mktemp("atlases"))


@pytest.fixture
def good(tmp_path: Path) -> Path:
    return write_atlas(tmp_path / "good.sqlite")


def test_there_are_many_kinds() -> None:
    assert len(KINDS) >= 80


def test_the_list_has_a_line_for_each_and_comes_soon(hostile: dict[str, Path]) -> None:
    folder = hostile["pipe"].parent
    library = AtlasLibrary(folder)
    begin = time.process_time()
    listed = {one["name"]: one for one in library.contents()}
    assert (time.process_time() - begin) * OF_40 < LIST_SECONDS
    assert set(HOSTILE) <= set(listed)
    troubles = {name for name in HOSTILE if "trouble" in listed[name]}
    assert len(troubles) >= 60
    assert listed["deltawalker-small"]["gaits"] == 4000
    assert all(listed[name]["gaits"] == 6 for name in set(HOSTILE) - troubles)
    assert all(len(listed[name]["trouble"]) < 700 for name in troubles)


@pytest.mark.parametrize("kind", KINDS)
def test_commands_and_python_refuse_each_kind_with_a_sentence(
    capsys: pytest.CaptureFixture[str], hostile: dict[str, Path], tmp_path: Path, kind: str
) -> None:
    atlas, csv_file = str(hostile[kind]), tmp_path / "a.csv"
    status, _, said = run(capsys, "atlas", "export", atlas, "-o", str(csv_file))
    assert (status, said.count("\n"), csv_file.exists()) == (2, 1, False)
    status, out, said = run(capsys, "atlas", "front", atlas)
    assert (status, out, said.count("\n")) == (2, "", 1)
    status, out, said = run(capsys, "atlas", "open", atlas, "6")
    assert (status, out, said.count("\n")) == (2, "", 1)
    with pytest.raises(footfall.InputError):
        footfall.atlas(atlas).rows(None)


NEW = ("empty", "link to nothing", "link to itself")
"""Kinds in whose place a run makes an atlas, or says that it cannot."""


@pytest.mark.parametrize("kind", sorted(set(KINDS) - set(NEW)))
def test_a_run_does_not_go_on_with_them(kind: str, hostile: dict[str, Path]) -> None:
    def read_all() -> None:
        with closing(AtlasFile(hostile[kind], default_space("deltawalker"))) as atlas:
            atlas.counts()
            list(atlas.entries())
            atlas.physics()

    with pytest.raises(InputError):
        read_all()


def test_nothing_endless_is_waited_for(good: Path) -> None:
    """Another program exchanges the tables while the atlas is open."""
    with closing(AtlasFile(good)) as atlas:
        with closing(sqlite3.connect(good)) as other, other:
            other.executescript(
                "BEGIN; DROP TABLE gaits; CREATE VIEW gaits AS WITH RECURSIVE n(x) AS "
                "(SELECT 1 UNION ALL SELECT x + 1 FROM n) "
                "SELECT x AS id, 'solved' AS status, 1.0 AS speed FROM n"
            )
        with pytest.raises(InputError, match="is no atlas that can be read"):
            atlas.counts()


def test_a_file_that_is_only_read_is_not_changed_and_nothing_is_left_beside_it(good: Path) -> None:
    before, folder = good.read_bytes(), set(good.parent.iterdir())
    with closing(AtlasFile(good)) as atlas:
        with pytest.raises((InputError, StorageError)):
            atlas.add_physics(PhysicsRow(2, 16))
        assert len(list(atlas.entries())) == 6
    assert (good.read_bytes(), set(good.parent.iterdir())) == (before, folder)


def test_an_atlas_is_read_while_a_run_writes_to_it_and_after_the_run_was_killed(good: Path) -> None:
    with closing(sqlite3.connect(good, isolation_level=None)) as run_connection:
        run_connection.execute("PRAGMA cache_size = 1")
        run_connection.execute("BEGIN IMMEDIATE")
        run_connection.execute("UPDATE gaits SET reason = 'half done'")
        with closing(AtlasFile(good)) as atlas:
            assert "half done" not in {row.reason for row in atlas.rows()}
        run_connection.execute("COMMIT")
    killed = _killed_in_a_transaction(good)
    assert killed.with_name(killed.name + "-journal").stat().st_size > 0
    with closing(AtlasFile(killed)) as atlas:
        assert atlas.counts()[RowStatus.SOLVED] == 4


def _killed_in_a_transaction(path: Path) -> Path:
    """A copy of an atlas in the midst of a transaction that is larger than the memory for it."""
    copy = path.with_name("killed.sqlite")
    with closing(sqlite3.connect(path, isolation_level=None)) as connection:
        connection.execute("PRAGMA cache_size = 1")
        connection.execute("BEGIN")
        connection.execute("UPDATE gaits SET reason = printf('%.*c', 5000, 'x'), status = 'gone'")
        copy.write_bytes(path.read_bytes())
        journal = path.with_name(path.name + "-journal")
        copy.with_name(copy.name + "-journal").write_bytes(journal.read_bytes())
        connection.execute("ROLLBACK")
    return copy


def test_a_table_marks_what_a_spreadsheet_would_run(tmp_path: Path) -> None:
    path = write_atlas(tmp_path / "formula.sqlite", FORMULA)
    with closing(AtlasFile(path)) as atlas:
        export_atlas(atlas, tmp_path / "a.csv")
        export_atlas(atlas, tmp_path / "a.html")
    rows = list(csv.DictReader((tmp_path / "a.csv").read_text().splitlines()))
    assert rows[0]["reason"] == f"'{FORMULA}"
    assert float(rows[1]["speed"]) == 1e-3
    assert FORMULA not in (tmp_path / "a.html").read_text()
