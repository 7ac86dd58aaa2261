"""Gaits that are created, imported, deleted and restored, with a ledger of what was acknowledged."""

from __future__ import annotations

import json
import random
from dataclasses import dataclass, field
from urllib.parse import quote

from tests.support.storm.actor import Actor
from tests.support.studio_process import StudioProcess

CREATE, IMPORT, DELETE, RESTORE = "create", "import", "delete", "restore"
SOURCE = "walk-manual-1"
NAME = "Collected"
MOST = 12
"""Gaits that are created in all; after that they are deleted and restored only."""


@dataclass
class Collection:
    """What is known of the gaits that were created.

    Args:
        there: names of the gaits in the list, by id.
        deleted: names of the gaits in the trash, by id.
        coming: kind of the action in flight, and the name or id that it is about; None for none.
        numbers: of names that were given so far.
    """

    there: dict[str, str] = field(default_factory=dict)
    deleted: dict[str, str] = field(default_factory=dict)
    coming: tuple[str, str] | None = None
    numbers: int = 0

    def take(self, gait: str = "") -> None:
        """The action in flight is done; `gait` is the id that a new gait got."""
        if self.coming is None:
            raise AssertionError("nothing was in flight")
        kind, about = self.coming
        self.coming = None
        if kind == DELETE:
            self.deleted[about] = self.there.pop(about)
        elif kind == RESTORE:
            self.there[about] = self.deleted.pop(about)
        else:
            self.there[gait] = about

    def compare(self, there: dict[str, str], deleted: dict[str, str]) -> bool | None:
        """Compares with what is there after a kill.

        Returns:
            Whether the action in flight is there; None where none was.
        """
        coming = self.coming
        if (there, deleted) == (self.there, self.deleted):
            self.coming = None
            return None if coming is None else False
        assert coming is not None, f"{there} instead of {self.there}; deleted {deleted} of {self.deleted}"
        new = [gait for gait, name in there.items() if gait not in self.there and name == coming[1]]
        self.take(*new)
        assert (there, deleted) == (self.there, self.deleted), coming
        return True


class Collector(Actor):
    """Creates, imports, deletes and restores gaits.

    Args:
        studio: which one.
        collection: the ledger.
        dice: what is done next.
    """

    def __init__(self, studio: StudioProcess, collection: Collection, dice: random.Random) -> None:
        super().__init__(studio)
        self._known, self._dice = collection, dice
        self._document = studio.document(SOURCE)

    def act(self) -> None:
        """One of the four."""
        kinds = []
        if len(self._known.there) + len(self._known.deleted) < MOST:
            kinds += [CREATE, IMPORT]
        kinds += [DELETE] if self._known.there else []
        kinds += [RESTORE] if self._known.deleted else []
        kind = self._dice.choice(kinds)
        if kind in (CREATE, IMPORT):
            self._create(kind)
        else:
            gait = self._dice.choice(sorted(self._known.there if kind == DELETE else self._known.deleted))
            self._known.coming = (kind, gait)
            method, path = ("DELETE", "") if kind == DELETE else ("POST", "/restore")
            answer = self.change(kind, method, f"/api/gaits/{gait}{path}")
            assert answer.status == 200, answer
            self._known.take()

    def _create(self, kind: str) -> None:
        self._known.numbers += 1
        name = f"{NAME} {self._known.numbers}"
        self._known.coming = (kind, name)
        if kind == CREATE:
            path, content = f"/api/gaits?copy_of={SOURCE}&name={quote(name)}", None
        else:
            path = f"/api/gaits/import?file=gait.json&name={quote(name)}"
            content = json.dumps({**self._document, "name": name}).encode()
        answer = self.change(kind, "POST", path, content)
        assert answer.status == 201, answer
        assert answer.content["document"]["name"] == name
        self._known.take(answer.content["id"])


def found_collection(studio: StudioProcess) -> tuple[dict[str, str], dict[str, str]]:
    """The gaits of the collection in the list and in the trash, name by id."""
    lists = (studio.ask("GET", path).content["gaits"] for path in ("/api/gaits", "/api/gaits/deleted"))
    there, deleted = (
        {line["id"]: line["name"] for line in lines if line["name"].startswith(NAME)} for lines in lists
    )
    return there, deleted
