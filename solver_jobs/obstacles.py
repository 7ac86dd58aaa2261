"""What rules a motion out before any search: proofs from the bounds alone, each with its sentence."""

from __future__ import annotations

import numpy as np

from core.motion_problem import missing_support
from core.support import GRAVITY
from solver_jobs.constraint import Box, Situation
from solver_jobs.diagnosis import knot_ranges
from solver_jobs.variables import MM
from solver_jobs.words import FAMILY_WORDS, REMEDIES

SLACK = 1e-9
"""Numbers may differ by this much, m, before something is called impossible."""


def obstacles(situation: Situation, box: Box) -> tuple[str, ...]:
    """Sentences for everything that no motion can get round; empty where nothing is in the way."""
    if (falling := _falling(situation)) is not None:
        return (falling,)
    looks = (
        _no_area(situation),
        _contradictions(situation, box),
        _short_swings(situation),
        _far_feet(situation),
        _far_body(situation),
    )
    return tuple(sentence for look in looks for sentence in look)


def _falling(situation: Situation) -> str | None:
    """With no foot down the whole robot falls, Σ m a = −M g, faster than any speed limit allows."""
    problem = situation.problem
    floating = tuple(int(k) for k in np.nonzero(~situation.contact[:-1].any(axis=1))[0])
    fastest = max(problem.limits.body_speed, problem.limits.foot_speed)
    if not floating or GRAVITY * problem.timeline.sample_time <= 2 * fastest:
        return None
    return f"No foot stands at {knot_ranges(floating)}, so the robot falls. Keep at least three feet down."


def _no_area(situation: Situation) -> list[str]:
    """With fewer than three feet down the support has no area, and no margin can be kept inside it."""
    sentence = missing_support(situation.problem.timeline, situation.problem.limits.margin)
    return [] if sentence is None else [sentence]


def _contradictions(situation: Situation, box: Box) -> list[str]:
    sentences = []
    for conflict in box.conflicts:
        ends = {0: "the start", situation.problem.knot_count - 1: "the goal"}
        place = ends.get(conflict.knot, f"knot {conflict.knot + 1}")
        sentences.append(
            f"{FAMILY_WORDS[conflict.family].capitalize()} contradicts what is fixed at {place} by "
            f"{conflict.gap * MM:.2f} mm. {REMEDIES[conflict.family]}"
        )
    return sentences


def _short_swings(situation: Situation) -> list[str]:
    """A swing of L knots lifts its middle knot by at most dt·v·(knots to the nearer end + ½)."""
    problem, sentences = situation.problem, []
    for swing in situation.swings:
        half = (swing.last - swing.first) // 2
        reach = problem.timeline.sample_time * problem.limits.foot_speed * (half + 0.5)
        highest = 0.0 if swing.first == swing.last else reach
        if highest < problem.limits.clearance - SLACK:
            sentences.append(
                f"Foot {swing.foot + 1} is in the air at knots {swing.first + 1} to {swing.last + 1}: too "
                f"short to rise {problem.limits.clearance * MM:.1f} mm (at most {highest * MM:.1f} mm at "
                f"{problem.limits.foot_speed * MM:.0f} mm/s). Lengthen the swing or lower the clearance."
            )
    return sentences


def _far_feet(situation: Situation) -> list[str]:
    """A foot travels at most dt·v a knot in the air."""
    problem, sentences = situation.problem, []
    inner = ~situation.contact[1:-1]
    for foot in range(problem.model.leg_count):
        way = float(np.linalg.norm((problem.goal.feet_world - problem.start.feet_world)[foot, :2]))
        count = int(inner[:, foot].sum())
        reach = count * problem.timeline.sample_time * problem.limits.foot_speed
        if way > SLACK and count == 0:
            sentences.append(
                f"Foot {foot + 1} has to travel {way * MM:.1f} mm but never swings. Give it a swing or "
                "leave it where it stands."
            )
        elif way > reach + SLACK:
            sentences.append(
                f"Foot {foot + 1} has to travel {way * MM:.1f} mm but its {count} knots in the air allow "
                f"{reach * MM:.1f} mm at {problem.limits.foot_speed * MM:.0f} mm/s. Lengthen its swing or "
                "shorten the step."
            )
    return sentences


def _far_body(situation: Situation) -> list[str]:
    """The body travels at most dt·v a knot between its resting ends."""
    problem = situation.problem
    way = float(np.linalg.norm(problem.goal.body_world - problem.start.body_world))
    reach = (problem.knot_count - 2) * problem.timeline.sample_time * problem.limits.body_speed
    if way <= reach + SLACK:
        return []
    return [
        f"The body has to travel {way * MM:.1f} mm but {problem.knot_count} knots allow {reach * MM:.1f} mm "
        f"at {problem.limits.body_speed * MM:.0f} mm/s. Lengthen the gait or shorten the step."
    ]
