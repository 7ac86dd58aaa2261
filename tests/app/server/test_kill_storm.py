"""Kill −9 at random moments of everything: nothing acknowledged is lost, and nothing resumes by itself."""

from __future__ import annotations

import os
import random
import sys
from pathlib import Path

import pytest

from app.emulator.emulated_robot import EmulatedRobot
from tests.support.storm.storm import Storm

pytestmark = pytest.mark.heavy

SPEED = 10.0
"""Seconds of the emulated robot in a second."""
KILLS = int(os.environ.get("FOOTFALL_STORM_KILLS", "200"))
SEED = "FOOTFALL_STORM_SEED"
"""Environment variable with the seed of a storm that is to be repeated, as far as threads can be."""
EACH = ("edit", "save", "approval", "job start", "run under way")
"""Kinds of action that some kill must have come upon."""


def test_nothing_acknowledged_is_lost_and_nothing_resumes(robot: EmulatedRobot, tmp_path: Path) -> None:
    seed = int(os.environ.get(SEED, random.SystemRandom().randrange(2**32)))
    storm = Storm(tmp_path, robot, seed)
    try:
        storm.prepare()
        while storm.report.kills < KILLS:
            storm.round()
        storm.finish()
    finally:
        sys.stdout.write(f"{SEED}={seed}\n{storm.report.text()}")
        storm.close()
    assert storm.report.there > 0
    assert storm.report.not_there > 0
    assert [kind for kind in EACH if not storm.report.in_flight[kind]] == []
