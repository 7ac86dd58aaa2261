"""Trials beside plan and physics: figures of the three, tracks in the plan's frame, bands over several."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
import pytest

from app.store.database import Database
from app.store.tables.trial_reference_store import TrialReferenceStore
from app.trials.comparison import TrialComparison
from app.trials.planned import sent_problem
from app.trials.service import TrialDescription, TrialService
from app.trials.simulated_feet import NOT_KNOWN, TrialSimulations
from core.errors import CheckError, InputError, NotFoundError
from core.physics.motion import SimulatedMotion
from core.physics.problem import SimulationProblem
from core.physics.variations import VariedRun
from core.vision.track import FootTrack
from tests.support.simulated_walk import followed, walk_plan, walk_problem
from tests.support.studio_process import wait_for
from tests.support.trials.tracks import stepping_track
from tests.support.trials.walking import walk_planned, walked

WORDS = TrialDescription("first", "Ada", 1.0, 1, gait="walk", gait_name="Walk 10 mm")


@dataclass(frozen=True)
class Answer:
    motion: SimulatedMotion
    runs: tuple[VariedRun, ...] = ()


@dataclass
class Tier:
    """Physics that answers when it is told to, or refuses."""

    refusal: CheckError | None = None
    may_answer: threading.Event = field(default_factory=threading.Event)
    asked: int = 0

    def submit(
        self,
        problem: SimulationProblem,
        variations: int = 0,
        *,
        progress: Callable[[float], object] = lambda share: None,
    ) -> Handle:
        self.asked += 1
        progress(0.4)
        return Handle(self, problem)


@dataclass
class Handle:
    tier: Tier
    problem: SimulationProblem

    def result(self) -> Answer:
        assert self.tier.may_answer.wait(60)
        if self.tier.refusal is not None:
            raise self.tier.refusal
        return Answer(followed(self.problem))

    def cancel(self) -> None:
        raise AssertionError("nobody cancels")


@pytest.fixture
def tier() -> Tier:
    return Tier()


@pytest.fixture
def service(database: Database) -> TrialService:
    return TrialService(database)


@pytest.fixture
def comparison(database: Database, service: TrialService, tier: Tier) -> TrialComparison:
    return TrialComparison(service, TrialSimulations(TrialReferenceStore(database), tier))


def test_the_problem_of_what_was_sent_is_the_one_of_the_plan() -> None:
    sent = walk_planned().sent
    assert sent is not None
    found, wanted = sent_problem(dict(sent)), walk_problem()
    assert found.waypoints.content_hash == wanted.waypoints.content_hash
    np.testing.assert_array_equal(found.waypoints.durations, wanted.waypoints.durations)
    np.testing.assert_array_equal(found.times, wanted.times)
    np.testing.assert_array_equal(found.plan.feet_world, wanted.plan.feet_world)
    assert found.physics == wanted.physics
    # Feet that touch the ground in their swing count as standing in the one alone; physics asks for neither.
    assert (found.contact <= wanted.contact).all()
    assert (found.standing <= wanted.standing).all()


def test_physics_stands_beside_a_trial_once_it_is_there(
    service: TrialService, comparison: TrialComparison, tier: Tier
) -> None:
    trial = service.add(walked(), WORDS, walk_planned())["id"]
    before = comparison.figures(trial)
    assert before["simulation"]["state"] == "absent"
    assert [row["source"] for row in before["rows"]] == ["planned", "tracked"]
    assert before["rows"][0]["gap_mm"] == pytest.approx(0.0, abs=0.2)
    assert comparison.simulate(trial) == {"state": "running", "share": 0.4, "sentence": ""}
    assert comparison.simulate(trial)["state"] == "running"
    tier.may_answer.set()
    wait_for(lambda: comparison.figures(trial)["simulation"]["state"] == "done", "the simulation is kept")
    after = comparison.figures(trial)
    planned, simulated, tracked = after["rows"]
    assert [planned["source"], simulated["source"], tracked["source"]] == ["planned", "simulated", "tracked"]
    assert simulated["net_distance"] == pytest.approx(tracked["net_distance"], abs=0.01)
    assert simulated["net_angle_deg"] == pytest.approx(tracked["net_angle_deg"], abs=0.5)
    assert 1.0 < simulated["gap_mm"] < 4.0
    assert tracked["gap_mm"] is None
    assert tracked["seconds"] == pytest.approx(planned["seconds"])  # the track is the plan's motion
    assert planned["seconds"] > 10.0
    assert after["simulation"]["remark"].startswith("Physics: ")
    assert len(after["simulated"]["feet"]) == 4
    assert tier.asked == 1


def test_laps_go_on_from_where_the_simulated_robot_is(
    service: TrialService, comparison: TrialComparison, tier: Tier
) -> None:
    words = TrialDescription("laps", "Ada", 2.0, 2)
    trial = service.add(walked(2), words, walk_planned(2))["id"]
    tier.may_answer.set()
    comparison.simulate(trial)
    wait_for(lambda: len(comparison.figures(trial)["rows"]) == 3, "the simulation is kept")
    planned, simulated, _ = comparison.figures(trial)["rows"]
    assert simulated["net_distance"] == pytest.approx(planned["net_distance"], abs=0.02)


def test_a_refused_simulation_says_why_and_can_be_asked_for_again(
    service: TrialService, comparison: TrialComparison, tier: Tier
) -> None:
    trial = service.add(walked(), WORDS, walk_planned())["id"]
    tier.refusal = CheckError("A leg's chain opened.", "plan")
    tier.may_answer.set()
    comparison.simulate(trial)
    wait_for(lambda: comparison.figures(trial)["simulation"]["state"] == "failed", "it is refused")
    assert comparison.figures(trial)["simulation"]["sentence"] == "A leg's chain opened."
    tier.refusal = None
    comparison.simulate(trial)
    wait_for(lambda: comparison.figures(trial)["simulation"]["state"] == "done", "it is kept")


def test_what_was_sent_without_being_known_is_not_simulated(
    service: TrialService, comparison: TrialComparison, tier: Tier
) -> None:
    trial = service.add(walked(), WORDS, walk_planned(knows_sent=False))["id"]
    assert comparison.simulate(trial)["sentence"] == NOT_KNOWN
    assert tier.asked == 0
    with pytest.raises(NotFoundError):
        comparison.simulate("none")


def test_a_track_comes_into_the_scene_as_the_plan_lies(
    service: TrialService, comparison: TrialComparison
) -> None:
    trial = service.add(walked(), WORDS, walk_planned())["id"]
    scene = comparison.scene(trial)
    plan = walk_plan().trajectory
    assert plan is not None
    feet = np.array(scene["feet"])
    np.testing.assert_allclose(feet[:, 0], plan.feet_world[0, :, :2], atol=1e-4)
    np.testing.assert_allclose(feet[:, -1], plan.feet_world[-1, :, :2], atol=1e-3)
    assert scene["turn_deg"] == pytest.approx(90.0, abs=0.01)
    assert max(scene["gaps_mm"]) < 0.1
    assert (scene["shares"][0], scene["shares"][-1]) == (0.0, 1.0)
    assert not np.array(scene["filled"]).any()


def test_a_later_lap_lies_over_the_plan_as_the_first_one_does(
    service: TrialService, comparison: TrialComparison
) -> None:
    trial = service.add(walked(2), TrialDescription("laps", "Ada", 2.0, 2), walk_planned(2))["id"]
    first, second = comparison.scene(trial), comparison.scene(trial, 2)
    assert first["laps"] == 2
    assert (first["playing"], second["playing"]) == ([0.0, 0.5], [0.5, 1.0])
    shares, feet = np.array(first["shares"]), np.array(first["feet"])
    begin, end = feet[:, 0], feet[:, -1]
    middle = int(np.argmin(np.abs(shares - 0.5)))
    np.testing.assert_allclose(np.array(second["feet"])[:, middle], begin, atol=1e-3)
    np.testing.assert_allclose(np.array(second["feet"])[:, -1], feet[:, middle], atol=1e-3)
    assert np.linalg.norm(end - begin, axis=-1) == pytest.approx([0.02] * 4, abs=1e-3)
    with pytest.raises(InputError, match="The walk has 2 laps"):
        comparison.scene(trial, 3)


def test_a_run_that_ended_early_plays_over_as_much_of_the_plan_as_was_done(
    service: TrialService, comparison: TrialComparison
) -> None:
    whole = walk_planned(2)
    lap = float(whole.times[-1]) / 2
    done = whole.times <= 1.5 * lap
    planned = replace(whole, times=whole.times[done], feet=whole.feet[done], sent=None, lap_seconds=lap)
    track = walked(2)
    frames = int((track.times <= planned.times[-1]).sum())
    words = TrialDescription("early", "Ada", 1.5, 1)
    trial = service.add(track.between(0, frames - 1), words, planned)["id"]
    first, second = comparison.scene(trial), comparison.scene(trial, 2)
    assert first["laps"] == 2
    assert first["playing"] == pytest.approx([0.0, 2 / 3], abs=0.02)
    assert second["playing"] == pytest.approx([2 / 3, 4 / 3], abs=0.03)
    at = int(np.argmin(np.abs(np.array(second["shares"]) - second["playing"][0])))
    np.testing.assert_allclose(np.array(second["feet"])[:, at], np.array(first["feet"])[:, 0], atol=1e-3)


def test_a_trial_without_a_plan_stands_as_the_robot_does(
    service: TrialService, comparison: TrialComparison
) -> None:
    trial = service.add(stepping_track((0.01, 0.0), 1), WORDS, None)["id"]
    assert [row["source"] for row in comparison.figures(trial)["rows"]] == ["tracked"]
    assert abs(comparison.scene(trial)["turn_deg"]) < 90.0


def test_a_band_over_trials_lies_round_their_mean_over_the_plan(
    service: TrialService, comparison: TrialComparison
) -> None:
    longer = walked()
    first = service.add(longer, WORDS, walk_planned())["id"]
    stretched = FootTrack(longer.times, longer.feet[0] + 1.2 * (longer.feet - longer.feet[0]), longer.filled)
    second = service.add(stretched, WORDS, walk_planned())["id"]
    band = comparison.band([first, second])
    assert [trial["id"] for trial in band["trials"]] == [first, second]
    way = band["feet"][0]["way"]
    assert way["plan"][-1] == pytest.approx(1.0, abs=0.01)
    assert (way["low"][-1], way["mean"][-1], way["high"][-1]) == pytest.approx((1.0, 1.1, 1.2), abs=0.01)
    assert band["feet"][0]["end_spread_cm"] == pytest.approx(0.1, abs=0.01)
    place = band["feet"][2]["place"]
    assert len(place["trials"]) == 2
    assert place["plan"]["x"][0] == pytest.approx(place["mean"]["x"][0], abs=0.01)


def test_trials_of_other_iterations_or_the_same_twice_make_no_band(
    service: TrialService, comparison: TrialComparison
) -> None:
    one = service.add(walked(), WORDS, None)["id"]
    two = service.add(stepping_track((0.01, 0.0), 2), TrialDescription("two", "Ada", 2.0, 2), None)["id"]
    with pytest.raises(InputError, match="as many feet and iterations"):
        comparison.band([one, two])
    with pytest.raises(InputError, match="different trials"):
        comparison.band([one, one])
    with pytest.raises(InputError, match="Choose 1 to 20"):
        comparison.band([])
