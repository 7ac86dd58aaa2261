"""Documents in the database that this program cannot show: every way out works, and nothing is lost."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from app.documents.gait_json import gait_content
from app.gaits.recovery import LAST_LABEL, ORIGINAL_LABEL, WayOut
from app.gaits.service import GaitService
from app.gaits.summaries import GaitSummaries
from app.store.database import Database
from app.store.tables.unreadable import Unreadable
from core.errors import InputError, StateError
from core.gait.gait import Gait
from core.library.library import library
from tests.app.gaits.test_service import WALK, reopened

Change = Callable[[dict[str, Any]], dict[str, Any]]


def _with(**fields: Any) -> Change:
    return lambda content: {**content, **fields}


UNSHOWN: dict[str, Callable[[str], str]] = {
    "another robot": lambda text: json.dumps({**json.loads(text), "robot": "centipede"}),
    "later version": lambda text: json.dumps({**json.loads(text), "version": 99}),
    "out of bounds": lambda text: json.dumps(_clearance(json.loads(text), 0.5)),
    "cut off": lambda text: text[:100],
    "empty": lambda text: "",
    "a list": lambda text: "[]",
    "nested": lambda text: "[" * 5000,
}
"""How a document that was kept can be of no use."""


def _clearance(content: dict[str, Any], metres: float) -> dict[str, Any]:
    return {**content, "options": {**content["options"], "clearance": metres}}


def noted(service: GaitService, gait_id: str, notes: str) -> Gait:
    """Edits a gait's notes; gives the document."""
    gait = replace(service.open_gait(gait_id).gait, notes=notes)
    service.edit(gait_id, gait, f"Note {notes}", None)
    return gait


def spoil(database: Database, gait_id: str, position: int, change: Callable[[str], str]) -> str:
    """Changes one document in a gait's history; position -1 is the present one. Gives its new text."""
    [(last,)] = database.rows("SELECT last FROM open_gait WHERE gait=?", gait_id)
    at = last if position == -1 else position
    [(text,)] = database.rows("SELECT document FROM history WHERE gait=? AND position=?", gait_id, at)
    changed = change(text)
    with database.writing() as connection:
        connection.execute(
            "UPDATE history SET document=? WHERE gait=? AND position=?", (changed, gait_id, at)
        )
    return changed


def line(service: GaitService, gait_id: str) -> dict[str, Any]:
    return next(line for line in GaitSummaries(service).lines() if line["id"] == gait_id)


@pytest.fixture
def gait_id(tmp_path: Path, database: Database) -> str:
    """A saved gait with the notes “one”, then “two”."""
    service = reopened(tmp_path, database)
    made = service.create(replace(library()[WALK].gait, name="Mine"))
    noted(service, made.id, "one")
    noted(service, made.id, "two")
    return made.id


@pytest.mark.parametrize("kind", UNSHOWN)
def test_a_saved_gait_goes_back_to_its_last_state_that_can_be_shown(
    kind: str, gait_id: str, tmp_path: Path, database: Database
) -> None:
    text = spoil(database, gait_id, -1, UNSHOWN[kind])
    service = reopened(tmp_path, database)
    marked = line(service, gait_id)
    assert (marked["kind"], marked["way_out"]) == ("damaged", "last")
    with pytest.raises(InputError, match="recover"):
        service.open_gait(gait_id)
    recovered = service.recover(gait_id)
    assert recovered.gait.notes == "one"
    assert recovered.history.present.label == LAST_LABEL
    assert (line(service, gait_id)["problem"], line(service, gait_id)["way_out"]) == (None, None)
    assert service.versions.all(gait_id).rows[0].document == text
    service.undo(gait_id)
    assert service.open_gait(gait_id).gait.notes == ""
    assert reopened(tmp_path, database).open_gait(gait_id).gait.notes == ""


