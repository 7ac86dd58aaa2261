"""Every rule that a plan must keep before a person may approve it, in one list; each returns findings."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from core.balance_check import check_balance, check_standing_balance
from core.checked_plan import CheckedPlan
from core.coupling_check import check_coupling
from core.document_check import check_travel
from core.findings import Finding, Outcome, Severity, Verdict
from core.ground_check import CLEARANCE_LIMIT, check_clearance, check_contact, check_slip
from core.motor_check import check_deafness, check_motor_speed, check_strokes
from core.path_check import SLACK_NOTE, check_path, send_costs
from core.robot import RobotModel
from core.waypoints import Waypoints

_RULES = (check_balance, check_contact, check_clearance, check_slip, check_motor_speed)


def check_plan(plan: CheckedPlan) -> Verdict:
    """Every rule on a plan, for exactly these waypoints."""
    rules = (check_strokes(plan.model, plan.knots), check_deafness(plan.waypoints))
    outcomes = [*rules, *(rule(plan) for rule in _RULES)]
    if plan.expected_travel is not None:
        outcomes.append(check_travel(plan, plan.expected_travel))
    if plan.model.is_coupled:
        outcomes.append(check_coupling(plan.model, plan.trajectory, CLEARANCE_LIMIT))
    if plan.way is not None:
        outcomes += check_path(plan.model, plan.trajectory, plan.way)
    findings = [finding for outcome in outcomes for finding in outcome.findings]
    if plan.is_draft:
        findings.append(
            Finding(
                "computed",
                Severity.ERROR,
                "This plan is only drawn from the timeline. Click Optimise and check its result.",
                0.0,
                1.0,
            )
        )
    verdict = _verdict(plan.waypoints, findings, outcomes)
    if plan.way is None:
        return verdict
    costs = send_costs(plan.model, plan.trajectory, plan.way)
    return replace(verdict, costs=costs, notes=() if plan.model.is_coupled else (SLACK_NOTE,))


def check_waypoints(model: RobotModel, waypoints: Waypoints) -> Verdict:
    """What waypoints alone can show: range, deafness, and balance by forward kinematics."""
    outcomes = [
        check_strokes(model, waypoints),
        check_deafness(waypoints),
        check_standing_balance(model, waypoints),
    ]
    findings = [finding for outcome in outcomes for finding in outcome.findings]
    return _verdict(waypoints, findings, outcomes)


def _verdict(waypoints: Waypoints, findings: Sequence[Finding], outcomes: Sequence[Outcome]) -> Verdict:
    ordered = sorted(findings, key=lambda f: (f.severity is not Severity.ERROR, f.rule, f.sample or 0))
    return Verdict(waypoints.content_hash, tuple(ordered), tuple(outcome.margin for outcome in outcomes))
