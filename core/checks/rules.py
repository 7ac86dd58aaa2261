"""Every rule that a plan must keep before a person may approve it, in one list.

The rules, by kind: `motors`, `balance` and `ground`, or `coupling` where motors share actuators, `shoes`,
`arms`, `document`, `path` for the way between waypoints, and `simulation` for what the physics finds, by
which `rocking` judges a robot that rocks onto a foot.
"""

from collections.abc import Sequence
from dataclasses import replace

from core.checks.arms import check_arms, check_arms_of_waypoints
from core.checks.balance import check_balance, check_standing_balance
from core.checks.checked_plan import WITHIN, Beyond, CheckedPlan
from core.checks.coupling import check_made, check_made_waypoints
from core.checks.document import check_document, check_origin
from core.checks.ground import check_clearance, check_contact, check_slip
from core.checks.motors import (
    acceleration_note,
    check_deafness,
    check_durations,
    check_motor_acceleration,
    check_motor_speed,
    check_move_size,
    check_strokes,
    still_note,
)
from core.checks.path import SLACK_NOTE, check_path, send_costs
from core.checks.rocking import rocking_judged
from core.checks.shoes import check_shoes, check_shoes_of_waypoints
from core.checks.simulation import Simulated, check_simulation, simulation_note
from core.findings import Finding, Outcome, Severity, Verdict
from core.robot.model import RobotModel
from core.wire.waypoints import Waypoints


def check_plan(plan: CheckedPlan, simulated: Simulated | None = None) -> Verdict:
    """Every rule on a plan, for exactly these waypoints.

    Args:
        plan: what is checked.
        simulated: a simulation of exactly these waypoints; without one a note says that there is none.
    """
    kept = None if plan.way is None else plan.way.kept
    outcomes = [
        check_strokes(plan.model, plan.knots, plan.trajectory.times, plan.beyond),
        check_deafness(plan.waypoints, kept),
        check_durations(plan.waypoints, kept),
        *_motion_rules(plan, is_simulated=simulated is not None),
        *check_shoes(plan),
        *check_arms(plan),
        check_motor_speed(plan),
        *check_motor_acceleration(plan),
        check_move_size(plan),
        *check_document(plan),
    ]
    if plan.way is not None:
        outcomes += check_path(plan.model, plan.trajectory, plan.way)
    outcomes += check_simulation(simulated)
    found = [finding for outcome in outcomes for finding in outcome.findings]
    findings = rocking_judged([*found, *check_origin(plan)], plan.model, simulated)
    verdict = _verdict(plan.model, plan.waypoints, findings, outcomes)
    if simulated is not None:
        verdict = replace(verdict, simulation=simulated.key)
    notes = [acceleration_note(plan), simulation_note(simulated)]
    if plan.way is not None:
        if not plan.asked.sent_whole:
            verdict = replace(verdict, costs=send_costs(plan.model, plan.trajectory, plan.way))
        notes += [still_note(plan), "" if plan.model.is_coupled else SLACK_NOTE]
    return replace(verdict, notes=tuple(filter(None, notes)))


def _motion_rules(plan: CheckedPlan, *, is_simulated: bool) -> list[Outcome]:
    """How the robot stands and steps: in the planned motion, or in the one that shared motors make of it."""
    if plan.model.is_coupled:
        return check_made(plan, is_simulated=is_simulated)
    return [check_balance(plan), check_contact(plan), check_clearance(plan), check_slip(plan)]


def check_waypoints(model: RobotModel, waypoints: Waypoints, beyond: Beyond = WITHIN) -> Verdict:
    """What waypoints alone can show: range, durations, deafness; by kinematics balance, shoes, arms.

    Args:
        model: the robot.
        waypoints: what would be sent.
        beyond: where strokes left the range before they were clipped.
    """
    outcomes = [
        check_strokes(model, waypoints, beyond=beyond),
        check_deafness(waypoints),
        check_durations(waypoints),
        *_standing_rules(model, waypoints),
        *check_shoes_of_waypoints(model, waypoints),
        *check_arms_of_waypoints(model, waypoints),
    ]
    found = [finding for outcome in outcomes for finding in outcome.findings]
    return _verdict(model, waypoints, rocking_judged(found, model), outcomes)


def _standing_rules(model: RobotModel, waypoints: Waypoints) -> list[Outcome]:
    """How the robot stands at its waypoints, as far as strokes alone say."""
    if model.is_coupled:
        return check_made_waypoints(model, waypoints)
    return [check_standing_balance(model, waypoints)]


def _verdict(
    model: RobotModel, waypoints: Waypoints, findings: Sequence[Finding], outcomes: Sequence[Outcome]
) -> Verdict:
    ordered = sorted(findings, key=lambda f: (f.severity is not Severity.ERROR, f.rule, f.sample or 0))
    margins = tuple(outcome.margin for outcome in outcomes)
    return Verdict(waypoints.content_hash, tuple(ordered), margins, robot_hash=model.parameters_hash)