@pytest.mark.parametrize("kind", UNSHOWN)
def test_a_built_in_gait_goes_back_to_how_it_came(kind: str, tmp_path: Path, database: Database) -> None:
    service = reopened(tmp_path, database)
    noted(service, WALK, "one")
    noted(service, WALK, "two")
    text = spoil(database, WALK, -1, UNSHOWN[kind])
    again = reopened(tmp_path, database)
    assert line(again, WALK)["way_out"] == "original"
    recovered = again.recover(WALK)
    assert recovered.gait == library()[WALK].gait
    assert recovered.undo_label() == ORIGINAL_LABEL
    assert again.versions.all(WALK).rows[0].document == text
    assert again.undo(WALK).gait.notes == "one"
    assert again.undo(WALK).gait.notes == ""


def test_undo_edit_and_delete_are_ways_out_as_well(tmp_path: Path, database: Database) -> None:
    def bad() -> GaitService:
        service = reopened(tmp_path, database)
        noted(service, WALK, "one")
        noted(service, WALK, "two")
        spoil(database, WALK, -1, UNSHOWN["another robot"])
        return reopened(tmp_path, database)

    assert bad().undo(WALK).gait == library()[WALK].gait
    assert bad().edit(WALK, replace(library()[WALK].gait, notes="new"), "Edit", 1).gait.notes == "new"
    deleted = bad().delete(WALK)
    assert deleted is not None
    assert deleted.gait == library()[WALK].gait


def test_a_saved_gait_that_cannot_be_shown_is_deleted_and_brought_back(
    gait_id: str, tmp_path: Path, database: Database
) -> None:
    spoil(database, gait_id, -1, UNSHOWN["cut off"])
    service = reopened(tmp_path, database)
    assert service.delete(gait_id) is None
    assert [gait.id for gait in service.deleted()] == [gait_id]
    assert service.restore(gait_id).gait.notes == "one"


def test_an_unreadable_file_is_set_aside(gait_id: str, tmp_path: Path, database: Database) -> None:
    path = tmp_path / "gaits" / f"{gait_id}.json"
    path.write_text("[")
    with database.writing() as connection:
        connection.execute("DELETE FROM version")
    service = reopened(tmp_path, database)
    assert line(service, gait_id)["way_out"] == "last"
    assert service.recover(gait_id).gait.notes == "two"
    assert json.loads(path.read_text())["notes"] == "two"
    assert [file.read_text() for file in (tmp_path / "set-aside").iterdir()] == ["["]


def test_an_unreadable_file_over_a_built_in_gait_is_set_aside(tmp_path: Path, database: Database) -> None:
    path = tmp_path / "gaits" / f"{WALK}.json"
    reopened(tmp_path, database)
    path.write_text("[")
    service = reopened(tmp_path, database)
    assert service.recover(WALK).gait == library()[WALK].gait
    assert not path.exists()
    assert [file.read_text() for file in (tmp_path / "set-aside").iterdir()] == ["["]


def test_a_gait_without_any_state_that_can_be_shown_is_deleted_only(
    tmp_path: Path, database: Database
) -> None:
    reopened(tmp_path, database)
    (tmp_path / "gaits" / "odd.json").write_text("[")
    service = reopened(tmp_path, database)
    assert line(service, "odd")["way_out"] is None
    with pytest.raises(StateError, match="Delete it"):
        service.recover("odd")
    assert service.delete("odd") is None
    with pytest.raises(InputError):
        service.restore("odd")
    assert line(service, "odd")["problem"]


def test_a_gait_that_can_be_shown_has_nothing_to_recover_from(
    gait_id: str, tmp_path: Path, database: Database
) -> None:
    with pytest.raises(StateError, match="can be shown"):
        reopened(tmp_path, database).recover(gait_id)


