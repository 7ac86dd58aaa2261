"""What a gait's motion comes from."""

from enum import StrEnum

from core.gait.gait import Gait, is_drawn


class MotionSource(StrEnum):
    """What a gait's motion comes from."""

    RECORDED = "recorded"
    """The motion of a file."""
    SEQUENCE = "sequence"
    """Other gaits, one after the other."""
    POSES = "poses"
    """Poses for the robot's clock."""
    MANUAL = "manual"
    """A segment table."""
    OPTIMISED = "optimised"
    """A timeline drawn from foot order and phases, for the optimiser."""
    DRAWN = "drawn"
    """A timeline drawn by hand, for the optimiser too."""


def motion_source(gait: Gait) -> MotionSource:
    """What a gait's motion comes from."""
    if gait.sequence:
        return MotionSource.SEQUENCE
    if gait.recorded is not None:
        return MotionSource.RECORDED
    if gait.poses is not None:
        return MotionSource.POSES
    if gait.segment_table is not None:
        return MotionSource.MANUAL
    return MotionSource.OPTIMISED if is_drawn(gait) else MotionSource.DRAWN
