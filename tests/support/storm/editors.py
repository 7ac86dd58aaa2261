"""Edits, saves, versions, undo, redo and approvals of one gait, with a ledger of what was acknowledged."""

from __future__ import annotations

import json
import random
from collections.abc import Callable
from pathlib import Path
from urllib.parse import quote

from tests.support.storm.actor import Actor
from tests.support.storm.gait_ledger import GaitLedger, GaitState
from tests.support.studio_process import StudioProcess

EDIT, UNDO, SAVE, VERSION, APPROVAL = "edit", "undo or redo", "save", "version", "approval"


class Editor(Actor):
    """Changes one gait again and again; nobody else does.

    Args:
        studio: which one.
        ledger: of the gait.
        dice: what is done next.
    """

    def __init__(self, studio: StudioProcess, ledger: GaitLedger, dice: random.Random) -> None:
        super().__init__(studio)
        self._ledger, self._dice = ledger, dice
        self._path = f"/api/gaits/{ledger.gait}"
        self._document = studio.document(ledger.gait)
        others = (self._undo, self._redo, self._save, self._name_version)
        self._actions: tuple[Callable[[], None], ...] = (
            self._edit,
            self._edit,
            *others,
            *((self._approve, self._approve) if ledger.approves else ()),
        )

    def act(self) -> None:
        """Edits, or does something with the gait as it is."""
        self._dice.choice(self._actions)()

    def _edit(self) -> None:
        name = f"Number {self._ledger.number()}"
        self._ledger.coming = self._ledger.state.edited(name)
        self._document["name"] = name
        self._changed(EDIT, "PUT", f"?label={quote(name)}", self._document)

    def _undo(self) -> None:
        if self._ledger.state.done:
            self._ledger.coming = self._ledger.state.taken_back()
            self._changed(UNDO, "POST", "/undo")

    def _redo(self) -> None:
        if self._ledger.state.undone:
            self._ledger.coming = self._ledger.state.done_again()
            self._changed(UNDO, "POST", "/redo")

    def _save(self) -> None:
        self._ledger.coming = self._ledger.state.kept()
        self._changed(SAVE, "POST", "/save")

    def _changed(self, kind: str, method: str, path: str, content: object = None) -> None:
        answer = self.change(kind, method, self._path + path, content)
        assert answer.status == 200, answer
        self._ledger.acknowledge()
        assert answer.content["document"]["name"] == self._ledger.state.name
        self._document = answer.content["document"]

    def _name_version(self) -> None:
        version = f"Version {self._ledger.number()} of {self._ledger.state.name}"
        self._ledger.coming = self._ledger.state.named(version)
        answer = self.change(VERSION, "POST", f"{self._path}/versions", {"name": version})
        assert answer.status == 201, answer
        self._ledger.acknowledge()

    def _approve(self) -> None:
        verdict = self.change("check", "POST", f"{self._path}/check").content
        by = f"Ada {self._ledger.number()}"
        self._ledger.coming = self._ledger.state.approved(by)
        content = {"by": by, "verdict_hash": verdict["hash"], "accept_warnings": True}
        answer = self.change(APPROVAL, "POST", f"{self._path}/approve", content)
        assert answer.status == 200, answer
        self._ledger.acknowledge()


def found_state(studio: StudioProcess, data: Path, ledger: GaitLedger) -> GaitState:
    """What is there of a gait after a start, as far as can be looked at without changing it."""
    path, file = f"/api/gaits/{ledger.gait}", data / "gaits" / f"{ledger.gait}.json"
    lines = studio.ask("GET", f"{path}/versions").content["versions"]
    named = [line for line in reversed(lines) if line["kind"] == "named"]
    for line in named[-1:]:
        document = studio.ask("GET", f"{path}/versions/{line['number']}").content["document"]
        assert line["name"].endswith(f" of {document['name']}"), line
    approvals = studio.ask("GET", f"{path}/approvals").content["approvals"] if ledger.approves else []
    standing = [line["by"] for line in approvals if line["stands"]]
    assert len(standing) < 2, standing
    return GaitState(
        name=studio.document(ledger.gait)["name"],
        saved=json.loads(file.read_bytes())["name"] if file.exists() else None,
        versions=tuple(line["name"] for line in named),
        approvals=tuple(line["by"] for line in reversed(approvals)),
        stands=standing[0] if standing else None,
    )
