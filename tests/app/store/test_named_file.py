"""Files that a person names: plain ones are replaced with all that is theirs, others are written through."""

from __future__ import annotations

import errno
import os
import pty
import socket
import stat
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from app.export.trajectory_files import companion_path, write_with_companion
from app.store.named_file import form_of, is_plain, open_file_number, write_named
from core.errors import FootfallError, InputError, StorageFullError
from tests.support.studio_process import PROJECT

OLD, NEW = "old\n", "new content\n"


WRITES = """
import os, resource, sys
from pathlib import Path
from app.store.named_file import write_named
from core.errors import FootfallError
number = int(sys.argv[1])
if number:
    os.setgroups([]), os.setgid(number), os.setuid(number)
else:
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
for path in sys.argv[2:]:
    try:
        write_named(Path(path), "new content" * 1000)
    except FootfallError as refusal:
        print(refusal.sentence)
"""
"""Writes files as another account, or as this one on a disk that takes 4 kB a file."""


def said_of_writes(account: int, *paths: Path) -> list[str]:
    """What a process that writes files says, a line for each refusal."""
    command = [sys.executable, "-c", WRITES, str(account), *map(str, paths)]
    return subprocess.run(
        command, cwd=PROJECT, capture_output=True, text=True, check=True
    ).stdout.splitlines()


def write_beside(path: Path) -> None:
    """Writes a file with a companion."""
    write_named(path, NEW, path.with_suffix(".companion"), NEW)


@pytest.fixture
def old(tmp_path: Path) -> Path:
    path = tmp_path / "file.csv"
    path.write_text(OLD)
    return path


@contextmanager
def read_pipe(path: Path) -> Iterator[Callable[[], bytes]]:
    """Reads a pipe in another thread; gives what came, once the writer has closed it."""
    came: list[bytes] = []
    reader = threading.Thread(target=lambda: came.append(path.read_bytes()))
    reader.start()

    def content() -> bytes:
        reader.join(30)
        return came[0]

    yield content


@pytest.mark.parametrize("mode", [0o600, 0o640, 0o664, 0o755])
def test_a_replaced_file_keeps_its_mode(old: Path, mode: int) -> None:
    old.chmod(mode)
    write_named(old, NEW)
    assert (old.read_text(), stat.S_IMODE(old.stat().st_mode)) == (NEW, mode)


def test_a_new_file_has_the_mode_of_every_new_file(tmp_path: Path) -> None:
    write_named(tmp_path / "new.csv", NEW)
    (tmp_path / "other").touch()
    assert (tmp_path / "new.csv").stat().st_mode == (tmp_path / "other").stat().st_mode


@pytest.mark.parametrize("name", ["n" * 251 + ".csv", "ä" * 125 + ".csv", "-", "a\nb\x1b.csv", " .csv"])
def test_every_name_that_a_file_may_have_is_written(tmp_path: Path, name: str) -> None:
    write_named(tmp_path / name, OLD)
    write_named(tmp_path / name, NEW)
    assert [(path.name, path.read_text()) for path in tmp_path.iterdir()] == [(name, NEW)]


@pytest.mark.skipif(os.getuid() != 0, reason="only root gives files away")
def test_a_replaced_file_keeps_its_owner_and_group(old: Path) -> None:
    os.chown(old, 12345, 23456)
    old.chmod(0o640)
    write_named(old, NEW)
    state = old.stat()
    assert (state.st_uid, state.st_gid, stat.S_IMODE(state.st_mode)) == (12345, 23456, 0o640)


def test_a_replaced_file_keeps_its_extended_attributes(old: Path) -> None:
    try:
        os.setxattr(old, "user.origin", b"lab")
    except OSError:
        pytest.skip("this file system has no extended attributes")
    write_named(old, NEW)
    assert os.getxattr(old, "user.origin") == b"lab"


def test_links_are_followed_and_stay(tmp_path: Path, old: Path) -> None:
    near, far = tmp_path / "near", tmp_path / "far"
    near.symlink_to("file.csv")
    far.symlink_to(near)
    write_named(far, NEW)
    assert far.is_symlink()
    assert near.is_symlink()
    assert old.read_text() == NEW


