"""Courses of learning and the sets that come of them: kept, named, versioned, brought back, cancelled."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from app.learning.service import LearningService
from app.simulation.problem import simulation_key
from app.simulation.repository import SimulationRepository
from app.store.database import Database
from app.store.tables.learning_store import LearningStore
from app.store.tables.simulation_store import SimulationStore
from core.errors import InputError, NotFoundError, StateError
from core.physics.parameters import physics_set
from core.robot.model import load_robot
from tests.support.simulated_walk import walk_plan
from tests.support.studio_process import wait_for
from tests.support.trials.few_draws import few_draws
from tests.support.trials.synthetic_walks import POINTS, Tier, made_walks

__all__ = ["few_draws"]

ROBOT = load_robot("deltawalker")
USUAL = physics_set("scales")


@pytest.fixture
def tier() -> Tier:
    return Tier()


@pytest.fixture
def service(database: Database, tier: Tier) -> Iterator[LearningService]:
    service = LearningService(database, (tier, tier), POINTS)
    yield service
    service.close()


def begun(service: LearningService) -> str:
    learning: str = service.start(made_walks(), USUAL, "Ada", "made")["id"]
    return learning


def ended(service: LearningService, learning: str) -> dict[str, Any]:
    wait_for(lambda: service.content(learning)["ended"] is not None, "learning has ended")
    return service.content(learning)


@pytest.fixture
def learned(service: LearningService, tier: Tier) -> str:
    tier.may_answer.set()
    learning = begun(service)
    assert ended(service, learning)["state"] == "done"
    return learning


def test_a_course_tells_how_far_it_is_and_what_came_of_it(service: LearningService, learned: str) -> None:
    content = service.content(learned)
    assert content["done"] == content["total"]
    drag = next(one for one in content["result"]["parameters"] if one["name"] == "cable_drag")
    assert drag["is_identifiable"]
    assert drag["low"] - 0.1 <= 0.6 <= drag["high"] + 0.1
    assert "cable drag" in content["sentence"]
    assert [gait["cut_mm"] for gait in content["result"]["gaits"]] == pytest.approx([4.2, 0.0, 0.0])
    assert [(one["id"], "result" in one) for one in service.found()] == [(learned, False)]


def test_what_was_learned_gets_a_name_and_a_version_and_is_offered_to_its_robot(
    service: LearningService, learned: str
) -> None:
    for version in (1, 2):
        kept = service.save(learned, " Lab  floor", "Ada")
        assert (kept.name, kept.version, kept.physics.name) == (
            "Lab floor",
            version,
            f"Lab floor, version {version}",
        )
    assert kept.physics.cable_drag > 0.3
    offered = [one.name for one in service.sets.fitting(ROBOT)]
    assert offered[0] == "scales"
    assert offered[-2:] == ["Lab floor, version 2", "Lab floor, version 1"]
    assert [one.name for one in service.sets.fitting(load_robot("hexapod"))] == ["model"]
    assert service.sets.chosen(ROBOT, "Lab floor, version 1").masses == "scales"
    assert service.sets.chosen(ROBOT, None) == USUAL
    with pytest.raises(InputError, match=r"no physics set “moon” for .*Lab floor, version 1"):
        service.sets.chosen(ROBOT, "moon")


def test_a_simulation_with_a_learned_set_has_a_key_of_its_own_and_is_stale_while_the_set_is_deleted(
    service: LearningService, learned: str, database: Database
) -> None:
    kept = service.save(learned, "Lab floor", "Ada")
    simulations = SimulationRepository(SimulationStore(database), sets=service.sets.physics)
    key = simulation_key(walk_plan(), kept.physics)
    assert key != simulation_key(walk_plan(), USUAL)
    assert key in simulations.keys_of(walk_plan())
    service.sets.delete("Lab floor", 1)
    assert key not in simulations.keys_of(walk_plan())
    assert [one.name for one in service.sets.found(deleted=True)] == ["Lab floor"]
    assert service.sets.restore("Lab floor", 1) == kept
    assert key in simulations.keys_of(walk_plan())


def test_the_version_of_a_deleted_set_is_not_given_again(service: LearningService, learned: str) -> None:
    service.save(learned, "Lab floor", "Ada")
    service.sets.delete("Lab floor", 1)
    assert service.save(learned, "Lab floor", "Ada").version == 2


def test_a_course_that_is_cancelled_ends_without_a_result(service: LearningService) -> None:
    learning = begun(service)
    assert service.cancel(learning)["state"] in ("cancelling", "cancelled")
    content = ended(service, learning)
    assert (content["state"], content["result"]) == ("cancelled", None)
    with pytest.raises(StateError, match="no result"):
        service.save(learning, "Lab floor", "Ada")
    assert service.cancel(learning)["state"] == "cancelled"


def test_one_course_is_on_at_a_time(service: LearningService) -> None:
    begun(service)
    with pytest.raises(StateError, match="Wait for it, or cancel it"):
        begun(service)


def test_a_course_that_was_on_when_the_studio_ended_is_said_to_be_interrupted(
    database: Database, service: LearningService, learned: str
) -> None:
    LearningStore(database).put({**service.content(learned), "state": "running", "ended": None})
    again = LearningService(database, ())
    assert again.content(learned)["state"] == "interrupted"
    assert "Learn again" in again.content(learned)["sentence"]


def test_a_course_that_is_on_while_the_studio_closes_is_interrupted_too(service: LearningService) -> None:
    learning = begun(service)
    service.close()
    assert service.content(learning)["state"] == "interrupted"


def test_too_few_gaits_and_unknown_things_are_refused(service: LearningService, learned: str) -> None:
    with pytest.raises(InputError, match="these are of 2"):
        service.start(made_walks(2), USUAL, "Ada", "made")
    with pytest.raises(InputError, match="no name"):
        service.save(learned, "  ", "Ada")
    with pytest.raises(NotFoundError):
        service.content("none")
    with pytest.raises(NotFoundError, match="no set “Lab floor”, version 7"):
        service.sets.delete("Lab floor", 7)
