"""The parser of the command line; a command's module is loaded when a line asks for that command."""

import argparse
import sys
from collections.abc import Iterable
from typing import Any, NoReturn

from app.cli.command_groups import COMMANDS, grouped_commands
from app.cli.common.output import write
from app.common.named import named
from app.common.version import VERSION
from core.errors import InputError


class _Parser(argparse.ArgumentParser):
    """Usage errors become refusals like every other."""

    def error(self, message: str) -> NoReturn:
        raise InputError(f"{message}. See {self.prog} --help.", "command line")

    def _print_message(self, message: str, file: Any = None) -> None:
        write(file or sys.stdout, message)


class _CommandParser(_Parser):
    """The parser of a command, which is defined when it first parses."""

    define: str | None = None
    """The function that defines it; None once that is done."""

    def parse_known_args(
        self, args: Iterable[str] | None = None, namespace: Any = None
    ) -> tuple[Any, list[str]]:
        if self.define is not None:
            define, self.define = self.define, None
            named(define, __package__)(self)
        return super().parse_known_args(args, namespace)


def make_parser() -> argparse.ArgumentParser:
    """The parser of `footfall`; each command sets `run`."""
    parser = _Parser(
        prog="footfall",
        usage="footfall [-h] [--version] COMMAND ...",
        description="Footfall Studio: gaits for delta-legged walking robots.",
        epilog=grouped_commands(),
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument("--version", action="version", version=f"footfall {VERSION}")
    commands = parser.add_subparsers(
        required=True,
        prog="footfall",
        metavar="COMMAND",
        help=argparse.SUPPRESS,
        parser_class=_CommandParser,
    )
    for name, command in COMMANDS.items():
        commands.add_parser(name, allow_abbrev=False).define = command.define
    return parser


def option_names(command: str) -> frozenset[str]:
    """What the options of a command are called as keyword arguments, but for those that only print."""
    parser = _Parser()
    named(COMMANDS[command].define, __package__)(parser)
    names = {name for name in parser._option_string_actions if name.startswith("--")}
    names = {name.removeprefix("--").replace("-", "_") for name in names}
    return frozenset(names - {"help", "json", "output"})
