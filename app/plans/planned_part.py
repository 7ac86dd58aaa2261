"""A stretch of a sequence's plan, to be shown."""

from dataclasses import dataclass


@dataclass(frozen=True)
class PlannedPart:
    """A part of a sequence, or the transition that leads to it.

    Args:
        part: which part, 0-based.
        is_transition: whether it is the body's move, or the steps, before that part.
        name: of the part's gait.
        source: how its motion came about; `draft` where there is none.
        note: a sentence on that.
        first: its first knot, 0-based; None where the sequence has no motion.
        last: its last knot, which is also the first one of what follows.
        travel: of the body in the world, m; None where the sequence has no motion.
        turn: of the body, rad.
        duration: s.
        broke_off: whether a solver gave no answer to it.
        feet: those that step in a transition, 0-based; none where only the body moves.
        has_own_motion: whether the gait, run once, has a motion, although its repetitions have none.
    """

    part: int
    is_transition: bool
    name: str
    source: str
    note: str
    first: int | None = None
    last: int | None = None
    travel: tuple[float, float] | None = None
    turn: float | None = None
    duration: float | None = None
    broke_off: bool = False
    feet: tuple[int, ...] = ()
    has_own_motion: bool = False
