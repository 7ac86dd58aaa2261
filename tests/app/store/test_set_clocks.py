"""Records while the wall clock is set: ends, the order of lists, what is purged, and backups."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest

from app.bridge.states import LinkState, MotorTestProgress, MotorTestState, RobotState, Transition
from app.jobs.job_tracker import JobTracker
from app.jobs.repository import JobRepository
from app.robot.motor_test_service import MotorTestService
from app.robot.recorded_bridge import RecordedBridge, RecordedRun
from app.robot.transition_times import TransitionTimes
from app.robot.views import RunOrigin
from app.store.backups import DAILY, MOST, found_backups, make_backup
from app.store.database import Database
from app.store.folder_time import FILE, FolderTime
from app.store.gait_files import GaitFiles
from app.store.tables.job_store import JobStore
from app.store.tables.learning_store import LearningStore
from app.store.tables.result_store import ResultStore
from app.store.tables.run_store import RunFilter, RunStore
from app.store.tables.simulation_store import SimulationRow, SimulationStore
from app.store.tables.trial_store import TrialStore
from app.store.tables.video_store import VideoStore
from app.studio.database_keeper import DAY_SECONDS, DatabaseKeeper
from app.videos.service import MOST_DELETED, VideoService
from app.vision.services import VisionServices
from core.library.library import library
from tests.support import stored_contents as stored
from tests.support.newest_run import newest_run
from tests.support.patience import patient_robot
from tests.support.set_clock import SetClock
from tests.support.studio_process import wait_for
from tests.support.virtual_robot import make_plan

HOURS_2, TO_1970, TO_2099 = 7200.0, -1.7e9, 2.3e9
STEPS = [-HOURS_2, HOURS_2, TO_1970, TO_2099, -1.0]


@pytest.fixture
def clock() -> SetClock:
    return SetClock()


@pytest.fixture
def database(tmp_path: Path, clock: SetClock) -> Iterator[Database]:
    with closing(Database(tmp_path / "studio.sqlite3", clock)) as opened:
        yield opened


@pytest.mark.parametrize("step", STEPS)
def test_a_run_ends_as_much_later_than_it_began_as_a_watch_counts(
    step: float, database: Database, clock: SetClock
) -> None:
    plan = make_plan([[5.0] * 12])
    origin = RunOrigin("r", "walk", "Walk", plan.waypoints, plan.waypoints.durations)
    with patient_robot(20.0, booted=True) as robot, closing(RecordedBridge(database)) as kept:
        kept.bridge.connect(robot.device)
        wait_for(lambda: kept.bridge.snapshot.robot is RobotState.DISARMED, "the robot is up")
        kept.bridge.arm("Ada")
        kept.send(plan, RecordedRun(origin, None), "Ada")
        clock.pass_seconds(3.5)
        clock.step(step)
        wait_for(lambda: bool(newest_run(database)["ended"]), "the run has ended")
    record = newest_run(database)
    assert record["ended"] == record["started"] + 3.5


@pytest.mark.parametrize("step", STEPS)
def test_a_job_ends_as_much_later_than_it_began_as_a_watch_counts(
    step: float, database: Database, clock: SetClock
) -> None:
    repository = JobRepository(database)
    tracker = JobTracker(repository, lambda act: act(), lambda job: None, "Works.")
    created = repository.begin("job", "track", "walk", "Walk", "")["created"]
    tracker.begin("job", None)  # type: ignore[arg-type]
    clock.pass_seconds(2.0)
    clock.step(step)
    tracker.teller("job")(0.5)
    clock.pass_seconds(4.0)
    tracker.end("job", {"state": "done", "sentence": "Done."})
    job = repository.content("job")
    assert (job["started"], job["ended"]) == (created + 2.0, created + 6.0)


@pytest.mark.parametrize("step", STEPS)
def test_a_job_of_a_studio_that_was_killed_ends_not_before_it_began(
    step: float, database: Database, clock: SetClock
) -> None:
    created = JobRepository(database).begin("job", "track", "walk", "Walk", "")["created"]
    clock.step(step)
    job = JobRepository(database).content("job")
    assert job["state"] == "interrupted"
    assert job["ended"] == max(created, clock.wall())


@pytest.mark.parametrize("step", STEPS)
def test_jobs_have_the_newest_first_also_after_the_studio_was_started_again(
    step: float, database: Database, clock: SetClock
) -> None:
    first = JobRepository(database)
    for key in "ab":
        first.begin(key, "track", "walk", "Walk", "")
        clock.step(step)
    again = JobRepository(database)
    again.begin("c", "track", "walk", "Walk", "")
    jobs = again.contents()
    assert [job["id"] for job in jobs] == ["c", "b", "a"]
    assert jobs[0]["number"] > jobs[1]["number"] > jobs[2]["number"] > 0


def put_run(database: Database, key: str, made: float) -> None:
    RunStore(database).begin(stored.run(key, made), None)


def put_simulation(database: Database, key: str, made: float) -> None:
    SimulationStore(database).put(
        SimulationRow("walk", key, "w", "usual", made), stored.simulation(key, made)
    )


def put_learning(database: Database, key: str, made: float) -> None:
    store = LearningStore(database)
    for state in ("running", "done"):
        store.put(stored.learning(key, made, state))


def put_job(database: Database, key: str, made: float) -> None:
    for state in ("queued", "done"):
        JobStore(database).put(stored.job(key, made, state))


def put_trial(database: Database, key: str, made: float) -> None:
    TrialStore(database).add(stored.trial(key, made), "")


def put_video(database: Database, key: str, made: float) -> None:
    VideoStore(database).put(stored.video(key, made))


LISTS: list[tuple[Callable[[Database, str, float], None], Callable[[Database], list[str]]]] = [
    (put_run, lambda database: [row.id for row in RunStore(database).listed(RunFilter(), 0, 9).rows]),
    (put_job, lambda database: [row.id for row in JobStore(database).newest(9).rows]),
    (put_learning, lambda database: [row.id for row in LearningStore(database).newest(9).rows]),
    (put_simulation, lambda database: [row.key for row in SimulationStore(database).of_gait("walk")]),
    (put_trial, lambda database: [row.id for row in TrialStore(database).listed(lambda row: row).rows]),
    (put_video, lambda database: [row.id for row in VideoStore(database).listed().rows]),
]


@pytest.mark.parametrize(("put", "listed"), LISTS)
def test_lists_have_the_newest_first_whatever_the_clock_was_set_to(
    put: Callable[[Database, str, float], None], listed: Callable[[Database], list[str]], database: Database
) -> None:
    for key, made in zip("abcdef", (1.8e9, 1.8e9 - HOURS_2, 4.1e9, 5.0, 1.8e9, 1.8e9), strict=True):
        put(database, key, made)
    assert listed(database) == list("fedcba")


@pytest.mark.parametrize("step", STEPS)
def test_a_deleted_video_stays_for_its_days_whatever_the_clock_is_set_to(
    step: float, tmp_path: Path, database: Database, clock: SetClock, vision: VisionServices
) -> None:
    service = VideoService(tmp_path, database, vision)
    content = service.begin_recording("Walk", "run", "under")
    service.change(content["id"], state="kept")
    service.delete(content["id"])
    clock.step(step)
    clock.pass_seconds(MOST_DELETED - 1.0)
    service.tidy()
    assert service.view(content["id"])["state"] == "kept"
    clock.pass_seconds(2.0)
    service.tidy()
    assert service.view(content["id"])["state"] == "removed"


@pytest.mark.parametrize(
    ("away", "counted"),
    [
        (0.0, 0.0),
        (3600.0, 3600.0),
        (-HOURS_2, 0.0),
        (TO_1970, 0.0),
        (TO_2099, DAY_SECONDS),
        (8e5, DAY_SECONDS),
    ],
)
def test_a_folders_time_counts_time_away_as_a_day_at_most(
    away: float, counted: float, tmp_path: Path, clock: SetClock
) -> None:
    time = FolderTime(tmp_path, clock)
    clock.pass_seconds(100.0)
    before = time.now
    time.keep()
    clock.step(away)
    assert FolderTime(tmp_path, clock).now == before + counted


@pytest.mark.parametrize("text", ["", "{", "[]", '{"time": "x", "wall": 1, "backup": null}', "null"])
def test_a_damaged_file_of_a_folders_time_begins_it_anew(text: str, tmp_path: Path, clock: SetClock) -> None:
    (tmp_path / FILE).write_text(text)
    assert FolderTime(tmp_path, clock).now == clock.wall()


@pytest.mark.parametrize("step", STEPS)
def test_backups_are_made_once_a_day_whatever_the_clock_is_set_to(
    step: float, database: Database, clock: SetClock
) -> None:
    keeper = DatabaseKeeper(database, lambda view: None, lambda: True)
    for _ in range(2):
        keeper.look()
    assert len(found_backups(database.path.parent)) == 1
    clock.step(step)
    ResultStore(database).put("x", {})
    keeper.look()
    assert len(found_backups(database.path.parent)) == 1
    clock.pass_seconds(DAY_SECONDS)
    keeper.look()
    assert len(found_backups(database.path.parent)) == 2


def test_the_newest_backups_are_kept_though_older_ones_are_from_2099(database: Database) -> None:
    for _ in range(MOST[DAILY]):
        os.utime(make_backup(database.path, DAILY).path, (4.1e9, 4.1e9))
    newest = make_backup(database.path, DAILY)
    kept = found_backups(database.path.parent)
    assert (len(kept), kept[0].path) == (MOST[DAILY], newest.path)


@pytest.mark.parametrize("step", STEPS)
def test_the_robots_log_keeps_the_times_that_it_had(step: float, clock: SetClock) -> None:
    times = TransitionTimes(clock)
    changes = [Transition(clock.boot(), LinkState.READY, RobotState.DISARMED, "It is up.", 1)]
    (first,) = times.of(changes)
    clock.pass_seconds(5.0)
    clock.step(step)
    changes.append(Transition(clock.boot() - 1.0, LinkState.READY, RobotState.ARMED, "Armed.", 2))
    assert times.of(changes) == pytest.approx([first, first + 4.0])
    assert times.of(changes[1:]) == pytest.approx([first + 4.0])
    changes.append(Transition(clock.boot(), LinkState.CONNECTING, RobotState.UNKNOWN, "Opened.", 3))
    assert times.of(changes)[-1] == pytest.approx(clock.wall())


class BridgeWithTest:
    """A bridge with a motor test."""

    def __init__(self) -> None:
        self.tell: Callable[[Any], None] = lambda snapshot: None

    def subscribe(self, tell: Callable[[Any], None]) -> None:
        self.tell = tell


@pytest.mark.parametrize("step", STEPS)
def test_a_motor_test_ends_as_much_later_than_it_began_as_a_watch_counts(
    step: float, clock: SetClock
) -> None:
    shown: list[Any] = []
    bridge = BridgeWithTest()
    MotorTestService(bridge, shown.append, clock)  # type: ignore[arg-type]
    for state in (MotorTestState.RUNNING, MotorTestState.DONE):
        test = MotorTestProgress("Ada", state, None, (), 0.0)
        bridge.tell(type("Snapshot", (), {"motor_test": test}))
        clock.pass_seconds(40.0)
        clock.step(step)
    assert shown[1]["at"] == shown[0]["at"] + 40.0


def test_deleted_gaits_have_the_last_one_first(tmp_path: Path) -> None:
    files = GaitFiles(tmp_path)
    for gait_id in ("a", "b", "c", "d", "e"):
        files.write(gait_id, library()["walk"].gait)
    for gait_id in ("c", "a", "e", "b"):
        files.remove(gait_id)
    assert files.deleted_ids() == ("b", "e", "a", "c")
    files.restore("e", "e")
    files.remove("e")
    assert files.deleted_ids() == ("e", "b", "a", "c")
    assert files.ids() == ("d",)
