"""README's commands do what it says."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest

from app.cli import main
from tests.support.patience import patient_robot
from tests.support.studio_process import PROJECT

BLOCKS = re.findall(r"^```sh\n(.*?)^```", (PROJECT / "README.md").read_text(), re.S | re.M)


def test_the_first_two_blocks_are_run_and_test_in_plain_lines() -> None:
    run, test = (block.strip().split("\n") for block in BLOCKS[:2])
    assert run[-1] == ".venv/bin/footfall serve"
    assert test[-1] == ".venv/bin/python -m tests"
    assert run[0] == test[0] == "python3 -m venv .venv"
    assert not any("#" in line or "\\" in line for line in run + test)


def test_the_commands_without_a_browser_work_one_after_the_other(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    block = next(block for block in BLOCKS if "footfall manual" in block)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    with patient_robot(20.0, booted=True) as robot:
        for line in block.strip().split("\n"):
            words = shlex.split(line)
            assert words[0] == ".venv/bin/footfall"
            # The robot of the test is the same emulated one, only faster.
            arguments = [robot.device if word == "emulator" else word for word in words[1:]]
            assert main(arguments) == 0, (line, capsys.readouterr().err)
    written = {"walk0.csv", "walk.csv", "walk_way.csv", "fast_way.csv"}
    assert {path.name for path in tmp_path.glob("*.csv")} == written


def test_pictures_that_readme_shows_exist() -> None:
    for name in re.findall(r"!\[[^\]]*\]\(([^)]+)\)", (PROJECT / "README.md").read_text()):
        assert (PROJECT / name).stat().st_size > 1000, name
