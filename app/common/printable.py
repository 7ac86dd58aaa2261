"""Text as it may reach a terminal: control characters are written as escapes that can be read."""

import re

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
