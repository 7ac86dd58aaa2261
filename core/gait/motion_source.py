"""How a gait is made, in a word: what says its motion."""

from __future__ import annotations

from enum import StrEnum

import numpy as np

from core.gait.gait import Gait, drawn_timeline


class Making(StrEnum):
    """What a gait's motion comes from."""

    RECORDED = "recorded"
    """The motion of a file."""
    SEQUENCE = "sequence"
    """Other gaits, one after the other."""
    MANUAL = "manual"
    """A segment table."""
    OPTIMISED = "optimised"
    """A timeline drawn from foot order and phases, for the optimiser."""
    DRAWN = "drawn"
    """A timeline drawn by hand, for the optimiser too."""


def making(gait: Gait) -> Making:
    """What a gait's motion comes from."""
    if gait.sequence:
        return Making.SEQUENCE
    if gait.recorded is not None:
        return Making.RECORDED
    if gait.segment_table is not None:
        return Making.MANUAL
    is_drawn_from_order = np.array_equal(gait.timeline.stance, drawn_timeline(gait).stance)
    return Making.OPTIMISED if is_drawn_from_order else Making.DRAWN