@pytest.mark.parametrize("kind", UNSHOWN)
def test_undo_and_redo_skip_a_document_that_cannot_be_shown(
    kind: str, gait_id: str, tmp_path: Path, database: Database
) -> None:
    noted(reopened(tmp_path, database), gait_id, "three")
    text = spoil(database, gait_id, 2, UNSHOWN[kind])  # of the note “two”
    service = reopened(tmp_path, database)
    opened = service.open_gait(gait_id)
    assert (opened.gait.notes, opened.before) == ("three", None)
    undone = service.undo(gait_id)
    assert undone.gait.notes == "one"
    assert undone.notice is not None
    assert "“Note three” cannot be shown and is skipped" in undone.notice
    assert text in {version.document for version in service.versions.all(gait_id).rows}
    assert service.redo(gait_id).gait.notes == "three"


def test_redo_skips_what_cannot_be_shown_any_more(gait_id: str, tmp_path: Path, database: Database) -> None:
    before = reopened(tmp_path, database)
    before.undo(gait_id)
    before.undo(gait_id)
    spoil(database, gait_id, 1, UNSHOWN["later version"])
    service = reopened(tmp_path, database)
    assert service.redo(gait_id).gait.notes == "two"
    assert service.undo(gait_id).gait.notes == ""


def test_where_nothing_before_can_be_shown_undo_says_so(
    gait_id: str, tmp_path: Path, database: Database
) -> None:
    for position in (0, 1):
        spoil(database, gait_id, position, UNSHOWN["another robot"])
    service = reopened(tmp_path, database)
    with pytest.raises(StateError, match=r"cannot be shown and is skipped.* nothing to undo"):
        service.undo(gait_id)
    assert service.open_gait(gait_id).gait.notes == "two"


@pytest.mark.parametrize(
    ("column", "text"),
    [("done", "{"), ("undone", "[[1]]"), ("done", '[["a", "b", "c"]]'), ("last", 77)],
)
def test_a_history_that_contradicts_itself_has_the_same_way_out(
    column: str, text: str | int, gait_id: str, tmp_path: Path, database: Database
) -> None:
    with database.writing() as connection:
        connection.execute(f"UPDATE open_gait SET {column}=? WHERE gait=?", (text, gait_id))
    service = reopened(tmp_path, database)
    assert service.recover(gait_id).gait.notes == "two"
    assert noted(service, gait_id, "three").notes == "three"
    assert reopened(tmp_path, database).undo(gait_id).gait.notes == "two"


@pytest.mark.parametrize("is_builtin", [True, False])
def test_a_history_that_is_lost_has_the_same_way_out(
    is_builtin: bool, gait_id: str, tmp_path: Path, database: Database
) -> None:
    lost = WALK if is_builtin else gait_id
    noted(reopened(tmp_path, database), lost, "three")
    with database.writing() as connection:
        connection.execute("DELETE FROM history")
    service = reopened(tmp_path, database)
    assert line(service, lost)["way_out"] == ("original" if is_builtin else "last")
    assert service.recover(lost).gait.notes == ""
    assert reopened(tmp_path, database).open_gait(lost).gait.notes == ""


@pytest.mark.parametrize("column", ["label", "page", "name", "edit"])
def test_a_step_whose_words_were_damaged_keeps_its_document(
    column: str, gait_id: str, tmp_path: Path, database: Database
) -> None:
    last = noted(reopened(tmp_path, database), gait_id, "Kept.")
    with database.writing() as connection:
        connection.execute(f"UPDATE history SET {column}=x'ff' WHERE gait=?", (gait_id,))
    assert reopened(tmp_path, database).open_gait(gait_id).gait == last


