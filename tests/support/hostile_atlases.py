"""Atlas files as somebody else may have made them: each kind is an atlas with one thing that no atlas has."""

from __future__ import annotations

import json
import os
import sqlite3
import struct
from collections.abc import Callable, Mapping
from contextlib import closing
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from types import MappingProxyType

from app.atlas.atlas_file import AtlasFile
from core.atlas.physics_row import PhysicsRow
from core.atlas.row import AtlasRow, RowStatus
from core.atlas.space import default_space
from solver_jobs import drawn_points

FORMULA = '=HYPERLINK("http://192.0.2.1/","see")'
"""A text that a spreadsheet would run."""
_ENDLESS = "WITH RECURSIVE n(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM n)"
_FIGURES = "seconds, speed, turn_rate, least_margin, body_move, stroke_use, stop_seconds"
_PAGE = 4096


def write_atlas(path: Path, reason: str = "Prevented by: margin.") -> Path:
    """A good atlas of six gaits, of which one is simulated, without any solver.

    Args:
        path: of the file.
        reason: of the infeasible gait.
    """
    path.write_bytes(_content(reason))
    return path


@cache
def _content(reason: str) -> bytes:
    space = default_space("deltawalker")
    rows = [
        AtlasRow(0, RowStatus.INFEASIBLE, reason),
        *(AtlasRow(k, RowStatus.SOLVED, "", 20.0, 1e-3 * k, 0.0, 0.006, 0.01, 0.5, 1.2) for k in range(1, 5)),
        AtlasRow(5, RowStatus.FAILED, "The check does not confirm it."),
    ]
    with TemporaryDirectory() as folder:
        path = Path(folder) / "atlas.sqlite"
        with closing(AtlasFile(path, space)) as atlas:
            atlas.add(list(zip(drawn_points(space, 0, len(rows)), rows, strict=True)))
            atlas.add_physics(PhysicsRow(1, 16, "", 1.0, 0.003, 0.0, 0.01, 0.0, 0.001))
        return path.read_bytes()


def _run(*statements: str) -> Callable[[Path], None]:
    """A good atlas, and then some statements."""

    def write(path: Path) -> None:
        write_atlas(path)
        with closing(sqlite3.connect(path, isolation_level=None)) as connection:
            for statement in statements:
                connection.execute(statement)

    return write


def _schema(change: str, table: str = "gaits") -> Callable[[Path], None]:
    """A good atlas whose entry of a table has another text, rows as they were."""
    return _run("PRAGMA writable_schema = ON", f"UPDATE sqlite_master SET {change} WHERE name = '{table}'")


def _set(assignment: str, table: str = "gaits") -> Callable[[Path], None]:
    return _run(f"UPDATE {table} SET {assignment}{' WHERE id = 1' if table == 'gaits' else ''}")


def _about(key: str, value: str) -> Callable[[Path], None]:
    return _run(f"UPDATE about SET value = {value} WHERE key = '{key}'")


def _text(value: str) -> str:
    return "'" + value.replace("'", "''") + "'"


def _space(**vary: object) -> Callable[[Path], None]:
    return _about("space", _text(json.dumps({"robot": "deltawalker", "vary": vary})))


def _parameters(change: str) -> Callable[[Path], None]:
    """One key of the parameters of a gait is another one, or has another value."""
    return _set(f"parameters = json_set(parameters, {change})")


def _bytes(change: Callable[[bytearray], object]) -> Callable[[Path], None]:
    def write(path: Path) -> None:
        content = bytearray(write_atlas(path).read_bytes())
        change(content)
        path.write_bytes(content)

    return write


def _many_tables(path: Path) -> None:
    write_atlas(path)
    with closing(sqlite3.connect(path)) as connection, connection:
        connection.executescript("BEGIN;" + ";".join(f"CREATE TABLE t{k} (a, b, c)" for k in range(2000)))


def _fans(path: Path) -> None:
    """The table of gaits is a tree whose four upper levels all lead to one page: 400⁴ times the same rows."""
    write_atlas(path)
    count, levels = path.stat().st_size // _PAGE, 4
    with closing(sqlite3.connect(path, isolation_level=None)) as connection:
        query = "SELECT rootpage FROM sqlite_master WHERE name = 'gaits'"
        (leaf,) = connection.execute(query).fetchone()
        connection.execute("PRAGMA writable_schema = ON")
        connection.execute(f"UPDATE sqlite_master SET rootpage = {count + 1} WHERE name = 'gaits'")
    content = bytearray(path.read_bytes())
    for level in range(levels):
        content += _fan(leaf if level == levels - 1 else count + level + 2)
    content[28:32] = struct.pack(">I", count + levels)
    path.write_bytes(content)


