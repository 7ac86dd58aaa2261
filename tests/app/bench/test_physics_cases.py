"""The gaits that the physics is measured by: what is sent of them, and where their bodies lean."""

from __future__ import annotations

from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest

from app.bench.common.cases import Case, all_cases
from app.bench.physics import cases as physics_cases
from app.bench.physics.cases import manual_problem, solved_case, tipping
from app.published.problems import own_problem, published_problem, walker
from app.published.reference import Reference
from core.motion.support_polygon import stability_margins
from core.motion.trajectory import Trajectory
from core.physics.parameters import physics_set
from core.problem.motion_problem import MotionProblem, Workspace
from solver_jobs import SolveStatus
from tests.support.reference import reference_path

PHYSICS = physics_set("published")


def case(name: str) -> Case:
    return next(
        case
        for case in all_cases()
        if case.name == name
        and case.gait.options.workspace is Workspace.STROKE
        and case.gait.options.closing_knots
    )


@cache
def own_walk() -> tuple[float, Trajectory]:
    found = solved_case(case("walk 10 mm"))
    assert found is not None
    return found


def answers(monkeypatch: pytest.MonkeyPatch, largest: float) -> None:
    """In place of the solver: every margin up to one has a motion, the walk's."""

    def verified(problem: MotionProblem, result: object) -> SimpleNamespace:
        has_one = problem.limits.margin <= largest
        status = SolveStatus.SOLVED if has_one else SolveStatus.INFEASIBLE
        return SimpleNamespace(status=status, trajectory=own_walk()[1])

    monkeypatch.setattr(physics_cases, "verify", verified)
    monkeypatch.setattr(physics_cases, "solve_exact", lambda problem: None)


def test_our_own_gait_has_the_largest_margin_that_it_can(monkeypatch: pytest.MonkeyPatch) -> None:
    assert own_walk()[0] == 0.003
    answers(monkeypatch, 0.0024)
    assert solved_case(case("walk 10 mm")) == (0.002, own_walk()[1])
    answers(monkeypatch, -0.001)
    assert solved_case(case("walk 10 mm")) is None


def test_a_gait_made_to_tip_leans_out_in_every_swing_and_ends_as_before() -> None:
    _, motion = own_walk()
    out = tipping(motion)
    margins = stability_margins(out.body_world[:, :2], out.feet_world, out.contact)
    lifted = ~out.contact.all(axis=1)
    assert margins[lifted] == pytest.approx(np.full(lifted.sum(), -0.005), abs=1e-9)
    assert out.body_world[[0, -1]] == pytest.approx(motion.body_world[[0, -1]])
    assert np.array_equal(out.feet_world, motion.feet_world)
    assert own_problem(out, PHYSICS).waypoints.count == motion.knot_count


def test_a_published_gait_is_cut_to_the_motors_range_and_says_by_how_much() -> None:
    reference = Reference(reference_path("trajectories").parent)
    problem, cut = published_problem(reference, "walk", 0.010, PHYSICS)
    assert problem.waypoints.count == 40
    assert problem.waypoints.strokes.min() == walker().stroke.lower
    assert cut == pytest.approx(0.00345, abs=1e-5)
    assert problem.contact.sum() == 40 * 4 - (3 * 5 + 4)


def test_a_gait_by_hand_has_a_waypoint_a_sample() -> None:
    problem = manual_problem("walk", 0, PHYSICS)
    assert problem.waypoints.count == problem.plan.knot_count == 55
