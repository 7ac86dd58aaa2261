"""The parts of a sequence's plan, as they are shown."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import groupby
from operator import attrgetter

import numpy as np

from app.plans.plan import Plan
from app.plans.planned_part import PlannedPart
from core.gait.chain import Chain, Span
from core.gait.gait import Gait

_MOVE = "The body moves over its standing feet to where the next part begins."
_STEPS = "Feet step to where the next part begins, and the body with them; solved by the live optimiser."


def unplaced_parts(gait: Gait, plans: Sequence[Plan]) -> tuple[PlannedPart, ...]:
    """The parts of a sequence that cannot be put in a row.

    Args:
        gait: the sequence.
        plans: of its runs, as far as they were made.
    """
    return tuple(
        PlannedPart(index, False, part.gait.name, plan.source.value, plan.note, broke_off=plan.broke_off)
        for index, (part, plan) in enumerate(zip(gait.sequence, plans, strict=False))
    )


def placed_parts(gait: Gait, plans: Sequence[Plan], whole: Chain) -> tuple[PlannedPart, ...]:
    """A part with all its copies is one stretch, and the transition before it another.

    Args:
        gait: the sequence.
        plans: of its runs.
        whole: the motion that they were chained into.
    """
    shown = []
    spans = sorted(whole.spans, key=lambda span: (span.part, span.first))
    for part, own in groupby(spans, key=attrgetter("part")):
        stretch = list(own)
        lead = stretch[0] if stretch[0].is_transition else None
        name, plan = gait.sequence[part].gait.name, plans[part]
        if lead is not None:
            feet = _stepping(whole, lead)
            origin = ("steps", _STEPS) if feet else ("move", _MOVE)
            shown.append(replace(_stretch(whole, lead, lead, name, origin), feet=feet))
        first = stretch[1] if lead is not None else stretch[0]
        own_stretch = _stretch(whole, first, stretch[-1], name, (plan.source.value, plan.note))
        shown.append(replace(own_stretch, broke_off=plan.broke_off))
    return tuple(shown)


def _stretch(whole: Chain, first: Span, last: Span, name: str, origin: tuple[str, str]) -> PlannedPart:
    t, knots = whole.trajectory, [first.first, last.last]
    dx, dy = np.diff(t.body_world[knots, :2], axis=0)[0]
    return PlannedPart(
        part=first.part,
        is_transition=first.is_transition,
        name=name,
        source=origin[0],
        note=origin[1],
        first=first.first,
        last=last.last,
        travel=(float(dx), float(dy)),
        turn=float(np.diff(t.heading[knots])[0]),
        duration=float(np.diff(t.times[knots])[0]),
    )


def _stepping(whole: Chain, span: Span) -> tuple[int, ...]:
    stands = whole.trajectory.contact[span.first : span.last + 1].all(axis=0)
    return tuple(int(foot) for foot in np.nonzero(~stands)[0])
