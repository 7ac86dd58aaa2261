"""A row of the database that cannot be read, and the text that cannot be decoded."""

from dataclasses import dataclass

from app.common.json import Json


class DamagedText(bytes):
    """Bytes of a column of text that are no text."""


@dataclass(frozen=True)
class RowDamage:
    """A row that cannot be read; all others can.

    Args:
        table: where it is.
        row: its number there.
        noun: what it is, for a person.
        key: how a person finds it.
        sentence: why it cannot be read, and what to do.
        may_be_set_aside: whether it can be taken out of its list; some rows belong together.
    """

    table: str
    row: int
    noun: str
    key: str
    sentence: str
    may_be_set_aside: bool = True

    def content(self) -> Json:
        """As JSON content."""
        return {
            "table": self.table,
            "row": self.row,
            "noun": self.noun,
            "id": self.key,
            "name": self.key,
            "sentence": self.sentence,
            "may_be_set_aside": self.may_be_set_aside,
        }
