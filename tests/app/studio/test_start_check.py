"""The doctor's look at a data folder: it says what a start of the studio says, and leaves nothing behind."""

from __future__ import annotations

import os
import sqlite3
import subprocess
import sys
import tempfile
from contextlib import closing
from pathlib import Path

import pytest

from app.store.database import DATABASE, Database
from app.store.folder_lock import STUDIO, StudioLock
from app.store.gait_files import GaitFiles
from app.store.tables.result_store import ResultStore
from app.studio.start_check import check_start
from core.errors import FootfallError
from core.library.library import library
from tests.support.command import run
from tests.support.studio_process import PROJECT

NOBODY = 65534
AS_NOBODY = f"""
import os, sys
from pathlib import Path
from app.store.database import DATABASE, Database
from app.studio.start_check import check_start
from app.store.gait_files import require_folder
from core.errors import FootfallError
os.setgroups([]); os.setgid({NOBODY}); os.setuid({NOBODY})
for act in (require_folder, check_start, lambda data: Database(data / DATABASE)):
    try:
        act(Path(sys.argv[1]))
    except FootfallError as refusal:
        print(refusal.sentence)
"""


def contents(folder: Path) -> dict[str, bytes | None]:
    """What is in a folder, by path."""
    paths = sorted(folder.rglob("*"))
    return {str(path.relative_to(folder)): path.read_bytes() if path.is_file() else None for path in paths}


def serve_sentence(capsys: pytest.CaptureFixture[str], data: Path) -> str:
    """What `serve` says of a folder in which it does not start."""
    status, _, err = run(capsys, "serve", "--no-browser", "--port", "0", "--data", str(data))
    assert status == 2
    return err.splitlines()[-1]


@pytest.mark.parametrize(
    ("spoiled", "is_file"),
    [
        ("", True),
        ("gaits", True),
        ("trash", True),
        ("running", True),
        ("backups", True),
        ("atlases", True),
        ("set-aside", True),
        ("trial-photos", True),
        (STUDIO, False),
        (DATABASE, False),
        ("database.lock", False),
    ],
)
def test_it_says_what_serve_says(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, spoiled: str, is_file: bool
) -> None:
    data = tmp_path / "data"
    spoilt = data / spoiled if spoiled else data
    spoilt.parent.mkdir(exist_ok=True)
    spoilt.touch() if is_file else spoilt.mkdir()
    before = contents(tmp_path)
    with pytest.raises(FootfallError) as refusal:
        check_start(data)
    assert contents(tmp_path) == before
    assert refusal.value.sentence == serve_sentence(capsys, data)


@pytest.mark.parametrize("place", ["/proc/footfall", "/dev/null/data", "/proc/version/data"])
def test_a_folder_that_cannot_be_made_is_no_ok(capsys: pytest.CaptureFixture[str], place: str) -> None:
    with pytest.raises(FootfallError, match="cannot be made") as refusal:
        check_start(Path(place))
    assert refusal.value.sentence == serve_sentence(capsys, Path(place))


@pytest.mark.skipif(os.getuid() != 0, reason="only root can become somebody else")
@pytest.mark.parametrize("mode", [0o755, 0o700])
def test_a_home_without_the_right_to_write_is_no_ok(mode: int) -> None:
    with tempfile.TemporaryDirectory() as home:
        Path(home).chmod(mode)
        data = Path(home) / ".local/share/footfall-studio"
        command = [sys.executable, "-c", AS_NOBODY, str(data)]
        said = subprocess.run(command, cwd=PROJECT, capture_output=True, text=True, check=True)
    made, checked, _ = said.stdout.splitlines()
    assert made == f"The data folder {data} cannot be made: Permission denied. Give another with --data."
    assert checked == made


@pytest.mark.skipif(os.getuid() != 0, reason="only root can become somebody else")
def test_a_database_that_may_only_be_read_is_no_ok() -> None:
    with tempfile.TemporaryDirectory() as folder:
        data = Path(folder)
        Database(data / DATABASE).close()
        (data / DATABASE).chmod(0o400)
        for path in (data, *data.iterdir()):
            os.chown(path, NOBODY, NOBODY)
        before = (data / DATABASE).read_bytes()
        command = [sys.executable, "-c", AS_NOBODY, str(data)]
        said = subprocess.run(command, cwd=PROJECT, capture_output=True, text=True, check=True)
        assert (data / DATABASE).read_bytes() == before
    checked, opened = said.stdout.splitlines()
    assert checked == opened
    assert "may only be read" in checked
    assert "Give yourself the right to write to it" in checked


@pytest.mark.parametrize("table", ["run", "open_gait", "physics_set"])
def test_a_database_without_one_of_its_tables_is_no_ok(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, table: str
) -> None:
    Database(tmp_path / DATABASE).close()
    with closing(sqlite3.connect(tmp_path / DATABASE)) as connection:
        connection.execute(f"DROP TABLE {table}")
    with pytest.raises(FootfallError) as refusal:
        check_start(tmp_path)
    assert f"is damaged (its table {table} is missing). Nothing can be stored." in refusal.value.sentence
    assert "footfall restore" in refusal.value.sentence
    assert refusal.value.sentence == serve_sentence(capsys, tmp_path)


@pytest.mark.parametrize("place", ["data", "home/.local/share/footfall-studio"])
def test_a_new_folder_is_tried_and_taken_away(tmp_path: Path, place: str) -> None:
    found = check_start(tmp_path / place)
    assert (found.is_new, found.gaits, found.is_outdated) == (True, 0, False)
    assert list(tmp_path.iterdir()) == []


def test_a_used_folder_stays_as_it_was(tmp_path: Path) -> None:
    GaitFiles(tmp_path).write("mine", library()["walk"].gait)
    Database(tmp_path / DATABASE).close()
    before = contents(tmp_path)
    found = check_start(tmp_path)
    assert (found.is_new, found.gaits) == (False, 1)
    assert contents(tmp_path) == before


def test_an_older_database_is_not_changed(tmp_path: Path) -> None:
    Database(tmp_path / DATABASE).close()
    with closing(sqlite3.connect(tmp_path / DATABASE)) as connection:
        connection.execute("PRAGMA user_version = 1")
    before = contents(tmp_path)
    assert check_start(tmp_path).is_outdated
    assert contents(tmp_path) == before


def test_a_newer_a_damaged_and_a_locked_database_are_no_ok(tmp_path: Path) -> None:
    path = tmp_path / DATABASE
    Database(path).close()
    with closing(sqlite3.connect(path)) as connection:
        connection.execute("PRAGMA user_version = 9999")
    with pytest.raises(FootfallError, match="newer"):
        check_start(tmp_path)
    path.write_bytes(b"no database at all, but long enough to be read as one" * 100)
    with pytest.raises(FootfallError, match="damaged"):
        check_start(tmp_path)
    path.unlink()
    with closing(StudioLock(tmp_path, "restore")), pytest.raises(FootfallError, match="Another restore"):
        check_start(tmp_path)


def test_a_database_that_another_program_opens_meanwhile_stays(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[Database] = []

    def other_program(folder: Path) -> None:
        opened.append(Database(tmp_path / DATABASE))

    monkeypatch.setattr("app.studio.start_check.VideoFiles", other_program)
    check_start(tmp_path)
    ResultStore(opened[0]).put("motion", {"kept": True})
    opened[0].close()
    with closing(Database(tmp_path / DATABASE)) as database:
        assert ResultStore(database).get("motion") == {"kept": True}
    assert not (tmp_path / STUDIO).exists()
