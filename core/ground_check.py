"""What feet do on the ground and over it: standing, sliding, lifting."""

from __future__ import annotations

import numpy as np

from core.arrays import stretches
from core.checked_plan import CheckedPlan
from core.findings import TOLERANCE, Finding, Outcome, RuleMargin, Severity
from core.manual import stance_slip

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
            worst = first + int(gap[first : last + 1, foot].argmax())
            where = "stand" if t.contact[worst, foot] else "swing"
            sentence = (
                f"Foot {foot + 1} should {where} at {t.times[worst]:.1f} s but is "
                f"{height[worst, foot] * 1000:.1f} mm above the ground. Correct the timeline or the motion."
            )
            value = float(gap[worst, foot])
            findings.append(Finding("contact", Severity.ERROR, sentence, value, CONTACT_LIMIT, worst, foot))
    return Outcome(RuleMargin("contact", CONTACT_LIMIT - float(gap.max()), "m"), tuple(findings))


def check_slip(plan: CheckedPlan) -> Outcome:
    """A foot that stands stays where it is."""
    slips = stance_slip(plan.trajectory.feet_world, plan.trajectory.contact)
    findings = [
        Finding(
            "slip",
            Severity.WARNING,
            f"Foot {foot + 1} slides {slip * 1000:.1f} mm while it stands; more than "
            f"{SLIP_LIMIT * 1000:.1f} mm. An optimised gait keeps standing feet still.",
            float(slip),
            SLIP_LIMIT,
            None,
            foot,
        )
        for foot, slip in enumerate(slips)
        if slip > SLIP_LIMIT
    ]
    return Outcome(RuleMargin("slip", SLIP_LIMIT - float(slips.max()), "m"), tuple(findings))


def check_clearance(plan: CheckedPlan) -> Outcome:
    """A foot that swings rises."""
    t = plan.trajectory
    smallest, findings = np.inf, []
    for foot in range(t.leg_count):
        for first, last in stretches(np.asarray(~t.contact[:, foot])):
            rise = float(t.feet_world[first : last + 1, foot, 2].max())
            smallest = min(smallest, rise - CLEARANCE_LIMIT)
            if rise < CLEARANCE_LIMIT - TOLERANCE:
                sentence = (
                    f"Foot {foot + 1} rises only {rise * 1000:.1f} mm in its swing from "
                    f"{t.times[first]:.1f} s; less than {CLEARANCE_LIMIT * 1000:.0f} mm drags. "
                    "Ask for more clearance."
                )
                findings.append(
                    Finding("clearance", Severity.WARNING, sentence, rise, CLEARANCE_LIMIT, first, foot)
                )
    margin = float(smallest) if np.isfinite(smallest) else 0.0
    return Outcome(RuleMargin("clearance", margin, "m"), tuple(findings))
