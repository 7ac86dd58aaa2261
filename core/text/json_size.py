"""How many values a JSON text has, counted before it is read.

Python does nothing else while it reads JSON, in whatever thread: a Stop waits. Half a million values take
some 50 ms.
"""

from core.errors import InputError

MOST_VALUES = 500_000
"""Values that are read: numbers, texts, lists and objects."""

PIECE_BYTES = 65_536

_QUOTE, _MARKS = b'"', (b",", b"[", b"{")
"""A value stands behind each mark."""


class JsonSize:
    """Counts the values of a JSON text that comes in pieces.

    Attributes:
        values: counted so far.
    """

    def __init__(self) -> None:
        self.values = 0
        self._slashes = 0
        self._is_text = False

    @property
    def is_too_large(self) -> bool:
        """Whether there are more values than are read."""
        return self.values > MOST_VALUES

    def add(self, piece: bytes) -> None:
        """Takes the next piece; bytes that are no JSON in UTF-8 (with a NUL) count as a value each."""
        quotes = piece.count(_QUOTE)
        if self.is_too_large or self.values + quotes // 2 > MOST_VALUES or b"\0" in piece:
            self.values += len(piece)
            return
        for number, part in enumerate(piece.split(_QUOTE)):
            if number:
                is_escaped = self._is_text and self._slashes % 2 == 1
                self._is_text, self._slashes = is_escaped or not self._is_text, 0
            if self._is_text:
                slashes = len(part) - len(part.rstrip(b"\\"))
                self._slashes = slashes + (self._slashes if slashes == len(part) else 0)
            else:
                self.values += sum(map(part.count, _MARKS))


def require_few_values(source: str | bytes, name: str) -> None:
    """Refuses JSON that takes too long to read.

    Args:
        source: the text, or the bytes of its file.
        name: of the file, for messages.

    Raises:
        InputError: it has too many values.
    """
    content = source.encode(errors="surrogatepass") if isinstance(source, str) else source
    size = JsonSize()
    for begin in range(0, len(content), PIECE_BYTES):
        size.add(content[begin : begin + PIECE_BYTES])
        if size.is_too_large:
            raise InputError(f"{name} has more than {MOST_VALUES:,} values. Send less at a time.", name)
