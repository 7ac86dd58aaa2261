"""The parts of the fit: even points, response surfaces, the line through distances, travels."""

from __future__ import annotations

import numpy as np
import pytest

from core.errors import CheckError
from core.identification.baseline import baseline_left_out
from core.identification.parameters import FIT_PARAMETERS, box, physics_at
from core.identification.surrogate import fit_surrogate, space_filling_points
from core.physics.parameters import physics_set
from core.trials.displacement import motion_displacement, track_displacement
from core.vision.track import FootTrack


def test_points_fill_the_box_evenly_and_a_larger_count_begins_with_a_smaller_one() -> None:
    points = space_filling_points(64, 7)
    assert (space_filling_points(16, 7) == points[:16]).all()
    counts = np.stack([np.histogram(column, 4, (0.0, 1.0))[0] for column in points.T])
    assert counts.min() >= 13
    assert counts.max() <= 19


def test_a_surface_goes_nearly_through_values_that_are_quadratic() -> None:
    low, high = np.full(3, -2.0), np.full(3, 2.0)
    z = 4.0 * space_filling_points(60, 3) - 2.0
    values = np.stack([1.0 + z[:, 0] - 0.5 * z[:, 1] * z[:, 2], z[:, 2] ** 2], axis=1)
    surrogate = fit_surrogate(low, high, z, values, ["Walk", "Amble"])
    assert np.abs(surrogate.at(z) - values).max() < 0.6
    assert surrogate.misfit.max() < 0.3


def test_points_without_an_answer_do_not_count_until_they_are_most() -> None:
    low, high = np.full(2, -2.0), np.full(2, 2.0)
    z = 4.0 * space_filling_points(40, 2) - 2.0
    values, gaits = z.copy(), ["Walk", "Amble"]
    values[:10, 1] = np.nan
    surrogate = fit_surrogate(low, high, z, values, gaits)
    assert surrogate.at(z)[20, 1] == pytest.approx(z[20, 1], abs=0.2)
    values[:30, 1] = np.nan
    with pytest.raises(CheckError, match="25 % of the simulations of “Amble” came to their end"):
        fit_surrogate(low, high, z, values, gaits)


def test_defaults_are_at_zero_and_every_end_of_the_box_is_a_robot() -> None:
    physics = physics_set("scales")
    assert physics_at(physics, np.zeros(len(FIT_PARAMETERS))) == physics
    for ends in box():
        changed = physics_at(physics, ends)
        assert changed.link_stiffness > 900.0
        assert changed.friction > 0.2
        assert changed.cable_drag >= 0.0
        assert changed.backlash >= 0.0
        assert changed.motor_speed > 0.7


def test_a_line_foretells_what_lies_on_it_without_having_seen_it() -> None:
    wanted = np.array([0.03, 0.045, 0.06, 0.075])
    said = baseline_left_out(wanted, 0.5 * wanted + 0.01, [[0], [1], [2, 3]])
    assert said == pytest.approx(0.5 * wanted + 0.01)
    assert baseline_left_out(
        np.full(3, 0.03), np.array([0.02, 0.03, 0.04]), [[0], [1], [2]]
    ) == pytest.approx([0.035, 0.03, 0.025])


def test_a_travel_does_not_depend_on_how_the_motion_lies_in_its_frame() -> None:
    times = np.arange(3.0)
    feet = np.zeros((3, 4, 2)) + np.array([[0.1, 0.0], [0.0, 0.1], [-0.1, 0.0], [0.0, -0.1]])
    feet[1:, :, 0] += 0.01
    once = motion_displacement(times, feet, 1, 0.0, 0.01)
    thrice = motion_displacement(times, feet, 3, 0.0, 0.03)
    assert once.distance == pytest.approx(0.01)
    assert thrice.distance == pytest.approx(0.03)
    turned = feet[..., ::-1] * np.array([1.0, 1.0])
    assert motion_displacement(times, turned, 1, np.pi / 2, 0.01).angle == pytest.approx(0.0, abs=1e-12)
    track = FootTrack(times, feet, np.zeros((3, 4), dtype=np.bool_))
    assert track_displacement(track, -0.1, 0.01).angle == pytest.approx(0.1)
