"""Gaits from recorded motions: order, direction, step and iterations are those of the published gait."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.errors import InputError
from core.gait.gait import Orientation, heading_step
from core.library.library import library
from core.motion.contact_timeline import ContactTimeline, timeline_from_rows
from core.motion.trajectory import Trajectory
from core.recorded.recorded_gait import STANDS_AT_LAST, gait_of_motion, gait_of_timeline
from core.wire.trajectory_csv import parse_trajectory_csv
from tests.support.reference import reference_path

ORDERS = {"walk": (3, 2, 4, 1), "ambl": (3, 1, 4, 2), "mtri": (1, 2, 4, 3), "adjs": (1, 2, 3, 4)}


def published(direction: int, name: str) -> Trajectory:
    path = reference_path(f"trajectories/direction{direction}/{name}.csv")
    return parse_trajectory_csv(path.read_text(), path.name).trajectory


@pytest.mark.parametrize("direction", [1, 2, 3, 4])
@pytest.mark.parametrize("family", list(ORDERS))
def test_a_published_trajectory_becomes_the_gait_that_made_it(direction: int, family: str) -> None:
    described = gait_of_motion(published(direction, f"{family}_b"), "b")
    gait = described.gait
    orientation = Orientation.FB if family in ("walk", "ambl") else Orientation.FBS
    assert (gait.orientation, gait.direction, gait.order) == (orientation, direction, ORDERS[family])
    assert gait.step == pytest.approx(heading_step(orientation, 0.015), abs=1e-4)
    assert (gait.iterations, gait.timeline.sample_count, gait.timeline.sample_time) == (1, 40, 0.4)
    assert described.remarks == (STANDS_AT_LAST,)
    assert gait.notes == STANDS_AT_LAST


@pytest.mark.parametrize("name", ["walk_e", "mtri_e"])
def test_three_iterations_are_counted(name: str) -> None:
    gait = gait_of_motion(published(1, name), name).gait
    assert gait.iterations == 3
    assert np.hypot(*gait.step[:2]) == pytest.approx(0.02, abs=1e-4)


@pytest.mark.parametrize("gait_id", ["walk", "s-gait"])
@pytest.mark.parametrize("quarter_turns", [0, 1, 2, 3])
def test_a_turned_timeline_keeps_the_order_of_its_own_feet(gait_id: str, quarter_turns: int) -> None:
    gait = library()[gait_id].gait
    described = gait_of_timeline(gait.timeline.turned(quarter_turns), "turned").gait
    own = tuple((foot - 1 + quarter_turns) % 4 + 1 for foot in gait.order)
    assert (described.order, described.direction, described.step) == (own, 1, (0.0, 0.0, 0.0))


def test_feet_that_never_step_are_said() -> None:
    described = gait_of_timeline(timeline_from_rows(["11111", "11111", "10111", "11101"], 0.4), "two step")
    assert described.gait.order == (3, 4, 1, 2)
    assert "Foot 1, 2 never steps" in described.gait.notes


def test_feet_without_one_order_are_said() -> None:
    described = gait_of_timeline(timeline_from_rows(["10101", "11111", "11101", "10111"], 0.4), "mixed")
    assert described.gait.iterations == 1
    assert "Foot 2 never steps" in described.gait.notes
    uneven = gait_of_timeline(timeline_from_rows(["10101", "11011", "11101", "10111"], 0.4), "mixed")
    assert "do not step in one order" in uneven.gait.notes


def test_uneven_intervals_are_refused_by_knot() -> None:
    times = np.array([0.0, 0.4, 0.8, 1.3])
    motion = Trajectory(
        times, np.zeros((4, 3)), np.zeros(4), np.zeros((4, 4, 3)), np.ones((4, 4), dtype=np.bool_)
    )
    with pytest.raises(InputError, match=r"from sample 3 to 4 is 0.5 s, the first one 0.4 s"):
        gait_of_motion(motion, "uneven")
    even = replace(motion, times=np.array([0.0, 0.4, 0.8, 1.2]))
    assert gait_of_motion(even, "even").gait.timeline.sample_time == 0.4


def test_a_robot_with_another_number_of_feet_is_refused() -> None:
    stance = np.ones((5, 4), dtype=np.bool_)
    with pytest.raises(InputError, match="has 5 feet; the robots here have 4, 6, 12"):
        gait_of_timeline(ContactTimeline(stance, np.zeros_like(stance), 0.4), "five")
