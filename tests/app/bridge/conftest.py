"""A robot for each test of the bridge's session."""

from __future__ import annotations

import pytest

from tests.support.virtual_robot import VirtualRobot


@pytest.fixture
def robot() -> VirtualRobot:
    return VirtualRobot()
