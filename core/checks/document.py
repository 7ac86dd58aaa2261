"""Rules that compare a plan with its document: displacement, turn, heights, start pose, provenance."""

import numpy as np

from core.arrays import Floats, first_highest
from core.checks.checked_plan import CheckedPlan, knot_place, plane_heights
from core.findings import TOLERANCE, Finding, Outcome, RuleMargin, Severity, found
from core.gait.held_feet import feet_words

TRAVEL_LIMIT = 0.001
"""A plan that ends further from where the document says is wrong, m."""
TURN_LIMIT = float(np.deg2rad(1.0))
"""A plan that ends turned further from what the document says is wrong, rad."""
HEIGHT_LIMIT = 0.001
"""A plan that begins or ends higher or lower than the document says by more is wrong, m."""
START_FEET = 3
"""So many feet stand in a pose that a robot can be set down in."""


def check_document(plan: CheckedPlan) -> list[Outcome]:
    """Travel, turn, heights and start pose, each where the document says something of it."""
    outcomes = [check_start(plan)]
    if plan.expected_displacement is not None:
        outcomes.append(check_travel(plan, plan.expected_displacement))
    if plan.asked.turn is not None:
        outcomes.append(check_turn(plan, plan.asked.turn))
    if plan.asked.heights is not None:
        outcomes.append(check_height(plan, plan.asked.heights))
    return outcomes


def check_travel(plan: CheckedPlan, expected: Floats) -> Outcome:
    """The body ends where the document says."""
    body = plan.trajectory.body_world
    gap = float(np.linalg.norm(body[-1, :2] - body[0, :2] - expected))
    margin = RuleMargin("travel", TRAVEL_LIMIT - gap, "m")
    if gap <= TRAVEL_LIMIT + TOLERANCE:
        return Outcome(margin)
    words = (
        f"The body ends {gap * 1000:.1f} mm from where the gait says; at most {TRAVEL_LIMIT * 1000:.0f} mm "
        "is allowed."
    )
    remedy, place = "Optimise again, or correct the step.", knot_place(plan, len(body) - 1)
    return Outcome(margin, (found("travel", Severity.ERROR, words, remedy, gap, TRAVEL_LIMIT, **place),))


def check_turn(plan: CheckedPlan, expected: float) -> Outcome:
    """The body ends turned as the document says."""
    heading = plan.trajectory.heading
    gap = abs(float(heading[-1] - heading[0]) - expected)
    margin = RuleMargin("turn", TURN_LIMIT - gap, "rad")
    if gap <= TURN_LIMIT + TOLERANCE:
        return Outcome(margin)
    words = (
        f"The body ends turned {np.degrees(gap):.1f}° from what the gait says; at most "
        f"{np.degrees(TURN_LIMIT):.0f}° is allowed."
    )
    remedy, place = "Optimise again, or correct the turn.", knot_place(plan, len(heading) - 1)
    return Outcome(margin, (found("turn", Severity.ERROR, words, remedy, gap, TURN_LIMIT, **place),))


def check_height(plan: CheckedPlan, expected: tuple[float, float]) -> Outcome:
    """The body begins and ends as high as the document says; between them its height is the motion's own."""
    heights = plane_heights(plan)[[0, -1]]
    gaps = np.abs(heights - expected)
    end = int(first_highest(gaps))
    gap = float(gaps.max())
    margin = RuleMargin("height", HEIGHT_LIMIT - gap, "m")
    if gap <= HEIGHT_LIMIT + TOLERANCE:
        return Outcome(margin)
    words = (
        f"The body {('begins', 'ends')[end]} {heights[end] * 1000:.1f} mm high, where the gait says "
        f"{expected[end] * 1000:.1f} mm; at most {HEIGHT_LIMIT * 1000:.0f} mm is allowed."
    )
    remedy = "Optimise again, or correct the body's height."
    place = knot_place(plan, 0 if end == 0 else plan.trajectory.knot_count - 1)
    return Outcome(margin, (found("height", Severity.ERROR, words, remedy, gap, HEIGHT_LIMIT, **place),))


def check_start(plan: CheckedPlan) -> Outcome:
    """The robot can be set down in the first pose: three feet stand, and only feet that are held do not."""
    standing = plan.trajectory.contact[0]
    count = int(standing.sum())
    margin = RuleMargin("start_pose", float(count - START_FEET), "feet")
    up = tuple(foot for foot in range(1, len(standing) + 1) if not standing[foot - 1])
    if count < START_FEET:
        words = f"The run begins on {count} feet; a robot stands still on {START_FEET} or more."
        remedy = "Begin with feet down."
        place = knot_place(plan, 0)
        return Outcome(
            margin, (found("start_pose", Severity.ERROR, words, remedy, float(count), START_FEET, **place),)
        )
    forgotten = tuple(foot for foot in up if foot not in plan.asked.held.start)
    if not forgotten:
        return Outcome(margin)
    what = "is" if len(forgotten) == 1 else "are"
    words = f"The run begins while {feet_words(forgotten)} {what} in the air, and not held up on purpose."
    remedy = "Begin with the feet down, or say that they are up at the start."
    place = {**knot_place(plan, 0), "foot": forgotten[0] - 1}
    return Outcome(
        margin, (found("start_pose", Severity.WARNING, words, remedy, float(count), START_FEET, **place),)
    )


def check_origin(plan: CheckedPlan) -> list[Finding]:
    """The plan was computed, and from the document as it is."""
    findings = []
    if plan.is_draft:
        words = "This plan is only drawn from the timeline."
        remedy = "Click Optimise and check its result."
        findings.append(found("computed", Severity.ERROR, words, remedy, 0.0, 1.0))
    if not plan.is_fresh:
        words = "This plan was made from another version of the gait than the one that is checked."
        findings.append(found("fresh", Severity.ERROR, words, "Check again.", 0.0, 1.0))
    return findings
