"""The record of a run where the database does not take it, and whose runs are still under way."""

from __future__ import annotations

import fcntl
import sqlite3
import threading
from collections.abc import Iterator, Sequence
from contextlib import closing

import pytest

from app.bridge.states import Direction, LinkState, RobotState, Transition
from app.robot import run_recorder
from app.robot.recorded_bridge import RecordedBridge, RecordedRun
from app.robot.run_recorder import RunRecorder
from app.robot.views import RunOrigin
from app.runs.recovery import end_abandoned
from app.runs.service import RunService
from app.store.database import Database
from app.store.run_journal import Entry, EntryKind, RunJournal
from app.store.tables.run_store import RunFilter, RunStore
from app.store.tables.run_writer import RunWriter
from core.errors import StateError
from tests.support import stored_contents
from tests.support.newest_run import newest_run
from tests.support.patience import patient_robot
from tests.support.studio_process import wait_for
from tests.support.virtual_robot import make_plan

RECORD = stored_contents.run("r", state="running", started_monotonic=10.0, gait="walk", ended=None)


class FullDisk(RunWriter):
    """A way into the database that takes nothing as long as the disk is full."""

    def __init__(self, database: Database) -> None:
        super().__init__(database.path, database.files)
        self.is_full = True
        self.refusals = 0

    def write(self, entries: Sequence[tuple[str, Entry]]) -> None:
        if self.is_full:
            self.refusals += 1
            raise sqlite3.OperationalError("database or disk is full")
        super().write(entries)


@pytest.fixture
def writer(database: Database, monkeypatch: pytest.MonkeyPatch) -> FullDisk:
    monkeypatch.setattr(run_recorder, "RETRY_SECONDS", 0.01)
    monkeypatch.setattr(run_recorder, "LAG_SHOWN", 0.0)
    return FullDisk(database)


@pytest.fixture
def told() -> list[str | None]:
    return []


@pytest.fixture
def recorder(database: Database, writer: FullDisk, told: list[str | None]) -> Iterator[RunRecorder]:
    opened = RunRecorder(database, lambda: told.append(opened.trouble), writer)
    yield opened
    opened.close()


def change(number: int) -> Transition:
    return Transition(float(number), LinkState.READY, RobotState.MOVING, f"change {number}", number)


def log_some(recorder: RunRecorder, first: int = 0, count: int = 5) -> None:
    for number in range(first, first + count):
        recorder.log(Direction.FROM_ROBOT, b"%d" % number, 11.0 + number)


def test_what_the_database_does_not_take_is_kept_and_written_when_it_does(
    database: Database, recorder: RunRecorder, writer: FullDisk
) -> None:
    recorder.begin(RECORD)
    log_some(recorder)
    recorder.note([change(1)])
    wait_for(lambda: writer.refusals > 2, "the database was tried again")
    log_some(recorder, first=5)
    recorder.end(RECORD | {"state": "done"})
    writer.is_full = False
    wait_for(lambda: newest_run(database)["state"] == "done", "the record is whole")
    assert [piece.data for piece in RunStore(database).bytes_of("r")] == [b"%d" % n for n in range(10)]
    assert [state.cause for state in RunStore(database).states_of("r")] == ["change 1"]


def test_a_record_that_lags_is_told_of_until_it_has_caught_up(
    recorder: RunRecorder, writer: FullDisk, told: list[str | None]
) -> None:
    recorder.begin(RECORD)
    assert recorder.trouble is None
    log_some(recorder)
    wait_for(lambda: len(told) > 1, "the lag is told of")
    assert "lags by 0 s: the database does not take it (database or disk is full)" in str(told[-1])
    writer.is_full = False
    wait_for(lambda: told[-1] is None, "the end of the lag is told")


