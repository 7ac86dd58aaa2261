"""`footfall bench page`: its largest timeline, and what it says where there is no browser to measure in."""

from __future__ import annotations

import os
from pathlib import Path

from app.bench.page.long_timeline import FEET, SAMPLES, long_gait
from app.documents.gait_json import gait_from_content
from core.gait.gait import motion_problem
from core.robot.model import load_robot
from tests.support.studio_process import footfall


def test_without_chromium_the_benchmark_says_what_is_missing(tmp_path: Path) -> None:
    missing = str(tmp_path / "no-chromium")
    ended = footfall("bench", "page", env={**os.environ, "FOOTFALL_CHROMIUM": missing})
    assert ended.returncode == 2
    assert f"Chromium does not start ({missing})" in ended.stderr
    assert "FOOTFALL_CHROMIUM" in ended.stderr


def test_the_largest_timeline_is_a_gait_in_which_every_foot_steps() -> None:
    gait = gait_from_content(long_gait())
    assert gait.timeline.stance.shape == (FEET, SAMPLES)
    assert {swing.foot for swing in gait.timeline.swings()} == set(range(FEET))
    assert motion_problem(gait, load_robot(gait.robot)).timeline == gait.timeline
