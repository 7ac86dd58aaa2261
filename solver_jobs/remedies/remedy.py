"""A remedy: a changed gait with what it gives, and which remedies come first."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from core.gait.gait import Gait
from core.robot.model import RobotModel
from solver_jobs.results.motion import MotionResult

MOST = 4
"""Remedies that a person is offered."""

SHORT_SWING = 4
"""Swings that were made this short or shorter tip more easily."""


class RemedyKind(StrEnum):
    """What a remedy changes."""

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
        return self.found[:MOST]


def nothing_words(gait: Gait) -> str:
    """What a person reads where no change helps, with what stood in the way."""
    kept = []
    if gait.timeline.locked.any():
        kept.append("Locked cells stay as they are, so it is made no longer either: unlock some.")
    if gait.held.any:
        kept.append("Feet that are held up stay up: try it without.")
    if not any(gait.step):
        kept.append("It neither steps nor turns: give it a step.")
    return " ".join(["No change was found that makes it walk.", *kept])


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
    margin = asked.options.margin
    lost_margin = 0.0 if margin == 0 else max(0.0, 1.0 - gait.options.margin / margin)
    low = gait.options.margin < model.margin
    return bool(remedy.caution), low, lost_way + lost_margin + 0.3 * _effort(asked, gait)


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


def order_words(gait: Gait) -> str:
    """The feet in the order of their swings, such as “Feet 3, 2, 4, 1”; short where there are many."""
    swings = sorted(gait.timeline.swings(), key=lambda swing: (swing.first, swing.foot))
    if len(swings) > 8:
        return f"{len(swings)} swings one after the other"
    return "Feet " + ", ".join(str(swing.foot + 1) for swing in swings)
