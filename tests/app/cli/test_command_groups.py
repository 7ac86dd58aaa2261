"""`footfall --help`: every command stands in one group, with one line."""

from __future__ import annotations

import re

import pytest

from app.cli.command_groups import COMMAND_GROUPS
from app.cli.parser import make_parser
from core.errors import InputError
from tests.support.studio_process import PROJECT

LISTED = [name for commands in COMMAND_GROUPS.values() for name in commands]
TERMINAL = 80


def commands_of_the_parser() -> list[str]:
    """The names that the parser offers when it refuses another one."""
    with pytest.raises(InputError) as refusal:
        make_parser().parse_args(["no-such-command"])
    choices = str(refusal.value).partition("choose from")[2].partition(")")[0]
    return re.findall(r"[\w-]+", choices)


def test_every_command_stands_in_one_group() -> None:
    assert sorted(LISTED) == sorted(commands_of_the_parser())


def test_help_shows_each_command_in_one_line_below_its_group() -> None:
    text = make_parser().format_help()
    for title, commands in COMMAND_GROUPS.items():
        block = text.partition(f"\n{title}:\n")[2].partition("\n\n")[0].splitlines()
        assert [line.split()[0] for line in block] == list(commands)
        assert all(len(line) < TERMINAL for line in block)


@pytest.mark.parametrize("name", LISTED)
def test_a_command_explains_itself(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        make_parser().parse_args([name, "--help"])
    assert capsys.readouterr().out.startswith(f"usage: footfall {name} ")


def test_the_documentation_groups_the_commands_alike() -> None:
    rows = re.findall(r"^\| ([^|]*)\| `(\w+)` \|", (PROJECT / "docs/command_line.md").read_text(), re.M)
    groups: dict[str, list[str]] = {}
    for title, name in rows:
        groups.setdefault(title.strip() or list(groups)[-1], []).append(name)
    assert groups == {title: list(commands) for title, commands in COMMAND_GROUPS.items()}