@pytest.mark.parametrize("column", ["revision", "last", "done", "notice", "revoked"])
def test_an_editing_state_that_was_damaged_loses_no_document(
    column: str, gait_id: str, tmp_path: Path, database: Database
) -> None:
    last = noted(reopened(tmp_path, database), gait_id, "Kept.")
    with database.writing() as connection:
        connection.execute(f"UPDATE open_gait SET {column}=x'ff' WHERE gait=?", (gait_id,))
    with pytest.raises(StateError, match="Go back to the last state"):
        Unreadable(database).set_aside("open_gait", 1)
    service = reopened(tmp_path, database)
    assert line(service, gait_id)["way_out"] == WayOut.LAST
    recovered = service.recover(gait_id)
    assert (recovered.gait, recovered.revision > 1) == (last, True)


def test_a_document_that_is_no_text_is_set_aside_by_the_way_out(
    gait_id: str, tmp_path: Path, database: Database
) -> None:
    before = noted(reopened(tmp_path, database), gait_id, "Kept.")
    noted(reopened(tmp_path, database), gait_id, "Spoilt.")
    with database.writing() as connection:
        last = "SELECT max(position) FROM history WHERE gait=:gait"
        connection.execute(
            f"UPDATE history SET document=x'ff' WHERE gait=:gait AND position=({last})", {"gait": gait_id}
        )
    service = reopened(tmp_path, database)
    assert service.recover(gait_id).gait == before
    [(name,)] = database.rows("SELECT name FROM set_aside")
    assert name == "history"


def test_undo_skips_nothing_where_another_edit_stands_in_between(
    gait_id: str, tmp_path: Path, database: Database
) -> None:
    service = reopened(tmp_path, database)
    noted(service, gait_id, "three")
    service.undo(gait_id)
    noted(service, gait_id, "four")
    spoil(database, gait_id, 4, UNSHOWN["another robot"])
    again = reopened(tmp_path, database)
    with pytest.raises(StateError, match="Restore an earlier version"):
        again.undo(gait_id)
    assert again.open_gait(gait_id).gait.notes == "four"


def test_knots_beyond_todays_bounds_are_limited_and_said(
    gait_id: str, tmp_path: Path, database: Database
) -> None:
    def wide(text: str) -> str:
        content = json.loads(text)
        return json.dumps(
            {**content, "options": {**content["options"], "phase_knots": 60, "closing_knots": 150}}
        )

    spoil(database, gait_id, -1, wide)
    path = tmp_path / "gaits" / f"{gait_id}.json"
    path.write_text(wide(path.read_text()))
    opened = reopened(tmp_path, database).open_gait(gait_id)
    assert (opened.gait.options.phase_knots, opened.gait.options.closing_knots) == (50, 100)
    assert opened.gait.notes == "two"
    assert opened.notice is not None
    assert (
        "a phase length of 60 samples (now 50) and a final stance of 150 samples (now 100)" in opened.notice
    )
    (tmp_path / "gaits" / "old.json").write_text(path.read_text())
    old = reopened(tmp_path, database).open_gait("old")
    assert old.notice is not None
    assert not old.edited


def test_a_line_that_fails_for_any_reason_hides_no_other(
    gait_id: str, tmp_path: Path, database: Database, monkeypatch: pytest.MonkeyPatch
) -> None:
    service = reopened(tmp_path, database)
    glance, way_out = service.open_gaits.glance, service.open_gaits.way_out

    def failing(wanted: str) -> tuple[Gait, bool, bool]:
        return 1 // 0 if wanted == gait_id else glance(wanted)  # type: ignore[return-value]

    def without(wanted: str) -> WayOut | None:
        return 1 // 0 if wanted == gait_id else way_out(wanted)  # type: ignore[return-value]

    monkeypatch.setattr(service.open_gaits, "glance", failing)
    monkeypatch.setattr(service.open_gaits, "way_out", without)
    assert "ZeroDivisionError" in line(service, gait_id)["problem"]
    assert line(service, WALK)["problem"] is None


def test_a_document_is_read_back_as_it_was(gait_id: str, tmp_path: Path, database: Database) -> None:
    opened = reopened(tmp_path, database).open_gait(gait_id)
    assert json.loads(opened.history.present.document) == gait_content(opened.gait)
