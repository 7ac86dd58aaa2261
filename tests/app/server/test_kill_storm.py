"""Kill −9 at random moments of everything: nothing acknowledged is lost, and nothing resumes by itself.

`FOOTFALL_STORM_SEED` repeats an earlier storm, as far as threads can be; `FOOTFALL_STORM_KILLS` is how many.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator

import pytest

from app.emulator.emulated_robot import EmulatedRobot
from tests.support.soak import seed_of, soaked
from tests.support.storm.storm import Storm

pytestmark = pytest.mark.soak

SPEED = 10.0
"""Seconds of the emulated robot in a second."""
KILLS = soaked(200, 20, "FOOTFALL_STORM_KILLS")
PARTS = 5
"""In which they come, each within the time that a test may take on a busy machine."""
ENOUGH = 100
"""So many kills come upon actions of every kind."""
EACH = ("edit", "save", "approval", "job start", "run under way")
"""Kinds of action that some kill must have come upon."""


@pytest.fixture(scope="module")
def storm(robot: EmulatedRobot, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Storm]:
    seed = seed_of("FOOTFALL_STORM_SEED")
    storm = Storm(tmp_path_factory.mktemp("storm"), robot, seed)
    try:
        storm.prepare()
        yield storm
    finally:
        sys.stdout.write(f"\nFOOTFALL_STORM_SEED={seed}\n{storm.report.text()}")
        storm.close()


@pytest.mark.parametrize("part", range(1, PARTS + 1))
def test_nothing_acknowledged_is_lost_and_nothing_resumes(storm: Storm, part: int) -> None:
    while storm.report.kills < KILLS * part // PARTS:
        storm.round()


def test_kills_came_upon_actions_of_every_kind(storm: Storm) -> None:
    storm.finish()
    report = storm.report
    assert report.there > 0
    assert report.kills < ENOUGH or report.not_there > 0
    missed = [kind for kind in EACH if not report.in_flight[kind]]
    assert report.kills < ENOUGH or missed == []
