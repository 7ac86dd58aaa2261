"""Setups of cameras for the page and scripts: named documents with revisions, deleted and brought back."""

import sqlite3
import time
import uuid
from collections.abc import Callable
from contextlib import suppress

import numpy as np

from app.cameras.setup_schema import SetupDocument
from app.common.json import Json, finite
from app.store.database import Database
from app.store.tables.camera_setup_store import CameraSetupRow, CameraSetupStore
from app.store.tables.table import reading
from core.errors import DamagedRowError, InputError, NotFoundError, StateError
from core.vision.setup import CameraSetup

MOST_VIEWS = 500
"""Views of setups that are remembered."""


class CameraSetupService:
    """How cameras see the platform; every method may be called from any thread.

    Args:
        database: where setups are kept.
        changed: called when the list is another.
    """

    def __init__(self, database: Database, changed: Callable[[], None] = lambda: None) -> None:
        self._store = CameraSetupStore(database)
        self._changed = changed
        self._views: dict[tuple[str, int], Json] = {}
        """Of setups by id and revision, which take milliseconds each."""

    def views(self, *, is_deleted: bool = False) -> list[Json]:
        """All setups, the last changed first."""
        return self._all(is_deleted)[0]

    def unreadable(self, *, is_deleted: bool = False) -> list[Json]:
        """Setups that cannot be read."""
        return self._all(is_deleted)[1]

    def _all(self, is_deleted: bool) -> tuple[list[Json], list[Json]]:
        """Views of setups, and those of which none can be made."""
        gone = self._store.deleted()
        rows, damaged = self._store.newest()
        if len(self._views) > MOST_VIEWS:
            self._views = {}
        views, unreadable = [], [damage.content() for damage in damaged if not is_deleted]
        for row in rows:
            if (row.id in gone) != is_deleted:
                continue
            try:
                views.append({**self._listed(row), "deleted": is_deleted})
            except InputError as error:
                unreadable.append({"id": row.id, "name": row.id, "sentence": error.sentence})
        return views, unreadable

    def _listed(self, row: CameraSetupRow) -> Json:
        views, key = self._views, (row.id, row.revision)
        if key not in views:
            views[key] = self._view(row)
        return views[key]

    def _view(self, row: CameraSetupRow) -> Json:
        with reading(f"The camera setup {row.id} cannot be read: "):
            return {**_view(row), "deleted": row.id in self._store.deleted()}

    def view(self, setup: str, revision: int | None = None) -> Json:
        """A setup with what it amounts to."""
        return self._view(self._known(setup, revision))

    def check(self, document: SetupDocument) -> Json:
        """What a setup would amount to; nothing is kept.

        Raises:
            InputError: a value that no setup can have.
        """
        return _view(CameraSetupRow("", 0, 0.0, document.model_dump(mode="json")))

    def add(self, document: SetupDocument) -> Json:
        """Keeps a new setup."""
        return self._keep(uuid.uuid4().hex[:12], 1, document)

    def change(self, setup: str, revision: int, document: SetupDocument) -> Json:
        """Keeps a new revision.

        Raises:
            StateError: somebody changed it meanwhile.
        """
        if self._known(setup).revision != revision:
            raise self._moved_on(setup, revision)
        return self._keep(setup, revision + 1, document)

    def _keep(self, setup: str, revision: int, document: SetupDocument) -> Json:
        row = CameraSetupRow(setup, revision, time.time(), document.model_dump(mode="json"))
        view = _view(row)
        try:
            self._store.add(setup, revision, row.made, row.content)
        except sqlite3.IntegrityError:
            raise self._moved_on(setup, revision - 1) from None
        self._changed()
        return view

    def _moved_on(self, setup: str, revision: int) -> StateError:
        found = self._known(setup).revision
        return StateError(
            f"The setup was changed meanwhile: it has revision {found}, and you changed {revision}. Load it "
            "again and repeat your change.",
            "revision",
        )

    def delete(self, setup: str) -> None:
        """Takes a setup out of the list; `restore` brings it back."""
        with suppress(DamagedRowError):  # it goes all the same
            self._known(setup)
        self._store.put_deleted(setup, time.time())
        self._changed()

    def restore(self, setup: str) -> Json:
        """Brings a deleted setup back."""
        self._known(setup)
        self._store.put_deleted(setup, None)
        self._changed()
        return self.view(setup)

    def complete(self, setup: str) -> tuple[CameraSetup, int]:
        """A setup that can track, and its revision.

        Raises:
            InputError: something is missing.
        """
        row = self._known(setup)
        with reading(f"The camera setup {setup} cannot be read: "):
            made = SetupDocument.model_validate(row.content).setup()
        made.tracking()
        return made, row.revision

    def _known(self, setup: str, revision: int | None = None) -> CameraSetupRow:
        row = self._store.get(setup, revision)
        if row is None:
            which = "" if revision is None else f" of revision {revision}"
            raise NotFoundError(f"There is no setup {setup}{which}.", "setup")
        return row


def _view(row: CameraSetupRow) -> Json:
    setup = SetupDocument.model_validate(row.content).setup()
    return {
        "id": row.id,
        "revision": row.revision,
        "made": row.made,
        "deleted": False,
        "setup": row.content,
        "ready": not setup.missing,
        "missing": list(setup.missing),
        "view": None if setup.missing else _platform(setup),
    }


def _platform(setup: CameraSetup) -> Json:
    """Where the platform is, and how well the clicked points agree."""
    off_mm = setup.off * 1000.0
    outline = setup.outline
    across = np.linalg.norm(np.roll(outline, -1, axis=0) - outline, axis=1).mean()
    content: Json = finite(
        {
            "off_mm": np.round(off_mm, 4).tolist(),
            "worst_mm": float(off_mm.max()),
            "mm_per_pixel": float(100.0 / across),
            "outline": np.round(outline, 2).tolist(),
            "seen": np.round(setup.seen(setup.places), 2).tolist(),
            "grid": [
                {
                    "axis": line.axis,
                    "at_cm": round(line.at * 100.0, 6),
                    "line": np.round(line.pixels, 1).tolist(),
                }
                for line in setup.grid
                if np.isfinite(line.pixels).all()
            ],
            "doubt": setup.doubt,
        }
    )
    return content
