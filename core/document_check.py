"""Whether the plan is what its document says: where it goes, how it begins, and what it was made from."""

from __future__ import annotations

import numpy as np

from core.arrays import Floats
from core.checked_plan import CheckedPlan
from core.findings import Finding, Outcome, RuleMargin, Severity

TRAVEL_LIMIT = 0.001
"""A plan that ends further from where the document says is wrong, m."""


def check_travel(plan: CheckedPlan, expected: Floats) -> Outcome:
    """The body ends where the document says."""
    body = plan.trajectory.body_world
    gap = float(np.linalg.norm(body[-1, :2] - body[0, :2] - expected))
    margin = RuleMargin("travel", TRAVEL_LIMIT - gap, "m")
    if gap <= TRAVEL_LIMIT:
        return Outcome(margin)
    sentence = (
        f"The body ends {gap * 1000:.1f} mm from where the gait says; at most {TRAVEL_LIMIT * 1000:.0f} mm "
        "is allowed. Optimise again, or correct the step."
    )
    return Outcome(margin, (Finding("travel", Severity.ERROR, sentence, gap, TRAVEL_LIMIT),))
