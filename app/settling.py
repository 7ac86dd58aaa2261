"""What an edit carries with it: locks that hold, and timeline and segment table that agree."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from core.errors import StateError
from core.gait import Gait
from core.timeline import ContactTimeline, timeline_from_order


def require_locks(before: Gait, after: Gait) -> None:
    """Locked cells stay as they are until they are unlocked.

    Raises:
        StateError: naming the first locked cell that would change.
    """
    locked = before.timeline.locked
    if not locked.any():
        return
    if after.timeline.stance.shape != locked.shape:
        raise StateError("The timeline has locked cells; unlock them before you draw it anew.", "timeline")
    changed = locked & after.timeline.locked & (before.timeline.stance != after.timeline.stance)
    if changed.any():
        foot, sample = (int(i) + 1 for i in np.argwhere(changed)[0])
        raise StateError(
            f"Foot {foot}, sample {sample} is locked; unlock it before you change it.", "timeline"
        )


def settle_iterations(before: Gait, after: Gait) -> Gait:
    """Draws a drawn gait's timeline anew where only its number of iterations changed."""
    same_drawing = np.array_equal(before.timeline.stance, after.timeline.stance)
    if after.segment_table is not None or after.iterations == before.iterations or not same_drawing:
        return after
    return replace(after, timeline=drawn_timeline(after))


def drawn_timeline(gait: Gait) -> ContactTimeline:
    """The timeline of a gait's foot order, phase lengths, iterations and direction."""
    return timeline_from_order(
        gait.timeline.leg_count,
        gait.order,
        phase_knots=gait.options.phase_knots,
        closing_knots=gait.options.closing_knots,
        iterations=gait.iterations,
        sample_time=gait.timeline.sample_time,
    ).turned(gait.quarter_turns)


def settle_table(before: Gait, after: Gait) -> tuple[Gait, str | None]:
    """Brings segment table and timeline of an edited gait into agreement.

    Where only the table, direction or iterations changed, the timeline follows. Where the timeline was
    drawn by hand, the table no longer says what is drawn and is set aside.

    Returns:
        The gait, and a sentence where the table was set aside.
    """
    table = after.segment_table
    if table is None:
        return after, None
    repeated = table.repeated(after.iterations).turned(after.quarter_turns)
    implied = repeated.timeline(after.timeline.sample_time)
    if np.array_equal(after.timeline.stance, implied.stance):
        return after, None
    if before.segment_table is not None and np.array_equal(after.timeline.stance, before.timeline.stance):
        return replace(after, timeline=implied), None
    notice = (
        "The segment table cannot say what you drew, so it was set aside and the gait is now a drawn one. "
        "Undo brings the table back."
    )
    return replace(after, segment_table=None), notice
