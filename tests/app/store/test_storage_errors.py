"""What SQLite and the disk refuse is said in a sentence, and nothing is half-stored."""

from __future__ import annotations

import errno
import os
import resource
import sqlite3
import subprocess
import sys
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest

from app.gaits.approvals import ApprovalRequest
from app.store.database import Database
from app.store.gait_files import GaitFiles
from app.store.plain_file import write_atomically
from app.store.storage_errors import file_error, storage_error
from app.store.tables.result_store import ResultStore
from core.errors import InputError, StorageDamagedError, StorageError, StorageFullError
from core.library.library import library
from tests.support.spoilt_database import service_on, take_more, take_no_more
from tests.support.studio_process import PROJECT

LONG = "n" * 20_000
"""More than a database that takes no more has room for in its last pages."""


class RefusedError(sqlite3.OperationalError):
    def __init__(self, code: int, text: str = "what SQLite says") -> None:
        super().__init__(text)
        self.sqlite_errorcode = code


@pytest.mark.parametrize(
    ("code", "kind"),
    [
        (sqlite3.SQLITE_FULL, StorageFullError),
        (sqlite3.SQLITE_TOOBIG, StorageFullError),
        (sqlite3.SQLITE_NOMEM, StorageFullError),
        (sqlite3.SQLITE_IOERR, StorageError),
        (sqlite3.SQLITE_IOERR_WRITE, StorageError),
        (sqlite3.SQLITE_READONLY, StorageError),
        (sqlite3.SQLITE_BUSY, StorageError),
        (sqlite3.SQLITE_LOCKED, StorageError),
        (sqlite3.SQLITE_CANTOPEN, StorageError),
        (sqlite3.SQLITE_PROTOCOL, StorageError),
        (sqlite3.SQLITE_PERM, StorageError),
        (sqlite3.SQLITE_ERROR, StorageError),
        (sqlite3.SQLITE_CORRUPT, StorageDamagedError),
        (sqlite3.SQLITE_CORRUPT_INDEX, StorageDamagedError),
        (sqlite3.SQLITE_NOTADB, StorageDamagedError),
    ],
)
def test_every_kind_of_refusal_names_the_file_and_the_reason(code: int, kind: type[StorageError]) -> None:
    refusal = storage_error(RefusedError(code), Path("/somewhere/studio.sqlite3"))
    assert type(refusal) is kind
    assert refusal.where == "/somewhere/studio.sqlite3"
    assert refusal.where in refusal.sentence
    assert "what SQLite says" in refusal.sentence


@pytest.mark.parametrize("error", [sqlite3.IntegrityError("twice"), sqlite3.ProgrammingError("closed")])
def test_a_defect_of_the_program_stays_one(error: sqlite3.Error) -> None:
    assert storage_error(error, Path("x")) is None


@pytest.mark.parametrize(
    ("number", "kind"),
    [
        (errno.ENOSPC, StorageFullError),
        (errno.EDQUOT, StorageFullError),
        (errno.EFBIG, StorageFullError),
        (errno.EIO, StorageError),
        (errno.EROFS, StorageError),
        (errno.EACCES, StorageError),
        (errno.ENOENT, InputError),
    ],
)
def test_a_file_that_cannot_be_written_says_why(number: int, kind: type[Exception]) -> None:
    refusal = file_error(OSError(number, os.strerror(number)), Path("/data/gaits/walk.json"))
    assert type(refusal) is kind
    assert os.strerror(number) in refusal.sentence


def test_an_edit_and_an_approval_on_a_full_disk_leave_everything_as_it_was(tmp_path: Path) -> None:
    with closing(Database(tmp_path / "studio.sqlite3")) as database:
        service = service_on(tmp_path, database)
        manual = "walk-manual-0"
        kept = service.edit(manual, replace(service.open_gait(manual).gait, notes="kept"), "Notes", None)
        service.check(manual)
        versions = service.versions.all(manual)
        take_no_more(database)
        with pytest.raises(StorageFullError):
            service.edit(manual, replace(kept.gait, notes=LONG), "Notes", None)
        with pytest.raises(StorageFullError):
            service.approve(manual, ApprovalRequest(by="Ada" * 4000, accept_warnings=True))
        now = service.open_gait(manual)
        assert (now.gait, now.revision, now.approval) == (kept.gait, kept.revision, None)
        again = service_on(tmp_path, database)
        assert (again.open_gait(manual).gait, again.versions.all(manual)) == (kept.gait, versions)
        take_more(database)
        assert service.edit(manual, replace(kept.gait, notes=LONG), "Notes", None).gait.notes == LONG


