"""The list of a folder of atlases: files that changed are read and no others, not for long, and no links."""

from __future__ import annotations

import os
import sqlite3
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from pathlib import Path
from typing import Any
from unittest.mock import Mock

import pytest

from app.atlas import summaries
from app.atlas.atlas_file import AtlasFile
from app.atlas.library import AtlasLibrary
from app.atlas.service import AtlasService
from app.atlas.summaries import AtlasSummaries
from core.atlas.space import default_space
from core.errors import InputError, StateError
from tests.support.command import run
from tests.support.hostile_atlases import write_atlas

NAMES = ("a", "b", "c", "d")
INCLUDED = "deltawalker-small"
YEAR = 31_536_000


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with atlases that nobody has written to for long."""
    for name in NAMES:
        put_aside(write_atlas(tmp_path / f"{name}.sqlite"))
    return tmp_path


@pytest.fixture
def read(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Names of the files that are read for summaries."""
    names: list[str] = []

    def opened(path: Path, *, follows_link: bool) -> AtlasFile:
        names.append(path.stem)
        return AtlasFile(path, follows_link=follows_link)

    monkeypatch.setattr(summaries, "AtlasFile", opened)
    return names


def put_aside(path: Path) -> None:
    """A file that was written to a year ago."""
    time = path.stat().st_mtime - YEAR
    os.utime(path, (time, time))


def taken(names: list[str]) -> list[str]:
    found = sorted(names)
    names.clear()
    return found


def by_name(library: AtlasLibrary) -> dict[str, Any]:
    return {one["name"]: one for one in library.contents()}


def test_a_list_reads_only_files_that_changed(folder: Path, read: list[str]) -> None:
    library = AtlasLibrary(folder)
    first = library.contents()
    assert taken(read) == [*NAMES, INCLUDED]
    assert library.contents() == first
    assert library.content("b") == first[1]
    assert taken(read) == []
    with closing(sqlite3.connect(folder / "b.sqlite")) as other, other:
        other.execute("DELETE FROM gaits WHERE id = 5")
    put_aside(folder / "b.sqlite")
    assert by_name(library)["b"]["gaits"] == 5
    assert taken(read) == ["b"]


def test_a_file_in_the_place_of_another_is_read_though_size_and_time_are_the_same(
    folder: Path, read: list[str]
) -> None:
    library, path = AtlasLibrary(folder), folder / "b.sqlite"
    before, _ = path.stat(), library.contents()
    taken(read)
    path.write_bytes(b"x" * before.st_size)
    os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))
    assert "trouble" in by_name(library)["b"]
    assert taken(read) == ["b"]


def test_what_stands_beside_a_file_counts(folder: Path, read: list[str]) -> None:
    library, beside = AtlasLibrary(folder), folder / "b.sqlite-journal"
    library.contents()
    taken(read)
    beside.mkdir()
    assert "stands beside" in by_name(library)["b"]["trouble"]
    beside.rmdir()
    assert by_name(library)["b"]["gaits"] == 6
    assert taken(read) == ["b"]


