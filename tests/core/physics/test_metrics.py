"""The figures of a run: known motions give known figures."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core.physics.metrics import FALL_TILT, LOAD, report, rotations, tilts
from core.physics.problem import Rig
from tests.support import synthetic_motions as made
from tests.support.synthetic_motions import PLANNED, PROBLEM


def test_a_run_as_planned_has_no_error() -> None:
    figures = report(PROBLEM, PLANNED)
    assert figures.body_error == pytest.approx(0.0, abs=1e-15)
    assert figures.feet_mean_error == pytest.approx(0.0, abs=1e-15)
    assert figures.distance == pytest.approx(0.004)
    assert figures.planned_distance == pytest.approx(0.004)
    assert figures.way.gap == pytest.approx(0.0, abs=1e-12)
    assert (figures.max_tilt, figures.heading, figures.slip.sum(), figures.saturation.max()) == (0, 0, 0, 0)
    assert not figures.fell
    assert figures.fell_time is None
    assert figures.arrival_times.tolist() == [0.0, 0.5, 1.0, 1.5, 2.0]
    assert figures.realtime_factor == pytest.approx(20.0)


def test_a_shift_of_all_is_the_error_of_all_and_no_slip() -> None:
    shift = np.array([0.003, 0.0, 0.004])
    moved = replace(PLANNED, body_world=PLANNED.body_world + shift, feet_world=PLANNED.feet_world + shift)
    figures = report(PROBLEM, moved)
    assert figures.body_error == pytest.approx(0.005)
    assert figures.feet_error == pytest.approx(np.full(4, 0.005))
    assert figures.distance == pytest.approx(0.004)
    assert figures.slip.tolist() == [0.0] * 4


def test_errors_count_at_arrivals_only_and_each_foot_by_itself() -> None:
    feet = PLANNED.feet_world.copy()
    feet[made.EACH // 2, 0] += 0.05
    feet[PLANNED.arrivals[2], 1, 2] += 0.010
    figures = report(PROBLEM, replace(PLANNED, feet_world=feet))
    assert figures.feet_error == pytest.approx([0.0, 0.010 / made.KNOTS, 0.0, 0.0], abs=1e-15)
    assert figures.feet_mean_error == pytest.approx(0.010 / made.KNOTS / 4)


def test_the_mean_is_of_distances_and_not_of_squares() -> None:
    feet = PLANNED.feet_world.copy()
    feet[PLANNED.arrivals[1], 0, 2] += 0.001
    feet[PLANNED.arrivals[2], 0, 2] += 0.003
    assert report(PROBLEM, replace(PLANNED, feet_world=feet)).feet_error[0] == pytest.approx(
        0.004 / made.KNOTS
    )


@given(st.floats(0.0, 1.5), st.floats(-3.0, 3.0))
def test_tilt_is_the_lean_whatever_the_heading(lean: float, heading: float) -> None:
    about_z = np.array([[np.cos(heading / 2), 0.0, 0.0, np.sin(heading / 2)]])
    half = lean / 2
    w, z = about_z[0, 0], about_z[0, 3]
    both = np.array([[w * np.cos(half), w * np.sin(half), z * np.sin(half), z * np.cos(half)]])
    assert tilts(rotations(both))[0] == pytest.approx(lean, abs=1e-9)
    matrix = rotations(both)[0]
    assert matrix @ matrix.T == pytest.approx(np.eye(3), abs=1e-12)


def test_a_lean_has_its_size_and_time_and_slides_no_sole() -> None:
    angle = np.zeros(len(PLANNED.times))
    angle[17] = np.radians(4.0)
    figures = report(PROBLEM, made.leaning(PLANNED, angle))
    assert figures.max_tilt == pytest.approx(np.radians(4.0))
    assert figures.max_tilt_time == pytest.approx(0.85)
    assert not figures.fell
    assert figures.slip == pytest.approx(np.zeros(4), abs=1e-12)


def test_a_robot_that_tips_over_has_fallen_from_then_on() -> None:
    angle = np.linspace(0.0, 2 * FALL_TILT, len(PLANNED.times))
    figures = report(PROBLEM, made.leaning(PLANNED, angle))
    assert figures.fell
    assert figures.fell_time == pytest.approx(1.0, abs=0.06)


def test_a_body_on_the_floor_has_fallen_though_it_lies_level() -> None:
    body = PLANNED.body_world.copy()
    body[20:, 2] = made.MODEL.com_height + 0.020
    figures = report(PROBLEM, replace(PLANNED, body_world=body))
    assert figures.fell
    assert figures.fell_time == pytest.approx(1.0)


def test_a_floating_robot_does_not_fall() -> None:
    problem = made.problem_of(made.walking_plan(), rig=Rig.FLOATING)
    assert not report(problem, made.leaning(PLANNED, np.full(len(PLANNED.times), 2 * FALL_TILT))).fell


def test_a_clamped_robots_feet_are_compared_in_the_bodys_frame() -> None:
    still = np.tile(PLANNED.body_world[0], (len(PLANNED.times), 1))
    feet = PLANNED.feet_world - (PLANNED.body_world - still)[:, None]
    clamped = replace(PLANNED, body_world=still, feet_world=feet)
    assert report(made.problem_of(made.walking_plan(), rig=Rig.CLAMPED), clamped).feet_error == pytest.approx(
        np.zeros(4), abs=1e-12
    )
    assert report(PROBLEM, clamped).feet_error.min() > 0.001


def test_heading_is_the_turn_from_the_first_to_the_last_arrival_beyond_half_a_turn() -> None:
    figures = report(PROBLEM, made.turned(PLANNED, np.linspace(0.1, 3.6, len(PLANNED.times))))
    assert figures.heading == pytest.approx(3.5)
    assert figures.planned_heading == 0.0


def test_a_known_slip_is_in_its_move_and_its_foot() -> None:
    slid = report(PROBLEM, made.sliding(PLANNED, 2, made.EACH + 2, made.EACH + 8, 0.0015))
    assert slid.slip == pytest.approx([0.0, 0.0, 0.0015, 0.0], abs=1e-12)
    assert slid.slip_samples[2, 2] == pytest.approx(0.0015)


def test_to_and_fro_is_a_way_of_both() -> None:
    there = made.sliding(PLANNED, 0, 3, 6, 0.001)
    back = made.sliding(there, 0, 15, 18, -0.001)
    assert report(PROBLEM, back).slip[0] == pytest.approx(0.002)


def test_a_foot_in_swing_or_without_load_does_not_slip() -> None:
    slid = made.sliding(PLANNED, 1, 2, 8, 0.004)
    standing = np.array(PROBLEM.standing)
    standing[1, 1] = False
    assert report(made.problem_of(made.walking_plan(), standing), slid).slip[1] == 0.0
    forces = PLANNED.ground_forces.copy()
    forces[:, 1, 2] = LOAD / 2
    assert report(PROBLEM, replace(slid, ground_forces=forces)).slip[1] == 0.0


@pytest.mark.parametrize(("first", "last"), [(1, 3), (2, 2)])
def test_a_foot_s_load_in_its_swing_is_a_share_of_that_swing(first: int, last: int) -> None:
    lifted = made.swinging(PROBLEM, 1, first, last)
    assert report(lifted, PLANNED).swing_load.tolist() == [0.0, 1.0, 0.0, 0.0]
    middle = (first + last) * made.EACH // 2
    forces = PLANNED.ground_forces.copy()
    forces[:middle, 1, 2] = LOAD / 2
    loads = report(lifted, replace(PLANNED, ground_forces=forces))
    assert loads.swing_load[1] == pytest.approx(0.5, abs=0.07)
    assert loads.swing_load_times[1] == pytest.approx(PLANNED.times[middle])
    forces[middle:, 1, 2] = LOAD / 2
    assert report(lifted, replace(PLANNED, ground_forces=forces)).swing_load[1] == 0.0


def test_a_swing_that_was_not_reached_carries_nothing() -> None:
    short = replace(PLANNED, arrivals=PLANNED.arrivals[:2], ended_early="it fell")
    assert report(made.swinging(PROBLEM, 1, 2, 3), short).swing_load[1] == 0.0


def test_the_margin_is_to_the_edge_of_the_feet_that_carry_load() -> None:
    forces = PLANNED.ground_forces.copy()
    forces[25:, 2] = 0.0
    centre = PLANNED.centre_world.copy()
    centre[:, 0] = 0.001
    centre[34, 0] = -0.002
    figures = report(PROBLEM, replace(PLANNED, ground_forces=forces, centre_world=centre))
    assert figures.min_margin == pytest.approx(-0.002)
    assert figures.min_margin_time == pytest.approx(1.7)


def test_a_foot_that_hands_over_bears_for_a_moment_longer() -> None:
    forces = PLANNED.ground_forces.copy()
    forces[10:12, 2] = 0.0
    centre = PLANNED.centre_world.copy()
    centre[:, 0] = -0.002
    away = replace(PLANNED, ground_forces=forces, centre_world=centre)
    assert report(PROBLEM, away).min_margin == pytest.approx(0.038 / np.sqrt(2))
    forces[10:20, 2] = 0.0
    assert report(PROBLEM, replace(away, ground_forces=forces)).min_margin == pytest.approx(-0.002)


def test_no_margin_is_known_where_two_feet_carry() -> None:
    forces = PLANNED.ground_forces.copy()
    forces[:, [0, 2]] = 0.0
    figures = report(PROBLEM, replace(PLANNED, ground_forces=forces))
    assert figures.min_margin is None
    assert figures.min_margin_time is None


def test_a_motors_lag_and_its_force_have_their_times() -> None:
    strokes, forces = PLANNED.strokes.copy(), PLANNED.motor_forces.copy()
    strokes[12, 3, 1] -= 0.0004
    forces[5:9, 0, 2] = -PROBLEM.physics.motor_force
    figures = report(PROBLEM, replace(PLANNED, strokes=strokes, motor_forces=forces))
    assert figures.motor_error[3, 1] == pytest.approx(0.0004)
    assert figures.motor_error_times[3, 1] == pytest.approx(0.6)
    assert figures.saturation[0, 2] == pytest.approx(4 / 41)
    assert figures.saturation.sum() == pytest.approx(4 / 41)
    assert figures.peak_forces[0, 2] == PROBLEM.physics.motor_force
    assert figures.peak_force_times[0, 2] == pytest.approx(0.25)


def test_a_weak_motor_is_at_its_own_limit() -> None:
    weak = replace(PROBLEM, physics=replace(PROBLEM.physics, weak_motor=4, weak_share=0.5))
    forces = np.full_like(PLANNED.motor_forces, PROBLEM.physics.motor_force / 2)
    share = report(weak, replace(PLANNED, motor_forces=forces)).saturation
    assert share[1, 1] == 1.0
    assert share.sum() == 1.0


def test_a_run_that_fell_at_its_first_sample_has_figures_too() -> None:
    rows: dict[str, Any] = {
        name: value[:1] for name, value in vars(PLANNED).items() if isinstance(value, np.ndarray)
    }
    first = replace(PLANNED, ended_early="it fell", **rows)
    figures = report(PROBLEM, first)
    assert (figures.distance, figures.slip.tolist()) == (0.0, [0.0] * 4)


def test_a_run_that_ended_early_is_judged_by_what_was_reached() -> None:
    short = replace(PLANNED, arrivals=PLANNED.arrivals[:3], ended_early="it fell")
    figures = report(PROBLEM, short)
    assert figures.distance == pytest.approx(0.002)
    assert figures.planned_distance == pytest.approx(0.002)
    assert figures.slip_samples.shape == (made.KNOTS, 4)
    assert figures.ended_early == "it fell"
