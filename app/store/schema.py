"""The database's tables, and how an older database becomes one of today.

`PRAGMA user_version` holds the number of the last migration that was done.
"""

import json
import sqlite3
from collections.abc import Callable
from contextlib import closing

from core.errors import InputError

_BASE = """
CREATE TABLE IF NOT EXISTS history(
    gait TEXT, position INTEGER, label TEXT, document TEXT, PRIMARY KEY(gait, position));
CREATE TABLE IF NOT EXISTS open_gait(
    gait TEXT PRIMARY KEY, revision INTEGER, cursor INTEGER, notice TEXT, approval TEXT);
CREATE TABLE IF NOT EXISTS result(motion TEXT PRIMARY KEY, content TEXT);
CREATE TABLE IF NOT EXISTS job(id TEXT PRIMARY KEY, created REAL, content TEXT);
CREATE TABLE IF NOT EXISTS approval(
    number INTEGER PRIMARY KEY AUTOINCREMENT, gait TEXT, content TEXT);
CREATE TABLE IF NOT EXISTS run(id TEXT PRIMARY KEY, started REAL, content TEXT);
CREATE TABLE IF NOT EXISTS run_bytes(
    number INTEGER PRIMARY KEY AUTOINCREMENT, run TEXT, time REAL, direction TEXT, data BLOB);
"""
"""The tables of the first release."""


def bring_up_to_date(connection: sqlite3.Connection) -> None:
    """Makes the tables, or changes those of an older database, in one transaction.

    Raises:
        InputError: a newer program wrote the database.
    """
    if version(connection) == NEWEST:
        return
    connection.execute("BEGIN IMMEDIATE")
    with connection:
        found = version(connection)  # another program may have changed it until now
        for statement in _BASE.split(";"):
            connection.execute(statement)
        for migrate in _MIGRATIONS[found:]:
            migrate(connection)
        connection.execute(f"PRAGMA user_version = {NEWEST}")


def try_write(connection: sqlite3.Connection) -> None:
    """Makes sure that a database takes changes; leaves it as it was.

    SQLite opens a file that may only be read without a word, and begins transactions on it too.

    Raises:
        sqlite3.Error: it takes none.
    """
    connection.execute("BEGIN IMMEDIATE")
    try:
        connection.execute(f"PRAGMA user_version = {version(connection)}")
    finally:
        connection.rollback()


def missing_tables(connection: sqlite3.Connection) -> list[str]:
    """Tables that a database of this version should have and has not; none where its version is another."""
    if connection.execute("PRAGMA user_version").fetchone()[0] != NEWEST:
        return []
    with closing(sqlite3.connect(":memory:")) as whole:
        bring_up_to_date(whole)
        return sorted(_tables(whole) - _tables(connection))


def _tables(connection: sqlite3.Connection) -> set[str]:
    return {name for (name,) in connection.execute("SELECT name FROM sqlite_master WHERE type='table'")}


def is_outdated(connection: sqlite3.Connection) -> bool:
    """Whether there are tables, of an older version; see `version`."""
    has_tables = connection.execute("SELECT 1 FROM sqlite_master LIMIT 1").fetchone() is not None
    return version(connection) < NEWEST and has_tables


def version(connection: sqlite3.Connection) -> int:
    """The version of a database's tables; 0 for those of the first release, and for none.

    Raises:
        InputError: a newer program wrote the database.
    """
    found = int(connection.execute("PRAGMA user_version").fetchone()[0])
    if found > NEWEST:
        raise InputError(
            f"The database has version {found}; this program reads up to version {NEWEST}. "
            "Start the newer program, or give another data folder with --data.",
            "--data",
        )
    return found


def _add_authors_and_versions(connection: sqlite3.Connection) -> None:
    """A log that only grows, by whom, and versions.

    Before, undo moved a cursor back in the history. Where it stands back, the document that it points at is
    added as the newest.
    """
    for statement in (
        "ALTER TABLE history ADD COLUMN page TEXT NOT NULL DEFAULT 'api'",
        "ALTER TABLE history ADD COLUMN name TEXT NOT NULL DEFAULT ''",
        "ALTER TABLE open_gait RENAME COLUMN cursor TO last",
        "ALTER TABLE open_gait ADD COLUMN done TEXT NOT NULL DEFAULT '[]'",
        "ALTER TABLE open_gait ADD COLUMN undone TEXT NOT NULL DEFAULT '[]'",
        "CREATE TABLE version(gait TEXT, number INTEGER, made REAL, kind TEXT, name TEXT, by TEXT, "
        "position INTEGER, motion TEXT, document TEXT, PRIMARY KEY(gait, number))",
    ):
        connection.execute(statement)
    for gait, cursor in connection.execute("SELECT gait, last FROM open_gait").fetchall():
        _from_cursor(connection, gait, cursor)


def _from_cursor(connection: sqlite3.Connection, gait: str, cursor: int) -> None:
    last = connection.execute("SELECT MAX(position) FROM history WHERE gait=?", (gait,)).fetchone()[0]
    done = [(position, position, "api") for position in range(1, cursor + 1)]
    undone = [(position, last + 1, "api") for position in range(last, cursor, -1)]
    if undone:
        last += 1
        connection.execute(
            "INSERT INTO history(gait, position, label, document) "
            "SELECT gait, ?, 'Undo', document FROM history WHERE gait=? AND position=?",
            (last, gait, cursor),
        )
    connection.execute(
        "UPDATE open_gait SET last=?, done=?, undone=? WHERE gait=?",
        (last, json.dumps(done), json.dumps(undone), gait),
    )


