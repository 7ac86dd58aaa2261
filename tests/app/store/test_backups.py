"""Backups of the database, and the way back to one."""

from __future__ import annotations

import os
import shutil
import sqlite3
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest

from app.common.json import Json
from app.store import backups
from app.store.backups import DAILY, MIGRATION, MOST, found_backups, last_good, make_backup
from app.store.database import Database
from app.store.folder_lock import StudioLock
from app.store.quick_check import damage_of
from app.store.restore import restore
from app.store.schema import NEWEST
from app.store.tables.job_store import JobStore
from app.store.tables.result_store import ResultStore
from app.studio import database_keeper
from app.studio.database_keeper import DatabaseKeeper
from core.errors import InputError, NotFoundError, StorageDamagedError, StorageError, StorageFullError
from core.library.library import library
from tests.app.store.test_old_database import old_database
from tests.support.set_clock import SetClock
from tests.support.spoilt_database import fill, overwrite, overwrite_table, service_on


def keeper_of(database: Database, told: list[Json] | None = None) -> DatabaseKeeper:
    return DatabaseKeeper(database, (told if told is not None else []).append, lambda: True)


def without_room(*_: Any) -> Any:
    return shutil._ntuple_diskusage(10**9, 10**9, 0)


def test_a_backup_holds_what_was_acknowledged_also_while_the_database_is_open(tmp_path: Path) -> None:
    with closing(Database(tmp_path / "studio.sqlite3")) as database:
        ResultStore(database).put("x", {"a": 1})
        backup = make_backup(database.path, DAILY)
    assert found_backups(tmp_path) == (backup,)
    assert [path.name for path in backup.path.parent.iterdir()] == [backup.path.name]
    with closing(sqlite3.connect(backup.path)) as copy:
        assert copy.execute("SELECT content FROM result").fetchall() == [('{"a": 1}',)]


def test_garbage_in_the_middle_of_a_database_is_found_and_no_backup_is_made_of_it(tmp_path: Path) -> None:
    path = fill(tmp_path)
    assert damage_of(path) is None
    good = make_backup(path, DAILY)
    overwrite(path)
    assert damage_of(path) is not None
    with pytest.raises(StorageDamagedError):
        make_backup(path, DAILY)
    assert [backup.path for backup in found_backups(tmp_path)] == [good.path]


def test_only_the_newest_backups_are_kept_of_each_kind(tmp_path: Path) -> None:
    path = fill(tmp_path, 1)
    first = make_backup(path, MIGRATION)
    folder = first.path.parent
    for day in range(1, MOST[DAILY] + 3):
        old = folder / f"studio-2026-01-{day:02d}-000000-{DAILY}.sqlite3"
        shutil.copyfile(first.path, old)
        os.utime(old, (day * 86_400, day * 86_400))
    newest = make_backup(path, DAILY)
    kept = [backup.path.name for backup in found_backups(tmp_path)]
    assert (newest.path.name in kept, first.path.name in kept) == (True, True)
    assert len(kept) == MOST[DAILY] + 1
    assert not any("2026-01-01" in name for name in kept)


