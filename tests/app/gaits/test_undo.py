"""Undo on the service: across restarts, of one's own edits, and what it refuses."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from app.gaits.live_plans import LivePlans
from app.gaits.service import GaitService
from app.store.database import Database
from app.store.gait_files import GaitFiles
from app.undo.history import LEAST_STEPS, MOST_ENTRIES, MOST_STEPS, Author, fresh_history
from core.errors import StateError
from core.gait.gait import Gait
from core.library.library import library
from solver_jobs import SolveStatus
from tests.app.gaits.test_service import MANUAL, WALK, edit, reopened, service, toggled
from tests.support.live_tiers import FixedTier

__all__ = ["service"]  # a fixture


def test_a_hundred_steps_are_undone_and_redone_across_a_restart(
    service: GaitService, tmp_path: Path, database: Database
) -> None:
    first = service.open_gait(WALK).gait
    for step in range(120):
        edit(service, WALK, foot=step % 4, sample=1 + step // 4)
    last = service.open_gait(WALK).gait
    again = reopened(tmp_path, database)
    for _ in range(120):
        again.undo(WALK)
    assert again.open_gait(WALK).gait == first
    more = reopened(tmp_path, database)
    for _ in range(120):
        more.redo(WALK)
    assert more.open_gait(WALK).gait == last
    assert len(more.open_gait(WALK).history.entries) == 361


def test_an_edit_that_is_sent_again_is_made_once_also_after_a_restart(
    service: GaitService, tmp_path: Path, database: Database
) -> None:
    once = toggled(service.open_gait(WALK).gait, 0, 1)
    made = service.edit(WALK, once, "Once", None, edit_number="page.1")
    twice = toggled(once, 0, 2)
    for asked in (service, reopened(tmp_path, database)):
        again = asked.edit(WALK, twice, "Once", 0, edit_number="page.1")
        assert (again.gait, again.revision) == (made.gait, made.revision)
    assert (
        service.edit(WALK, twice, "Another", made.revision, edit_number="page.2").revision
        == made.revision + 1
    )
    assert service.open_gait(WALK).history.newest_edits == ("page.2", "page.1")


def test_a_long_log_keeps_what_undo_needs_and_no_more() -> None:
    history = fresh_history(json.dumps({"name": 0}))
    for number in range(1, MOST_ENTRIES + 400):
        history = history.edited(json.dumps({"name": number}), "Name", Author(), frozenset()).pruned()
        assert len(history.entries) <= MOST_ENTRIES
    for number in range(MOST_STEPS):
        step = history.undo(Author(), frozenset())
        history = history.stepped(step, json.dumps(step.content), Author()).pruned()
        assert step.content == {"name": MOST_ENTRIES + 398 - number}
    with pytest.raises(StateError, match="nothing to undo"):
        history.undo(Author(), frozenset())


def test_a_large_log_still_keeps_a_hundred_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.undo.history.MOST_CHARACTERS", 40_000)
    history = fresh_history(json.dumps({"name": 0}))
    for number in range(1, 200):
        text = json.dumps({"name": number, "recorded": "1" * 500})
        history = history.edited(text, "Name", Author(), frozenset()).pruned()
        assert len(history.entries) <= LEAST_STEPS + 1 or number <= LEAST_STEPS
    for number in range(LEAST_STEPS):
        step = history.undo(Author(), frozenset())
        assert step.content["name"] == 198 - number
        history = history.stepped(step, json.dumps(step.content), Author())
    with pytest.raises(StateError, match="nothing to undo"):
        history.undo(Author(), frozenset())


def test_the_edits_of_a_page_that_is_gone_are_everybodys(tmp_path: Path, database: Database) -> None:
    pages = {"ada", "bob"}
    tier = LivePlans(FixedTier(SolveStatus.INFEASIBLE))
    service = GaitService(GaitFiles(tmp_path), database, tier.solve_for, lambda: frozenset(pages))
    first = service.open_gait(WALK).gait
    service.edit(WALK, toggled(first, 1, 20), "Hers", None, Author("ada", "Ada"))
    with pytest.raises(StateError, match="nothing to undo"):
        service.undo(WALK, Author("bob"))
    assert service.open_gait(WALK).undo_label(frozenset({"ada"})) is None
    pages.remove("ada")
    assert service.undo(WALK, Author("bob")).gait == first
    pages.add("ada")
    with pytest.raises(StateError, match="nothing to redo"):
        service.redo(WALK, Author("ada"))  # who undid it does it again
    assert service.redo(WALK, Author("bob")).gait == toggled(first, 1, 20)


def test_undo_says_who_changed_the_same_since(tmp_path: Path, database: Database) -> None:
    pages = frozenset({"ada", "bob"})
    tier = LivePlans(FixedTier(SolveStatus.INFEASIBLE))
    service = GaitService(GaitFiles(tmp_path), database, tier.solve_for, lambda: pages)
    first = service.open_gait(WALK).gait
    service.edit(WALK, first.with_options(margin=0.001), "Margin to 1 mm", None, Author("ada", "Ada"))
    service.edit(WALK, first.with_options(margin=0.002), "Margin to 2 mm", None, Author("bob", "Bob"))
    with pytest.raises(
        StateError, match=r"“Margin to 1 mm” cannot be undone: Bob changed the stability margin since"
    ):
        service.undo(WALK, Author("ada", "Ada"))
    with pytest.raises(StateError, match="another tab changed the stability margin"):
        service.undo(WALK, Author("ada", "Bob"))
    assert service.open_gait(WALK).gait.options.margin == 0.002
    service.undo(WALK, Author("bob", "Bob"))
    assert service.undo(WALK, Author("ada", "Ada")).gait == first


def test_a_swing_that_two_moved_is_undone_by_the_last_one_first(tmp_path: Path, database: Database) -> None:
    tier = LivePlans(FixedTier(SolveStatus.INFEASIBLE))
    service = GaitService(GaitFiles(tmp_path), database, tier.solve_for, lambda: frozenset({"ada", "bob"}))

    def row() -> str:
        return "".join("1" if stance else "0" for stance in service.open_gait(WALK).gait.timeline.stance[1])

    def move(by: int, author: Author) -> None:
        gait = service.open_gait(WALK).gait
        stance = gait.timeline.stance.copy()
        stance[1] = np.roll(stance[1], by)
        moved = replace(gait, timeline=replace(gait.timeline, stance=stance))
        service.edit(WALK, moved, "Move the swing", None, author)

    first = row()
    move(2, Author("bob"))
    his = row()
    move(-1, Author("ada", "Ada"))
    hers = row()
    with pytest.raises(StateError, match=r"cannot be undone: Ada changed foot 2, samples \d+–\d+ since"):
        service.undo(WALK, Author("bob"))
    assert row() == hers
    service.undo(WALK, Author("ada", "Ada"))
    assert row() == his
    service.undo(WALK, Author("bob"))
    assert row() == first
    with pytest.raises(StateError, match="cannot be done again: another tab changed foot 2"):
        service.redo(WALK, Author("ada", "Ada"))


def test_undo_leaves_cells_alone_that_somebody_locked(tmp_path: Path, database: Database) -> None:
    tier = LivePlans(FixedTier(SolveStatus.INFEASIBLE))
    service = GaitService(GaitFiles(tmp_path), database, tier.solve_for, lambda: frozenset({"ada", "bob"}))
    painted = toggled(service.open_gait(WALK).gait, 1, 20)
    service.edit(WALK, painted, "Paint", None, Author("ada"))
    locked = painted.timeline.locked.copy()
    locked[1, 20] = True
    locking = replace(painted, timeline=replace(painted.timeline, locked=locked))
    service.edit(WALK, locking, "Lock", None, Author("bob"))
    with pytest.raises(StateError, match="Foot 2, sample 21 is locked"):
        service.undo(WALK, Author("ada"))


def test_the_document_before_the_present_one_is_known(service: GaitService) -> None:
    assert service.open_gait(WALK).before is None
    first = service.open_gait(WALK).gait
    edit(service, WALK)
    assert service.open_gait(WALK).before == first


def test_a_deleted_gait_comes_back_with_its_unsaved_edits_and_its_id_is_not_given_away(
    service: GaitService, tmp_path: Path, database: Database
) -> None:
    created = service.create(replace(library()[WALK].gait, name="My walk"))
    edit(service, created.id)
    edited = service.open_gait(created.id).gait
    service.delete(created.id)
    assert service.create(created.gait).id == "my-walk-2"
    again = reopened(tmp_path, database)
    assert again.restore(created.id).gait == edited
    assert again.undo(created.id).gait == created.gait


def renamed_segment(gait: Gait, foot: int, at: int, name: str) -> Gait:
    """The gait with a segment of its table under another name that means the same."""
    table = gait.segment_table
    assert table is not None
    words = table.vocabulary.segments
    vocabulary = replace(table.vocabulary, segments={**words, name: words[table.rows[foot][at]]})
    rows = [list(row) for row in table.rows]
    rows[foot][at] = name
    return replace(gait, segment_table=replace(table, rows=tuple(map(tuple, rows)), vocabulary=vocabulary))


def test_two_people_edit_one_segment_table_and_undo_their_own(tmp_path: Path, database: Database) -> None:
    tier = LivePlans(FixedTier(SolveStatus.INFEASIBLE))
    service = GaitService(GaitFiles(tmp_path), database, tier.solve_for, lambda: frozenset({"ada", "bob"}))
    first = service.open_gait(MANUAL).gait
    service.edit(MANUAL, renamed_segment(first, 0, 3, "Hers"), "Hers", None, Author("ada"))
    both = renamed_segment(service.open_gait(MANUAL).gait, 1, 3, "His")
    service.edit(MANUAL, both, "His", None, Author("bob"))
    undone = service.undo(MANUAL, Author("ada")).gait
    assert undone == renamed_segment(first, 1, 3, "His")
    assert service.redo(MANUAL, Author("ada")).gait == both
    assert service.undo(MANUAL, Author("bob")).gait == renamed_segment(first, 0, 3, "Hers")


def test_a_new_length_of_the_timeline_is_not_taken_back_under_somebodys_drawing(
    tmp_path: Path, database: Database
) -> None:
    tier = LivePlans(FixedTier(SolveStatus.INFEASIBLE))
    service = GaitService(GaitFiles(tmp_path), database, tier.solve_for, lambda: frozenset({"ada", "bob"}))
    first = service.open_gait(WALK).gait
    service.edit(WALK, replace(first, iterations=2), "Two iterations", None, Author("ada"))
    drawn = toggled(service.open_gait(WALK).gait, 1, 60)
    service.edit(WALK, drawn, "Draw", None, Author("bob", "Bob"))
    with pytest.raises(StateError, match="Bob changed the timeline of foot 2 since"):
        service.undo(WALK, Author("ada"))
    assert service.open_gait(WALK).gait == drawn
    service.undo(WALK, Author("bob", "Bob"))
    assert service.undo(WALK, Author("ada")).gait == first
