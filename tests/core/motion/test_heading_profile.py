"""How the body turns: profiles, and the time that a return takes."""

from __future__ import annotations

import numpy as np
import pytest

from core.errors import InputError
from core.motion.contact_timeline import timeline_from_order
from core.motion.heading_profile import HeadingProfile, heading_profile, return_knots
from core.robot.model import load_robot

ORDER = (3, 2, 4, 1)


def test_a_steady_turn_begins_and_ends_gently() -> None:
    timeline = timeline_from_order(4, ORDER)
    heading = heading_profile(timeline, 0.3, 1, HeadingProfile.STEADY)
    steps = np.diff(heading)
    assert heading[0] == 0.0
    assert heading[-1] == pytest.approx(0.3)
    assert (steps > 0).all()
    assert max(steps[0], steps[-1]) < steps.max() / 5
    np.testing.assert_allclose(heading + heading[::-1], 0.3)


@pytest.mark.parametrize("yaw", [0.3, -0.2])
def test_a_return_turns_only_while_every_foot_stands_after_its_iteration(yaw: float) -> None:
    timeline = timeline_from_order(4, ORDER, iterations=3, closing_knots=8)
    heading = heading_profile(timeline, yaw, 3, HeadingProfile.RETURN)
    turning = np.abs(np.diff(heading)) > 0
    standing = np.array([column.all() for column in timeline.stance.T])
    assert standing[:-1][turning].all()
    assert standing[1:][turning].all()
    for iteration in range(3):
        last_swing = 40 * (iteration + 1) - 1
        assert heading[last_swing] == pytest.approx(yaw * iteration)
    assert heading[-1] == pytest.approx(3 * yaw)


def test_a_return_without_a_closing_stance_is_refused() -> None:
    timeline = timeline_from_order(4, ORDER, closing_knots=2)
    with pytest.raises(InputError, match="has 2 samples; it needs at least 3"):
        heading_profile(timeline, 0.3, 1, HeadingProfile.RETURN)


def test_a_larger_turn_takes_longer_to_return_and_keeps_the_motors_speed() -> None:
    model = load_robot("deltawalker")
    counts = [return_knots(model, np.radians(yaw), 0.0535, 0.1, 3) for yaw in (5, 10, 15)]
    assert counts == sorted(counts)
    assert counts[0] < counts[-1]
    slow = return_knots(model, np.radians(10), 0.0535, 0.2, 3)
    assert slow < counts[1]


def test_a_turn_that_no_leg_reaches_takes_the_least_knots() -> None:
    assert return_knots(load_robot("deltawalker"), np.radians(80), 0.0535, 0.4, 7) == 7
