"""The example of a trial that physics makes for an empty list."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from app.learning.walks import SentTrial, walks_of
from app.store.database import Database
from app.trials.example import NOISE, TITLE, ExampleTrials, example_track
from app.trials.service import TrialDescription, TrialService, compared
from core.errors import InputError, StateError
from core.physics.problem import SimulationProblem
from core.vision.track_csv import FRAME_RATE
from tests.support.simulated_walk import followed, walk_problem
from tests.support.trials.walking import walk_planned, walked


@dataclass
class Tier:
    """A physics in which the robot does as it is sent, or breaks off."""

    ended_early: str = ""

    def submit(
        self,
        problem: SimulationProblem,
        variations: int = 0,
        *,
        progress: Callable[[float], object] = lambda share: None,
    ) -> Any:
        motion = replace(followed(problem), ended_early=self.ended_early)
        return SimpleNamespace(result=lambda: SimpleNamespace(motion=motion), cancel=lambda: None)


@pytest.fixture
def service(database: Database) -> TrialService:
    return TrialService(database)


def test_an_example_is_marked_and_stands_beside_its_plan(service: TrialService) -> None:
    made = ExampleTrials(service, Tier()).add()
    assert made["is_example"] is True
    assert made["name"].startswith(TITLE)
    assert "No robot did this" in made["note"]
    assert made["iterations"] == len(made["parts"]) == 3
    assert made["figures"]["net_distance"] == pytest.approx(3.0, abs=0.1)
    assert made["plan"]["fits"]
    (line,) = service.lines()
    assert line["is_example"] is True


def test_an_example_is_deleted_like_any_trial(service: TrialService) -> None:
    made = ExampleTrials(service, Tier()).add()
    service.delete(made["id"])
    assert service.lines() == []
    assert service.restore(made["id"])["is_example"] is True


def test_an_example_counts_in_no_comparison_and_is_not_learned_from(service: TrialService) -> None:
    example = ExampleTrials(service, Tier()).add()
    words = TrialDescription("real", "Ada", 3.0, 3, gait="walk-manual-0", gait_name="Manual walk, v0")
    real = service.add(walked(3), words, walk_planned(3))
    assert real["is_example"] is False
    (group,) = compared(service.lines())
    assert group["trials"] == [real["id"]]
    sent = [SentTrial(service.record(one["id"]), service.sent(one["id"])) for one in (real, example)]
    assert len(walks_of(sent[:1])) == 1
    with pytest.raises(InputError, match="is an example made by simulation: no robot did it"):
        walks_of(sent)


def test_the_track_is_the_same_each_time_and_a_little_noisy() -> None:
    motion = followed(walk_problem())
    one, again = example_track(motion, 2), example_track(motion, 2)
    assert (one.feet == again.feet).all()
    assert not one.filled.any()
    assert np.diff(one.times) == pytest.approx(1.0 / FRAME_RATE)
    whole = 2 * (motion.times[-1] - motion.times[0])
    assert whole - 1.0 / FRAME_RATE <= one.times[-1] <= whole
    off = one.feet[0] - motion.feet_world[0, :, :2]
    assert 0 < np.abs(off).max() < 6 * NOISE


def test_a_robot_that_falls_is_no_example(service: TrialService) -> None:
    with pytest.raises(StateError, match="did not come to the end in physics: It fell"):
        ExampleTrials(service, Tier("It fell.")).add()
    assert service.lines() == []