def test_the_target_of_a_link_that_leads_nowhere_is_made(tmp_path: Path) -> None:
    link = tmp_path / "link.csv"
    link.symlink_to("target.csv")
    write_beside(link)
    assert link.is_symlink()
    assert (tmp_path / "target.csv").read_text() == NEW
    assert (tmp_path / "link.companion").read_text() == NEW


def test_devices_stay_devices_and_get_no_companion(tmp_path: Path) -> None:
    before = Path(os.devnull).stat()
    write_named(Path(os.devnull), NEW)
    link = tmp_path / "null.csv"
    link.symlink_to(os.devnull)
    write_beside(link)
    after = Path(os.devnull).stat()
    assert (before.st_ino, before.st_mode, before.st_rdev) == (after.st_ino, after.st_mode, after.st_rdev)
    assert [path.name for path in tmp_path.iterdir()] == ["null.csv"]
    assert link.is_symlink()
    assert not is_plain(link)


def test_a_pipe_gets_the_content(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    with read_pipe(pipe) as content:
        write_beside(pipe)
        assert content() == NEW.encode()
    assert stat.S_ISFIFO(pipe.stat().st_mode)
    assert not (tmp_path / "pipe.companion").exists()


def test_an_open_file_is_written_where_it_stands(tmp_path: Path) -> None:
    with (tmp_path / "log").open("w+") as file:
        file.write("before\n")
        file.flush()
        path = Path(f"/dev/fd/{file.fileno()}")
        assert open_file_number(path) == file.fileno()
        write_named(path, NEW)
    assert (tmp_path / "log").read_text() == "before\n" + NEW


def test_a_socket_that_is_open_gets_the_content() -> None:
    ours, theirs = socket.socketpair()
    with ours, theirs:
        write_named(Path(f"/proc/self/fd/{theirs.fileno()}"), NEW)
        assert ours.recv(100) == NEW.encode()


def test_a_reader_that_has_read_enough_is_no_failure() -> None:
    reading, writing = os.pipe()
    os.close(reading)
    try:
        write_named(Path(f"/dev/fd/{writing}"), NEW)
    finally:
        os.close(writing)


def test_a_terminal_gets_no_control_characters() -> None:
    ours, theirs = pty.openpty()
    try:
        write_named(Path(os.ttyname(theirs)), '{"name": "\x9b31m\x1b[2J"}\n')
        shown = os.read(ours, 1000)
    finally:
        os.close(ours)
        os.close(theirs)
    assert shown == b'{"name": "\\u009b31m\\u001b[2J"}\r\n'


def _folder(folder: Path) -> Path:
    return folder


def _loop(folder: Path) -> Path:
    (folder / "loop").symlink_to("loop")
    return folder / "loop"


def _no_folder(folder: Path) -> Path:
    (folder / "link").symlink_to("none/file.csv")
    return folder / "link"


def _socket(folder: Path) -> Path:
    with socket.socket(socket.AF_UNIX) as bound:
        bound.bind(str(folder / "socket"))
    return folder / "socket"


def _names(folder: Path) -> Path:
    (folder / "other.csv").hardlink_to(folder / "file.csv")
    return folder / "file.csv"


def _file_as_folder(folder: Path) -> Path:
    return folder / "file.csv" / "x.csv"


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (_folder, "is a folder. Name a file in it."),
        (_loop, "is a link that leads nowhere but to links."),
        (_no_folder, "none/file.csv cannot be written: No such file or directory."),
        (_socket, "is a socket, into which no file can be written."),
        (_names, "has 2 names (hard links), and the others would keep what it holds now."),
        (_file_as_folder, "cannot be written: Not a directory."),
        (lambda folder: Path("/proc/version"), "cannot be written"),
        (lambda folder: Path("/dev/fd/987"), "cannot be written: Bad file descriptor."),
    ],
)
def test_what_takes_no_file_is_a_sentence_and_nothing_is_written(
    old: Path, make: Callable[[Path], Path], sentence: str
) -> None:
    path = make(old.parent)
    before = {entry.name for entry in old.parent.iterdir()}
    with pytest.raises(FootfallError) as refusal:
        write_beside(path)
    assert sentence in refusal.value.sentence
    assert old.read_text() == OLD
    assert {entry.name for entry in old.parent.iterdir()} == before


def test_a_full_disk_is_a_sentence() -> None:
    with pytest.raises(StorageFullError, match="No space left on device"):
        write_named(Path("/dev/full"), NEW)


