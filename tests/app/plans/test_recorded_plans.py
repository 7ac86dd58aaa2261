"""Recorded motions in documents: planned, checked, approved and exported as they stand, until an edit."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from app.documents.gait_json import gait_content, parse_gait
from app.export.formats import ExportFormat, export
from app.export.import_gait import read_gait
from app.export.source import Exportable, exportable_plan
from app.gaits.approvals import ApprovalRequest
from app.gaits.sequence_documents import PartReference, made_sequence
from app.gaits.service import GaitService
from app.plans.make_plan import make_plan
from app.plans.plan import Plan, PlanSource, verdict_of
from app.store.database import Database
from app.store.gait_files import GaitFiles
from app.undo.history import Author
from core.errors import InputError, StateError
from core.findings import Severity
from core.gait.gait import Gait, Orientation, motion_problem
from core.gait.motion_source import MotionSource, motion_source
from core.library.library import library
from core.motion.contact_timeline import timeline_from_order
from core.motion.trajectory import Trajectory
from core.problem.motion_problem import MotionProblem
from core.robot.model import load_robot
from core.wire.trajectory_csv import format_companion, format_trajectory_csv, parse_trajectory_csv
from core.wire.waypoint_path import waypoints_from_trajectory
from core.wire.waypoints import format_waypoint_csv
from solver_jobs import MotionResult, solve_live
from tests.app.documents.test_gait_json import PROVENANCE
from tests.support.beyond_range import lowered, recorded_gait
from tests.support.reference import reference_path

MODEL = load_robot("deltawalker")


def no_solver(problem: MotionProblem) -> MotionResult:
    raise AssertionError(f"a recorded motion of {problem.model.name} needs no solver")


@pytest.fixture(scope="module")
def motion() -> Trajectory:
    return solve_live(motion_problem(library()["walk"].gait, MODEL)).trajectory


@pytest.fixture(scope="module")
def recorded(motion: Trajectory) -> Gait:
    text = format_trajectory_csv(motion)
    return read_gait(text, "mine.csv", companion=format_companion(motion, text)).gait


@pytest.fixture
def service(tmp_path: Path) -> Iterator[GaitService]:
    database = Database(tmp_path / "studio.sqlite3")
    yield GaitService(GaitFiles(tmp_path), database, lambda gait: solve_live, lambda: frozenset("ab"))
    database.close()


def planned(gait: Gait) -> Plan:
    return make_plan(gait, None, no_solver)


def exportable(gait: Gait) -> Exportable:
    return exportable_plan("mine", gait, planned(gait))


def test_the_plan_is_the_recorded_motion_to_the_last_bit(recorded: Gait, motion: Trajectory) -> None:
    plan = planned(parse_gait(json.dumps(gait_content(recorded))))
    assert plan.trajectory is not None
    assert plan.source is PlanSource.RECORDED
    assert plan.note == "The recorded motion of mine.csv, as it stands."
    assert plan.trajectory.feet_world.tobytes() == motion.feet_world.tobytes()
    assert plan.trajectory.body_world.tobytes() == motion.body_world.tobytes()
    assert motion_source(recorded) is MotionSource.RECORDED


def test_the_gait_is_described_as_the_one_that_moved_so(recorded: Gait) -> None:
    walk = library()["walk"].gait
    assert recorded.order == walk.order
    assert recorded.timeline == walk.timeline
    assert recorded.step == pytest.approx(walk.step, abs=1e-5)
    assert motion_source(replace(recorded, recorded=None)) is MotionSource.OPTIMISED


def test_it_is_checked_approved_and_kept_over_a_restart(
    service: GaitService, recorded: Gait, tmp_path: Path
) -> None:
    gait_id = service.create(recorded).id
    verdict = service.check(gait_id).verdict
    assert verdict is not None
    assert verdict.passed
    service.approve(gait_id, ApprovalRequest("Ada", accept_warnings=True))
    database = Database(tmp_path / "studio.sqlite3")
    again = GaitService(GaitFiles(tmp_path), database, lambda gait: no_solver)
    assert again.plan(gait_id).session_hash == service.plan(gait_id).session_hash
    assert again.open_gait(gait_id).approval is not None
    database.close()


def _longer(gait: Gait) -> Gait:
    return replace(gait, step=(0.008, 0.008, 0.0))


def _slower(gait: Gait) -> Gait:
    return replace(gait, timeline=replace(gait.timeline, sample_time=0.5))


def _another_swing(gait: Gait) -> Gait:
    stance = gait.timeline.stance.copy()
    stance[2, 10] = False
    return replace(gait, timeline=replace(gait.timeline, stance=stance))


def _longer_timeline(gait: Gait) -> Gait:
    stance = np.concatenate([gait.timeline.stance, gait.timeline.stance[:, -1:]], axis=1)
    return replace(gait, timeline=replace(gait.timeline, stance=stance, locked=~stance & False))


EDITS: list[Callable[[Gait], Gait]] = [
    _longer,
    _slower,
    _another_swing,
    _longer_timeline,
    lambda gait: replace(gait, direction=2),
    lambda gait: replace(gait, iterations=2),
    lambda gait: gait.with_options(clearance=0.004),
]


@pytest.mark.parametrize("change", EDITS)
def test_an_edit_that_asks_for_another_motion_sets_it_aside_and_undo_brings_it_back(
    change: Callable[[Gait], Gait], service: GaitService, recorded: Gait
) -> None:
    gait_id = service.create(recorded).id
    service.check(gait_id)
    service.approve(gait_id, ApprovalRequest("Ada", accept_warnings=True))
    edited = service.edit(gait_id, change(recorded), "Edit", None)
    assert edited.gait.recorded is None
    assert edited.notice is not None
    assert edited.notice.startswith(
        "The recorded motion of mine.csv was set aside; the motion is computed now"
    )
    assert edited.approval is None
    assert service.plan(gait_id).source is not PlanSource.RECORDED
    assert service.undo(gait_id).gait == recorded
    assert service.plan(gait_id).source is PlanSource.RECORDED


def _locked(gait: Gait) -> Gait:
    return replace(gait, timeline=replace(gait.timeline, locked=~gait.timeline.stance))


@pytest.mark.parametrize(
    "change",
    [
        lambda gait: replace(gait, name="Another", notes="words"),
        lambda gait: replace(gait, orientation=Orientation.FBS),
        _locked,
    ],
)
def test_words_orientation_and_locks_leave_it_alone(
    change: Callable[[Gait], Gait], service: GaitService, recorded: Gait
) -> None:
    gait_id = service.create(recorded).id
    edited = service.edit(gait_id, change(recorded), "Edit", None)
    assert (edited.gait.recorded, edited.notice) == (recorded.recorded, None)
    assert service.plan(gait_id).source is PlanSource.RECORDED


def _options(gait: Gait) -> Gait:
    return gait.with_options(clearance=0.004)


def _words(gait: Gait) -> Gait:
    return replace(gait, notes="words")


@pytest.mark.parametrize(("others", "fits"), [(_options, False), (_words, True)])
def test_undo_brings_a_recorded_motion_back_only_where_the_gait_still_asks_for_it(
    others: Callable[[Gait], Gait], fits: bool, service: GaitService, recorded: Gait
) -> None:
    gait_id = service.create(recorded).id
    service.edit(gait_id, replace(recorded, recorded=None), "Compute", None, Author("a"))
    service.edit(gait_id, others(service.document(gait_id)), "Other", None, Author("b"))
    if fits:
        assert service.undo(gait_id, Author("a")).gait.recorded == recorded.recorded
        return
    with pytest.raises(StateError, match=r"recorded motion of mine\.csv is not what the gait would ask for"):
        service.undo(gait_id, Author("a"))
    assert service.document(gait_id).recorded is None


@pytest.mark.parametrize("change", [_another_swing, _slower, _longer_timeline])
def test_a_document_whose_timeline_says_another_motion_has_no_plan(
    change: Callable[[Gait], Gait], recorded: Gait
) -> None:
    plan = planned(change(recorded))
    assert (plan.source, plan.trajectory) == (PlanSource.DRAFT, None)
    assert "is not that of the recorded motion of mine.csv. Import the file again" in plan.note


def test_another_step_than_the_recorded_one_fails_the_check(recorded: Gait) -> None:
    verdict = verdict_of(planned(_longer(recorded)), _longer(recorded))
    assert [f.rule for f in verdict.findings if f.severity is Severity.ERROR] == ["travel"]


def test_csv_and_companion_are_written_again_to_the_last_byte(recorded: Gait) -> None:
    assert recorded.recorded is not None
    source = exportable(parse_gait(json.dumps(gait_content(recorded))))
    assert export(source, ExportFormat.CSV).content.decode() == recorded.recorded.text
    assert export(source, ExportFormat.COMPANION).content.decode() == recorded.recorded.companion


@pytest.mark.parametrize("name", ["direction1/walk_e", "direction3/adjs_c", "rotation/rots_b"])
def test_a_published_file_is_written_again_to_the_last_byte_and_no_companion_is_made_up(name: str) -> None:
    content = reference_path(f"trajectories/{name}.csv").read_bytes()
    source = exportable(read_gait(content.decode(), "lab.csv").gait)
    assert export(source, ExportFormat.CSV).content == content
    with pytest.raises(InputError, match="came without a companion"):
        export(source, ExportFormat.COMPANION)


@pytest.mark.parametrize("edit", [lambda t: "\ufeff" + t, lambda t: t.replace("\n", "\r\n")])
def test_marks_and_line_ends_of_other_systems_stay_and_the_companion_still_belongs(
    edit: Callable[[str], str], motion: Trajectory
) -> None:
    text = format_trajectory_csv(motion)
    described = read_gait(edit(text), "mine.csv", companion=format_companion(motion, text))
    assert not any("assumed" in remark for remark in described.remarks)
    assert export(exportable(described.gait), ExportFormat.CSV).content.decode() == edit(text)


def test_waypoints_become_a_gait_that_sends_the_same_strokes(motion: Trajectory) -> None:
    text = format_waypoint_csv(waypoints_from_trajectory(MODEL, motion))
    described = read_gait(text, "way.csv")
    plan = planned(described.gait)
    assert described.gait.name == "way"
    assert described.remarks[0].startswith("The waypoints of way.csv are kept as they stand")
    assert plan.source is PlanSource.RECORDED
    assert plan.note.startswith("The waypoints of way.csv; standing feet slide up to 0.0 mm.")
    assert verdict_of(plan, described.gait).passed
    source = exportable(described.gait)
    assert export(source, ExportFormat.WAYPOINTS).content.decode() == text
    again = read_gait(
        export(source, ExportFormat.CSV).content.decode(),
        "again.csv",
        companion=export(source, ExportFormat.COMPANION).content.decode(),
    )
    assert planned(again.gait).session_hash == plan.session_hash


def test_a_ring_of_six_modules_is_recorded_and_sent_as_well() -> None:
    model = load_robot("hexapod")
    order = (1, 4, 2, 5, 3, 6)
    timeline = timeline_from_order(6, order)
    gait = Gait("Six", "hexapod", Orientation.FBS, 1, order, (0.01, 0.0, 0.0), 1, timeline)
    motion = solve_live(motion_problem(gait, model)).trajectory
    text, way = format_trajectory_csv(motion), format_waypoint_csv(waypoints_from_trajectory(model, motion))
    for described in (
        read_gait(text, "six.csv", companion=format_companion(motion, text)),
        read_gait(way, "way.csv"),
    ):
        assert (described.gait.robot, described.gait.order) == ("hexapod", order)
        plan = planned(described.gait)
        assert verdict_of(plan, described.gait).passed
        assert plan.waypoints is not None
        assert format_waypoint_csv(plan.waypoints) == way


def test_a_file_that_would_make_too_large_a_document_is_refused(motion: Trajectory) -> None:
    text = format_trajectory_csv(motion)
    with pytest.raises(
        InputError, match=r"long.csv would make a gait document of 20\d\d kB; at most 2000 kB"
    ):
        read_gait(text, "long.csv", companion=format_companion(motion, text) + " " * 2_000_000)


def test_a_trajectory_that_is_not_in_the_worlds_frame_is_refused(motion: Trajectory) -> None:
    flat = replace(motion, body_world=motion.body_world * [1.0, 1.0, 0.0])
    with pytest.raises(InputError, match=r"flat.csv: the body's height is 0 throughout"):
        read_gait(format_trajectory_csv(flat), "flat.csv")


def test_a_sequence_that_begins_with_a_recorded_motion_is_exported_whole(
    service: GaitService, recorded: Gait, motion: Trajectory
) -> None:
    mine = service.create(replace(recorded, provenance=PROVENANCE))
    tour = service.create(made_sequence("Tour", [PartReference(mine.id, 2)], service.document)).gait
    assert (tour.recorded, tour.provenance, motion_source(tour)) == (None, None, MotionSource.SEQUENCE)
    older = replace(tour, recorded=recorded.recorded)
    assert motion_source(older) is MotionSource.SEQUENCE
    for gait in (tour, older):
        plan = service.open_gaits.planned(gait)
        text = export(exportable_plan("tour", gait, plan), ExportFormat.CSV).content.decode()
        assert plan.trajectory is not None
        assert text == format_trajectory_csv(plan.trajectory)
        read = parse_trajectory_csv(text, "tour.csv").trajectory
        assert read.knot_count == 2 * motion.knot_count - 1


def test_a_recorded_motion_comes_back_only_to_its_own_timeline(service: GaitService, recorded: Gait) -> None:
    ada, bo = Author("a"), Author("b")
    mine = service.create(recorded).id
    slower = replace(recorded, options=replace(recorded.options, clearance=0.002))
    assert service.edit(mine, slower, "Clearance", None, ada).gait.recorded is None
    longer = replace(service.document(mine), iterations=2)
    service.edit(mine, longer, "Iterations", None, bo)
    with pytest.raises(StateError, match="does not fit what others changed since: The timeline"):
        service.undo(mine, ada)
    service.undo(mine, bo)
    assert service.undo(mine, ada).gait == service.open_gait(mine).saved


def test_a_motion_that_is_refused_for_the_least_excess_does_not_pass_the_check() -> None:
    motion = lowered(0.0)
    lowest = float(motion.strokes(load_robot("deltawalker")).min())
    gait = recorded_gait(lowest - load_robot("deltawalker").stroke.lower + 5e-7)
    plan = planned(gait)
    assert plan.is_out_of_range
    assert "stroke" in {finding.rule for finding in verdict_of(plan, gait).errors}
