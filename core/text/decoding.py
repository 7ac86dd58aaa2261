"""From the bytes of a text file to its text."""

from core.errors import InputError

MOST_BYTES = 100_000_000
"""Bytes that a text file of a person may have."""
MARK = "\ufeff"
"""The mark of byte order with which a text may begin."""
_UTF_8 = "Save it as UTF-8 (in Excel “CSV UTF-8”)"
_KINDS = (
    (b"\xff\xfe\0\0", "it is text in UTF-32", _UTF_8),
    (b"\0\0\xfe\xff", "it is text in UTF-32", _UTF_8),
    (b"\xff\xfe", "it is text in UTF-16", _UTF_8),
    (b"\xfe\xff", "it is text in UTF-16", _UTF_8),
    (b"PK\x03\x04", "it is a spreadsheet or a ZIP file", "Save the table as CSV in UTF-8"),
    (b"\x1f\x8b", "it is compressed by gzip", "Unpack it first"),
)
"""How files begin that are no text in UTF-8, what they are, and the way out."""


def require_size(size: int, name: str, most: int = MOST_BYTES) -> None:
    """A file is not too large.

    Args:
        size: bytes that it has.
        name: of the file, for messages.
        most: bytes that it may have.

    Raises:
        InputError: it has more.
    """
    if size > most:
        raise InputError(
            f"{name} has {size / 1e6:.1f} MB; at most {most / 1e6:g} MB are read. Cut it into several files.",
            name,
        )


def text_of(content: bytes, name: str, most: int = MOST_BYTES) -> str:
    """The text of a file; a mark of byte order at its beginning stays.

    Args:
        content: of the file.
        name: of the file, for messages.
        most: bytes that it may have.

    Raises:
        InputError: it is too large, in another encoding than UTF-8, or no text.
    """
    require_size(len(content), name, most)
    for begin, kind, way_out in _KINDS:
        if content.startswith(begin):
            raise InputError(f"{name} is not text in UTF-8: {kind}. {way_out}.", name)
    if b"\0" in content:
        raise _zero_byte(content, name)
    try:
        return content.decode()
    except UnicodeDecodeError as error:
        line, column = place_in(content[: error.start].decode(), error.start)
        byte = content[error.start]
        like = "" if byte < 0xA0 else f" (“{chr(byte)}” in Latin-1 or Windows-1252)"
        raise InputError(
            f"{name} is not text in UTF-8: line {line}, column {column} has the byte 0x{byte:02X}{like}. "
            f"{_UTF_8}.",
            f"{name}:{line}",
        ) from error


def _zero_byte(content: bytes, name: str) -> InputError:
    at = content.index(0)
    half = len(content) // 2
    if min(content[::2].count(0), content[1::2].count(0)) == 0 and content.count(0) > half * 0.8:
        return InputError(f"{name} is not text in UTF-8: it is text in UTF-16. {_UTF_8}.", name)
    line = content.count(b"\n", 0, at) + 1
    return InputError(
        f"{name} is not text in UTF-8: line {line} has a zero byte. It is no text file, or it is damaged: "
        "write it anew.",
        f"{name}:{line}",
    )


def without_mark(text: str) -> str:
    """The text without the mark of byte order at its beginning."""
    return text.removeprefix(MARK)


def place_in(text: str, index: int) -> tuple[int, int]:
    """Line and column of a character, both counted from 1."""
    return text.count("\n", 0, index) + 1, index - text.rfind("\n", 0, index)
