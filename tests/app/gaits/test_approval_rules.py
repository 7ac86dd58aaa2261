"""Approval as a state machine: whatever is done to a gait, only what a person approved reaches the wire."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, rule, run_state_machine_as_test

from app.bridge.bridge import RobotBridge
from app.bridge.run import plan_moves
from app.bridge.states import RunPlan
from app.gaits.approvals import ApprovalRequest
from app.gaits.open_gait import gait_text
from app.gaits.service import GaitService
from app.plans.plan import Plan
from app.robot.ports import RobotPorts
from app.robot.service import RobotService
from app.simulation.problem import simulation_problem
from app.store.database import Database
from app.store.gait_files import GaitFiles
from core.checks.simulation import Simulated
from core.errors import FootfallError, InputError, StateError
from core.gait.gait import Gait
from core.physics.metrics import report
from core.physics.parameters import physics_set
from core.robot.model import RobotModel
from tests.support.simulated_walk import followed, no_solver

GAIT = "walk-manual-0"
MEMORY = Path("/dev/shm") if Path("/dev/shm").is_dir() else None
A_FEW = settings(
    max_examples=12,
    stateful_step_count=30,
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
)


@dataclass(frozen=True)
class Given:
    """What was approved: the waypoints, and the robot's parameters at that time."""

    waypoints: str
    robot: str


class Wire:
    """What a bridge would write, and the robot whose parameters stand."""

    def __init__(self) -> None:
        self.robot = "as built"
        self.messages: list[bytes] = []

    def send(self, plan: RunPlan) -> None:
        self.messages = [move.message for move in plan_moves(plan, tuple(plan.waypoints.strokes_mm[0]))]


