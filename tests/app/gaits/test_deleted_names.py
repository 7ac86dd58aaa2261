"""A file that appears under a deleted gait's name is a new gait; the deleted one can be brought back."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from app.gaits.approvals import ApprovalRequest
from app.gaits.service import GaitService
from app.gaits.trash import IN_TRASH
from app.store.database import Database
from app.store.gait_files import GaitFiles
from app.store.tables.edit_history_store import EditHistoryStore
from core.errors import InputError, NotFoundError, StorageFullError
from core.library.library import library
from tests.app.gaits.test_approvals import GAIT, Opened, opened, simulations

__all__ = ["opened", "simulations"]

WALK = library()[GAIT].gait
ADA = ApprovalRequest("Ada", accept_warnings=True)


def deleted_gait(service: GaitService) -> str:
    """An approved gait with two edits, deleted."""
    gait_id = service.create(replace(WALK, name="Mine")).id
    service.edit(gait_id, replace(service.document(gait_id), name="Edited"), "Name", None)
    service.edit(gait_id, service.document(gait_id).with_options(stop_bound=0.9), "Stop bound", None)
    service.check(gait_id)
    assert service.approve(gait_id, ADA).approval is not None
    service.delete(gait_id)
    return gait_id


def appear(data: Path, gait_id: str, *, same: bool) -> None:
    """A copy of the deleted file, or of another gait, under its name."""
    target = data / "gaits" / f"{gait_id}.json"
    if same:
        shutil.copy(data / "trash" / f"{gait_id}.json", target)
    else:
        GaitFiles(data).write(gait_id, replace(WALK, name="Theirs"))


@pytest.mark.parametrize("same", [False, True])
@pytest.mark.parametrize("is_reopened", [False, True])
def test_a_file_under_a_deleted_name_is_a_new_gait(
    opened: Opened, tmp_path: Path, same: bool, is_reopened: bool
) -> None:
    service = opened()
    gait_id = deleted_gait(service)
    appear(tmp_path, gait_id, same=same)
    service = opened() if is_reopened else service
    fresh = service.open_gait(gait_id)
    assert (fresh.gait.name, fresh.revision, fresh.edited) == ("Mine" if same else "Theirs", 1, False)
    assert (fresh.approval, fresh.kept_approval, fresh.revoked) == (None, None, None)
    assert len(fresh.history.entries) == 1
    assert service.versions.all(gait_id).rows == ()
    assert service.approvals.all(gait_id).rows == ()
    assert service.open_gaits.outside(gait_id) is None

    back = service.restore(gait_id)
    assert back.id != gait_id
    assert (back.gait.name, back.gait.options.stop_bound) == ("Edited", 0.9)
    assert back.approval is None
    assert back.revoked is not None
    assert service.versions.all(back.id).rows
    assert len(service.approvals.all(back.id).rows) == 1
    assert service.undo(back.id).gait.options.stop_bound != 0.9
    assert service.open_gait(gait_id).gait == fresh.gait
    assert opened().document(back.id).name == "Edited"


def test_gaits_of_one_name_are_deleted_one_after_the_other_and_all_come_back(
    opened: Opened, tmp_path: Path
) -> None:
    service = opened()
    gait_id = deleted_gait(service)
    for name in ("Second", "Third"):
        appear(tmp_path, gait_id, same=False)
        service.edit(gait_id, replace(service.document(gait_id), name=name), "Name", None)
        service.delete(gait_id)
    assert [one.name for one in service.deleted()] == ["Third", "Second", "Edited"]
    assert service.deleted()[0].id == gait_id
    names = {service.restore(one.id).gait.name for one in service.deleted()}
    assert names == {"Edited", "Second", "Third"}
    with pytest.raises(InputError, match="no deleted gait"):
        service.restore(gait_id)


def test_a_deleted_gait_has_no_state_until_it_is_back(opened: Opened) -> None:
    service = opened()
    gait_id = deleted_gait(service)
    with pytest.raises(NotFoundError):
        service.open_gait(gait_id)
    back = service.restore(gait_id)
    assert (back.id, back.gait.name) == (gait_id, "Edited")


def test_rows_of_an_older_program_are_put_away_at_the_start(
    opened: Opened, tmp_path: Path, database: Database
) -> None:
    gait_id = deleted_gait(opened())
    EditHistoryStore(database).rename(f"{IN_TRASH}{gait_id}", gait_id)
    service = opened()
    appear(tmp_path, gait_id, same=False)
    assert service.document(gait_id).name == "Theirs"
    assert service.restore(gait_id).gait.name == "Edited"


@pytest.mark.parametrize("kind", ["folder", "pipe"])
def test_an_order_of_the_trash_that_is_no_file_holds_nothing_up(
    kind: str, opened: Opened, tmp_path: Path
) -> None:
    opened()
    order = tmp_path / "trash" / ".order"
    order.mkdir() if kind == "folder" else os.mkfifo(order)
    service = opened()
    gait_id = deleted_gait(service)
    assert [one.id for one in opened().deleted()] == [gait_id]
    assert service.restore(gait_id).gait.name == "Edited"


def test_a_gait_that_cannot_be_put_away_is_not_deleted(
    opened: Opened, monkeypatch: pytest.MonkeyPatch
) -> None:
    service = opened()
    gait_id = service.create(replace(WALK, name="Mine")).id
    rename: Callable[..., None] = EditHistoryStore.rename

    def full(store: EditHistoryStore, gait: str, to: str) -> None:
        if gait == gait_id:
            raise StorageFullError("The disk is full.", "studio.sqlite3")
        rename(store, gait, to)

    monkeypatch.setattr(EditHistoryStore, "rename", full)
    with pytest.raises(StorageFullError):
        service.delete(gait_id)
    assert service.deleted() == ()
    assert service.document(gait_id).name == "Mine"
