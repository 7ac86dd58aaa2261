"""The one way to read a table: each row gives a value or a marked damage, and may be taken out of lists."""

import base64
import json
import sqlite3
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from app.common.json import Json
from app.store.database import Database
from app.store.row_damage import DamagedText, RowDamage
from app.store.tables.shapes import Shape, ShapeError
from core.errors import DamagedRowError, InputError

Row = TypeVar("Row")
View = TypeVar("View")

WAY_OUT = "Set it aside (it can be brought back), or go back to a backup with footfall restore."
"""What a person can do about a row that cannot be read."""


@dataclass(frozen=True)
class TableKind(Generic[Row]):
    """What a table, or some of its columns, holds.

    Args:
        name: of the table.
        noun: what a row is, for a person.
        key: the columns by which a person finds a row, the last one first.
        shapes: of the columns, by name.
        make: makes the value of a row, from the columns by name.
        way_out: says what a person can do about a row that cannot be read.
    """

    name: str
    noun: str
    key: tuple[str, ...]
    shapes: Mapping[str, Shape]
    make: Callable[..., Row]
    way_out: str = WAY_OUT

    @property
    def columns(self) -> tuple[str, ...]:
        """Every column that is read."""
        return tuple(dict.fromkeys((*self.shapes, *self.key)))

    def value(self, columns: Mapping[str, Any]) -> Row:
        """The value of a row.

        Raises:
            ShapeError, InputError: it holds none.
        """
        return self.make(**{name: shape(columns[name], name) for name, shape in self.shapes.items()})


@dataclass(frozen=True)
class Selection(Generic[Row]):
    """Rows in the order of a query.

    Args:
        rows: those that can be read.
        damaged: those that cannot.
    """

    rows: tuple[Row, ...]
    damaged: tuple[RowDamage, ...]

    @property
    def unreadable(self) -> list[Json]:
        """The damaged rows as JSON content."""
        return [damage.content() for damage in self.damaged]

    def whole(self) -> tuple[Row, ...]:
        """All rows.

        Raises:
            DamagedRowError: one cannot be read.
        """
        if self.damaged:
            raise DamagedRowError(self.damaged[0].sentence, self.damaged[0].key)
        return self.rows


class Table(Generic[Row]):
    """Rows of one table as values; any thread may ask.

    Args:
        database: where it is.
        kind: what it holds.
    """

    def __init__(self, database: Database, kind: TableKind[Row]) -> None:
        self._database, self._kind = database, kind

    def select(self, rest: str = "", *values: Any) -> Selection[Row]:
        """Rows that a query finds.

        Args:
            rest: of the SQL query, behind the name of the table.
            values: for its places.

        Raises:
            StorageError: the database cannot be read.
        """
        return self.viewed(lambda row: row, rest, *values)

    def viewed(self, view: Callable[[Row], View], rest: str = "", *values: Any) -> Selection[View]:
        """The same with something made of each row; a row of which it cannot be made counts as damaged."""
        kind, names = self._kind, self._kind.columns
        query = f"SELECT rowid, {', '.join(names)} FROM {kind.name} {rest}"
        views: list[View] = []
        damaged: list[RowDamage] = []
        is_news = False
        for number, *row in self._database.rows(query, *values):
            columns = dict(zip(names, row, strict=True))
            try:
                with reading():
                    views.append(view(kind.value(columns)))
            except InputError as error:
                damaged.append(self._damage(number, columns, error.sentence.rstrip(".")))
                is_news |= self._database.take_row_damage(damaged[-1], columns.values())
        if is_news:
            self._database.damaged()
        return Selection(tuple(views), tuple(damaged))

    def first(self, rest: str, *values: Any) -> Row | None:
        """The first row that a query finds; None where it finds none.

        Raises:
            DamagedRowError: it cannot be read.
        """
        rows = self.select(f"{rest} LIMIT 1", *values).whole()
        return rows[0] if rows else None

    def put_deleted(self, deleted: float | None, **key: Any) -> bool:
        """Takes a row out of every list, or brings it back with None; tells whether there is such a row.

        Args:
            deleted: when, s since the epoch.
            key: values of the columns that name the row.
        """
        where = " AND ".join(f"{column}=?" for column in key)
        with self._database.writing() as connection:
            done = connection.execute(
                f"UPDATE {self._kind.name} SET deleted=? WHERE {where}", (deleted, *key.values())
            )
        return done.rowcount > 0

    def _damage(self, number: int, columns: Mapping[str, Any], reason: str) -> RowDamage:
        kind = self._kind
        key = " of ".join(_shown(columns[column]) for column in reversed(kind.key))
        sentence = f"The {kind.noun} “{key}” cannot be read: {reason}. {kind.way_out}"
        return RowDamage(kind.name, number, kind.noun, key, sentence, kind.way_out == WAY_OUT)


@contextmanager
def reading(what: str = "") -> Iterator[None]:
    """Makes a damage of what stored content lacks for the code that reads it; refusals stay what they are.

    Args:
        what: is read, as the beginning of a sentence; nothing where the reason alone is wanted.

    Raises:
        DamagedRowError: something is missing or of another kind.
    """
    try:
        yield
    except ShapeError as error:
        raise DamagedRowError(f"{what}{error}", error.place) from error
    except KeyError as error:
        raise DamagedRowError(f"{what}“{error.args[0]}” is missing") from error
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
        raise DamagedRowError(f"{what}{' '.join(str(error).split())[:200]}") from error


def move_aside(connection: sqlite3.Connection, table: str, row: int, made: float) -> int | None:
    """Moves a row to the table `set_aside`, within a transaction.

    Args:
        connection: on which the transaction is.
        table: where the row is.
        row: its number there.
        made: the present time, s since the epoch.

    Returns:
        The number by which it is brought back; None where there is no such row.
    """
    found = connection.execute(f"SELECT * FROM {table} WHERE rowid=?", (row,))
    values = found.fetchone()
    if values is None:
        return None
    names = [column[0] for column in found.description]
    columns = dict(zip(names, map(_written, values), strict=True))
    kept = connection.execute(
        "INSERT INTO set_aside(name, row, made, columns) VALUES(?,?,?,?)",
        (table, row, made, json.dumps(columns)),
    )
    connection.execute(f"DELETE FROM {table} WHERE rowid=?", (row,))
    return int(kept.lastrowid or 0)


def _written(value: Any) -> Any:
    """A column as JSON content."""
    if isinstance(value, bytes):
        return {"text" if isinstance(value, DamagedText) else "bytes": base64.b64encode(value).decode()}
    return value


def json_of(path: str, column: str = "content") -> str:
    """SQL for a value in a column of JSON; NULL where the column holds no JSON.

    Args:
        path: of the value, such as `$.state`.
        column: the column.
    """
    return (
        f"CASE WHEN typeof({column})='text' AND json_valid({column}) "
        f"THEN json_extract({column}, '{path}') END"
    )


def key_of(row: Any, content: Json, *names: str) -> None:
    """Content and columns name the same.

    Raises:
        ShapeError: they do not.
    """
    for name in names:
        if content[name] != getattr(row, name):
            raise ShapeError(f"content.{name}", f"is “{_shown(content[name])}”, and the row's is another")


def _shown(value: Any) -> str:
    text = value if isinstance(value, str) else repr(value)
    return text if len(text) <= 40 else f"{text[:37]}…"
