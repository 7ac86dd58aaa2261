"""Figures of the published tables: computed row after row in the background, kept, cancelled, and refused."""

from __future__ import annotations

import json
import queue
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import pytest

from app.common.json import Json
from app.published import service as service_module
from app.published.reference_folder import ReferenceFolder
from app.published.service import PublishedService
from app.store.database import Database
from app.store.tables.published_store import PublishedStore
from core.errors import CheckError, InputError, NotFoundError, SimulationCancelledError
from core.physics.motion import SimulatedMotion
from core.physics.problem import SimulationProblem
from core.published.tables import PublishedTable, published_table
from solver_jobs import simulate, solve_live
from tests.support.reference import reference_path
from tests.support.simulated_walk import BEHIND, followed

SECONDS = 60.0


@dataclass
class Answer:
    motion: SimulatedMotion
    runs: tuple[()] = ()


class Handle:
    """A simulation that is computed where its answer is waited for."""

    def __init__(self, compute: Callable[[], SimulatedMotion]) -> None:
        self._compute = compute
        self._ended = threading.Event()

    def result(self) -> Any:
        motion = self._compute()
        if self._ended.is_set():
            raise SimulationCancelledError("The simulation was cancelled.")
        return Answer(motion)

    def cancel(self) -> None:
        self._ended.set()


class Physics:
    """What simulates, in the thread that waits."""

    def __init__(self, simulate_one: Callable[[SimulationProblem], SimulatedMotion]) -> None:
        self._simulate = simulate_one
        self.asked = 0

    def submit(self, problem: SimulationProblem, *rest: object, **more: object) -> Handle:
        self.asked += 1
        return Handle(lambda: self._simulate(problem))


@dataclass
class Opened:
    service: PublishedService
    physics: Physics
    events: queue.SimpleQueue[Json]

    def finish(self, table: str) -> Json:
        """Waits until nothing of a table is on."""
        while (view := self.service.view(table))["state"] == "running":
            self.events.get(timeout=SECONDS)
        return view


@pytest.fixture
def opened(database: Database, tmp_path: Path) -> Iterator[Callable[..., Opened]]:
    found: list[PublishedService] = []

    def make(simulate_one: Callable[[SimulationProblem], SimulatedMotion] = followed) -> Opened:
        physics, events = Physics(simulate_one), queue.SimpleQueue[Json]()
        folder = ReferenceFolder(tmp_path / "reference.json")
        store = PublishedStore(database)
        service = PublishedService(store, physics, solve_live, folder, events.put)
        found.append(service)
        return Opened(service, physics, events)

    yield make
    for service in found:
        service.close()


@pytest.fixture
def one_row(monkeypatch: pytest.MonkeyPatch) -> PublishedTable:
    return shortened("t4-1", 1, monkeypatch)


def shortened(table: str, rows: int, monkeypatch: pytest.MonkeyPatch) -> PublishedTable:
    """A table with its first rows alone."""
    whole = published_table(table)
    short = replace(whole, rows=whole.rows[:rows])
    monkeypatch.setattr(service_module, "published_table", lambda table: short)
    return short


def test_a_row_is_simulated_and_kept_over_a_restart(
    opened: Callable[..., Opened], one_row: PublishedTable
) -> None:
    before = opened(simulate)
    assert before.service.view("t4-1")["rows"][0]["state"] == "none"
    before.service.compute("t4-1")
    (row,) = before.finish("t4-1")["rows"]
    assert (row["state"], row["cells"]["published.feet_mm"]) == ("done", 2.8)
    assert row["cells"]["ours.feet_mm"] == pytest.approx(6.0, abs=0.1)
    assert row["cells"]["ours.way_mm"] == pytest.approx(2.97, abs=0.05)
    assert row["cells"]["ours.goes_mm"] == pytest.approx(12.1, abs=0.1)
    assert "<title" in before.service.plot("t4-1", row["id"])

    again = opened(simulate)
    view = again.service.view("t4-1")
    assert (view["state"], view["done"], view["rows"]) == ("done", 1, [row])
    again.service.compute("t4-1")
    assert again.physics.asked == 0


def test_figures_are_those_of_the_simulation(
    opened: Callable[..., Opened], monkeypatch: pytest.MonkeyPatch
) -> None:
    shortened("t4-2", 1, monkeypatch)
    studio = opened()
    studio.service.compute("t4-2")
    (row,) = studio.finish("t4-2")["rows"]
    beside = BEHIND * 1000
    assert (row["cells"]["ours.feet_mm"], row["cells"]["ours.body_mm"]) == (beside, beside)
    assert (row["cells"]["ours.goes_mm"], row["cells"]["ours.margin_mm"]) == (pytest.approx(10.0), 6.0)
    assert row["opens"] == ["ours"]


def test_tables_share_what_was_simulated(
    opened: Callable[..., Opened], monkeypatch: pytest.MonkeyPatch
) -> None:
    studio = opened()
    for table in ("t5-5", "ta-1"):
        shortened(table, 1, monkeypatch)
        studio.service.compute(table)
        (row,) = studio.finish(table)["rows"]
        assert row["state"] == "done"
    assert studio.physics.asked == 1