def test_what_is_no_file_or_cannot_be_read_is_no_good_backup(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = fill(tmp_path, 1)
    good = make_backup(path, DAILY)
    folder = good.path.parent
    (folder / "studio-a.sqlite3").mkdir()
    (folder / "studio-b.sqlite3").symlink_to(tmp_path / "nowhere")
    unreadable = folder / "studio-c.sqlite3"
    unreadable.write_bytes(b"")

    def damage(found: Path) -> str | None:
        if found == unreadable:
            raise StorageError("It cannot be opened.", str(found))
        return damage_of(found)

    monkeypatch.setattr(backups, "damage_of", damage)
    assert {backup.path for backup in found_backups(tmp_path)} == {good.path, unreadable}
    assert last_good(tmp_path) == good


def test_a_disk_that_fails_while_a_backup_is_due_does_not_end_the_backups(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails(*_: Any) -> Any:
        raise PermissionError(13, "Permission denied")

    with closing(Database(tmp_path / "studio.sqlite3")) as database:
        keeper = keeper_of(database)
        with monkeypatch.context() as failing:
            failing.setattr(database_keeper, "found_backups", fails)
            keeper.look()
        assert "Permission denied" in str(keeper.view()["sentence"])
        keeper.look()
        assert keeper.view()["sentence"] is None


def test_what_a_kill_left_of_a_backup_goes_with_the_next_one(tmp_path: Path) -> None:
    path = fill(tmp_path, 1)
    folder = tmp_path / backups.FOLDER
    folder.mkdir()
    partial = folder / ".studio-x.1.partial"
    partial.write_bytes(b"half")
    os.utime(partial, (1.0, 1.0))
    make_backup(path, DAILY)
    assert not partial.exists()
    assert len(list(folder.iterdir())) == 1


def test_without_room_no_backup_is_begun_and_none_is_lost(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = fill(tmp_path, 1)
    good = make_backup(path, DAILY)
    monkeypatch.setattr(shutil, "disk_usage", without_room)
    with pytest.raises(StorageFullError):
        make_backup(path, DAILY)
    assert [path.name for path in good.path.parent.iterdir()] == [good.path.name]


def test_an_older_database_is_copied_before_it_is_changed(tmp_path: Path) -> None:
    path = tmp_path / "studio.sqlite3"
    old_database(path, 3)
    Database(path).close()
    (backup,) = found_backups(tmp_path)
    with closing(sqlite3.connect(backup.path)) as copy:
        assert copy.execute("PRAGMA user_version").fetchone() == (0,)
        assert copy.execute("SELECT COUNT(*) FROM history").fetchone() == (4,)
    Database(path).close()
    assert found_backups(tmp_path) == (backup,)


def test_an_older_database_is_left_alone_where_its_copy_finds_no_room(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "studio.sqlite3"
    old_database(path, 3)
    monkeypatch.setattr(shutil, "disk_usage", without_room)
    with pytest.raises(StorageFullError):
        Database(path)
    with closing(sqlite3.connect(path)) as connection:
        assert connection.execute("PRAGMA user_version").fetchone() == (0,)


def test_a_new_database_needs_no_backup_to_begin(tmp_path: Path) -> None:
    Database(tmp_path / "studio.sqlite3").close()
    assert found_backups(tmp_path) == ()


def test_a_backup_is_made_once_a_day_and_only_of_something_new(tmp_path: Path) -> None:
    clock = SetClock()
    with closing(Database(tmp_path / "studio.sqlite3", clock)) as database:
        keeper = keeper_of(database)
        keeper.look()
        (first,) = found_backups(tmp_path)
        keeper.look()
        clock.pass_seconds(database_keeper.DAY_SECONDS + 1)
        keeper.look()
        assert found_backups(tmp_path) == (first,)
        ResultStore(database).put("x", {})
        keeper.look()
        assert len(found_backups(tmp_path)) == 2


def test_no_backup_begins_while_a_robot_moves(tmp_path: Path) -> None:
    with closing(Database(tmp_path / "studio.sqlite3")) as database:
        DatabaseKeeper(database, lambda view: None, lambda: False).look()
    assert found_backups(tmp_path) == ()


def test_a_backup_that_fails_is_told_and_taken_back_by_the_next_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    told: list[Json] = []
    with closing(Database(tmp_path / "studio.sqlite3")) as database:
        keeper = keeper_of(database, told)
        with monkeypatch.context() as patched:
            patched.setattr(shutil, "disk_usage", without_room)
            keeper.look()
            keeper.look()
        assert [(view["damaged"], view["sentence"] is None) for view in told] == [(False, False)]
        keeper.look()
    assert told[-1] == {"damaged": False, "sentence": None}


def test_a_damaged_database_is_read_where_it_can_be_and_takes_nothing(tmp_path: Path) -> None:
    path = fill(tmp_path)
    good = make_backup(path, DAILY)
    overwrite_table(path, "job")
    told: list[Json] = []
    with closing(Database(path)) as database:
        keeper = keeper_of(database, told)
        assert told == [keeper.view()]
        assert told[0]["damaged"]
        for word in ("jobs", good.path.name, "footfall restore", str(tmp_path)):
            assert word in told[0]["sentence"]
        service = service_on(tmp_path, database)
        assert service.open_gait("walk").gait.name == "Number 12"
        with pytest.raises(StorageDamagedError, match="footfall restore"):
            service.edit("walk", library()["walk"].gait, "Name", None)
        with pytest.raises(StorageDamagedError, match=good.path.name):
            JobStore(database).newest(50)
        keeper.look()
    assert [backup.path for backup in found_backups(tmp_path)] == [good.path]


def test_damage_that_is_found_on_the_way_is_told_once(tmp_path: Path) -> None:
    told: list[Json] = []
    path = fill(tmp_path)
    with closing(Database(path)) as database:
        keeper_of(database, told)
        assert told == []
        overwrite_table(path, "result")
        database.rows("PRAGMA shrink_memory")
        for _ in range(2):
            with pytest.raises(StorageDamagedError, match="no good backup"):
                ResultStore(database).get("0" * 64)
    assert len(told) == 1


@pytest.mark.parametrize("content", [b"no database at all" * 500, b"SQLite format 3\0" + b"\xa5" * 8000])
def test_a_file_that_is_no_database_is_refused_with_the_way_back(tmp_path: Path, content: bytes) -> None:
    path = fill(tmp_path)
    good = make_backup(path, DAILY)
    path.write_bytes(content)
    with pytest.raises(StorageError) as refused:
        Database(path)
    assert good.path.name in refused.value.sentence
    assert path.read_bytes() == content


def test_text_that_is_none_damages_its_row_alone(tmp_path: Path) -> None:
    path = tmp_path / "studio.sqlite3"
    with closing(Database(path)) as database:
        for number, content in enumerate((b"\xff\xfe", b"\0\0\0")):
            with database.writing() as connection:
                connection.execute("INSERT INTO result VALUES(?, CAST(? AS TEXT))", (str(number), content))
        assert [ResultStore(database).get(str(number)) for number in range(2)] == [None, None]
        assert [damage.table for damage in database.row_damages.values()] == ["result", "result"]
        assert database.damage is None


def test_going_back_keeps_the_damaged_file_aside(tmp_path: Path) -> None:
    path = fill(tmp_path)
    good = make_backup(path, DAILY)
    overwrite(path)
    spoilt = path.read_bytes()
    (tmp_path / "studio.sqlite3-wal").write_bytes(b"what was beside it")
    aside = restore(tmp_path, Path(good.path.name))
    assert aside is not None
    assert (aside / "studio.sqlite3").read_bytes() == spoilt
    assert (aside / "studio.sqlite3-wal").read_bytes() == b"what was beside it"
    assert not (tmp_path / "studio.sqlite3-wal").exists()
    with closing(Database(path)) as database:
        assert service_on(tmp_path, database).open_gait("walk").gait.name == "Number 12"
        service_on(tmp_path, database).undo("walk")
    assert good.path.exists()


def test_going_back_to_an_older_version_brings_it_up_to_date(tmp_path: Path) -> None:
    path = tmp_path / "studio.sqlite3"
    old_database(path, 3)
    Database(path).close()
    (backup,) = found_backups(tmp_path)
    restore(tmp_path, backup.path)
    with closing(Database(path)) as database:
        assert database.rows("PRAGMA user_version") == [(NEWEST,)]


def test_without_a_backup_one_can_begin_anew(tmp_path: Path) -> None:
    path = fill(tmp_path)
    overwrite(path, 0.0)
    with pytest.raises(StorageDamagedError, match="--empty"):
        Database(path)
    assert restore(tmp_path, None) is not None
    with closing(Database(path)) as database:
        assert JobStore(database).newest(50).rows == ()


def test_nobody_goes_back_under_a_program_that_has_the_folder_or_its_database(tmp_path: Path) -> None:
    path = fill(tmp_path, 1)
    good = make_backup(path, DAILY)
    with closing(StudioLock(tmp_path)), pytest.raises(InputError, match=str(os.getpid())):
        restore(tmp_path, good.path)
    with closing(Database(path)), pytest.raises(InputError, match="send"):
        restore(tmp_path, good.path)


def test_a_backup_that_is_damaged_missing_or_newer_changes_nothing(tmp_path: Path) -> None:
    path = fill(tmp_path)
    content = path.read_bytes()
    good, bad, newer = make_backup(path, DAILY).path, tmp_path / "bad.sqlite3", tmp_path / "newer.sqlite3"
    shutil.copyfile(good, bad)
    overwrite(bad)
    shutil.copyfile(good, newer)
    with closing(sqlite3.connect(newer)) as connection:
        connection.execute("PRAGMA user_version=99")
    for chosen, kind in ((bad, InputError), (tmp_path / "none", NotFoundError), (newer, InputError)):
        with pytest.raises(kind):
            restore(tmp_path, chosen)
    assert path.read_bytes() == content
    assert not (tmp_path / "damaged").exists()
    assert last_good(tmp_path) is not None


def test_a_full_disk_leaves_the_database_in_its_place(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = fill(tmp_path)
    good = make_backup(path, DAILY)
    content = path.read_bytes()

    def full(source: Path, target: Path) -> None:
        Path(target).write_bytes(b"half")
        raise OSError(28, os.strerror(28))

    monkeypatch.setattr(shutil, "copyfile", full)
    with pytest.raises(StorageFullError):
        restore(tmp_path, good.path)
    assert path.read_bytes() == content
    assert not list(tmp_path.glob(".*"))


def test_a_zero_within_a_text_is_no_damage(tmp_path: Path) -> None:
    database = Database(tmp_path / "studio.sqlite3")
    with closing(database), database.writing() as connection:
        connection.execute("INSERT INTO job VALUES('a', 1.0, ?)", ("an old\0 label",))
        assert connection.execute("SELECT content FROM job").fetchone() == ("an old\0 label",)
