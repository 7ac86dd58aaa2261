"""Spaces of gaits: what a file may say, and that a gait of a space is always the same."""

from __future__ import annotations

from datetime import date
from typing import Any

import numpy as np
import pytest

from core.atlas.space import AtlasKind, default_space, space_from_table, space_from_toml
from core.errors import InputError
from core.robot.model import load_robot

SPACE = """
robot = "deltawalker"
kind = "fast"
seed = 5
[vary]
order = ["1,2,3,4", "3,2,4,1"]
step_x = [0.01, 0.04]
margin = [0.003, 0.006, 0.008]
stop_bound = 1.5
"""


def table(**vary: Any) -> dict[str, Any]:
    return {"vary": {"step_x": [0.01, 0.03], **vary}}


def test_two_numbers_are_a_range_and_other_lists_are_choices() -> None:
    space = space_from_toml(SPACE, "space.toml")
    assert (space.kind, space.seed) == (AtlasKind.FAST, 5)
    assert space.varying == ("order", "step_x", "margin")
    point = space.point(7, np.array([0.6, 0.5, 0.99]))
    assert (point.number, point.order, point.margin, point.stop_bound) == (7, (3, 2, 4, 1), 0.008, 1.5)
    assert point.step_x == pytest.approx(0.025)
    two = space_from_table(table(margin={"choices": [0.003, 0.006]}), "a file")
    assert {two.point(0, np.array([0.5, place])).margin for place in (0.1, 0.4, 0.6)} == {0.003, 0.006}


def test_a_space_is_made_again_from_its_content() -> None:
    for robot in ("deltawalker", "hexapod"):
        space = default_space(robot)
        again = space_from_table(space.content(), "the content")
        assert again.hash == space.hash
        assert again.content() == space.content()


def test_a_number_of_the_robot_may_vary() -> None:
    space = space_from_table(table(robot={"leg": {"link_length": [0.048, 0.052]}}), "a file")
    point = space.point(0, np.array([0.0, 0.5]))
    assert space.model(point.numbers).leg.link_length == pytest.approx(0.05)
    assert load_robot("deltawalker").parameters_hash == space.robot_hash
    other = space_from_table(table(**{"robot.ring.radius": 0.045}), "a file")
    assert other.model(other.point(0, np.array([0.0])).numbers).radius == 0.045


def test_every_order_of_four_legs_begins_with_foot_1() -> None:
    orders = space_from_table(table(order="all"), "a file").axes["order"].choices
    assert len(orders) == 6
    assert all(order[0] == 1 for order in orders)


@pytest.mark.parametrize(
    ("content", "where", "words"),
    [
        (table(stride=[0.0, 1.0]), "stride", "has the unknown key stride. It may have order, overlap"),
        ({"vary": {"step_x": [0.03, 0.03]}}, "step_x", "range of step_x is empty: 0.03 to 0.03"),
        ({"vary": {"margin": []}}, "margin", "margin has no value"),
        (table(margin=[0.0, 0.5]), "margin", "must lie between 0 and 0.05"),
        (table(margin="much"), "margin", "it must be a number of m"),
        (table(order="1,2,3"), "order", "must name each foot 1 to 4 once"),
        (table(moves=3), "moves", "it must be 1, or 2"),
        (table(lost=[2]), "lost", 'Write kind = "drawn"'),
        (table(robot={"leg": {"bones": [1, 2]}}), "robot.leg.bones", "is no number of deltawalker.toml"),
        (
            table(robot={"leg": {"link_length": [-0.05, 0.05]}}),
            "robot.leg.link_length",
            "between 0.005 and 0.5",
        ),
        (table(step_x={"choises": [0.01, 0.02]}), "step_x", "step_x has choises. Write a range of two"),
        (
            table(robot={"leg": {"link_length": [1e-300, 1e300]}}),
            "robot.leg.link_length",
            "between 0.005 and",
        ),
        (table(robot={"leg": {"link_length": 0.01}}), "robot.leg", "a link has to bridge 0.014 m"),
        (table(robot={"leg": {"base_radius": [0.02, 0.07]}}), "robot.leg", "Make links longer"),
        (table(robot={"a": {"b": {"c": {"d": {"e": {"f": 1}}}}}}), "robot.a.b.c.d.e", "is no number of"),
        ({"vary": {"step_x": [1e-300, 1e300]}}, "step_x", "it must be 0, or at least 1e-06 in size"),
        ({"vary": {"step_x": 1e300}}, "step_x", "must lie between -0.2 and 0.2"),
        (table(turn=1e6), "turn", "must lie between -2.094 and 2.094"),
        (table(turn=-1e-9), "turn", "at least 1e-06 in size"),
        (table(height=10**400), "height", "it must be a number of m"),
        (table(clearance=float("nan")), "clearance", "it must be a number of m"),
        (table(moves=10**9), "moves", "it must be 1, or 2"),
        (table(moves=10**6000), "moves", "too long to be shown"),
        (table(margin=[0.001 + 1e-6 * k for k in range(1001)]), "margin", "has 1,001 choices; at most 1,000"),
        (table(order=["1,2,3,4"] * 2_000_000), "order", "has 2,000,000 choices"),
        (table(order=[list(range(1000))]), "order", "must name each foot 1 to 4 once"),
        ({"seed": 10**30, **table()}, "seed", "a whole number from 0"),
        ({"robot": "spot", **table()}, "robot", "There is no robot “spot”"),
        ({"kind": "quick", **table()}, "kind", "it must be one of fast, drawn"),
        ({"seed": -1, **table()}, "seed", "a whole number from 0"),
        ({"seed": True, **table()}, "seed", "seed is true; it"),
        ({"seed": "1", **table()}, "seed", 'seed is "1"; it'),
        ({"seed": date(2026, 1, 2), **table()}, "seed", "seed is a date or time (2026-01-02); it"),
        (table(margin=["a", True]), "margin", 'margin is "a"; it must be a number of m'),
        ({"colour": 1, **table()}, "colour", "has the unknown key colour"),
        ({"robot": "deltawalker"}, "vary", "has no table [vary]"),
        ({"kind": "drawn", **table(overlap=[True, False])}, "overlap", "leave it out"),
        ({"kind": "drawn", **table(lost=[7])}, "lost", "it must name limbs 1 to 4, each once"),
    ],
)
def test_what_does_not_fit_is_refused_with_its_key_and_a_remedy(
    content: dict[str, Any], where: str, words: str
) -> None:
    with pytest.raises(InputError) as refusal:
        space_from_table(content, "space.toml")
    assert refusal.value.where == where
    assert words in refusal.value.sentence


@pytest.mark.parametrize("seed", [-1, 2**31, True, "1", 0.5])
def test_another_seed_is_looked_at_too(seed: Any) -> None:
    with pytest.raises(InputError, match=r"seed is .*a whole number from 0"):
        default_space("deltawalker").drawn_by(seed)


def test_what_is_no_toml_is_refused() -> None:
    with pytest.raises(InputError, match=r"space\.toml is no TOML file"):
        space_from_toml("robot = ", "space.toml")