def test_a_walk_that_goes_as_planned_has_no_error_by_any_definition(
    opened: Callable[..., Opened], monkeypatch: pytest.MonkeyPatch
) -> None:
    shortened("ta-3", 1, monkeypatch)
    studio = opened()
    studio.service.compute("ta-3")
    (row,) = studio.finish("ta-3")["rows"]
    assert row["cells"]["ours.distance_cm"] == pytest.approx(3.0, abs=0.02)
    assert row["cells"]["ours.error_percent"] == pytest.approx(0.0, abs=0.5)
    assert row["cells"]["ours.angle_deg"] == pytest.approx(0.0, abs=0.5)


def test_a_cancel_ends_the_simulation_and_keeps_what_is_done(
    opened: Callable[..., Opened], monkeypatch: pytest.MonkeyPatch
) -> None:
    shortened("t4-1", 3, monkeypatch)
    begun, go_on = threading.Event(), threading.Event()

    def second_waits(problem: SimulationProblem) -> SimulatedMotion:
        if studio.physics.asked == 2:
            begun.set()
            assert go_on.wait(SECONDS)
        return followed(problem)

    studio = opened(second_waits)
    studio.service.compute("t4-1")
    assert begun.wait(SECONDS)
    assert [row["state"] for row in studio.service.view("t4-1")["rows"]] == ["done", "running", "waiting"]
    assert studio.service.compute("t4-1")["state"] == "running"
    line = studio.service.cancel("t4-1")
    go_on.set()
    assert (line["state"], line["done"], line["total"]) == ("cancelled", 1, 3)
    studio.service.close()
    assert [row["state"] for row in studio.service.view("t4-1")["rows"]] == ["done", "none", "none"]


def test_a_row_that_cannot_be_simulated_says_why_and_the_next_one_goes_on(
    opened: Callable[..., Opened], monkeypatch: pytest.MonkeyPatch
) -> None:
    shortened("t4-1", 2, monkeypatch)

    def first_refuses(problem: SimulationProblem) -> SimulatedMotion:
        if studio.physics.asked == 1:
            raise CheckError("The chains open by 0.2 mm.", "physics")
        return followed(problem)

    studio = opened(first_refuses)
    studio.service.compute("t4-1")
    view = studio.finish("t4-1")
    assert [(row["state"], row["sentence"]) for row in view["rows"]] == [
        ("failed", "The chains open by 0.2 mm."),
        ("done", ""),
    ]
    assert (view["state"], view["done"]) == ("failed", 2)
    studio.service.compute("t4-1")
    assert studio.finish("t4-1")["state"] == "done"


def test_a_folder_is_refused_by_name_and_remembered(opened: Callable[..., Opened], tmp_path: Path) -> None:
    service = opened().service
    for folder, words in (
        ("nowhere", "no full path"),
        (str(tmp_path / "absent"), "no folder"),
        (str(tmp_path), "holds no simulation_manual"),
    ):
        with pytest.raises(InputError, match=words):
            service.name_folder(folder)
    for name in ("simulation_manual", "simulation_optimised", "trajectories"):
        (tmp_path / "data" / name).mkdir(parents=True)
    service.name_folder(str(tmp_path / "data"))
    assert opened().service.overview()["reference"] == {"folder": str(tmp_path / "data"), "sentence": ""}
    (tmp_path / "data" / "trajectories").rmdir()
    assert "holds no trajectories" in service.overview()["reference"]["sentence"]
    service.name_folder("")
    assert opened().service.overview()["reference"] == {"folder": "", "sentence": ""}


def test_a_memory_that_names_no_folder_says_so(opened: Callable[..., Opened], tmp_path: Path) -> None:
    (tmp_path / "reference.json").write_text(json.dumps({"folder": 5}))
    assert "names no folder" in opened().service.overview()["reference"]["sentence"]


def test_what_there_is_not_is_not_found(opened: Callable[..., Opened]) -> None:
    service = opened().service
    for ask in (service.view, service.compute, service.cancel):
        with pytest.raises(NotFoundError, match="no published table"):
            ask("t9")
    with pytest.raises(NotFoundError, match="no plot of Walk 10 mm"):
        service.plot("t4-2", "walk-10")


def test_published_runs_and_motions_stand_beside_ours(
    opened: Callable[..., Opened], monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = reference_path("trajectories").parent
    shortened("t4-2", 1, monkeypatch)
    studio = opened()
    studio.service.name_folder(str(folder))
    studio.service.compute("t4-2")
    (row,) = studio.finish("t4-2")["rows"]
    assert row["cells"]["run.feet_mm"] == pytest.approx(row["cells"]["published.feet_mm"], abs=0.051)
    assert row["cells"]["recorded.feet_mm"] == BEHIND * 1000
    assert row["opens"] == ["ours", "published"]
    assert studio.service.plot("t4-2", "walk-10").count("published") >= 2