def test_a_refused_file_is_kept_too_and_a_busy_one_is_looked_at_again(
    folder: Path, read: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("app.atlas.atlas_file.READ_WAIT_SECONDS", 0.0)
    (folder / "a.sqlite").write_text("nothing of the kind, and no header " * 9)
    put_aside(folder / "a.sqlite")
    library = AtlasLibrary(folder)
    with closing(sqlite3.connect(folder / "b.sqlite", isolation_level=None)) as other:
        other.execute("BEGIN EXCLUSIVE")
        assert {"a", "b"} == {name for name, one in by_name(library).items() if "trouble" in one}
        taken(read)
    assert by_name(library)["b"]["gaits"] == 6
    assert taken(read) == ["b"]


def test_a_file_that_was_just_written_is_not_kept(folder: Path, read: list[str]) -> None:
    write_atlas(folder / "b.sqlite")
    library = AtlasLibrary(folder)
    library.contents()
    taken(read)
    library.contents()
    assert taken(read) == ["b"]


def test_a_list_ends_in_time_and_the_next_one_goes_on(folder: Path, read: list[str]) -> None:
    """Also beside files that change all the time."""
    write_atlas(folder / "a.sqlite")
    write_atlas(folder / "b.sqlite")
    paths = {name: folder / f"{name}.sqlite" for name in NAMES}
    short = AtlasSummaries(list_seconds=-1.0)
    first = short.summaries(paths)
    assert [one["name"] for one in first] == list(NAMES)
    assert ["gaits" in one for one in first] == [True, False, False, False]
    assert all("not looked at yet" in one["trouble"] for one in first[1:])
    others = [short.summaries(paths) for _ in NAMES[1:]]
    assert read == list(NAMES)
    assert ["gaits" in one for one in others[-1]] == [False, False, True, True]


def test_what_is_kept_is_bounded_by_the_folder_and_by_a_number(
    folder: Path, read: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(summaries, "MOST_KEPT", 2)
    paths = {name: folder / f"{name}.sqlite" for name in NAMES}
    kept = AtlasSummaries()
    kept.summaries(paths)
    taken(read)
    assert [one["gaits"] for one in kept.summaries(paths)] == [6] * len(NAMES)
    assert taken(read) == ["c", "d"]
    del paths["a"]
    kept.summaries(paths)
    taken(read)
    kept.summaries(paths)
    assert taken(read) == ["d"]


def test_many_threads_get_the_same_list_and_do_not_change_what_is_kept(folder: Path) -> None:
    library = AtlasLibrary(folder)
    with ThreadPoolExecutor(8) as threads:
        lists = list(threads.map(lambda _: library.contents(), range(32)))
    assert all(one == lists[0] for one in lists)
    lists[0][0]["gaits"] = "changed"
    assert library.contents() == lists[1]


@pytest.mark.parametrize("target", ["/etc/passwd", "good", "nothing at all", "link.sqlite", "/dev/zero"])
def test_a_link_in_the_folder_is_neither_followed_nor_made(tmp_path: Path, target: str) -> None:
    folder = tmp_path / "atlases"
    folder.mkdir()
    good = write_atlas(tmp_path / "good")
    before = good.read_bytes()
    link, library = folder / "link.sqlite", AtlasLibrary(folder)
    link.symlink_to(tmp_path / target if target in ("good", "nothing at all") else target)
    assert "is a symbolic link, which is not followed" in library.content("link")["trouble"]
    for space in (None, default_space("deltawalker")):
        with pytest.raises(InputError, match="symbolic link"):
            library.started("link", space)
    with pytest.raises(InputError, match="symbolic link"), library.opened("link"):
        pass
    library.delete("link")
    library.restore("link")
    assert link.is_symlink()
    assert good.read_bytes() == before
    assert sorted(path.name for path in tmp_path.iterdir()) == ["atlases", "good"]


def test_a_deleted_atlas_does_not_come_back_over_a_link(folder: Path) -> None:
    library, path = AtlasLibrary(folder), folder / "a.sqlite"
    library.delete("a")
    path.symlink_to("nothing at all")
    with pytest.raises(StateError, match="another atlas"):
        library.restore("a")
    assert path.is_symlink()


def test_a_folder_may_be_a_link_and_so_may_a_path_of_the_command_line(
    capsys: pytest.CaptureFixture[str], folder: Path
) -> None:
    (folder / "folder").symlink_to(folder)
    assert AtlasLibrary(folder / "folder").content("a")["gaits"] == 6
    (folder / "link.sqlite").symlink_to("a.sqlite")
    status, out, _ = run(capsys, "atlas", "front", str(folder / "link.sqlite"))
    assert (status, "on the front" in out) == (0, True)


@pytest.mark.parametrize("name", ["../x", "x/y", "", "x" * 61, "x.", "a\0b", INCLUDED])
def test_a_name_is_judged_before_what_the_studio_does(tmp_path: Path, name: str) -> None:
    service = AtlasService(AtlasLibrary(tmp_path), Mock(), Mock(), Mock())
    service.close()
    with pytest.raises(StateError):
        service.opened("x", None)
    with pytest.raises(InputError) as refused:
        service.opened(name, None)
    assert refused.value.where == "name"
