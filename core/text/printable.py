"""Text as it may reach a terminal: control characters are written as escapes that can be read."""

import codecs
import re
import unicodedata
from typing import Any, TextIO, cast

_PLAIN = "footfall-plain"
"""Name of the error handler that writes what an encoding lacks in ASCII."""
_ASCII = {
    **dict.fromkeys("“”„«»", '"'),
    **dict.fromkeys("‘’‚", "'"),
    **dict.fromkeys("–—−‐‑", "-"),
    **{"…": "...", "·": "*", "×": "x", "°": " deg", "µ": "u", "→": "->", "±": "+-", "≤": "<=", "≥": ">="},
}
_BIDIRECTIONAL = "\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069"
"""Marks and overrides that let a terminal draw text in another order than it has."""
_CONTROLS = rf"\x00-\x1f\x7f-\x9f\u2028\u2029\ufff9-\ufffb{_BIDIRECTIONAL}"
_IN_LINE = re.compile(rf"(?!\t)[{_CONTROLS}]")
_IN_TEXT = re.compile(rf"(?![\t\n]|\r\n)[{_CONTROLS}]")


def printable_text(text: str) -> str:
    r"""A text of several lines, with `\u001b` where it has the control character of that number.

    JSON writes them so too, so that JSON stays what it was.
    """
    return _IN_TEXT.sub(_escape, text)


def printable_line(text: str) -> str:
    """The same for text that is to stay on one line, whatever it contains."""
    return _IN_LINE.sub(_escape, text)


def _escape(found: re.Match[str]) -> str:
    return f"\\u{ord(found[0]):04x}"


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


def printable_stream(stream: TextIO) -> TextIO:
    """A stream as a `PrintableStream`; itself where it is one."""
    return stream if isinstance(stream, PrintableStream) else cast(TextIO, PrintableStream(stream))


def _plain(error: UnicodeError) -> tuple[str, int]:
    """Replaces what cannot be encoded: quotes and dashes by those of ASCII, é by e, all else by ?."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    return "".join(map(_ascii, error.object[error.start : error.end])), error.end


def _ascii(sign: str) -> str:
    plain = unicodedata.normalize("NFKD", sign).encode("ascii", "ignore").decode()
    return _ASCII.get(sign) or plain or "?"


codecs.register_error(_PLAIN, _plain)
