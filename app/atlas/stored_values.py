"""Values of an atlas file, which somebody else may have made: each is looked at before it is used."""

import json
import math
import re
import sqlite3
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from app.common.json import Json
from core.atlas.axes import KEYS, MOST_MOVES, ROBOT, Axis
from core.errors import InputError
from core.text.documents import json_content
from core.text.numbers import shortened

MOST_GAITS = 10_000_000
"""Gaits of an atlas."""
MOST_FIGURE = 1e6
"""Largest figure of a gait, SI."""
MOST_TEXT = 10_000
"""Characters of a reason, or of the parameters of a gait."""
_FEET = re.compile(r"(?:[0-9]{1,2}(?:,[0-9]{1,2})*)?", re.ASCII)
_CONTROL = re.compile(r"[\x00-\x1f\x7f-\x9f]")


ParameterBounds = Mapping[str, tuple[type, float, float]]
"""Of each key of a gait's parameters its type, and the least and the most of a number."""


def parameter_bounds(axes: Mapping[str, Axis]) -> ParameterBounds:
    """What the parameters of a gait of a space may be.

    Args:
        axes: of the space.
    """
    own = {name: axis.ends for name, axis in axes.items() if name.startswith(ROBOT)}
    return {
        **{name: (float, key.least, key.most) for name, key in KEYS.items() if key.is_number},
        "overlap": (bool, False, True),
        "moves": (int, 1, MOST_MOVES),
        "order": (str, 0, 0),
        "lost": (str, 0, 0),
        **{name: (float, ends[0], ends[-1]) for name, ends in own.items()},
    }


class StoredValues:
    """The values of one reading of a file.

    Args:
        path: the file.

    Attributes:
        size: bytes of the file; no reading gives more text.
    """

    def __init__(self, path: Path) -> None:
        self._path, self.size = path, 0
        self._read, self._last = 0, -1

    def number(self, value: object) -> int:
        """The number of a gait, larger than the one before."""
        found = self.whole(value, "the number of a gait", self._last + 1, MOST_GAITS - 1)
        self._last = found
        return found

    def whole(self, value: object, what: str, least: int, most: int) -> int:
        """A whole number between two."""
        if not isinstance(value, int) or not least <= value <= most:
            raise self.fault(f"{what} must be a whole number from {least} to {most}", value)
        return value

    def text(self, value: object, what: str, most: int = MOST_TEXT) -> str:
        """A text of one line."""
        if not isinstance(value, str) or len(value) > most or not (value.isprintable() or _is_line(value)):
            raise self.fault(f"{what} must be a text of one line and at most {most} characters", value)
        self._read += len(value)
        if self._read > self.size:
            raise self.fault("it holds more text than the file has bytes")
        return value

    def figure(self, value: object, what: str) -> float:
        """A figure; nan where there is none."""
        if value is None:
            return math.nan
        if not isinstance(value, float) or not abs(value) <= MOST_FIGURE:
            raise self.fault(f"{what} must be a number of at most {MOST_FIGURE:g} in size", value)
        return value

    def parameters(self, value: object, number: int, bounds: ParameterBounds) -> Json:
        """The parameters of a gait: JSON with every key of a gait, and the numbers of the robot that vary.

        Args:
            value: the text.
            number: of the gait.
            bounds: what `parameter_bounds` gives for the space.
        """
        text = self.text(value, f"the parameters of gait {number}")
        try:
            content = json_content(text, "the text")
        except InputError as error:
            words = error.sentence.rstrip(".")
            raise self.fault(f"the parameters of gait {number} do not fit ({words})") from error
        if not isinstance(content, dict) or content.keys() != bounds.keys():
            raise self.fault(f"the parameters of gait {number} must be an object with {', '.join(bounds)}")
        for name, (kind, least, most) in bounds.items():
            one: Any = content[name]
            if kind is str:
                fits = isinstance(one, str) and _FEET.fullmatch(one) is not None
            else:
                is_number = type(one) is kind or (kind is float and type(one) is int)
                fits = is_number and least <= one <= most
            if not fits:
                words = "the numbers of feet" if kind is str else f"from {least:g} to {most:g}"
                raise self.fault(f"{name} of gait {number} must be {words}", one)
        return content

    def fault(self, words: str, *values: object) -> InputError:
        """The refusal of a file.

        Args:
            words: a clause with what it should hold.
            values: the one that it holds, if there is one.
        """
        found = "".join(f", and is {_quoted(value)}" for value in values)
        return InputError(
            f"{self._path} is no atlas that can be read: {words}{found}. Choose another file, or run the "
            "atlas again into another file.",
            str(self._path),
        )


def require_tables(connection: sqlite3.Connection, path: Path, tables: Iterable[str], optional: str) -> None:
    """A file has the tables of an atlas and nothing else.

    Args:
        connection: to the file.
        path: the file.
        tables: statements that make the tables.
        optional: that of a table which may be missing.

    Raises:
        InputError: a table is missing or has other columns, or there is something else.
    """
    rows = connection.execute("SELECT type, name, tbl_name, sql FROM sqlite_master").fetchall()
    wanted = {_table(statement) for statement in tables}
    may_be = {*wanted, _table(optional), ("index", "sqlite_autoindex_about_1", "about", None)}
    found = [(*row[:3], " ".join(row[3].split()) if isinstance(row[3], str) else row[3]) for row in rows]
    values = StoredValues(path)
    for kind, name, *others in found:
        if (kind, name, *others) not in may_be or found.count((kind, name, *others)) > 1:
            raise values.fault(f"it has the {_quoted(kind)} {_quoted(name)}, which no atlas has in this form")
    if not wanted <= set(found):
        raise InputError(f"{path} is no atlas. Choose another file.", str(path))


def _table(statement: str) -> tuple[str, str, str, str]:
    text = " ".join(statement.replace(" IF NOT EXISTS", "").split()).removesuffix(";")
    name = text.split()[2]
    return "table", name, name, text


def _is_line(text: str) -> bool:
    return _CONTROL.search(text) is None


def _quoted(value: Any) -> str:
    if isinstance(value, bytes):
        return f"{len(value)} bytes"
    return shortened(value if isinstance(value, str) else json.dumps(value, default=str))
