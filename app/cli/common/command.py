"""What every command has."""

from argparse import ArgumentParser, Namespace
from collections.abc import Callable


def set_command(parser: ArgumentParser, run: Callable[[Namespace], int], text: str) -> None:
    """Gives a command's parser the text of its help, the function that runs it, and `--json`."""
    parser.description = text
    parser.set_defaults(run=run)
    parser.add_argument("--json", action="store_true", help="print one JSON object")
