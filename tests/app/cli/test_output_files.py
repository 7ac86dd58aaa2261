"""`-o` of the commands: files are replaced, devices and pipes written through, companions stand by files."""

from __future__ import annotations

import json
import os
import shutil
import stat
import subprocess
import sys
from pathlib import Path

import pytest

import footfall
from core.wire.waypoints import parse_waypoint_csv
from tests.support.command import run
from tests.support.studio_process import PROJECT


@pytest.fixture(scope="module")
def motion(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("motion") / "walk.csv"
    footfall.plan("walk-manual-0").save(path)
    return path


def words_of(command: str, motion: Path) -> tuple[str, ...]:
    return {
        "manual": ("manual", "walk"),
        "optimise": ("optimise", "walk"),
        "frontier": ("frontier", "walk"),
        "fastest": ("fastest", "walk"),
        "waypoints": ("waypoints", str(motion)),
        "export": ("export", str(motion), "--format", "csv"),
        "import": ("import", str(motion)),
        "atlas export": ("atlas", "export", "deltawalker-small"),
    }[command]


@pytest.mark.parametrize("command", ["manual", "waypoints", "export", "import", "atlas export"])
@pytest.mark.parametrize("kind", ["device", "link to a device"])
def test_a_device_is_written_through(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, motion: Path, command: str, kind: str
) -> None:
    path = Path(os.devnull)
    if kind != "device":
        path = tmp_path / "null.csv"
        path.symlink_to(os.devnull)
    before = os.stat(os.devnull)
    status, out, _ = run(capsys, *words_of(command, motion), "-o", str(path))
    after = os.stat(os.devnull)
    assert status == 0
    assert f"to {path}." in out or f"Wrote {path}." in out
    assert stat.S_ISCHR(after.st_mode)
    assert (before.st_ino, before.st_mode) == (after.st_ino, after.st_mode)
    assert [entry.name for entry in tmp_path.iterdir()] == ([] if kind == "device" else ["null.csv"])
    if command in ("manual", "waypoints", "export"):
        assert "no companion was written" in out


@pytest.mark.parametrize("command", ["manual", "waypoints", "export", "import", "atlas export"])
def test_a_full_device_is_exit_2(capsys: pytest.CaptureFixture[str], motion: Path, command: str) -> None:
    status, out, err = run(capsys, *words_of(command, motion), "-o", "/dev/full")
    assert (status, out) == (2, "")
    assert "/dev/full cannot be written: No space left on device." in err


@pytest.mark.parametrize("output", ["", ".", "./", "..", "/", "new/", "new/.", "old.csv/", "folder"])
@pytest.mark.parametrize(
    "command",
    ["manual", "optimise", "frontier", "fastest", "waypoints", "export", "import", "atlas export"],
)
def test_a_folder_is_exit_2_before_anything_is_computed(
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    motion: Path,
    command: str,
    output: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("folder").mkdir()
    Path("old.csv").write_text("old")
    assert run(capsys, *words_of(command, motion), "-o", output) == (
        2,
        "",
        f"{output or '.'} is a folder. Name a file in it.\n",
    )
    assert sorted(entry.name for entry in Path().iterdir()) == ["folder", "old.csv"]
    assert Path("old.csv").read_text() == "old"


@pytest.mark.parametrize(
    ("words", "output", "said"),
    [
        ("optimise gait.json", "gait.json", "gait.json"),
        ("frontier gait.json", "link.json", "link.json"),
        ("fastest gait.json", "gait.json", "gait.json"),
        ("fastest gait.json", "hard.json", "hard.json"),
        ("optimise gait.footfall.json", "gait.csv", "gait.footfall.json (companion of gait.csv)"),
        ("export gait.json --format json", "./gait.json", "gait.json"),
        ("waypoints walk.csv", "walk.csv", "walk.csv"),
        ("waypoints walk.csv", "sub/../walk.csv", "sub/../walk.csv"),
        ("waypoints walk.csv", "walk.txt", "walk.footfall.json (companion of walk.txt)"),
        ("waypoints walk.csv", "walk.footfall.json", "walk.footfall.json"),
        ("export walk.csv --format csv", "walk.csv", "walk.csv"),
        ("import walk.csv", "walk.csv", "walk.csv"),
        ("import walk.csv", "walk.footfall.json", "walk.footfall.json"),
        ("atlas export atlas.csv", "atlas.csv", "atlas.csv"),
        ("atlas open atlas.json 1", "atlas.json", "atlas.json"),
    ],
)
def test_the_file_that_is_read_is_not_written_over(
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    words: str,
    output: str,
    said: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("sub").mkdir()
    footfall.plan("walk-manual-0").save("walk.csv")
    footfall.gait("walk").save("gait.json")
    shutil.copy("gait.json", "gait.footfall.json")
    Path("link.json").symlink_to("gait.json")
    Path("hard.json").hardlink_to("gait.json")
    for name in ("atlas.csv", "atlas.json"):
        Path(name).touch()
    before = {path.name: path.read_bytes() for path in Path().iterdir() if path.is_file()}
    status, out, err = run(capsys, *words.split(), "-o", output)
    assert (status, out, err) == (2, "", f"{said} is the file that is read; choose another name.\n")
    assert {path.name: path.read_bytes() for path in Path().iterdir() if path.is_file()} == before


@pytest.mark.parametrize("words", ["import walk.csv", "export walk.csv --format json"])
def test_a_gait_file_beside_a_companion_is_written(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words: str
) -> None:
    monkeypatch.chdir(tmp_path)
    footfall.plan("walk-manual-0").save("walk.csv")
    assert run(capsys, *words.split(), "-o", "walk.json")[0] == 0


def test_a_link_and_its_companion(capsys: pytest.CaptureFixture[str], tmp_path: Path, motion: Path) -> None:
    (tmp_path / "kept").mkdir()
    link = tmp_path / "way.csv"
    link.symlink_to("kept/target.csv")
    assert run(capsys, "waypoints", str(motion), "-o", str(link))[0] == 0
    assert link.is_symlink()
    assert (tmp_path / "kept/target.csv").is_file()
    assert (tmp_path / "way.footfall.json").is_file()
    _, _, err = run(capsys, "check", str(link))
    assert "no companion" not in err


def test_standard_output_gets_the_file_alone(motion: Path) -> None:
    said = subprocess.run(
        [sys.executable, "-m", "app", *words_of("waypoints", motion), "--json", "-o", "/dev/stdout"],
        cwd=PROJECT,
        capture_output=True,
        check=True,
    )
    assert parse_waypoint_csv(said.stdout.decode()).count == json.loads(said.stderr)["waypoints"]


def test_a_process_substitution_gets_the_file(tmp_path: Path, motion: Path) -> None:
    command = f'"$0" -m app waypoints "$1" -o >(cat > "{tmp_path}/copy.csv"); wait $!'
    subprocess.run(["bash", "-c", command, sys.executable, str(motion)], cwd=PROJECT, check=True)
    assert parse_waypoint_csv((tmp_path / "copy.csv").read_text()).count == 55


def test_other_names_of_a_file_are_a_refusal(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, motion: Path
) -> None:
    (tmp_path / "way.csv").write_text("old")
    (tmp_path / "backup.csv").hardlink_to(tmp_path / "way.csv")
    status, _, err = run(capsys, "waypoints", str(motion), "-o", str(tmp_path / "way.csv"))
    assert (status, (tmp_path / "backup.csv").read_text()) == (2, "old")
    assert "2 names (hard links)" in err
    assert not (tmp_path / "way.footfall.json").exists()


def test_an_atlas_is_a_plain_file(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    pipe = tmp_path / "pipe.sqlite"
    os.mkfifo(pipe)
    status, _, err = run(capsys, "atlas", "run", "-o", str(pipe), "--count", "10")
    assert (status, "pipe.sqlite must be a plain file" in err) == (2, True)


def test_python_saves_by_the_same_rules(tmp_path: Path, motion: Path) -> None:
    plan = footfall.plan(motion)
    for name in ("null.csv", "null.waypoints.csv"):
        (tmp_path / name).symlink_to(os.devnull)
        plan.save(tmp_path / name)
    (tmp_path / "walk.json").symlink_to("target.json")
    footfall.gait("walk").save(tmp_path / "walk.json")
    names = sorted(entry.name for entry in tmp_path.iterdir())
    assert names == ["null.csv", "null.waypoints.csv", "target.json", "walk.json"]
    (tmp_path / "folder.csv").mkdir()
    for path in (tmp_path / "folder.csv", f"{tmp_path}/new.csv/"):
        with pytest.raises(footfall.InputError, match="is a folder"):
            plan.save(path)
    assert stat.S_ISCHR(os.stat(os.devnull).st_mode)