def test_where_memory_has_an_end_the_record_says_what_it_lacks(
    database: Database, recorder: RunRecorder, writer: FullDisk, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(run_recorder, "MOST_WAITING", 3 * (run_recorder.ENTRY_OVERHEAD + 1))
    recorder.begin(RECORD)
    log_some(recorder)
    assert "has a hole: 2 bytes" in str(recorder.trouble)
    recorder.end(RECORD | {"state": "done"})
    writer.is_full = False
    wait_for(lambda: newest_run(database)["state"] == "done", "the record is ended")
    assert newest_run(database)["left_out"] == 2
    assert [piece.data for piece in RunStore(database).bytes_of("r")] == [b"0", b"1", b"2"]
    recorder.begin(RECORD | {"id": "next"})
    assert recorder.trouble is None


def test_another_programs_long_write_costs_the_record_nothing(database: Database) -> None:
    recorder = RunRecorder(database)
    recorder.begin(RECORD)
    other = sqlite3.connect(database.path, isolation_level=None)
    other.execute("BEGIN IMMEDIATE")
    log_some(recorder)
    recorder.end(RECORD | {"state": "done"})
    end = threading.Thread(target=recorder.close)
    end.start()
    other.execute("COMMIT")
    other.close()
    end.join()
    assert len(RunStore(database).bytes_of("r")) == 5
    assert newest_run(database)["state"] == "done"


def test_the_end_of_the_program_does_not_wait_for_ever(
    database: Database,
    writer: FullDisk,
    monkeypatch: pytest.MonkeyPatch,
    caplog: pytest.LogCaptureFixture,
) -> None:
    monkeypatch.setattr(run_recorder, "CLOSE_SECONDS", 0.05)
    recorder = RunRecorder(database, writer=writer)
    recorder.begin(RECORD)
    log_some(recorder)
    recorder.close()
    assert journals(database) == ["r.journal"]
    assert "5 pieces of a run's record could not be written." in caplog.text


def test_a_run_whose_record_cannot_be_begun_is_not_sent(database: Database) -> None:
    plan = make_plan([[5.0] * 12])
    origin = RunOrigin("r", "walk", "Walk", plan.waypoints, plan.waypoints.durations)
    with patient_robot(20.0, booted=True) as robot, closing(RecordedBridge(database)) as kept:
        kept.bridge.connect(robot.device)
        wait_for(lambda: kept.bridge.snapshot.robot is RobotState.DISARMED, "the robot is up")
        kept.bridge.arm("Ada")
        with database.writing() as connection:
            connection.execute("DROP TABLE run_plan")
        with pytest.raises(StateError, match=r"record of the run cannot be begun.*no such table"):
            kept.send(plan, RecordedRun(origin, {"robot": "deltawalker"}), "Ada")
        assert kept.bridge.snapshot.robot is RobotState.ARMED
        assert RunStore(database).newest() is None


def journals(database: Database) -> list[str]:
    return sorted(path.name for path in (database.path.parent / "running").iterdir())


def test_what_the_database_never_got_is_completed_from_the_journal_of_a_program_that_is_gone(
    database: Database, writer: FullDisk, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(run_recorder, "CLOSE_SECONDS", 0.0)
    recorder = RunRecorder(database, writer=writer)
    writer.is_full = False
    recorder.begin(RECORD)
    log_some(recorder)
    recorder.note([change(1)])
    wait_for(lambda: len(RunStore(database).states_of("r")) == 1, "the database has the beginning")
    writer.is_full = True
    log_some(recorder, first=5)
    recorder.note([change(2)])
    end_abandoned(database)
    assert newest_run(database)["state"] == "running"  # it lives
    recorder.close()
    end_abandoned(database)
    assert [piece.data for piece in RunStore(database).bytes_of("r")] == [b"%d" % n for n in range(10)]
    assert [state.cause for state in RunStore(database).states_of("r")] == ["change 1", "change 2"]
    assert newest_run(database)["state"] == "interrupted"
    assert journals(database) == []


def test_a_run_whose_end_the_database_never_got_ends_as_it_did(
    database: Database, writer: FullDisk, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(run_recorder, "CLOSE_SECONDS", 0.0)
    recorder = RunRecorder(database, writer=writer)
    recorder.begin(RECORD)
    recorder.end(RECORD | {"state": "done"})
    recorder.close()
    assert journals(database) == ["r.journal"]
    end_abandoned(database)
    assert newest_run(database)["state"] == "done"


@pytest.mark.parametrize("tail", [bytes(40), b"\x07" + b"\x01" * 40, b"\x02" + bytes(12)])
def test_what_a_loss_of_power_left_at_a_journals_end_is_no_entry(database: Database, tail: bytes) -> None:
    RunStore(database).begin(RECORD, None)
    journal = RunJournal(database.path.parent, "r")
    journal.add(Entry(EntryKind.FROM_ROBOT, 11.0, b"j,"))
    journal.close(is_in_database=False)
    with (database.path.parent / "running" / "r.journal").open("ab") as file:
        file.write(tail)
    end_abandoned(database)
    [piece] = RunStore(database).bytes_of("r")
    assert (piece.time, piece.direction, piece.data) == (11.0, "from robot", b"j,")
    assert RunStore(database).running() == ()


def test_an_entry_that_was_cut_off_is_left_out(database: Database) -> None:
    data = database.path.parent
    RunStore(database).put(RECORD)
    journal = RunJournal(data, "r")
    journal.add(Entry(EntryKind.FROM_ROBOT, 11.0, b"whole"))
    journal.add(Entry(EntryKind.FROM_ROBOT, 12.0, b"cut off"))
    journal.close(is_in_database=False)
    path = data / "running" / "r.journal"
    path.write_bytes(path.read_bytes()[:-3])
    end_abandoned(database)
    [piece] = RunStore(database).bytes_of("r")
    assert (piece.time, piece.direction, piece.data) == (11.0, "from robot", b"whole")


@pytest.mark.parametrize(
    "entry",
    [
        Entry(EntryKind.END, 12.0, b"{}"),
        Entry(EntryKind.END, 12.0, b'{"id": "r", "state": 7}'),
        Entry(EntryKind.END, 12.0, b"[" * 100_000),
        Entry(EntryKind.END, 12.0, b'{"id": NaN}'),
        Entry(EntryKind.STATE, 12.0, b"[1, 2]"),
        Entry(EntryKind.STATE, 12.0, b'["a", "b", "\\ud800"]'),
        Entry(EntryKind.STATE, 12.0, b"\xff"),
        Entry(EntryKind.FROM_ROBOT, float("nan"), b"j,"),
    ],
)
def test_a_damaged_entry_of_a_journal_leaves_the_run_interrupted(database: Database, entry: Entry) -> None:
    RunStore(database).begin(RECORD, None)
    journal = RunJournal(database.path.parent, "r")
    journal.add(entry)
    journal.close(is_in_database=False)
    end_abandoned(database)
    row = RunStore(database).get("r")
    assert row is not None
    assert row.content["state"] == "interrupted"
    assert journals(database) == []


@pytest.mark.parametrize("state", [None, "done"])
def test_a_kill_before_the_record_began_or_after_it_was_whole_leaves_no_journal(
    database: Database, state: str | None
) -> None:
    journal = RunJournal(database.path.parent, "r")
    if state is not None:
        RunStore(database).put(RECORD | {"state": state})
    end_abandoned(database)
    assert journals(database) == ["r.journal"]  # its program lives
    journal.close(is_in_database=False)
    end_abandoned(database)
    assert journals(database) == []
    newest = RunStore(database).newest()
    assert (None if newest is None else newest["state"]) == state


def test_a_journal_that_was_taken_for_abandoned_before_it_was_locked_is_made_again(
    database: Database, monkeypatch: pytest.MonkeyPatch
) -> None:
    lock, path = fcntl.flock, database.path.parent / "running" / "r.journal"

    def late(file: int, operation: int) -> None:
        monkeypatch.undo()
        path.unlink()
        lock(file, operation)

    monkeypatch.setattr(fcntl, "flock", late)
    journal = RunJournal(database.path.parent, "r")
    journal.add(Entry(EntryKind.FROM_ROBOT, 11.0, b"j,"))
    assert path.read_bytes().endswith(b"j,")
    journal.close(is_in_database=True)


def test_only_runs_whose_program_is_gone_are_called_interrupted_also_while_the_studio_is_open(
    database: Database,
) -> None:
    more = {"gait_name": "Walk", "waypoints_hash": "", "by": "Ada", "sentence": "", "ended": None}
    for run in ("living", "old"):
        RunStore(database).put(RECORD | more | {"id": run})
    living, service = RunJournal(database.path.parent, "living"), RunService(database)

    def states() -> dict[str, str]:
        return {run["id"]: run["state"] for run in service.found(RunFilter(), 0, 5)["runs"]}

    assert states() == {"living": "running", "old": "interrupted"}
    living.close(is_in_database=False)
    assert states() == {"living": "interrupted", "old": "interrupted"}


def test_a_data_folder_that_takes_no_journal_begins_no_run(database: Database) -> None:
    (database.path.parent / "running").write_text("a file where a folder should be")
    recorder = RunRecorder(database)
    with pytest.raises(StateError, match="record of the run cannot be begun"):
        recorder.begin(RECORD)
    recorder.close()
    assert RunStore(database).newest() is None