def _fan(child: int, cells: int = 400) -> bytes:
    """An inner page of a table whose cells all have the same child."""
    start = _PAGE - 6 * cells
    head = struct.pack(">BHHHBI", 5, 0, cells, start, 0, child)
    places = struct.pack(f">{cells}H", *range(start, _PAGE, 6))
    # Keys of two bytes, which rise.
    own = b"".join(struct.pack(">IBB", child, 0x81 + (k >> 7), k & 0x7F) for k in range(cells))
    return head + places + bytes(start - len(head) - len(places)) + own


def _sparse(size: int) -> Callable[[Path], None]:
    def write(path: Path) -> None:
        write_atlas(path)
        os.truncate(path, size)

    return write


def _beside(end: str, write: Callable[[Path], object]) -> Callable[[Path], None]:
    def write_both(path: Path) -> None:
        write_atlas(path)
        write(path.with_name(path.name + end))

    return write_both


def _link(target: str) -> Callable[[Path], None]:
    return lambda path: path.symlink_to(target)


_SUPER = b"\xd9\xd5\x05\xf9\x20\xa1\x63\xd7" + bytes(500)
_KEPT = b"victim.txt" + struct.pack(">II", 10, sum(b"victim.txt")) + _SUPER[:8]

HOSTILE: Mapping[str, Callable[[Path], object]] = MappingProxyType(
    {
        "view endless": _run(
            "DROP TABLE gaits",
            f"CREATE VIEW gaits AS {_ENDLESS} SELECT x AS id, 'solved' AS status, '' AS reason, "
            + ", ".join(f"0.1 AS {name}" for name in _FIGURES.split(", "))
            + ", '{}' AS parameters FROM n",
        ),
        "view of about": _run(
            "ALTER TABLE about RENAME TO other", "CREATE VIEW about AS SELECT * FROM other"
        ),
        "view of physics": _run("DROP TABLE physics", f"CREATE VIEW physics AS {_ENDLESS} SELECT x FROM n"),
        "view beside": _run(f"CREATE VIEW extra AS {_ENDLESS} SELECT x FROM n"),
        "trigger": _run("CREATE TRIGGER t AFTER INSERT ON gaits BEGIN DELETE FROM gaits; END"),
        "virtual table": _run(
            "PRAGMA writable_schema = ON",
            "INSERT INTO sqlite_master VALUES ('table', 'v', 'v', 0, 'CREATE VIRTUAL TABLE v USING fts5(x)')",
        ),
        "virtual gaits": _schema("rootpage = 0, sql = 'CREATE VIRTUAL TABLE gaits USING fts5(x)'"),
        "extra table": _run("CREATE TABLE extra (x)"),
        "index of an expression": _run("CREATE INDEX i ON gaits (length(reason))"),
        "check of a column": _schema("sql = replace(sql, 'status TEXT NOT NULL', 'status TEXT CHECK (1)')"),
        "generated column": _schema("sql = replace(sql, 'speed REAL', 'speed REAL AS (1.0)')"),
        "default of a column": _schema("sql = replace(sql, 'speed REAL', 'speed REAL DEFAULT 1')"),
        "column missing": _run("ALTER TABLE gaits DROP COLUMN speed"),
        "column more": _run("ALTER TABLE gaits ADD COLUMN more TEXT"),
        "gaits missing": _run("DROP TABLE gaits"),
        "many tables": _many_tables,
        "text of a table": _schema("sql = 'CREATE TABLE gaits ((((('"),
        "first page as table": _schema("rootpage = 1"),
        "page beyond the end": _schema("rootpage = 100000"),
        "fans": _fans,
        "about without space": _run("DELETE FROM about WHERE key = 'space'"),
        "about with a nameless key": _run("INSERT INTO about VALUES (NULL, 'x')"),
        "about of bytes": _about("space", "x'7b7d'"),
        "about with thousands": _run(f"INSERT INTO about {_ENDLESS} SELECT 'k' || x, 'v' FROM n LIMIT 50000"),
        "space deep": _about("space", _text("[" * 200_000)),
        "space of brackets": _about("space", _text('{"a":' * 39_000)),
        "space cut off": _about("space", "'{'"),
        "space a list": _about("space", "'[1]'"),
        "space empty": _about("space", "''"),
        "space of nobody": _about("space", _text('{"robot": "../../etc/passwd", "vary": {"turn": 0}}')),
        "space long": _about("space", "printf('%.*c', 3000000, '[')"),
        "space absurd": _space(step_x=1e-300),
        "space wide": _space(robot={"leg": {"link_length": [1e-300, 1e300]}}),
        "space with nan": _about("space", _text('{"vary": {"step_x": NaN}}')),
        "space with many choices": _space(margin=[0.001 + 1e-7 * k for k in range(8_000)]),
        "version newer": _about("version", "'99'"),
        "version of text": _about("version", _text("1" * 5000)),
        "format of others": _about("format", "'others'"),
        "hash of bytes": _about("robot_hash", "x'00ff'"),
        "hash of markup": _about("robot_hash", "'<script>alert(1)</script>'"),
        "program of bytes that are no text": _about("program", "CAST(x'ffff' AS TEXT)"),
        "status unknown": _set("status = 'done'"),
        "status of bytes": _set("status = x'736f6c766564'"),
        "speed of text": _set("speed = 'fast'"),
        "speed of bytes": _set("speed = x'00'"),
        "speed endless": _set("speed = 9e999"),
        "speed absurd": _set("speed = 1e300"),
        "seconds of text": _set("seconds = 'long'"),
        "speed of text without a motion": _run("UPDATE gaits SET speed = 'fast' WHERE id = 0"),
        "status of bytes without a motion": _run("UPDATE gaits SET status = x'00' WHERE id = 5"),
        "reason of bytes without a motion": _run("UPDATE gaits SET reason = x'00' WHERE id = 0"),
        "parameters empty without a motion": _run("UPDATE gaits SET parameters = '{}' WHERE id = 5"),
        "number negative": _set("id = -5"),
        "number huge": _set("id = 4611686018427387904"),
        "reason of bytes": _set("reason = x'00'"),
        "reason long": _set("reason = printf('%.*c', 900000, 'x')"),
        "reason of no text": _set("reason = CAST(x'c328' AS TEXT)"),
        "reason with a zero": _set("reason = 'a' || char(0) || 'b'"),
        "reason with escapes": _set("reason = char(27) || '[2J'"),
        "parameters a list": _set("parameters = '[1]'"),
        "parameters empty": _set("parameters = '{}'"),
        "parameters cut off": _set("parameters = '{'"),
        "parameters deep": _set(f"parameters = {_text('[' * 9000)}"),
        "parameters of bytes": _set("parameters = x'7b7d'"),
        "parameters with a formula as key": _parameters(f"'$.\"{FORMULA.replace(chr(34), '')}\"', 1"),
        "parameters with a formula": _parameters(f"'$.order', {_text(FORMULA)}"),
        "parameters of other types": _parameters("'$.overlap', json_array(1)"),
        "parameters with nan": _set("parameters = replace(parameters, ': false', ': NaN')"),
        "parameters huge": _parameters("'$.step_x', 1e300"),
        "moves huge": _parameters("'$.moves', 1000000000"),
        "key twice": _set("parameters = replace(parameters, '{', '{\"turn\": 0, ')"),
        "physics of text": _set("walked = 'all'", "physics"),
        "physics endless": _set("slip = -9e999", "physics"),
        "variations of bytes": _set("variations = x'10'", "physics"),
        "physics of nobody": _set("id = -1", "physics"),
        "no database": lambda path: path.write_text("nothing of the kind, and no header " * 9),
        "empty": lambda path: path.write_bytes(b""),
        "zeros": lambda path: path.write_bytes(bytes(100_000)),
        "cut off": _bytes(lambda content: content.__delitem__(slice(_PAGE + 700, None))),
        "garbage": _bytes(lambda content: content.__setitem__(slice(_PAGE, None), b"\xa7" * _PAGE * 3)),
        "pages of another size": _bytes(lambda content: content.__setitem__(slice(16, 18), b"\x02\x00")),
        "written ahead": _run("PRAGMA journal_mode = WAL"),
        "huge": _sparse(10**12),
        "holes": _sparse(4 * 10**9),
        "folder": lambda path: path.mkdir(),
        "pipe": lambda path: os.mkfifo(path),
        "endless device": _link("/dev/zero"),
        "link to itself": _link("link to itself.sqlite"),
        "link to nothing": _link("nothing at all.sqlite"),
        "pipe as journal": _beside("-journal", os.mkfifo),
        "pipe as wal": _beside("-wal", os.mkfifo),
        "journal that names a file": _beside("-journal", lambda path: path.write_bytes(_SUPER + _KEPT)),
        "journal of gigabytes": _beside("-journal", lambda path: _hole(path, 10**10)),
    }
)
"""Writes each kind to a path, by a name that an atlas may have."""

HARMLESS = frozenset({"holes"})
"""Kinds that are read as atlases: what is odd in them does no harm."""


def _hole(path: Path, size: int) -> None:
    path.touch()
    os.truncate(path, size)


def write_hostile(folder: Path) -> dict[str, Path]:
    """Every kind in one folder, by name."""
    found = {name: folder / f"{name}.sqlite" for name in HOSTILE}
    for name, path in found.items():
        HOSTILE[name](path)
    return found
