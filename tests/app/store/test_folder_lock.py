"""Two studios do not share a data folder; other commands do."""

from __future__ import annotations

import errno
import fcntl
import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from app.store.database import Database
from app.store.folder_lock import STUDIO, DatabaseUse, StudioLock
from core.errors import InputError
from tests.support.studio_process import PROJECT

HOLD = """
import sys, time
from pathlib import Path
from app.store.folder_lock import StudioLock
StudioLock(Path(sys.argv[1])).tell("http://127.0.0.1:8412/")
print("held", flush=True)
time.sleep(600)
"""


@pytest.fixture
def holder(tmp_path: Path) -> Iterator[subprocess.Popen[bytes]]:
    with subprocess.Popen([sys.executable, "-c", HOLD, tmp_path], cwd=PROJECT, stdout=-1) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == b"held\n"
        yield process
        process.kill()


def test_a_folder_that_is_held_names_its_holder(holder: subprocess.Popen[bytes], tmp_path: Path) -> None:
    with pytest.raises(InputError) as refused:
        StudioLock(tmp_path)
    assert refused.value.where == "--data"
    for word in (str(holder.pid), "http://127.0.0.1:8412/", str(tmp_path), "--data"):
        assert word in refused.value.sentence


def test_a_folder_is_free_as_soon_as_its_holder_was_killed(
    holder: subprocess.Popen[bytes], tmp_path: Path
) -> None:
    holder.kill()
    holder.wait()
    assert json.loads((tmp_path / STUDIO).read_bytes())["process"] == holder.pid
    StudioLock(tmp_path).close()


def test_a_link_to_the_folder_is_the_same_folder(tmp_path: Path) -> None:
    data, link = tmp_path / "data", tmp_path / "link"
    data.mkdir()
    link.symlink_to(data)
    lock = StudioLock(data)
    with pytest.raises(InputError, match=str(os.getpid())):
        StudioLock(link)
    lock.close()
    StudioLock(link).close()


@pytest.mark.parametrize("content", [b"", b"{", b"[1]", b"\xff"])
def test_a_holder_that_could_not_say_who_it_is_is_refused_all_the_same(
    tmp_path: Path, content: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("app.store.folder_lock._LOOKS", 1)
    lock = StudioLock(tmp_path)
    (tmp_path / STUDIO).write_bytes(content)
    with pytest.raises(InputError, match="has the data folder"):
        StudioLock(tmp_path)
    lock.close()


@pytest.mark.parametrize("number", [errno.ENOLCK, errno.EOPNOTSUPP])
def test_a_file_system_without_locks_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: int
) -> None:
    def refuse(file: int, operation: int) -> None:
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr(fcntl, "flock", refuse)
    with pytest.raises(InputError, match="--data"):
        StudioLock(tmp_path)
    with pytest.raises(InputError, match="--data"):
        Database(tmp_path / "studio.sqlite3")


def test_a_database_is_opened_by_many_and_replaced_by_one_alone(tmp_path: Path) -> None:
    path = tmp_path / "studio.sqlite3"
    studio, sender = Database(path), Database(path)
    with pytest.raises(InputError, match="open"):
        DatabaseUse(tmp_path, alone=True)
    studio.close()
    with pytest.raises(InputError, match="open"):
        DatabaseUse(tmp_path, alone=True)
    sender.close()
    alone = DatabaseUse(tmp_path, alone=True)
    with pytest.raises(InputError, match="replaces"):
        Database(path)
    alone.close()
    Database(path).close()
