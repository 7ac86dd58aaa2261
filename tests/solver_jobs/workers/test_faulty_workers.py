"""A worker that hangs, dies or sends junk ends its task with a sentence; the next task has a new worker."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from app.cameras import process as camera_process
from app.cameras.address import CameraAddress
from app.cameras.process import CameraError, CameraProcess
from app.vision.services import VisionTask, open_vision_services
from core.errors import FootfallError, SimulationCancelledError, StateError
from core.problem.motion_problem import Workspace
from solver_jobs import (
    BatchSimulator,
    ChunkWorker,
    JobQueue,
    JobState,
    LiveSolver,
    PatternSolver,
    PhysicsWorker,
    PoseGaitSolver,
    Simulator,
    SolveStatus,
    Task,
    TaskService,
)
from solver_jobs.workers import job_thread, live_service, pattern_service, task_service
from solver_jobs.workers.pattern_service import PatternSearch
from solver_jobs.workers.pattern_worker import Find
from solver_jobs.workers.pose_service import PoseSearch
from solver_jobs.workers.simulation_service import Simulation
from solver_jobs.workers.worker_process import WorkerProcess
from tests.support.solvers import faulty_workers
from tests.support.solvers.cases import gait_problem
from tests.support.solvers.errands import AskedErrand, Errands, HastyErrand, run_errands, seven
from tests.support.solvers.faulty_workers import ENDING, HANGING, Body, stops
from tests.support.studio_process import wait_for

PATIENCE = 60.0
LARGE = 2_000_000
"""Bytes of a task that no pipe takes at once."""


def spoil(worker: WorkerProcess, body: Body, mark: Path) -> None:
    worker._body, worker._warm_up = body, str(mark)


class LargeErrand(HastyErrand):
    """One that fills the pipe."""

    def __init__(self) -> None:
        task: Any = LargeTask()
        super().__init__(task)


class LargeTask:
    """A task of many bytes."""

    def __init__(self) -> None:
        self.content = b"x" * LARGE


def is_alive(process: int | None) -> bool:
    try:
        os.kill(process or 0, 0)
    except ProcessLookupError:
        return False
    return True


@pytest.fixture
def errands(tmp_path: Path) -> Any:
    service = Errands()
    yield service
    service.close()


def works(errands: Errands) -> bool:
    spoil(errands._worker, run_errands, Path())
    errands._worker.kill()
    return errands.ask(AskedErrand(seven)).result(PATIENCE) == 7


@pytest.mark.parametrize(
    "body", [pytest.param(body, marks=() if body is stops else pytest.mark.heavy) for body in HANGING]
)
def test_a_worker_that_hangs_is_ended_after_its_silence(
    errands: Errands, body: Body, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    spoil(errands._worker, body, tmp_path / "mark")
    errand = errands.ask(LargeErrand())
    wait_for((tmp_path / "mark").exists, "the worker hangs")
    process = errands.process_id
    monkeypatch.setattr(task_service, "SILENCE_SECONDS", 0.1)
    with pytest.raises(StateError, match=r"errand runner gave no sign of life for \d+ s and was ended\. Try"):
        errand.result(PATIENCE)
    monkeypatch.undo()
    assert not is_alive(process)
    assert works(errands)


@pytest.mark.heavy
@pytest.mark.parametrize("body", HANGING)
def test_a_task_of_a_worker_that_hangs_is_cancelled_at_once(
    errands: Errands, body: Body, tmp_path: Path
) -> None:
    spoil(errands._worker, body, tmp_path / "mark")
    errand = errands.ask(LargeErrand())
    wait_for((tmp_path / "mark").exists, "the worker hangs")
    errand.cancel()
    assert errand.result(PATIENCE) == -1
    assert works(errands)


@pytest.mark.heavy
@pytest.mark.parametrize("body", ENDING)
def test_a_worker_that_ends_or_sends_junk_is_replaced_once(
    errands: Errands, body: Body, tmp_path: Path
) -> None:
    spoil(errands._worker, body, tmp_path / "mark")
    with pytest.raises(StateError, match=r"errand runner's process ended twice \(.*\)\. Try again"):
        errands.ask(LargeErrand()).result(PATIENCE)
    assert works(errands)


def test_a_studio_closes_beside_a_worker_that_is_stopped(tmp_path: Path) -> None:
    service = Errands()
    spoil(service._worker, faulty_workers.reads_nothing, tmp_path / "mark")
    errand = service.ask(LargeErrand())
    wait_for((tmp_path / "mark").exists, "the worker hangs")
    process = service.process_id
    service.close()
    assert not is_alive(process)
    with pytest.raises(StateError, match="closing"):
        errand.result(PATIENCE)


Make = Callable[[], tuple[TaskService[Any], Task[Any, Any, Any]]]


def vision(name: str) -> tuple[TaskService[Any], Task[Any, Any, Any]]:
    return getattr(open_vision_services(), name), VisionTask(LargeTask())  # type: ignore[arg-type]


def kinds() -> dict[str, Make]:
    from solver_jobs.workers.atlas_physics_service import PhysicsRun
    from solver_jobs.workers.atlas_service import ChunkRun
    from solver_jobs.workers.batch_simulation_service import BatchSimulation

    def told(known: object) -> None:
        del known

    task: Any = LargeTask()
    return {
        "pattern solver": lambda: (PatternSolver(), PatternSearch(Find(task, 1, 0.0), told)),
        "pose gait solver": lambda: (PoseGaitSolver(), PoseSearch(task, told)),
        "simulator": lambda: (Simulator(), Simulation(task, told)),
        "simulator of gaits": lambda: (BatchSimulator(), BatchSimulation(task, told)),
        "worker of the atlas": lambda: (ChunkWorker(), ChunkRun(task, told)),
        "idle worker of the atlas": lambda: (ChunkWorker(is_idle=True), ChunkRun(task, told)),
        "simulator of the atlas": lambda: (PhysicsWorker(), PhysicsRun(task, told)),
        "picture reader": lambda: vision("interactive"),
        "checkerboard finder": lambda: vision("checkerboards"),
        "video tracker": lambda: vision("tracker"),
    }


@pytest.mark.heavy
@pytest.mark.parametrize("name", kinds())
def test_every_kind_of_work_says_what_hung_and_what_to_do(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    service, task = kinds()[name]()
    spoil(service._worker, faulty_workers.stops, tmp_path / "mark")
    try:
        service.ask(task)
        wait_for((tmp_path / "mark").exists, "the worker hangs")
        process = service.process_id
        monkeypatch.setattr(task_service, "SILENCE_SECONDS", 0.1)
        monkeypatch.setattr(pattern_service, "EXPLAIN_SECONDS", 0.1)
        try:
            result = task.result(PATIENCE)
        except FootfallError as error:
            sentence = error.sentence
        else:
            assert result.status is SolveStatus.FAILED
            (sentence,) = result.explanation
        assert f"The {name.removeprefix('idle ')} gave no sign of life for" in sentence
        assert sentence.endswith(("again.", "again to go on."))
        assert not is_alive(process)
    finally:
        service.close()


@pytest.mark.heavy
@pytest.mark.parametrize("name", kinds())
def test_every_kind_of_work_is_cancelled_though_its_worker_hangs(name: str, tmp_path: Path) -> None:
    service, task = kinds()[name]()
    spoil(service._worker, faulty_workers.stops, tmp_path / "mark")
    try:
        service.ask(task)
        wait_for((tmp_path / "mark").exists, "the worker hangs")
        task.cancel()
        try:
            sentence = task.result(PATIENCE).status.value
        except (StateError, SimulationCancelledError) as error:
            sentence = error.sentence
        assert "gave no sign" not in sentence
        assert "cancelled" in sentence or "was ended" in sentence
    finally:
        service.close()


@pytest.mark.heavy
@pytest.mark.parametrize("body", [*HANGING, *ENDING])
def test_a_job_of_a_solver_that_fails_ends_as_failed(
    body: Body, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(job_thread, "SILENCE_SECONDS", 0.0)
    with JobQueue(starts_ahead=False) as jobs:
        thread = jobs._threads[0]
        spoil(thread.worker, body, tmp_path / "mark")
        job = jobs.submit(gait_problem("walk", 0.010, Workspace.STROKE), "walk")
        wait_for((tmp_path / "mark").exists, "the worker has its job")
        thread._time_limit = 0.1
        ended = jobs.wait(job, PATIENCE)
    assert ended.state is JobState.FAILED
    how = "ended unexpectedly" if body in ENDING else "gave no sign of life"
    assert how in ended.sentence
    assert "again" in ended.sentence


@pytest.mark.heavy
@pytest.mark.parametrize("body", [*HANGING, *ENDING])
def test_a_live_solver_that_fails_keeps_nobody(
    body: Body, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    problem = gait_problem("walk", 0.010, Workspace.STROKE)
    live = LiveSolver()
    with monkeypatch.context() as patch:
        patch.setattr(live_service, "run_live_worker", body)
        patch.setattr(live_service, "LOAD_SECONDS", 4.0)
        live._warm_up = str(tmp_path / "mark")  # type: ignore[assignment]
        live.start()
        process = live.process_id
        failed = live.solve(problem, 4.0)
    assert failed.status is SolveStatus.FAILED
    assert "gave no answer within" in failed.explanation[0]
    assert not is_alive(process)
    live._warm_up = None
    assert live.solve(problem, PATIENCE).status is SolveStatus.SOLVED
    live.close()


def test_a_camera_that_hangs_is_ended(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(camera_process, "run_camera", faulty_workers.stops_as_camera)
    camera = CameraProcess(CameraAddress("under", "Under", str(tmp_path / "none.avi"), True), lambda: None)
    process = camera.process_id
    with pytest.raises(CameraError, match="gives no picture"):
        camera.picture(None, 0.1)
    monkeypatch.setattr(camera_process, "SILENCE_SECONDS", 0.1)
    wait_for(lambda: not camera.is_open, "its end is noticed")
    assert not is_alive(process)
    camera.close()
