"""Remedies as a page is shown them: found, finished by the pattern search, tried in physics."""

from __future__ import annotations

import json
import queue
import threading
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
import pytest

from app.common.json import Json
from app.documents.gait_json import gait_from_content
from app.export.import_gait import gait_of_recording
from app.gaits.live_plans import LivePlans
from app.plans.sequence_plan import plan_of
from app.remedies.run import RemedyParts
from app.remedies.service import RemedyService
from app.simulation.repository import SimulationRepository
from app.store.database import DATABASE, Database
from app.store.tables.simulation_store import SimulationStore
from core.gait.gait import Gait, heading_step
from core.gait.recording import Recording, RecordingForm
from core.library.library import library
from core.motion.contact_timeline import ContactTimeline
from core.robot.model import load_robot
from core.wire.trajectory_csv import format_trajectory_csv
from solver_jobs import LiveSolver, PatternSolver, RemedyKind, Simulator, solve_live, solve_pattern
from solver_jobs.remedies.completion import completed_drawing, completion_question
from tests.solver_jobs.remedies.test_remedies import painted
from tests.support.beyond_range import lowered, recorded_gait

WALK = library()["walk"].gait.with_options(margin=0.006)
LONG = replace(WALK, step=heading_step(WALK.orientation, 0.030))
OVERLAPPING = painted(WALK, 1, 6, 12)


@pytest.fixture(scope="module")
def simulations(tmp_path_factory: pytest.TempPathFactory) -> Iterator[SimulationRepository]:
    database = Database(tmp_path_factory.mktemp("remedies") / DATABASE)
    yield SimulationRepository(SimulationStore(database))
    database.close()


@pytest.fixture(scope="module")
def service(simulations: SimulationRepository) -> Iterator[RemedyService]:
    solver, patterns, simulator = LiveSolver(), PatternSolver(), Simulator()
    live = LivePlans(solver)
    yield RemedyService(RemedyParts(live, solver, patterns, simulator, simulations))
    for part in (solver, patterns, simulator):
        part.close()


def states_of(service: RemedyService, gait: Gait, *, tips: bool = False) -> list[Json]:
    """Everything that a page is shown of a search."""
    shown: queue.SimpleQueue[Json | None] = queue.SimpleQueue()
    service.search(gait, shown.put, tips=tips)
    states = []
    while (state := shown.get(timeout=90.0)) is not None:
        json.dumps(state, allow_nan=False)
        states.append(state)
    return states


def test_a_gait_that_walks_gets_none(service: RemedyService) -> None:
    (state,) = states_of(service, WALK)
    assert (state["remedies"], state["searching"], state["trying"]) == ([], False, False)


@pytest.mark.heavy
def test_they_are_shown_as_they_are_found_and_marked_when_physics_has_tried_them(
    service: RemedyService,
) -> None:
    states = states_of(service, LONG)
    assert states[0]["searching"]
    assert len(states[0]["remedies"]) == 1
    assert states[0]["remedies"][0]["physics"] is None
    last = states[-1]
    assert (last["searching"], last["trying"], last["complete"]) == (False, False, True)
    assert len(last["remedies"]) >= 2
    assert last["remedies"][0]["physics"] == {"walks": True, "sentence": ""}
    verdicts = [remedy["physics"]["walks"] for remedy in last["remedies"]]
    assert verdicts == sorted(verdicts, reverse=True), "what tips comes last"
    for remedy in last["remedies"]:
        assert remedy["robot_seconds"] > 0
        assert remedy["balance"] >= remedy["margin"] - 1e-4


@pytest.mark.heavy
def test_overlaps_get_the_finished_drawing_too(service: RemedyService) -> None:
    last = states_of(service, OVERLAPPING)[-1]
    kinds = [remedy["kind"] for remedy in last["remedies"]]
    assert RemedyKind.ONE_BY_ONE in kinds
    assert last["remedies"][0]["physics"]["walks"]


