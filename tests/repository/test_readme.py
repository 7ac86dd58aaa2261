"""README's commands do what it says."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest

from app.bench import BENCHMARKS
from app.cli import main
from tests.support.patience import patient_robot
from tests.support.studio_process import PROJECT

README = (PROJECT / "README.md").read_text()
BLOCKS = re.findall(r"^```sh\n(.*?)^```", README, re.S | re.M)
FIGURES = (PROJECT / "docs" / "figures.md").read_text()
LONGEST = 130


def table_rows(text: str) -> list[list[str]]:
    """The cells of each row of the tables in a text, without heads and rules."""
    tables = re.findall(r"^\|[^\n]*\|\n\|[-|]+\|\n((?:\|[^\n]*\|\n)+)", text, re.M)
    return [[cell.strip() for cell in row[1:-1].split("|")] for table in tables for row in table.splitlines()]


def test_readme_is_read_in_one_breath() -> None:
    read = re.sub(r"<!--.*?-->\n", "", README, flags=re.DOTALL)
    assert len(read.splitlines()) <= LONGEST


def test_readme_has_eight_figures_and_the_others_name_their_command() -> None:
    figures = README[README.index("## Figures") : README.index("## Further reading")]
    assert len(table_rows(figures)) == 8
    commands = [row[-1] for row in table_rows(FIGURES)]
    named = [re.fullmatch(r"`bench (\w+)`", command) for command in commands]
    assert {match.group(1) for match in named if match} <= set(BENCHMARKS)
    others = [command for command, match in zip(commands, named, strict=True) if not match]
    assert len(commands) > 20
    assert all("`footfall " in command or "`python -m pytest " in command for command in others), others


def test_every_page_of_the_documentation_is_reached_from_readme() -> None:
    pages = {path.name for path in (PROJECT / "docs").glob("*.md")}
    linked = set(re.findall(r"\(docs/(\w+\.md)\)", README))
    assert pages - linked == {"fastest_figures.md"}


def test_the_first_two_blocks_are_run_and_test_in_plain_lines() -> None:
    run, test = (block.strip().split("\n") for block in BLOCKS[:2])
    assert run[-1] == ".venv/bin/footfall serve"
    assert test[-1] == ".venv/bin/python -m tests"
    assert run[0] == test[0] == "python3 -m venv .venv"
    assert not any("#" in line or "\\" in line for line in run + test)


@pytest.mark.heavy
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
