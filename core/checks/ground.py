"""Rules on feet: standing feet stay on the ground and do not slide; swinging feet rise."""

import numpy as np

from core.arrays import Bools, Floats, first_highest, stretches
from core.checks.checked_plan import CheckedPlan, knot_place
from core.findings import TOLERANCE, Outcome, RuleMargin, Severity, found
from core.gait.manual_motion import stance_slip

SLIP_LIMIT = 0.0005
"""A standing foot that slides further gets a warning, m."""
CLEARANCE_LIMIT = 0.001
"""A swing that rises less gets a warning, m."""
CONTACT_LIMIT = 0.00025
"""How far a standing foot may be from the ground, m (T (3.12) as we use it)."""


def check_contact(plan: CheckedPlan) -> Outcome:
    """A foot that is said to stand is on the ground, and none is below it."""
    t = plan.trajectory
    height = t.feet_world[..., 2]
    gap = np.where(t.contact, np.abs(height), np.maximum(-height, 0.0))
    findings = []
    for foot in range(t.leg_count):
        for first, last in stretches(np.asarray(gap[:, foot] > CONTACT_LIMIT + TOLERANCE)):
            worst = first + int(first_highest(gap[first : last + 1, foot]))
            should = "stand" if t.contact[worst, foot] else "swing"
            side = "above" if height[worst, foot] > 0 else "below"
            value = float(gap[worst, foot])
            words = (
                f"Foot {foot + 1} should {should} at {t.times[worst]:.1f} s but is {value * 1000:.1f} mm "
                f"{side} the ground."
            )
            remedy = "Correct the timeline or the motion."
            place = knot_place(plan, worst)
            findings.append(
                found("contact", Severity.ERROR, words, remedy, value, CONTACT_LIMIT, foot=foot, **place)
            )
    return Outcome(RuleMargin("contact", CONTACT_LIMIT - float(gap.max()), "m"), tuple(findings))


def check_slip(plan: CheckedPlan) -> Outcome:
    """A foot that stands stays where it is; the finding is where it slides most."""
    t = plan.trajectory
    slips, worst = stance_slip(t.feet_world, t.contact), _fastest_slides(t.feet_world, t.contact)
    findings = []
    for foot in np.nonzero(slips > SLIP_LIMIT + TOLERANCE)[0].tolist():
        value, place = float(slips[foot]), knot_place(plan, int(worst[foot]))
        words = (
            f"Foot {foot + 1} slides {value * 1000:.1f} mm while it stands. The limit is "
            f"{SLIP_LIMIT * 1000:.1f} mm."
        )
        remedy = "An optimised gait keeps standing feet still."
        findings.append(found("slip", Severity.WARNING, words, remedy, value, SLIP_LIMIT, foot=foot, **place))
    return Outcome(RuleMargin("slip", SLIP_LIMIT - float(slips.max()), "m"), tuple(findings))


def _fastest_slides(feet_world: Floats, contact: Bools) -> Floats:
    """(legs,) knot before which each foot slides furthest from one knot to the next."""
    both = contact[1:] & contact[:-1]
    moves = np.linalg.norm(np.diff(feet_world[:, :, :2], axis=0), axis=-1) * both
    return np.asarray(first_highest(moves, axis=0) + 1, dtype=np.float64)


def check_clearance(plan: CheckedPlan) -> Outcome:
    """A foot that swings rises."""
    t = plan.trajectory
    smallest, findings = np.inf, []
    for foot in range(t.leg_count):
        for first, last in stretches(np.asarray(~t.contact[:, foot])):
            rise = float(t.feet_world[first : last + 1, foot, 2].max())
            smallest = min(smallest, rise - CLEARANCE_LIMIT)
            if rise < CLEARANCE_LIMIT - TOLERANCE:
                words = (
                    f"Foot {foot + 1} rises only {rise * 1000:.1f} mm in its swing from "
                    f"{t.times[first]:.1f} s. A foot drags below {CLEARANCE_LIMIT * 1000:.0f} mm."
                )
                remedy, place = "Ask for more clearance.", knot_place(plan, first)
                findings.append(
                    found(
                        "clearance",
                        Severity.WARNING,
                        words,
                        remedy,
                        rise,
                        CLEARANCE_LIMIT,
                        foot=foot,
                        **place,
                    )
                )
    margin = float(smallest) if np.isfinite(smallest) else 0.0
    return Outcome(RuleMargin("clearance", margin, "m"), tuple(findings))
