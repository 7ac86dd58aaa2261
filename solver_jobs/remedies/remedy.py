"""A remedy: a changed gait with what it gives, and which remedies come first."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from core.gait.gait import Gait
from core.motion.contact_timeline import Swing
from core.robot.model import RobotModel
from solver_jobs.results.motion import MotionResult

MOST_REMEDIES = 4
"""Remedies that a person is offered."""

MOST_NAMED = 8
"""Swings whose feet a sentence names one by one."""

SHORT_SWING = 4
"""Swings that were made this short or shorter tip more easily."""


class RemedyKind(StrEnum):
    """What a remedy changes."""

    MENDED = "mended"
    ONE_BY_ONE = "one_by_one"
    LONGER = "longer"
    COMPLETED = "completed"
    STEP = "step"
    ITERATIONS = "iterations"
    MARGIN = "margin"
    ANEW = "anew"
    WORKSPACE = "workspace"
    HEIGHT = "height"
    CLEARANCE = "clearance"
    NO_MARGIN = "no_margin"


class Trouble(StrEnum):
    """What is wrong with a drawing."""

    SHAPE = "shape"
    """Overlapping swings, short ones, feet without one."""
    STEP = "step"
    MARGIN = "margin"
    TIPS = "tips"
    """It has a motion, but physics says that it does not walk."""


@dataclass(frozen=True, eq=False)
class Remedy:
    """A changed gait that the live tier solves.

    Args:
        kind: what is changed.
        label: text of a button.
        sentence: what it does, and its price.
        gait: the changed document.
        motion: of the changed document.
        caution: why it comes last; empty for every other one.
    """

    kind: RemedyKind
    label: str
    sentence: str
    gait: Gait
    motion: MotionResult
    caution: str = ""


@dataclass(frozen=True, eq=False)
class RemedySearch:
    """What a search for remedies found.

    Args:
        found: best first.
        complete: whether it was not cut short.
        trouble: what is wrong with the gait; None where that was not found out.
    """

    found: tuple[Remedy, ...]
    complete: bool
    trouble: Trouble | None = None

    @property
    def remedies(self) -> tuple[Remedy, ...]:
        """Those that a person is offered, best first."""
        return self.found[:MOST_REMEDIES]


def nothing_words(gait: Gait) -> str:
    """The sentence for a drawing that no change helps, with what limited the search."""
    limits = []
    if gait.timeline.locked.any():
        limits.append(
            "Locked cells were not changed, and a gait with locked cells cannot be made longer: unlock some."
        )
    if gait.held.any:
        limits.append("Held feet stayed in the air: try the gait without them.")
    if not any(gait.step):
        limits.append("The gait neither steps nor turns: give it a step.")
    return " ".join(["No change was found that makes it walk.", *limits])


def rank(asked: Gait, model: RobotModel, remedy: Remedy) -> tuple[bool, bool, float]:
    """Smaller is better: caution and too small a margin last; then what is lost, and how much changes.

    Args:
        asked: the gait before.
        model: its robot.
        remedy: what is offered.
    """
    gait = remedy.gait
    way = way_of(asked)
    lost_way = 0.0 if way == 0 else max(0.0, 1.0 - way_of(gait) / way)
    swings = [len(one.timeline.swings()) / one.iterations for one in (asked, gait)]
    lost_swings = 0.0 if swings[0] == 0 else max(0.0, 1.0 - swings[1] / swings[0])
    margin = asked.options.margin
    lost_margin = 0.0 if margin == 0 else max(0.0, 1.0 - gait.options.margin / margin)
    low = gait.options.margin < model.margin
    return bool(remedy.caution), low, lost_way + lost_swings + lost_margin + 0.3 * _effort(asked, gait)


def _effort(asked: Gait, gait: Gait) -> float:
    """Share of the drawing that changes."""
    before, after = asked.timeline, gait.timeline
    if before.sample_count != after.sample_count:
        return 0.15 + abs(after.sample_count - before.sample_count) / before.sample_count
    changed = int((before.stance != after.stance).sum())
    swings = after.swings()
    lengths = {swing.foot: swing.last - swing.first + 1 for swing in before.swings()}
    short = [s for s in swings if s.last - s.first + 1 <= min(SHORT_SWING, lengths.get(s.foot, 0) - 1)]
    return changed / max(2 * int((~before.stance).sum()), 1) + len(short) / max(len(swings), 1)


def step_length(gait: Gait) -> float:
    """Length of the step, m."""
    return float(np.hypot(*gait.step[:2]))


def way_of(gait: Gait) -> float:
    """How far, m, or how much round, rad, all iterations go."""
    return (step_length(gait) or abs(gait.step[2])) * gait.iterations


def duration_words(gait: Gait) -> str:
    """How long a gait takes as drawn."""
    return f"{(gait.timeline.sample_count - 1) * gait.timeline.sample_time:.1f} s"


def is_one_by_one(gait: Gait) -> bool:
    """Whether no two feet are in the air at once."""
    return all(len(group) == 1 for group in _groups(gait))


def order_words(gait: Gait) -> str:
    """Feet in the order of their swings, such as “Feet 3, 2, 4, 1”, or “Feet 1 + 4, 2 + 3” with overlaps."""
    groups = _groups(gait)
    count = sum(len(group) for group in groups)
    if count <= MOST_NAMED:
        return "Feet " + ", ".join(" + ".join(str(swing.foot + 1) for swing in group) for group in groups)
    return f"{count} swings, " + (
        "one after the other" if count == len(groups) else f"in {len(groups)} groups"
    )


def _groups(gait: Gait) -> list[list[Swing]]:
    """Swings in the order of their first samples; those that overlap in time are one group."""
    groups: list[list[Swing]] = []
    end = -1
    for swing in sorted(gait.timeline.swings(), key=lambda swing: (swing.first, swing.foot)):
        if swing.first > end:
            groups.append([])
        groups[-1].append(swing)
        end = max(end, swing.last)
    return groups
