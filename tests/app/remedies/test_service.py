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
from app.gaits.live_plans import LivePlans
from app.remedies.run import RemedyParts
from app.remedies.service import RemedyService
from core.gait.gait import Gait, heading_step
from core.library.library import library
from core.motion.contact_timeline import ContactTimeline
from core.robot.model import load_robot
from solver_jobs import LiveSolver, PatternSolver, RemedyKind, Simulator, solve_pattern
from solver_jobs.remedies.completion import completed_drawing, completion_question
from tests.solver_jobs.remedies.test_remedies import painted

WALK = library()["walk"].gait.with_options(margin=0.006)
LONG = replace(WALK, step=heading_step(WALK.orientation, 0.030))
OVERLAPPING = painted(WALK, 1, 6, 12)


@pytest.fixture(scope="module")
def service() -> Iterator[RemedyService]:
    solver, patterns, simulator = LiveSolver(), PatternSolver(), Simulator()
    live = LivePlans(solver)
    yield RemedyService(RemedyParts(live, solver, patterns, simulator))
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
