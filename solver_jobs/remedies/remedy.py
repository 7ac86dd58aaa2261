"""A remedy is a changed gait with its motion; the order and the texts of remedies."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from core.gait.gait import Gait
from core.motion.contact_timeline import Swing
from core.robot.model import RobotModel
from solver_jobs.results.motion import MotionResult

MOST_REMEDIES = 4
"""Number of remedies that a person is offered."""

MOST_NAMED = 8
"""Up to this number of swings, a sentence names the foot of each."""

SHORT_SWING = 4
"""Swings that are shortened to this length or less tip more easily, samples."""


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
    """Swings overlap or are too short, or a foot has none."""
    STEP = "step"
    MARGIN = "margin"
    TIPS = "tips"
    """The gait has a motion but does not walk in physics."""


@dataclass(frozen=True, eq=False)
class Remedy:
    """A changed gait that the live tier solves.

    Args:
        kind: what the remedy changes.
        label: text of its button.
        sentence: what it does, and what it costs.
        gait: the changed gait.
        motion: the motion of the changed gait.
        caution: why the remedy ranks last: it may tip, or arms touch; empty for a remedy that does not.
    """

    kind: RemedyKind
    label: str
    sentence: str
    gait: Gait
    motion: MotionResult
    caution: str = ""


@dataclass(frozen=True, eq=False)
class RemedySearch:
    """The result of a search for remedies.

    Args:
        found: the remedies, best first.
        complete: whether the search ran to its end.
        trouble: what is wrong with the gait; None if that is not known.
    """

    found: tuple[Remedy, ...]
    complete: bool
    trouble: Trouble | None = None

    @property
    def remedies(self) -> tuple[Remedy, ...]:
        """The remedies that a person is offered, best first."""
        return self.found[:MOST_REMEDIES]


def nothing_words(gait: Gait) -> str:
    """The text for a drawing without a remedy, with what limited the search."""
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
    """Sort key of a remedy; smaller is better.

    Remedies with a caution come last, and before them those with less than the robot's own margin. The rest
    is sorted by the losses of distance, swings and margin and by how much of the drawing changes.

    Args:
        asked: the gait before the change.
        model: its robot.
        remedy: the remedy to rank.
    """
    gait = remedy.gait
    way = way_of(asked)
    lost_way = 0.0 if way == 0 else max(0.0, 1.0 - way_of(gait) / way)
    swings = [len(one.timeline.swings()) / one.iterations for one in (asked, gait)]
    lost_swings = 0.0 if swings[0] == 0 else max(0.0, 1.0 - swings[1] / swings[0])
    margin = asked.options.margin
    lost_margin = 0.0 if margin == 0 else max(0.0, 1.0 - gait.options.margin / margin)
    low = gait.options.margin < model.margin
    lost = lost_way + lost_swings + lost_margin + 0.3 * _effort(asked, gait)
    return bool(remedy.caution), low, round(lost, 6)


def _effort(asked: Gait, gait: Gait) -> float:
    """How much of the drawing changes, as a share; swings that become short count extra."""
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
    """Distance that all iterations cover, m; for a gait that only turns, the total angle, rad."""
    return (step_length(gait) or abs(gait.step[2])) * gait.iterations


def duration_words(gait: Gait) -> str:
    """Duration of a gait as drawn, as text."""
    return f"{(gait.timeline.sample_count - 1) * gait.timeline.sample_time:.1f} s"


def is_one_by_one(gait: Gait) -> bool:
    """Whether no two feet are in the air at once."""
    return all(len(group) == 1 for group in _groups(gait))


def order_words(gait: Gait) -> str:
    """Feet in the order of their swings: “Feet 3, 2, 4, 1”, or “Feet 1 + 4, 2 + 3” if swings overlap."""
    groups = _groups(gait)
    count = sum(len(group) for group in groups)
    if count <= MOST_NAMED:
        return "Feet " + ", ".join(" + ".join(str(swing.foot + 1) for swing in group) for group in groups)
    return f"{count} swings, " + (
        "one after the other" if count == len(groups) else f"in {len(groups)} groups"
    )


def _groups(gait: Gait) -> list[list[Swing]]:
    """Swings in the order of their first samples; swings that overlap in time form one group."""
    groups: list[list[Swing]] = []
    end = -1
    for swing in sorted(gait.timeline.swings(), key=lambda swing: (swing.first, swing.foot)):
        if swing.first > end:
            groups.append([])
        groups[-1].append(swing)
        end = max(end, swing.last)
    return groups
