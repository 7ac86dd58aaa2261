"""`footfall restore`: the backups with what is in them, and the way back to one."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.store.backups import DAILY, make_backup
from tests.support.command import run, run_json
from tests.support.spoilt_database import fill, overwrite_table


def test_the_list_says_which_backups_are_good_and_what_is_in_them(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    good = make_backup(fill(tmp_path), DAILY).path
    bad = good.with_name(f"studio-2026-01-01-000000-{DAILY}.sqlite3")
    bad.write_bytes(good.read_bytes())
    for path in (bad, tmp_path / "studio.sqlite3"):
        overwrite_table(path, "result")
    status, answer = run_json(capsys, "restore", "--data", str(tmp_path))
    assert status == 0
    assert "optimised motions" in answer["database"]["damage"]
    states = {line["file"]: line["damage"] is None for line in answer["backups"]}
    assert states == {good.name: True, bad.name: False}
    (line,) = [line for line in answer["backups"] if line["file"] == good.name]
    assert (line["contents"]["edited gaits"], line["size"]) == (1, good.stat().st_size)
    status, out, _ = run(capsys, "restore", "--data", str(tmp_path))
    assert (status, good.name in out, "--backup" in out) == (0, True, True)


def test_going_back_says_where_the_damaged_database_is_kept(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    good = make_backup(fill(tmp_path), DAILY).path
    overwrite_table(tmp_path / "studio.sqlite3", "result")
    status, answer = run_json(capsys, "restore", "--data", str(tmp_path), "--backup", good.name)
    assert (status, Path(answer["aside"], "studio.sqlite3").exists()) == (0, True)
    status, answer = run_json(capsys, "restore", "--data", str(tmp_path))
    assert (status, answer["database"]["damage"]) == (0, None)


@pytest.mark.parametrize(
    "words", [("--backup", "none.sqlite3"), ("--backup", "a", "--empty"), ("--data", "nowhere")]
)
def test_what_cannot_be_gone_back_to_is_bad_input(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, words: tuple[str, ...]
) -> None:
    fill(tmp_path, 1)
    status, answer = run_json(capsys, "restore", "--data", str(tmp_path), *words)
    assert status == 2
    assert answer["error"]


def test_a_folder_without_a_database_has_nothing_to_go_back_to(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    status, answer = run_json(capsys, "restore", "--data", str(tmp_path))
    assert (status, answer) == (0, {"database": None, "backups": []})
    assert list(tmp_path.iterdir()) == []
