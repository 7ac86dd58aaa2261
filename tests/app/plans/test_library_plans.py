"""Every gait of the library opens: a plan, what the page is shown of it, and a verdict or its reason."""

from __future__ import annotations

import json

import pytest

from app.gaits.open_gait import fresh_gait
from app.gaits.verdict_views import verdict_view
from app.gaits.views import gait_view
from app.plans.plan import PlanSource, verdict_of
from app.plans.robot_times import robot_times
from app.plans.sequence_plan import plan_of
from core.checks.checked_plan import CheckedPlan
from core.checks.shoes import check_shoes
from core.errors import CheckError
from core.library.library import Group, library
from core.library.robot_times import library_times
from core.robot.shoes import foot_distances, least_distance
from solver_jobs import solve_live

SOURCES = {
    Group.FOR_ROBOT: PlanSource.POSES,
    Group.OPTIMISED: PlanSource.LIVE,
    Group.APPENDIX: PlanSource.LIVE,
    Group.BY_HAND: PlanSource.MANUAL,
    Group.TEXTBOOK: PlanSource.DRAFT,
    Group.PATTERNS: PlanSource.LIVE,
    Group.SEQUENCES: PlanSource.SEQUENCE,
}

OTHERS = {"textbook-crawl": PlanSource.LIVE, "hexapod-front-up": PlanSource.DRAFT}
"""Gaits that differ from their group: a crawl balances, four neighbouring feet of a ring of six do not."""


@pytest.mark.parametrize("gait_id", list(library()))
def test_no_gait_of_the_library_brings_two_shoes_together(gait_id: str) -> None:
    plan = plan_of(library()[gait_id].gait, lambda motion: None, lambda gait: solve_live)
    assert plan.trajectory is not None
    needed = least_distance(plan.model)
    assert needed is not None
    assert foot_distances(plan.trajectory.feet_world).min() > needed
    if plan.way is not None:
        (judged,) = check_shoes(CheckedPlan(plan.model, plan.trajectory, plan.way.waypoints, way=plan.way))
        assert judged.findings == ()


@pytest.mark.parametrize("gait_id", list(library()))
def test_every_gait_of_the_library_opens_and_is_judged(gait_id: str) -> None:
    entry = library()[gait_id]
    plan = plan_of(entry.gait, lambda motion: None, lambda gait: solve_live)
    assert plan.source is OTHERS.get(gait_id, SOURCES[entry.group])
    assert entry.walks is (plan.source is not PlanSource.DRAFT)
    times = None if plan.is_draft else robot_times(plan)
    assert library_times().get(gait_id) == times, "python -m app.plans.library_times finds them anew"
    shown = json.dumps(gait_view(fresh_gait(gait_id, entry.gait, True, None), plan), allow_nan=False)
    assert json.loads(shown)["plan"]["note"]
    if plan.refusal is not None:
        assert entry.group is Group.TEXTBOOK or gait_id == "hexapod-front-up"
        reason = "in the air together" if entry.group is Group.TEXTBOOK else "Balance is"
        with pytest.raises(CheckError, match=reason):
            verdict_of(plan, entry.gait)
        return
    verdict = verdict_of(plan, entry.gait)
    assert json.dumps(verdict_view(verdict), allow_nan=False)
    assert verdict.passed or verdict.findings
    if plan.source in (PlanSource.LIVE, PlanSource.SEQUENCE):
        assert verdict.passed
    if plan.source is PlanSource.DRAFT:
        assert not verdict.passed