class ApprovalMachine(RuleBasedStateMachine):
    """A service that can be opened anew at any time, beside the word that was given last."""

    def __init__(self, robot: RobotService, wire: Wire) -> None:
        super().__init__()
        self.robot, self.wire = robot, wire
        wire.robot = "as built"
        self.folder = tempfile.TemporaryDirectory(dir=MEMORY)
        self.simulated: dict[str, Simulated] = {}
        self.given: Given | None = None
        self.open_service()

    def open_service(self) -> None:
        self.database = Database(Path(self.folder.name) / "studio.sqlite3")
        files = GaitFiles(Path(self.folder.name))
        self.service = GaitService(
            files, self.database, lambda gait: no_solver, simulated_for=self.simulation_of
        )

    def simulation_of(self, plan: Plan) -> Simulated | None:
        return None if plan.waypoints is None else self.simulated.get(plan.waypoints.content_hash)

    def teardown(self) -> None:
        self.database.close()
        self.folder.cleanup()

    @property
    def document(self) -> str:
        return gait_text(self.service.document(GAIT))

    def change(self, verb: Callable[[], object]) -> None:
        """Does something that may change the document, which takes the word back, and visibly so."""
        before, had = self.document, self.service.open_gait(GAIT)
        try:
            verb()
        except (InputError, StateError):
            assert self.document == before
        if self.document == before:
            return
        self.given = None
        now = self.service.open_gait(GAIT)
        assert (now.verdict, now.approval, now.kept_approval) == (None, None, None)
        assert now.revoked or not (had.approval or had.kept_approval)

    def edit(self, gait: Gait) -> None:
        self.change(lambda: self.service.edit(GAIT, gait, "Edit", None))

    def look(self) -> None:
        """Whoever looks at an approval under other parameters takes it away."""
        if self.given is not None and self.given.robot != self.wire.robot:
            self.given = None

    @rule(bound=st.sampled_from([None, 0.9, 1.0]))
    def cut_otherwise(self, bound: float | None) -> None:
        self.edit(self.service.document(GAIT).with_options(stop_bound=bound))

    @rule(words=st.sampled_from(["", "For the ramp.", "For the floor."]))
    def write_notes(self, words: str) -> None:
        self.edit(replace(self.service.document(GAIT), notes=words))

    @rule(name=st.sampled_from(["Walk", "March"]))
    def rename(self, name: str) -> None:
        self.edit(replace(self.service.document(GAIT), name=name))

    @rule()
    def undo(self) -> None:
        self.change(lambda: self.service.undo(GAIT))

    @rule()
    def redo(self) -> None:
        self.change(lambda: self.service.redo(GAIT))

    @rule()
    def save(self) -> None:
        self.change(lambda: self.service.save(GAIT))

    @rule()
    def delete(self) -> None:
        self.change(lambda: self.service.delete(GAIT))

    @rule()
    def bring_back(self) -> None:
        deleted = self.service.deleted()
        self.change(lambda: self.service.restore(GAIT))
        if self.service.deleted() != deleted:
            self.given = None

    @rule(back=st.integers(0, 3))
    def restore_a_version(self, back: int) -> None:
        self.change(
            lambda: self.service.restore_version(GAIT, self.service.versions.newest_number(GAIT) - back)
        )

    @rule()
    def import_a_copy_and_send_it(self) -> None:
        copy = self.service.create(self.service.document(GAIT)).id
        with pytest.raises(StateError, match="is not approved as it is now"):
            self.robot.send(self.service.confirmed(copy), self.service.plan(copy), None, "Ada")

    @rule()
    def restart(self) -> None:
        self.database.close()
        self.open_service()
        self.service.plan(GAIT)
        self.look()

    @rule(parameters=st.sampled_from(["as built", "with longer rods"]))
    def change_the_robots_parameters(self, parameters: str) -> None:
        self.wire.robot = parameters

    @rule()
    def simulate(self) -> None:
        plan = self.service.plan(GAIT)
        assert plan.waypoints is not None
        problem = simulation_problem(plan, physics_set())
        known = plan.waypoints.content_hash
        self.simulated[known] = Simulated(report(problem, followed(problem)), problem)
        before = self.service.open_gait(GAIT).verdict
        self.service.on_simulated(known)
        # The same verdict as before leaves an approval alone.
        if self.service.open_gait(GAIT).verdict is not before:
            self.given = None

    @rule()
    def check(self) -> None:
        self.look()
        assert self.service.check(GAIT).verdict is not None

    @rule(
        accept_warnings=st.sampled_from([True, True, False]),
        seen=st.sampled_from([None, None, "0" * 64]),
        by=st.sampled_from(["Ada", "Ada", " "]),
    )
    def approve(self, accept_warnings: bool, seen: str | None, by: str) -> None:
        try:
            approved = self.service.approve(GAIT, ApprovalRequest(by, seen, accept_warnings))
        except StateError:
            return
        assert (accept_warnings, seen, by) == (True, None, "Ada")
        assert approved.approval is not None
        self.given = Given(approved.approval.waypoints_hash, self.wire.robot)

    @rule()
    def check_and_approve(self) -> None:
        self.check()
        self.approve(True, None, "Ada")
        assert self.given is not None

    @rule(seen=st.sampled_from([None, None, "0" * 64]))
    def send(self, seen: str | None) -> None:
        self.look()
        self.wire.messages = []
        open_gait, plan = self.service.confirmed(GAIT), self.service.plan(GAIT)
        try:
            self.robot.send(open_gait, plan, seen, "Ada")
        except FootfallError:
            assert self.given is None or seen is not None
            assert self.wire.messages == []
            return
        assert self.given is not None
        assert plan.waypoints is not None
        assert plan.waypoints.content_hash == self.given.waypoints
        assert len(self.wire.messages) == plan.waypoints.count

    @invariant()
    def an_approval_stands_only_where_it_was_given(self) -> None:
        approval = self.service.open_gait(GAIT).approval
        if approval is None:
            return
        assert self.given is not None
        assert approval.waypoints_hash == self.given.waypoints
        assert [one.approval for one in self.service.approvals.all(GAIT).rows].count(approval) == 1


def test_nothing_that_was_not_approved_reaches_the_wire(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    wire = Wire()
    monkeypatch.setattr(RobotModel, "parameters_hash", property(lambda model: wire.robot))
    monkeypatch.setattr(RobotBridge, "send", lambda bridge, plan, by, run_id=None: wire.send(plan))
    database = Database(tmp_path / "robot.sqlite3")
    robot = RobotService(database, "emulator", lambda view: None, RobotPorts(tmp_path / "robot.json"))

    class Wired(ApprovalMachine):
        def __init__(self) -> None:
            super().__init__(robot, wire)

    try:
        run_state_machine_as_test(Wired, settings=A_FEW)
    finally:
        robot.close()
        database.close()
