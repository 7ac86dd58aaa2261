"""The search for many motions at once: its slopes, its answers, and that company does not change them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.atlas.row import RowStatus, results_hash
from core.atlas.space import AtlasSpace, default_space, space_from_table
from core.pose_gaits.pose_check import check_poses
from core.pose_gaits.pose_problem import PoseBounds, PoseProblem
from core.robot.model import load_robot
from solver_jobs.atlas.convex_step import ConvexStep
from solver_jobs.atlas.draw import drawn_points
from solver_jobs.atlas.evaluate import evaluated, evaluated_points, pose_gaits
from solver_jobs.atlas.layout import MM, Asked, Layout
from solver_jobs.atlas.postures import Postures
from solver_jobs.atlas.rows import all_rows
from solver_jobs.atlas.search import Search

MODEL = load_robot("deltawalker")


def asked(step: float = 30.0, turn: float = 0.2, heading: float = 0.4) -> Asked:
    values = (heading, step, turn, 57.0, 3.0, 6.0, 7.475)
    return Asked(*(np.array([value]) for value in values))


@pytest.mark.parametrize("overlap", [False, True])
def test_slopes_of_every_row_are_those_of_small_changes(overlap: bool) -> None:
    model = load_robot("hexapod") if overlap else MODEL
    order = (1, 4, 2, 5, 3, 6) if overlap else (1, 3, 2, 4)
    one = asked()
    problem = PoseProblem(model, order, 0.4, step=0.03, turn=0.2, overlap=overlap, bounds=PoseBounds(0.003))
    layout = Layout(problem)
    postures = Postures(layout, one)
    rng = np.random.default_rng(1)
    unknowns = layout.start(one) + rng.normal(size=(1, layout.unknowns))

    def rooms(at: np.ndarray) -> dict[str, np.ndarray]:
        poses = postures.poses(at)
        rows = all_rows(postures, PoseBounds(), poses, postures.within(poses))
        return {f"{number} {row.limit}": row.room[0] for number, row in enumerate(rows)}

    poses = postures.poses(unknowns)
    families = all_rows(postures, PoseBounds(), poses, postures.within(poses))
    change = rng.normal(size=(1, layout.unknowns))
    size = 1e-5
    after, before = rooms(unknowns + size * change), rooms(unknowns - size * change)
    for number, row in enumerate(families):
        slopes = np.broadcast_to(row.slopes, (1, *row.slopes.shape[1:]))[0]
        name = f"{number} {row.limit}"
        measured = (after[name] - before[name]) / (2 * size)
        assert slopes @ change[0] == pytest.approx(measured, abs=1e-4), name


def test_arms_that_the_check_finds_too_near_are_brought_apart_alone_as_in_a_group() -> None:
    space = default_space("deltawalker")
    points = drawn_points(space, 140, 12)
    (near,) = [point for point in points if point.number == 147]
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(Search, "with_arms_farther", lambda search, found, places, distance: found)
        (before,) = evaluated_points(space, [near])
    assert (before.status, "The arms of legs" in before.reason) == (RowStatus.FAILED, True)
    (alone,) = evaluated_points(space, [near])
    assert alone.status is RowStatus.SOLVED
    grouped = {row.number: row for row in evaluated_points(space, points)}
    assert results_hash([grouped[147]]) == results_hash([alone])


def test_a_step_keeps_its_rows_or_misses_both_kinds_by_the_least() -> None:
    rng = np.random.default_rng(2)
    slopes = rng.normal(size=(300, 12))
    collides = np.arange(300) % 7 == 0
    solver = ConvexStep(12, 300)
    found = solver.solve(np.eye(12), rng.normal(size=12), np.full(300, 0.5), slopes, collides, 5.0)
    assert found is not None
    assert found.missed == pytest.approx(0.0, abs=1e-6)
    assert (0.5 + slopes @ found.change).min() > -1e-4
    # x at least 1 and at most 0.4: both are missed by 0.3.
    room, rows = np.full(300, 9.0), np.zeros((300, 12))
    room[:2], rows[0, 0], rows[1, 0] = (-1.0, 0.4), 1.0, -1.0
    apart = solver.solve(np.eye(12), np.zeros(12), room, rows, np.zeros(300, dtype=np.bool_), 5.0)
    assert apart is not None
    assert apart.missed == pytest.approx(0.3, abs=1e-3)
    assert apart.change[0] == pytest.approx(0.7, abs=1e-3)


@pytest.fixture(scope="module")
def space() -> AtlasSpace:
    return default_space("deltawalker")


def test_gait_k_is_the_same_however_many_are_drawn(space: AtlasSpace) -> None:
    many = drawn_points(space, 0, 40)
    assert drawn_points(space, 33, 3) == many[33:36]
    assert len({point.step_x for point in many}) == 40


@pytest.mark.heavy
def test_solved_gaits_are_confirmed_and_are_what_was_asked(space: AtlasSpace) -> None:
    points = drawn_points(space, 0, 40)
    rows = {row.number: row for row in evaluated(space, 0, 40)}
    assert sorted(rows) == list(range(40))
    solved = [point for point in points if rows[point.number].status is RowStatus.SOLVED]
    assert len(solved) >= 8
    for point in solved[:6]:
        ((gait, row),) = pose_gaits(space, [point])
        assert gait is not None
        assert row.agrees_with(rows[point.number])
        assert check_poses(gait, samples=81).confirmed
        assert gait.problem.order == point.order
        assert gait.step == pytest.approx(point.step)
        assert gait.turn == pytest.approx(point.turn)
        assert row.least_margin >= point.margin - 1e-4
        assert row.speed == pytest.approx(point.step / gait.seconds)
        assert gait.bodies[:, 2].mean() == pytest.approx(point.height, abs=0.0021)


@pytest.mark.heavy
def test_rows_do_not_depend_on_how_they_are_grouped(space: AtlasSpace) -> None:
    points = drawn_points(space, 100, 24)
    together = evaluated_points(space, points)
    apart = [row for point in points for row in evaluated_points(space, [point])]
    assert all(one.agrees_with(two) for one, two in zip(together, apart, strict=True))
    assert results_hash(evaluated_points(space, points)) == results_hash(together)


def test_a_long_step_is_infeasible_and_names_what_prevents_it(space: AtlasSpace) -> None:
    point = replace(drawn_points(space, 0, 1)[0], step_x=0.09, step_y=0.0)
    (row,) = evaluated_points(space, [point])
    assert row.status is RowStatus.INFEASIBLE
    assert row.reason.startswith("Prevented by: ")
    assert np.isnan(row.speed)


def test_drawn_gaits_have_rows_too() -> None:
    space = space_from_table(
        {
            "robot": "hexapod",
            "kind": "drawn",
            "vary": {"order": "all", "step_x": [0.005, 0.02], "lost": ["", "2"], "margin": 0.003},
        },
        "a file",
    )
    rows = evaluated(space, 0, 6)
    solved = [row for row in rows if row.status is RowStatus.SOLVED]
    assert solved
    for row in solved:
        point = drawn_points(space, row.number, 1)[0]
        assert row.speed * row.seconds == pytest.approx(point.step_x, rel=1e-6)
        assert row.least_margin >= 0.003 - 1e-6
    assert PoseBounds().margin * MM == 6.0
