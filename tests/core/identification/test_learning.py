"""Parameters learned from made-up robots whose physics is a formula."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import product

import numpy as np
import pytest

from core.errors import CheckError, InputError
from core.identification.learning import Learned, Simulate, Task, learn, simulation_count
from core.identification.parameters import FIT_PARAMETERS, physics_at
from core.physics.parameters import PhysicsSet, physics_set
from core.trials.displacement import Displacement, MeasuredWalk, pooled_spread, walk_of_trials
from tests.support.trials.few_draws import few_draws

__all__ = ["few_draws"]

DEFAULT = physics_set("scales")
REAL = replace(DEFAULT, link_stiffness=2000.0, cable_drag=0.6, centre_offset=(0.004, 0.0), motor_speed=0.85)
"""A soft robot with a cable and slow motors; how fast motors are does not show in these figures."""
STEPS = (0.03, 0.05, 0.075)
KINDS = ("walk", "amble", "s-gait")
POINTS = 48
TOLD = ("link_stiffness", "cable_drag", "centre_offset_x")


@dataclass(frozen=True)
class MadeWalk:
    """A walk without a simulation."""

    measured: MeasuredWalk


def displacement(wanted: float, physics: PhysicsSet) -> Displacement:
    """Soft links shorten long steps, drag every step alike, and a mass that lies ahead turns the robot."""
    compliance = 1.0 / physics.link_stiffness - 1.0 / DEFAULT.link_stiffness
    distance = wanted - 8.0e3 * wanted**2 * compliance - 0.012 * physics.cable_drag
    return Displacement(distance, 40.0 * wanted * physics.centre_offset[0])


def made_walks(real: PhysicsSet = REAL, noise: float = 0.0) -> list[MadeWalk]:
    off = noise * np.random.default_rng(5).normal(size=len(STEPS) * len(KINDS))
    walks = []
    for place, (kind, wanted) in enumerate(product(KINDS, STEPS)):
        went = displacement(wanted, real)
        trials = [
            Displacement(went.distance + off[place] + side, went.angle + side) for side in (-0.002, 0.002)
        ]
        walks.append(MadeWalk(walk_of_trials(f"{kind} {wanted}", kind, wanted, trials)))
    return walks


def simulating(walks: Sequence[MadeWalk], counted: list[Task] | None = None) -> Simulate:
    def simulate(tasks: Sequence[Task]) -> list[Displacement | None]:
        if counted is not None:
            counted.extend(tasks)
        return [displacement(walks[gait].measured.wanted, physics) for gait, physics in tasks]

    return simulate


@pytest.fixture(scope="module")
def counted() -> list[Task]:
    """What `learned` asks to be simulated."""
    return []


@pytest.fixture(scope="module")
def learned(counted: list[Task]) -> Learned:
    walks = made_walks()
    return learn(walks, DEFAULT, simulating(walks, counted), POINTS)


def test_known_parameters_come_back_within_their_stated_spread(learned: Learned) -> None:
    for place, parameter in enumerate(FIT_PARAMETERS):
        if parameter.name in TOLD:
            low, high = (
                parameter.read(physics_at(DEFAULT, learned.fit.z + side * 2.5 * learned.fit.spread * one))
                for side in (-1.0, 1.0)
                for one in [np.arange(len(FIT_PARAMETERS)) == place]
            )
            assert min(low, high) <= parameter.read(REAL) <= max(low, high), parameter.name


def test_what_does_not_show_is_said_to_be_unknown_and_stays_as_it_was(learned: Learned) -> None:
    told = {one.name for one, known in zip(FIT_PARAMETERS, learned.fit.is_identifiable, strict=True) if known}
    assert told == set(TOLD)
    assert learned.physics.motor_speed == DEFAULT.motor_speed
    assert learned.physics.friction == DEFAULT.friction
    assert learned.physics.backlash == DEFAULT.backlash


def test_gaits_that_were_left_out_are_predicted_better_than_by_plan_and_default(learned: Learned) -> None:
    errors = {way.name: learned.errors(way)[0] for way in learned.predicted}
    assert errors["as planned"] == pytest.approx(errors["default"])
    assert errors["left out"] < 0.25 * errors["default"]
    assert errors["kind left out"] < 0.25 * errors["default"]
    assert errors["fitted"] <= errors["left out"] + 1e-4


def test_a_line_helps_where_the_real_robot_goes_farther_than_any_parameter_lets_it() -> None:
    walks = [
        MadeWalk(replace(one.measured, displacement=replace(went, distance=1.3 * went.distance + 0.004)))
        for one in made_walks(DEFAULT)
        for went in [one.measured.displacement]
    ]
    result = learn(walks, DEFAULT, simulating(walks), POINTS)
    errors = {way.name: result.errors(way)[0] for way in result.predicted}
    assert errors["left out, line"] < 0.25 * errors["left out"]


def test_a_gait_that_is_left_out_says_nothing_about_itself(learned: Learned) -> None:
    lying = made_walks()
    lying[2] = MadeWalk(replace(lying[2].measured, displacement=Displacement(0.02, 0.5)))
    other = learn(lying, DEFAULT, simulating(lying), POINTS)
    of = [next(way for way in one.predicted if way.name == "left out") for one in (learned, other)]
    assert of[0].displacements[2].distance == pytest.approx(of[1].displacements[2].distance, abs=1e-3)


def test_as_many_simulations_run_as_were_announced(learned: Learned, counted: list[Task]) -> None:
    assert learned.simulations == len(counted) == simulation_count(9, 3, POINTS)


def test_trials_that_agree_with_the_defaults_change_nothing_much() -> None:
    walks = made_walks(DEFAULT)
    result = learn(walks, DEFAULT, simulating(walks), POINTS)
    way = next(way for way in result.predicted if way.name == "fitted")
    assert result.errors(way)[0] < result.spread[0]


def test_two_gaits_are_too_few() -> None:
    walks = made_walks()[:2]
    with pytest.raises(InputError, match=r"3 different gaits or steps.*these are of 2") as refused:
        learn(walks, DEFAULT, simulating(walks), POINTS)
    assert refused.value.where == "trials"


def test_a_handful_of_points_is_too_few() -> None:
    walks = made_walks()
    with pytest.raises(InputError, match="take at least 8"):
        learn(walks, DEFAULT, simulating(walks), 7)


def test_a_gait_that_falls_in_most_simulations_is_to_be_left_out() -> None:
    walks = made_walks()

    def falling(tasks: Sequence[Task]) -> list[Displacement | None]:
        return [
            None if gait == 1 and one.cable_drag > 0.3 else Displacement(0.03, 0.0) for gait, one in tasks
        ]

    with pytest.raises(CheckError, match="Leave it out"):
        learn(walks, DEFAULT, falling, POINTS)


def test_a_gait_that_falls_in_its_prediction_counts_its_whole_distance_and_no_angle() -> None:
    walks = made_walks()
    simulate = simulating(walks)

    def falling(tasks: Sequence[Task]) -> list[Displacement | None]:
        displacements = simulate(tasks)
        return displacements if len(tasks) > len(walks) else [displacements[0], None, *displacements[2:]]

    result = learn(walks, DEFAULT, falling, POINTS)
    way = next(way for way in result.predicted if way.name == "default")
    distance, angle = result.errors(way)
    others = [
        (
            abs(said.distance - walk.measured.displacement.distance),
            abs(said.angle - walk.measured.displacement.angle),
        )
        for place, (said, walk) in enumerate(zip(way.displacements, walks, strict=True))
        if place != 1
    ]
    assert (way.falls, way.angles) == (1, 8)
    assert angle == pytest.approx(np.mean([off for _, off in others]))
    whole = walks[1].measured.displacement.distance
    assert distance == pytest.approx((sum(off for off, _ in others) + whole) / 9)
    assert np.isnan(result.errors(result.predicted[5])[1])


def test_the_spread_of_a_trial_is_pooled_over_gaits_that_were_repeated() -> None:
    two = walk_of_trials("a", "a", 0.03, [Displacement(0.028, 0.0), Displacement(0.032, 0.2)])
    one = walk_of_trials("b", "b", 0.03, [Displacement(0.03, 0.0)])
    assert pooled_spread([one]) is None
    assert pooled_spread([one, two]) == pytest.approx((0.004 / np.sqrt(2), 0.2 / np.sqrt(2)))
    with pytest.raises(InputError, match="has no trial"):
        walk_of_trials("c", "c", 0.03, [])
