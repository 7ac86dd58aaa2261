"""The service: edits, undo, saving, approvals that never outlive what they approved."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path

import pytest

from app.documents.gait_json import motion_hash
from app.documents.trajectory_json import trajectory_content
from app.gaits.approvals import ApprovalRequest
from app.gaits.live_plans import FAILED_SECONDS, LivePlans
from app.gaits.service import GaitService
from app.gaits.summaries import GaitSummaries
from app.plans.plan import PlanSource
from app.store.database import Database
from app.store.gait_files import GaitFiles
from app.store.tables.result_store import ResultStore
from core.errors import CheckError, InputError, NotFoundError, StateError
from core.gait.gait import Gait
from core.library.library import library
from solver_jobs import SolveStatus, solve_live
from tests.support.live_tiers import FixedTier

WALK = "walk"
MANUAL = "walk-manual-0"


@pytest.fixture
def service(tmp_path: Path, database: Database) -> GaitService:
    return reopened(tmp_path, database)


def reopened(tmp_path: Path, database: Database) -> GaitService:
    """A service whose live tier finds everything infeasible."""
    tier = FixedTier(SolveStatus.INFEASIBLE)
    return GaitService(GaitFiles(tmp_path), database, LivePlans(tier).solve_for)


def solving(tmp_path: Path, database: Database) -> GaitService:
    """A service with the live tier itself."""
    return GaitService(GaitFiles(tmp_path), database, lambda gait: solve_live)


def toggled(gait: Gait, foot: int, sample: int) -> Gait:
    stance = gait.timeline.stance.copy()
    stance[foot, sample] = not stance[foot, sample]
    return replace(gait, timeline=replace(gait.timeline, stance=stance))


def edit(service: GaitService, gait_id: str, foot: int = 1, sample: int = 20) -> None:
    service.edit(gait_id, toggled(service.open_gait(gait_id).gait, foot, sample), "Toggle", None)


def test_an_edit_is_one_undo_step_that_survives_a_restart(
    service: GaitService, tmp_path: Path, database: Database
) -> None:
    before = service.open_gait(WALK).gait
    edit(service, WALK)
    edit(service, WALK, sample=21)
    again = reopened(tmp_path, database)
    assert again.open_gait(WALK).gait == service.open_gait(WALK).gait
    assert again.open_gait(WALK).undo_label() == "Toggle"
    again.undo(WALK)
    again.undo(WALK)
    assert again.open_gait(WALK).gait == before
    again.redo(WALK)
    again.redo(WALK)
    assert again.open_gait(WALK).gait == service.open_gait(WALK).gait
    with pytest.raises(StateError, match="nothing to redo"):
        again.redo(WALK)


def test_an_edit_after_undo_forgets_what_could_be_redone(service: GaitService) -> None:
    edit(service, WALK)
    service.undo(WALK)
    edit(service, WALK, foot=3)
    assert service.open_gait(WALK).redo_label() is None
    with pytest.raises(StateError, match="nothing to undo"):
        service.undo(service.undo(WALK).id)


def test_a_stale_edit_is_refused_and_nothing_is_lost(service: GaitService) -> None:
    seen = service.open_gait(WALK)
    edit(service, WALK)
    current = service.open_gait(WALK)
    with pytest.raises(StateError, match="changed elsewhere"):
        service.edit(WALK, toggled(seen.gait, 0, 3), "Toggle", seen.revision)
    assert service.open_gait(WALK) is current


def test_saving_writes_a_file_that_another_studio_reads(
    service: GaitService, tmp_path: Path, database: Database
) -> None:
    edit(service, WALK)
    assert service.open_gait(WALK).edited
    saved = service.save(WALK)
    assert not saved.edited
    assert reopened(tmp_path, database).open_gait(WALK).saved == saved.gait
    assert not list(tmp_path.glob("gaits/.*"))


def test_a_deleted_gait_can_be_restored(service: GaitService) -> None:
    created = service.create(replace(library()[WALK].gait, name="My walk"))
    assert created.id == "my-walk"
    assert service.create(created.gait).id == "my-walk-2"
    service.delete(created.id)
    with pytest.raises(NotFoundError):
        service.open_gait(created.id)
    assert service.restore(created.id).gait == created.gait
    with pytest.raises(StateError, match="comes with the program"):
        service.delete(WALK)


def test_deleted_gaits_are_listed_by_their_last_names_until_they_are_back(
    service: GaitService, tmp_path: Path, database: Database
) -> None:
    assert service.deleted() == ()
    began = time.time() - 1
    made = [service.create(replace(library()[WALK].gait, name=name)) for name in ("One", "Two", "Deleted")]
    assert [gait.id for gait in made] == ["one", "two", "deleted-2"]  # /api/gaits/deleted is the list itself
    service.edit("one", replace(made[0].gait, name="First"), "Rename", None)
    for gait in made:
        service.delete(gait.id)
    (tmp_path / "trash" / "broken.json").write_text("{")
    listed = reopened(tmp_path, database).deleted()
    names = {"one": "First", "two": "Two", "deleted-2": "Deleted", "broken": "broken.json"}
    assert {gait.id: gait.name for gait in listed} == names
    assert [gait.id for gait in listed] == ["deleted-2", "two", "one", "broken"]
    assert all(began < gait.when <= time.time() for gait in listed)
    service.restore("two")
    assert "two" not in [gait.id for gait in service.deleted()]


@pytest.mark.parametrize("gait_id", ["nope", "../walk", "", "Walk", "a" * 200])
def test_unknown_ids_are_refused(service: GaitService, gait_id: str) -> None:
    with pytest.raises(InputError):
        service.open_gait(gait_id)


def test_a_damaged_file_is_named_and_the_others_are_listed(service: GaitService, tmp_path: Path) -> None:
    (tmp_path / "gaits" / "broken.json").write_text("{")
    with pytest.raises(InputError, match=r"broken\.json is not JSON"):
        service.open_gait("broken")
    lines = {line["id"]: line["problem"] for line in GaitSummaries(service).lines()}
    assert lines.keys() == {*library(), "broken"}
    assert [gait_id for gait_id, problem in lines.items() if problem] == ["broken"]


def test_drawing_over_a_segment_table_sets_it_aside_until_undo(service: GaitService) -> None:
    edit(service, MANUAL, foot=0, sample=3)
    drawn = service.open_gait(MANUAL)
    assert drawn.gait.segment_table is None
    assert drawn.notice is not None
    assert service.undo(MANUAL).gait.segment_table is not None


def test_turning_a_manual_gait_turns_its_timeline(service: GaitService) -> None:
    gait = service.open_gait(MANUAL).gait
    turned = service.edit(MANUAL, replace(gait, direction=2), "Turn", None)
    assert turned.gait.segment_table is not None
    assert turned.gait.timeline == gait.timeline.turned(1)


def test_a_manual_gait_is_checked_approved_and_the_approval_survives_a_restart(
    service: GaitService, tmp_path: Path, database: Database
) -> None:
    with pytest.raises(StateError, match="Check this gait first"):
        service.approve(MANUAL, ApprovalRequest("Ada", accept_warnings=True))
    service.check(MANUAL)
    approval = service.approve(MANUAL, ApprovalRequest("Ada", accept_warnings=True)).approval
    assert approval is not None
    waypoints = service.plan(MANUAL).waypoints
    assert waypoints is not None
    assert approval.waypoints_hash == waypoints.content_hash
    again = reopened(tmp_path, database)
    again.plan(MANUAL)
    assert again.open_gait(MANUAL).approval == approval


def test_any_edit_takes_the_approval_away_and_undo_does_not_bring_it_back(service: GaitService) -> None:
    service.check(MANUAL)
    service.approve(MANUAL, ApprovalRequest("Ada", accept_warnings=True))
    gait = service.open_gait(MANUAL).gait
    service.edit(MANUAL, replace(gait, step=(0.006, 0.006, 0.0)), "Step", None)
    assert service.open_gait(MANUAL).approval is None
    assert service.open_gait(MANUAL).verdict is None
    assert service.undo(MANUAL).approval is None


def test_a_drawing_is_a_draft_that_cannot_be_approved(service: GaitService) -> None:
    assert service.plan(WALK).source is PlanSource.DRAFT
    service.check(WALK)
    with pytest.raises(StateError, match="only drawn"):
        service.approve(WALK, ApprovalRequest("Ada", accept_warnings=True))


def test_a_gait_that_ends_in_the_air_keeps_its_drawing_and_says_why(service: GaitService) -> None:
    edit(service, WALK, foot=2, sample=44)
    plan = service.plan(WALK)
    assert plan.trajectory is None
    assert plan.refusal is not None
    assert "Foot 3 is in the air at the last sample" in plan.refusal.sentence
    with pytest.raises(CheckError, match="last sample"):
        service.check(WALK)


def test_locked_cells_stay_until_they_are_unlocked(service: GaitService) -> None:
    gait = service.open_gait(WALK).gait
    locked = gait.timeline.locked.copy()
    locked[1, 20] = True
    service.edit(WALK, replace(gait, timeline=replace(gait.timeline, locked=locked)), "Lock", None)
    with pytest.raises(StateError, match="Foot 2, sample 21 is locked"):
        edit(service, WALK)
    with pytest.raises(StateError, match="locked cells"):
        service.redraw(WALK, (1, 2, 3, 4), 6, 5)
    edit(service, WALK, sample=22)


def test_more_iterations_draw_the_timeline_anew(service: GaitService) -> None:
    gait = service.open_gait(WALK).gait
    tripled = service.edit(WALK, replace(gait, iterations=3), "Three iterations", None).gait
    assert tripled.timeline.sample_count == 125
    assert len(tripled.timeline.swings()) == 12


def test_an_approval_is_of_the_verdict_that_was_seen(service: GaitService) -> None:
    service.check(MANUAL)
    with pytest.raises(StateError, match="The verdict has changed"):
        service.approve(MANUAL, ApprovalRequest("Ada", "0" * 64))


def test_a_stored_result_that_the_checker_does_not_confirm_is_a_draft(
    service: GaitService, database: Database
) -> None:
    gait = service.open_gait(WALK).gait
    drawn = service.plan(WALK).trajectory
    assert drawn is not None
    service.edit(WALK, replace(gait, notes="as it is"), "Notes", None)
    ResultStore(database).put(motion_hash(gait), {"trajectory": trajectory_content(drawn)})
    assert service.plan(WALK).source is PlanSource.DRAFT


def test_two_feet_in_the_air_are_named_at_once(service: GaitService) -> None:
    for sample in range(15, 20):
        edit(service, WALK, foot=0, sample=sample)
    plan = service.plan(WALK)
    words = plan.note if plan.refusal is None else plan.refusal.sentence
    assert "Feet 1, 2 are in the air together at samples 16 to 20" in words


def test_a_drawn_gait_is_solved_approved_and_its_approval_survives_a_restart(
    tmp_path: Path, database: Database
) -> None:
    service = solving(tmp_path, database)
    assert service.plan(WALK).source is PlanSource.LIVE
    assert "Live plan" in service.plan(WALK).note
    service.check(WALK)
    approval = service.approve(WALK, ApprovalRequest("Ada", accept_warnings=True)).approval
    assert approval is not None
    again = solving(tmp_path, database)
    assert again.plan(WALK).session_hash == service.plan(WALK).session_hash
    assert again.open_gait(WALK).approval == approval
    # Another answer of the solver for the same document is not what was approved.
    other = reopened(tmp_path, database)
    other.plan(WALK)
    assert other.open_gait(WALK).approval is None


def test_an_edit_takes_the_approval_of_a_live_plan_away(tmp_path: Path, database: Database) -> None:
    service = solving(tmp_path, database)
    service.check(WALK)
    service.approve(WALK, ApprovalRequest("Ada", accept_warnings=True))
    edit(service, WALK, foot=1, sample=20)
    assert service.open_gait(WALK).approval is None
    assert service.open_gait(WALK).verdict is None


def test_an_infeasible_gait_shows_the_nearest_motion_and_what_it_lacks(service: GaitService) -> None:
    plan = service.plan(WALK)
    assert plan.source is PlanSource.DRAFT
    assert plan.trajectory is not None
    assert plan.live is not None
    assert plan.live.result.lacks[0].feet == (2,)


def test_a_live_tier_that_broke_off_is_asked_again_and_the_old_verdict_is_gone(
    tmp_path: Path, database: Database
) -> None:
    tier, now = FixedTier(SolveStatus.FAILED), [0.0]
    service = GaitService(GaitFiles(tmp_path), database, LivePlans(tier, lambda: now[0]).solve_for)
    service.check(WALK)
    service.open_gaits.ask_again(WALK)
    assert service.open_gait(WALK).verdict is not None
    assert tier.asked == 1
    tier.status = SolveStatus.INFEASIBLE
    asked = tier.asked
    now[0] += FAILED_SECONDS
    service.open_gaits.ask_again(WALK)
    service.open_gaits.ask_again(WALK)
    assert tier.asked == asked + 1
    live = service.plan(WALK).live
    assert live is not None
    assert live.status is SolveStatus.INFEASIBLE


def test_what_the_live_tier_says_is_solved_counts_only_if_the_checker_confirms_it(
    tmp_path: Path, database: Database
) -> None:
    tier = FixedTier(SolveStatus.SOLVED)
    service = GaitService(GaitFiles(tmp_path), database, LivePlans(tier).solve_for)
    plan = service.plan(WALK)
    assert plan.source is PlanSource.DRAFT
    assert "the checker found" in plan.note