def _add_to_runs(connection: sqlite3.Connection) -> None:
    """Of a run its plan, states with causes, figures, a person's note, and when it was deleted."""
    for statement in (
        "ALTER TABLE run ADD COLUMN note TEXT NOT NULL DEFAULT ''",
        "ALTER TABLE run ADD COLUMN deleted REAL",
        "CREATE TABLE run_plan(run TEXT PRIMARY KEY, content TEXT)",
        "CREATE TABLE run_state(number INTEGER PRIMARY KEY AUTOINCREMENT, run TEXT, time REAL, link TEXT, "
        "robot TEXT, cause TEXT)",
        "CREATE TABLE run_figures(run TEXT PRIMARY KEY, content TEXT)",
        "CREATE INDEX run_bytes_of_run ON run_bytes(run)",
        "CREATE INDEX run_state_of_run ON run_state(run)",
    ):
        connection.execute(statement)


def _add_simulations(connection: sqlite3.Connection) -> None:
    """Simulations of gaits, by what was simulated."""
    connection.execute(
        "CREATE TABLE simulation(gait TEXT, key TEXT, waypoints TEXT, physics TEXT, made REAL, content TEXT, "
        "PRIMARY KEY(gait, key))"
    )


def _add_trials(connection: sqlite3.Connection) -> None:
    """Trials of the real robot: what is known of each, its foot track, and when it was deleted."""
    connection.execute(
        "CREATE TABLE trial(id TEXT PRIMARY KEY, made REAL, deleted REAL, content TEXT, track TEXT)"
    )


def _add_beside_trials(connection: sqlite3.Connection) -> None:
    """What stands beside a trial: what the robot was sent, physics' feet of it, and photos."""
    for statement in (
        "CREATE TABLE trial_sent(trial TEXT PRIMARY KEY, content TEXT)",
        "CREATE TABLE trial_simulated(trial TEXT PRIMARY KEY, key TEXT, content TEXT)",
        "CREATE TABLE trial_photo(id TEXT PRIMARY KEY, trial TEXT, made REAL, deleted REAL, content TEXT)",
        "CREATE INDEX photo_of_trial ON trial_photo(trial)",
    ):
        connection.execute(statement)


def _add_videos(connection: sqlite3.Connection) -> None:
    """Videos, how cameras see the platform (every revision), and what each camera is for."""
    for statement in (
        "CREATE TABLE video(id TEXT PRIMARY KEY, made REAL, deleted REAL, run TEXT, content TEXT)",
        "CREATE INDEX video_of_run ON video(run)",
        "CREATE TABLE camera_setup(id TEXT, revision INTEGER, made REAL, content TEXT, "
        "PRIMARY KEY(id, revision))",
        "CREATE TABLE camera_setup_deleted(id TEXT PRIMARY KEY, deleted REAL)",
        "CREATE TABLE camera(id TEXT PRIMARY KEY, content TEXT)",
    ):
        connection.execute(statement)


def _add_learning(connection: sqlite3.Connection) -> None:
    """What was learned from trials, and the named sets of physics parameters, every version."""
    for statement in (
        "CREATE TABLE learning(id TEXT PRIMARY KEY, made REAL, content TEXT)",
        "CREATE TABLE physics_set(name TEXT, version INTEGER, made REAL, deleted REAL, content TEXT, "
        "PRIMARY KEY(name, version))",
    ):
        connection.execute(statement)


def _add_times(connection: sqlite3.Connection) -> None:
    """How long each gait's plan lasts, as planned and on the robot."""
    connection.execute(
        "CREATE TABLE times(gait TEXT PRIMARY KEY, sent TEXT, plan_seconds REAL, robot_seconds REAL, "
        "speed REAL)"
    )


def _add_turn_rates(connection: sqlite3.Connection) -> None:
    """How fast each gait turns; times without it are found anew with the gait's next plan."""
    connection.execute("DELETE FROM times")
    connection.execute("ALTER TABLE times ADD COLUMN turn_rate REAL")


def _add_reasons(connection: sqlite3.Connection) -> None:
    """Why each gait's last approval is gone."""
    connection.execute("ALTER TABLE open_gait ADD COLUMN revoked TEXT")


def _add_edit_numbers(connection: sqlite3.Connection) -> None:
    """The number that its page gave an edit."""
    connection.execute("ALTER TABLE history ADD COLUMN edit TEXT NOT NULL DEFAULT ''")


def _add_set_aside(connection: sqlite3.Connection) -> None:
    """Rows that could not be read and that a person set aside: their table, number and columns."""
    connection.execute(
        "CREATE TABLE set_aside(number INTEGER PRIMARY KEY AUTOINCREMENT, name TEXT, row INTEGER, made REAL, "
        "columns TEXT)"
    )


def _add_published(connection: sqlite3.Connection) -> None:
    """Computed figures of the published tables' gaits, by what was computed."""
    connection.execute("CREATE TABLE published(key TEXT PRIMARY KEY, made REAL, content TEXT)")


_MIGRATIONS: tuple[Callable[[sqlite3.Connection], None], ...] = (
    _add_authors_and_versions,
    _add_to_runs,
    _add_simulations,
    _add_trials,
    _add_beside_trials,
    _add_videos,
    _add_learning,
    _add_times,
    _add_turn_rates,
    _add_reasons,
    _add_edit_numbers,
    _add_set_aside,
    _add_published,
)

NEWEST = len(_MIGRATIONS)
"""The version of the tables that this program uses."""