@pytest.mark.heavy
def test_a_gait_that_tips_gets_remedies_though_it_has_a_motion(service: RemedyService) -> None:
    tipping = WALK.with_options(margin=0.0)
    states = states_of(service, tipping, tips=True)
    first = states[-1]["remedies"][0]
    assert first["physics"]["walks"]
    assert first["margin"] >= load_robot("deltawalker").margin
    assert len({remedy["label"] for remedy in states[-1]["remedies"]}) == len(states[-1]["remedies"])


def test_a_motion_from_a_table_gets_none(service: RemedyService) -> None:
    assert states_of(service, library()["walk-manual-0"].gait, tips=True)[-1]["remedies"] == []


def test_where_nothing_helps_a_sentence_says_what_stood_in_the_way(service: RemedyService) -> None:
    stance = WALK.timeline.stance.copy()
    stance[:3, 6:9] = False
    locked = np.ones_like(stance)
    held_fast = replace(WALK, timeline=ContactTimeline(stance, locked, WALK.timeline.sample_time))
    last = states_of(service, held_fast)[-1]
    assert last["remedies"] == []
    assert last["sentence"].startswith(
        "No change was found that makes it walk. Locked cells were not changed"
    )


def test_a_search_that_is_ended_shows_only_its_end(service: RemedyService) -> None:
    ended, after = threading.Event(), []

    def show(state: Json | None) -> None:
        if state is None:
            ended.set()
        after.append(state)

    end: Callable[[], None] = service.search(LONG, show, tips=False)
    end()
    assert ended.wait(30.0)
    assert after[-1] is None


@pytest.mark.heavy
def test_a_drawing_is_finished_with_one_swing_a_foot() -> None:
    model = load_robot("deltawalker")
    question = completion_question(OVERLAPPING, model)
    assert question is not None
    (pattern,) = solve_pattern(question, seconds=20.0).patterns
    gait = completed_drawing(OVERLAPPING, model, pattern.stance)
    assert sorted(swing.foot for swing in gait.timeline.swings()) == [0, 1, 2, 3]
    assert (~gait.timeline.stance).sum(axis=0).max() == 1
    assert gait.options.margin == model.margin
    assert gait.timeline.sample_count == OVERLAPPING.timeline.sample_count


def test_a_recording_beyond_the_range_gets_ways_to_keep_it_tried_in_physics_and_kept(
    service: RemedyService, simulations: SimulationRepository
) -> None:
    gait = recorded_gait(0.002)
    last = states_of(service, gait)[-1]
    assert [one["kind"] for one in last["remedies"]] == ["recorded"] * 3
    assert not last["searching"]
    assert not last["trying"]
    for one in last["remedies"]:
        assert one["physics"]["walks"] is not None, one["label"]
        changed = gait_from_content(one["document"], "document")
        plan = plan_of(changed, lambda gait: None, lambda gait: solve_live)
        assert plan.misfit is None
        assert simulations.simulated(plan) is not None, "the page does not simulate it again"
        standing = simulations.standing("another-gait", plan)
        assert standing is not None
        assert standing["fresh"]


def test_a_recording_within_the_range_gets_none(service: RemedyService) -> None:
    (state,) = states_of(service, recorded_gait(0.0))
    assert state["remedies"] == []


def test_heights_in_another_frame_come_first_and_say_what_is_left(service: RemedyService) -> None:
    (first, *_) = states_of(service, recorded_gait(0.022))[-1]["remedies"]
    assert first["label"] == "Correct the heights"
    assert "20 mm too low" in first["sentence"]
    assert "still beyond the motors' range" in first["caution"]
    assert first["physics"] is None


def test_a_recording_that_nothing_keeps_says_so(service: RemedyService) -> None:
    motion = lowered(0.0)
    feet = np.array(motion.feet_world)
    feet[:, 2, 0] += 0.1
    text = format_trajectory_csv(replace(motion, feet_world=feet))
    gait = gait_of_recording(Recording("far.csv", RecordingForm.TRAJECTORY, text), "Far").gait
    last = states_of(service, gait)[-1]
    assert last["remedies"] == []
    assert "Neither clipping nor raising" in last["sentence"]