def test_a_save_whose_version_finds_no_room_leaves_the_file_as_it_was(tmp_path: Path) -> None:
    with closing(Database(tmp_path / "studio.sqlite3")) as database:
        service = service_on(tmp_path, database)
        service.save("walk")
        before = (tmp_path / "gaits" / "walk.json").read_bytes()
        service.edit("walk", replace(service.open_gait("walk").gait, notes=LONG), "Notes", None)
        saved = service.open_gait("walk").saved
        take_no_more(database)
        with pytest.raises(StorageFullError):
            service.save("walk")
        with pytest.raises(StorageFullError):
            service.create(replace(library()["amble"].gait, name="New", notes=LONG))
        assert [path.name for path in (tmp_path / "gaits").iterdir()] == ["walk.json"]
        assert (tmp_path / "gaits" / "walk.json").read_bytes() == before
        assert service.open_gait("walk").saved == saved


def test_a_gait_file_that_finds_no_room_leaves_the_old_one_and_no_version(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(file: int) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with closing(Database(tmp_path / "studio.sqlite3")) as database:
        service = service_on(tmp_path, database)
        service.save("walk")
        path = tmp_path / "gaits" / "walk.json"
        before, versions = path.read_bytes(), service.versions.all("walk")
        service.edit("walk", replace(service.open_gait("walk").gait, name="Other"), "Name", None)
        with monkeypatch.context() as patched:
            patched.setattr(os, "fsync", full)
            with pytest.raises(StorageFullError, match=r"walk\.json"):
                service.save("walk")
        assert (path.read_bytes(), service.versions.all("walk")) == (before, versions)
        assert list(path.parent.iterdir()) == [path]


def test_a_gait_that_cannot_be_moved_to_the_trash_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(source: Path, target: Path) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    files = GaitFiles(tmp_path)
    files.write("walk", library()["walk"].gait)
    with monkeypatch.context() as patched:
        patched.setattr(Path, "replace", full)
        with pytest.raises(StorageFullError):
            files.remove("walk")
    assert files.ids() == ("walk",)


WRITE = """
import resource, sys
from pathlib import Path
from app.cli import main
resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
sys.exit(main(sys.argv[1:]))
"""


def test_a_command_whose_file_finds_no_room_is_bad_input_with_a_sentence(tmp_path: Path) -> None:
    assert resource.RLIMIT_FSIZE
    path = tmp_path / "walk.csv"
    path.write_text("old")
    words = ["manual", "walk", "-o", str(path)]
    ended = subprocess.run([sys.executable, "-c", WRITE, *words], cwd=PROJECT, capture_output=True, text=True)
    assert (ended.returncode, path.read_text()) == (2, "old"), ended.stderr
    assert str(path) in ended.stderr
    assert "Traceback" not in ended.stderr
    assert list(tmp_path.iterdir()) == [path]


def test_what_is_written_before_a_file_takes_its_place_can_refuse_it(tmp_path: Path) -> None:
    def refuse() -> None:
        raise StorageError("no", "here")

    path = tmp_path / "file"
    write_atomically(path, "old")
    with pytest.raises(StorageError):
        write_atomically(path, "new", refuse)
    assert (path.read_text(), list(tmp_path.iterdir())) == ("old", [path])


def test_a_database_that_another_program_writes_to_says_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with closing(Database(tmp_path / "studio.sqlite3")) as database:
        database.rows("PRAGMA busy_timeout=1")
        with closing(sqlite3.connect(database.path)) as other:
            other.execute("BEGIN IMMEDIATE")
            with pytest.raises(StorageError, match="locked"):
                ResultStore(database).put("x", {})
        ResultStore(database).put("x", {"a": 1})
        assert ResultStore(database).get("x") == {"a": 1}
