"""Presolve: proofs from the bounds alone that no motion exists, each with its sentence."""

from __future__ import annotations

import numpy as np

from core.arrays import Floats
from core.motion.contact_timeline import Swing
from core.motion.support_polygon import GRAVITY
from core.problem.initial_guess import rise_times
from core.problem.motion_problem import Boundary, MotionProblem, missing_support
from core.problem.swing_height import is_held
from solver_jobs.nlp.constraint import Box, Situation
from solver_jobs.nlp.diagnosis import knot_ranges
from solver_jobs.nlp.held_obstacles import presolve_held_feet
from solver_jobs.nlp.messages import FAMILY_WORDS, REMEDIES
from solver_jobs.nlp.variables import MM

SLACK = 1e-9
"""Numbers may differ by this much, m, before something is called impossible."""


def presolve(situation: Situation, box: Box) -> tuple[str, ...]:
    """Sentences for everything that no motion can get round; empty where nothing is in the way."""
    if (falling := _falling(situation)) is not None:
        return (falling,)
    looks = (
        _no_area(situation),
        _contradictions(situation, box),
        _short_swings(situation),
        presolve_held_feet(situation.problem),
        _far_feet(situation),
        _far_body(situation),
    )
    return tuple(sentence for look in looks for sentence in look)


def _falling(situation: Situation) -> str | None:
    """With no foot down the whole robot falls, Σ m a = −M g, faster than any speed limit allows."""
    problem = situation.problem
    floating = tuple(int(k) for k in np.nonzero(~situation.contact[:-1].any(axis=1))[0])
    fastest = max(problem.limits.body_speed, problem.limits.foot_speed)
    if not floating or GRAVITY * problem.intervals[list(floating)].max() <= 2 * fastest:
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
    """A foot rests beside its swing, so it rises at most v·(time to the nearer end) from where it stood."""
    problem, sentences = situation.problem, []
    for swing, highest in low_swings(problem, situation.swings):
        sentences.append(
            f"Foot {swing.foot + 1} is in the air at {knot_ranges(tuple(swing.samples))}: too short to rise "
            f"{problem.limits.clearance * MM:.1f} mm (at most {highest * MM:.1f} mm at "
            f"{problem.limits.foot_speed * MM:.0f} mm/s). Lengthen the swing or lower the clearance."
        )
    return sentences


def low_swings(problem: MotionProblem, swings: tuple[Swing, ...]) -> list[tuple[Swing, float]]:
    """Swings that are too short for the clearance, and how high each can rise at most, m.

    None is asked of a foot that is held up before or after its swing.
    """
    found = []
    for swing in swings:
        if is_held(problem, swing):
            continue
        lone = max(swing.first, 1) >= swing.last
        acting = 0.0 if lone else float(rise_times(swing, problem.intervals).max())
        highest = acting * problem.limits.foot_speed + problem.limits.grounded_height
        if highest < problem.limits.clearance - SLACK:
            found.append((swing, highest))
    return found


def _far_feet(situation: Situation) -> list[str]:
    """A foot travels at most v in the time that acts on its knots in the air."""
    problem, sentences = situation.problem, []
    inner = ~situation.contact[1:-1]
    acting = _acting_times(problem)[1:-1]
    for foot in range(problem.model.leg_count):
        way = float(np.linalg.norm((problem.goal.feet_world - problem.start.feet_world)[foot, :2]))
        count = int(inner[:, foot].sum())
        seconds = float(inner[:, foot] @ acting)
        reach = seconds * problem.limits.foot_speed
        if way > SLACK and count == 0:
            sentences.append(
                f"Foot {foot + 1} has to travel {way * MM:.1f} mm but never swings. Give it a swing or "
                "leave it where it stands."
            )
        elif way > reach + SLACK:
            sentences.append(
                f"Foot {foot + 1} has to travel {way * MM:.1f} mm but its {seconds:.1f} s in the air allow "
                f"{reach * MM:.1f} mm at {problem.limits.foot_speed * MM:.0f} mm/s. Lengthen its swing or "
                "shorten the step."
            )
    return sentences


def _far_body(situation: Situation) -> list[str]:
    """The body travels at most v in the time between its ends, where it rests or, in a cycle, goes on."""
    problem = situation.problem
    way = float(np.linalg.norm(problem.goal.body_world - problem.start.body_world))
    acting = _acting_times(problem)
    span = acting.sum() if problem.boundary is Boundary.PERIODIC else acting[1:-1].sum()
    reach = float(span) * problem.limits.body_speed
    if way <= reach + SLACK:
        return []
    return [
        f"The body has to travel {way * MM:.1f} mm but {problem.knot_count} knots allow {reach * MM:.1f} mm "
        f"at {problem.limits.body_speed * MM:.0f} mm/s. Lengthen the gait or shorten the step."
    ]


def _acting_times(problem: MotionProblem) -> Floats:
    """(n,) how long each knot's velocity acts: half of the intervals beside it, s."""
    return np.asarray((np.append(problem.intervals, 0.0) + np.append(0.0, problem.intervals)) / 2)