def test_a_file_that_may_only_be_read_stays(old: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "access", lambda path, mode: False)  # root may write everything
    with pytest.raises(InputError, match="may only be read"):
        write_named(old, NEW)
    assert old.read_text() == OLD


@pytest.mark.skipif(os.getuid() != 0, reason="only root can become somebody else")
def test_an_account_without_the_rights_gets_a_sentence() -> None:
    with tempfile.TemporaryDirectory() as folder:
        Path(folder).chmod(0o755)
        theirs, mine, new = (Path(folder) / name for name in ("theirs.csv", "mine.csv", "new.csv"))
        theirs.write_text(OLD)
        mine.write_text(OLD)
        os.chown(mine, 65534, 65534)
        said = said_of_writes(65534, theirs, mine, new)
        assert sorted(path.name for path in Path(folder).iterdir()) == ["mine.csv", "theirs.csv"]
        assert theirs.read_text() == mine.read_text() == OLD
    assert said[0].startswith(f"{theirs} cannot be written: it may only be read.")
    for path, sentence in zip((mine, new), said[1:], strict=True):
        assert sentence.startswith(f"{path} cannot be written: Permission denied. Give yourself the right")


def test_a_disk_that_takes_no_more_leaves_the_file_as_it_was(old: Path) -> None:
    (said,) = said_of_writes(0, old)
    assert said == f"{old} cannot be written: File too large. Free space on its disk, then try again."
    assert old.read_text() == OLD
    assert [path.name for path in old.parent.iterdir()] == [old.name]


@pytest.mark.parametrize("companion", ["c" * 256, "none/companion", "folder"])
def test_without_its_companion_a_file_stays_as_it_was(old: Path, companion: str) -> None:
    (old.parent / "folder").mkdir()
    with pytest.raises(InputError, match=companion):
        write_named(old, NEW, old.parent / companion, NEW)
    assert old.read_text() == OLD
    assert sorted(path.name for path in old.parent.iterdir()) == ["file.csv", "folder"]


@pytest.mark.parametrize("is_new", [True, False])
def test_a_companion_goes_back_where_its_file_cannot_be_replaced(
    old: Path, monkeypatch: pytest.MonkeyPatch, is_new: bool
) -> None:
    beside, replace = old.with_suffix(".companion"), Path.replace
    if not is_new:
        beside.write_text(OLD)

    def replace_no_file(partial: Path, path: Path) -> Path:
        if path == old:
            raise PermissionError(errno.EPERM, os.strerror(errno.EPERM))
        return replace(partial, path)

    monkeypatch.setattr(Path, "replace", replace_no_file)
    with pytest.raises(FootfallError, match="Operation not permitted"):
        write_beside(old)
    names = [old.name] if is_new else [beside.name, old.name]
    assert sorted(path.name for path in old.parent.iterdir()) == names
    assert all(path.read_text() == OLD for path in old.parent.iterdir())


@pytest.mark.parametrize("length", [1, 40, 236, 240])
def test_a_long_name_and_its_companion_are_written(tmp_path: Path, length: int) -> None:
    path = tmp_path / f"{'a' * length}.csv"
    write_with_companion(path, NEW, OLD)
    assert (path.read_text(), companion_path(path).read_text()) == (NEW, OLD)
    assert len(list(tmp_path.iterdir())) == 2


def test_a_name_that_is_too_long_for_a_companion_is_not_written(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"footfall\.json cannot be written: File name too long"):
        write_with_companion(tmp_path / f"{'a' * 245}.csv", NEW, OLD)
    assert list(tmp_path.iterdir()) == []


def test_the_form_is_that_of_the_name_or_the_first_one() -> None:
    forms = (".csv", ".json")
    assert form_of(Path("a.json"), forms) == ".json"
    assert form_of(Path("a.txt"), forms) is None
    assert form_of(Path(os.devnull), forms) == ".csv"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("a\ngait \ud800 walk", "line 2 of its text holds half a character after “gait ”"),
        ("\udcff", "line 1 of its text begins with half a character"),
        ("x\n\udc80", "line 2 of its text begins with half a character"),
    ],
)
def test_a_text_with_half_a_character_is_refused_and_leaves_the_file(
    old: Path, text: str, words: str
) -> None:
    with pytest.raises(InputError, match=words):
        write_named(old, text)
    assert old.read_text() == OLD
