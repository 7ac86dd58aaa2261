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
from app.published.entries import entries_of
from app.published.figures import figures_content
from app.published.opening import Source
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


def empty_data(folder: Path) -> Path:
    """A folder of the published data without any file."""
    for name in ("simulation_manual", "simulation_optimised", "trajectories/direction1"):
        (folder / name).mkdir(parents=True)
    return folder


def test_a_damaged_file_costs_its_own_columns_and_another_folder_forgets_it(
    opened: Callable[..., Opened], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    shortened("t4-2", 1, monkeypatch)
    studio, data = opened(), empty_data(tmp_path / "data")
    path = data / "trajectories/direction1/walk_a.csv"
    path.write_bytes(b"\x80")
    studio.service.name_folder(str(data))
    studio.service.compute("t4-2")
    view = studio.finish("t4-2")
    (row,) = view["rows"]
    assert (view["state"], row["state"], row["cells"]["ours.feet_mm"]) == ("failed", "failed", BEHIND * 1000)
    assert "run is not in this folder" in row["sentence"]
    assert "walk_a.csv is not text in UTF-8" in row["sentence"]
    assert studio.service.overview()["reference"]["sentence"] == ""

    studio.service.name_folder(str(empty_data(tmp_path / "other")))
    (row,) = studio.service.view("t4-2")["rows"]
    assert (row["state"], "walk_a" in row["sentence"]) == ("none", False)
    with pytest.raises(NotFoundError, match="It is not in"):
        studio.service.gait("t4-2", row["id"], Source.PUBLISHED)


def test_a_new_folder_ends_what_is_computed_of_the_old_one(
    opened: Callable[..., Opened], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    shortened("t4-1", 1, monkeypatch)
    begun, go_on = threading.Event(), threading.Event()

    def waits(problem: SimulationProblem) -> SimulatedMotion:
        begun.set()
        assert go_on.wait(SECONDS)
        return followed(problem)

    studio = opened(waits)
    studio.service.compute("t4-1")
    assert begun.wait(SECONDS)
    studio.service.name_folder(str(empty_data(tmp_path / "data")))
    assert studio.service.line("t4-1")["state"] == "none"
    assert studio.service.compute("t4-1")["state"] == "running"
    go_on.set()
    (row,) = studio.finish("t4-1")["rows"]
    assert row["state"] == "done"
    assert studio.physics.asked == 2


def test_a_folder_that_vanishes_is_named(opened: Callable[..., Opened], tmp_path: Path) -> None:
    service, data = opened().service, empty_data(tmp_path / "data")
    service.name_folder(str(data))
    data.rename(tmp_path / "elsewhere")
    assert f"There is no folder {data}" in " ".join(service.view("t4-2")["about"])
    with pytest.raises(NotFoundError, match=f"There is no folder {data}"):
        service.gait("t4-2", "walk-10", Source.PUBLISHED)


@pytest.mark.parametrize("folder", ["/" + "a" * 300, "~nosuchuser/x", "\udcff", "a\0b", 5, None])
def test_a_memory_of_no_folder_is_told(opened: Callable[..., Opened], tmp_path: Path, folder: object) -> None:
    (tmp_path / "reference.json").write_text(json.dumps({"folder": folder}))
    assert opened().service.overview()["reference"]["sentence"]


@pytest.mark.parametrize(
    "damage",
    [
        {"figures": {"ours": {"standing": {}}}},
        {"figures": {}},
        {"figures": {"standing": {"lean_deg": None}}},
        {"figures": {"standing": {"feet_mm": "2"}}},
        {"ways": {}},
        {"ways": {"body": [[0, 0]], "planned_body": [[0, 0]], "feet": [], "planned_feet": []}},
        {"ways": [1]},
        {"sentence": None},
        {"is_refused": 0},
    ],
)
def test_a_damaged_row_of_the_store_is_computed_again_or_shown(
    opened: Callable[..., Opened], database: Database, one_row: PublishedTable, damage: Json
) -> None:
    (entry,) = entries_of(one_row, one_row.rows[0], None)
    feet = [[[0.0, 0.0]] * 4]
    ways = {"body": [[0.0, 0.0]], "planned_body": [[0.0, 0.0]], "feet": feet, "planned_feet": feet}
    whole = figures_content({"standing": {"feet_mm": 2.0, "lean_deg": 1.0}}, "", ways)
    PublishedStore(database).put(entry.key, 0.0, whole | damage)
    service = opened().service
    (row,) = service.view("t4-1")["rows"]
    assert row["state"] in ("none", "done")
    if row["has_plot"]:
        assert "<svg" in service.plot("t4-1", row["id"])
