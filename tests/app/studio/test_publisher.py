"""What pages are shown of gaits that change, and of those that go meanwhile."""

from __future__ import annotations

import logging
from pathlib import Path

import pytest

from app.studio.studio import Studio


def test_a_gait_that_is_deleted_before_its_plan_is_known_is_no_failure(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.ERROR):
        studio = Studio(tmp_path, "emulator")
        try:
            studio.call(lambda: studio.publisher.publish_soon("deleted")).result()
            studio.call(lambda: None).result()
        finally:
            studio.close()
    assert not caplog.records
