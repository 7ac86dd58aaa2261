"""The newest run of a database."""

from __future__ import annotations

from typing import Any

from app.store.database import Database
from app.store.tables.run_store import RunStore


def newest_run(database: Database) -> dict[str, Any]:
    """The newest run; there has to be one."""
    content = RunStore(database).newest()
    assert content is not None
    return content
