"""A request for the fastest gait: its document, and the options that have a price."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from app.fastest.request import Course, FastestRequest, options
from core.errors import InputError
from core.gait.gait import Orientation
from core.pose_gaits.gait_poses import pose_problem
from core.robot.model import load_robot

ASKED = FastestRequest()


def test_a_walk_is_asked_in_its_direction_with_its_limits() -> None:
    request = replace(ASKED, order=(1, 4, 2, 3), heading=math.pi / 4, stop_bound=1.0, margin=0.008, cycles=2)
    problem = pose_problem(request.document(), load_robot("deltawalker"))
    assert (problem.order, problem.cycles, problem.step) == ((1, 4, 2, 3), 2, None)
    assert problem.heading == pytest.approx(math.pi / 4)
    assert (problem.bounds.stop_bound, problem.bounds.margin) == (1.0, 0.008)
    assert request.problem().cycles is None
    assert request.document().name == "Amble, fastest"
    assert request.document("Mine").name == "Mine"


def test_a_step_of_its_own_is_kept_and_a_curve_turns() -> None:
    problem = replace(ASKED, step=0.020, turn=math.radians(10.0)).problem()
    assert problem.step == pytest.approx(0.020)
    assert problem.turn == pytest.approx(math.radians(10.0))
    assert problem.heading == pytest.approx(-math.radians(5.0))  # half of the turn is done in the middle


@pytest.mark.parametrize(("course", "side"), [(Course.LEFT, 1.0), (Course.RIGHT, -1.0)])
def test_a_turn_on_the_spot_is_free_to_its_side(course: Course, side: float) -> None:
    problem = replace(ASKED, course=course).problem()
    assert (problem.on_the_spot, problem.free_turn) == (True, True)
    assert math.copysign(1.0, problem.turn) == side


@pytest.mark.parametrize("turn", [math.radians(15.0), -math.radians(20.0)])
def test_a_rotation_turns_on_the_spot_by_what_is_asked(turn: float) -> None:
    request = replace(ASKED, course=Course.TURN, turn=turn, heading=math.pi / 4)
    problem = request.problem()
    assert (problem.on_the_spot, problem.free_turn, problem.step) == (True, False, 0.0)
    assert problem.turn == pytest.approx(turn)
    assert request.document("Turn").step == pytest.approx((0.0, 0.0, turn))


def test_the_direction_along_x_is_that_of_side_pairs() -> None:
    assert ASKED.document().orientation is Orientation.FBS
    assert replace(ASKED, heading=1e-13).document().orientation is Orientation.FBS
    assert replace(ASKED, heading=math.pi / 4).document().orientation is Orientation.FB


def test_every_option_changes_only_its_own() -> None:
    listed = options(ASKED)
    by_group = {group: [one for one in listed if one.group == group] for group in {o.group for o in listed}}
    counts = {group: len(ones) for group, ones in by_group.items()}
    assert counts == {
        "stop_bound": 4, "margin": 4, "step": 4, "clearance": 3, "sway": 2, "order": 7, "course": 7,
    }  # fmt: skip
    for one in (*by_group["stop_bound"], *by_group["margin"], *by_group["step"]):
        assert one.request == replace(ASKED, **{one.group: one.value})  # type: ignore[arg-type]
    assert {one.name for one in by_group["order"]} == {"C-Gait", "S-Gait", "Walk", "Amble"}


def test_foot_orders_stand_in_the_same_sequence_whichever_is_chosen() -> None:
    def orders(request: FastestRequest) -> list[object]:
        return [one.value for one in options(request) if one.group == "order"]

    usual = orders(ASKED)
    assert orders(replace(ASKED, order=(1, 4, 2, 3), heading=math.pi / 4)) == usual
    own = replace(ASKED, order=(1, 4, 3, 2), heading=math.pi)
    assert orders(own) == [{"order": [1, 4, 3, 2], "heading": math.pi, "overlap": False}, *usual]
    on_the_spot = replace(ASKED, course=Course.LEFT, heading=math.pi / 4)
    assert len(orders(on_the_spot)) == 3


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"robot": "nobody"}, "nobody"),
        ({"order": (1, 2, 3)}, "1 to 4"),
        ({"margin": 0.2}, "margin"),
        ({"stop_bound": 0.1}, "0.8"),
        ({"turn": 4.0}, "turn"),
        ({"course": Course.TURN, "turn": 4.0}, "turn"),
        ({"course": Course.TURN}, "turn"),
        ({"sway": 2.0}, "sway"),
        ({"cycles": 99}, "20"),
    ],
)
def test_what_no_gait_can_have_is_refused(changes: dict[str, object], sentence: str) -> None:
    with pytest.raises(InputError, match=sentence):
        replace(ASKED, **changes).problem()  # type: ignore[arg-type]
