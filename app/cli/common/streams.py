"""The standard streams of a command: none is missing, all text can be written, none controls a terminal.

Whatever writes to `sys.stdout` or `sys.stderr` passes here: results, notes, help, warnings, the log.
"""

import codecs
import logging
import os
import sys
import unicodedata
from typing import Any, TextIO, cast

from app.common.printable import printable_text

_PLAIN = "footfall-plain"
"""Name of the error handler that writes what an encoding lacks in ASCII."""
_ASCII = {
    **dict.fromkeys("“”„«»", '"'),
    **dict.fromkeys("‘’‚", "'"),
    **dict.fromkeys("–—−‐‑", "-"),
    **{"…": "...", "·": "*", "×": "x", "°": " deg", "µ": "u", "→": "->", "±": "+-", "≤": "<=", "≥": ">="},
}


class PrintableStream:
    """A text stream that writes control characters as escapes, and in ASCII what its encoding lacks.

    Args:
        stream: where the text goes.
    """

    def __init__(self, stream: TextIO) -> None:
        self.stream = stream

    def write(self, text: str) -> int:
        """Writes a text."""
        self.write_raw(printable_text(text))
        return len(text)

    def write_raw(self, text: str) -> None:
        """Writes a text with the control characters that it has; what the encoding lacks is replaced."""
        encoding = self.stream.encoding
        self.stream.write(text.encode(encoding, _PLAIN).decode(encoding) if encoding else text)

    def writelines(self, lines: list[str]) -> None:
        """Writes several texts."""
        for line in lines:
            self.write(line)

    def __getattr__(self, name: str) -> Any:
        return getattr(self.stream, name)


class LogFormatter(logging.Formatter):
    """Lines of the log; those that continue a message are indented, so that none can be taken for another."""

    def format(self, record: logging.LogRecord) -> str:
        """A message with its traceback, if it has one."""
        return super().format(record).replace("\n", "\n  ")


def prepare_streams() -> None:
    """Makes the standard streams safe to use; doing it twice does no harm."""
    _open_missing()
    codecs.register_error(_PLAIN, _plain)
    sys.stdin = sys.stdin or os.fdopen(0, closefd=False)
    sys.stdout = _prepared(sys.stdout or os.fdopen(1, "w", closefd=False))
    sys.stderr = _prepared(sys.stderr or os.fdopen(2, "w", closefd=False))


def _open_missing() -> None:
    """Opens /dev/null in the place of standard streams that are closed.

    Otherwise the next file that the program or a worker opens would get the number of one, and the output.
    """
    while True:
        number = os.open(os.devnull, os.O_RDWR)
        if number > 2:
            os.close(number)
            return
        os.set_inheritable(number, True)


def _prepared(stream: TextIO) -> TextIO:
    if isinstance(stream, PrintableStream):
        return cast(TextIO, stream)
    return cast(TextIO, PrintableStream(stream))


def _plain(error: UnicodeError) -> tuple[str, int]:
    """Replaces what cannot be encoded: quotes and dashes by those of ASCII, é by e, all else by ?."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    return "".join(map(_ascii, error.object[error.start : error.end])), error.end


def _ascii(sign: str) -> str:
    plain = unicodedata.normalize("NFKD", sign).encode("ascii", "ignore").decode()
    return _ASCII.get(sign) or plain or "?"
