"""One line on a person's terminal that shows how far a command is; nothing where nobody watches."""

import sys

from app.cli.common.output import drop
from core.text.printable import PrintableStream, printable_line

_CLEAR = "\r\x1b[K"


def is_watched() -> bool:
    """Whether standard error is a terminal."""
    return sys.stderr.isatty()


def rewrite_line(text: str, *, is_last: bool = False) -> None:
    """Puts a text in the place of the line, which ends with the last one."""
    _write(_CLEAR + printable_line(text) + ("\n" if is_last else ""))


def clear_line() -> None:
    """Takes the line away."""
    _write(_CLEAR)


def end_line() -> None:
    """Leaves the line as it is; what follows begins a new one."""
    _write("\n")


def _write(text: str) -> None:
    if is_watched():
        try:
            sys.stderr.write_raw(text) if isinstance(sys.stderr, PrintableStream) else sys.stderr.write(text)
            sys.stderr.flush()
        except OSError:  # the terminal is closed
            drop(sys.stderr)
