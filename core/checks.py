"""The rules that a plan must keep before a person may approve it; each returns findings."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from core.arrays import Bools, Floats, stretches
from core.coupling_check import check_coupling
from core.findings import TOLERANCE, Finding, Outcome, RuleMargin, Severity, Verdict
from core.leg import foot_from_strokes
from core.manual import stance_slip
from core.path_check import SLACK_NOTE, check_path, send_costs
from core.path_merging import WaypointPlan
from core.robot import RobotModel
from core.support import stability_margins, trajectory_pressure
from core.trajectory import Trajectory
from core.waypoints import Waypoints
from core.wire_timing import deafness

BALANCE_RESERVE = 0.001
"""Below this distance to the polygon's edge the check warns, m."""
SLIP_LIMIT = 0.0005
"""A standing foot that slides further gets a warning, m."""
CLEARANCE_LIMIT = 0.001
"""A swing that rises less gets a warning, m."""
TRAVEL_LIMIT = 0.001
"""A plan that ends further from where the document says is wrong, m."""
DEAF_LIMIT = 2.5
"""A plan during which Stop takes longer gets a warning, s."""
STANDING_DEPTH = 0.0005
"""Feet within this of the deepest one are taken to stand where only waypoints are known, m."""
STROKE_BALANCE_SLACK = 0.0005
"""From strokes alone balance is known to this much, since which feet stand is itself a guess, m."""
CONTACT_LIMIT = 0.00025
"""How far a standing foot may be from the ground, m (T (3.12) as we use it)."""


@dataclass(frozen=True, eq=False)
class CheckedPlan:
    """What the rules look at.

    Args:
        model: the robot.
        trajectory: the plan in the world frame.
        waypoints: what would be sent.
        expected_travel: (2,) the body's displacement that the document asks for, m; None where unknown.
        is_draft: whether the plan was only drawn, not computed by hand table or optimiser.
        way: how the waypoints were merged and cut; None where they are one a knot and the path between them
            is not looked at.
    """

    model: RobotModel
    trajectory: Trajectory
    waypoints: Waypoints
    expected_travel: Floats | None = None
    is_draft: bool = False
    way: WaypointPlan | None = None

    @property
    def knots(self) -> Waypoints:
        """One waypoint a knot."""
        return self.waypoints if self.way is None else self.way.knots


def check_plan(plan: CheckedPlan) -> Verdict:
    """Every rule on a plan, for exactly these waypoints."""
    rules = (_stroke(plan.model, plan.knots), _deafness(plan.waypoints))
    outcomes = [*rules, *(rule(plan) for rule in (_balance, _contact, _clearance, _slip, _motor_speed))]
    if plan.expected_travel is not None:
        outcomes.append(_travel(plan, plan.expected_travel))
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
        _stroke(model, waypoints),
        _deafness(waypoints),
        _standing_balance(model, waypoints),
    ]
    findings = [finding for outcome in outcomes for finding in outcome.findings]
    return _verdict(waypoints, findings, outcomes)


def _verdict(waypoints: Waypoints, findings: Sequence[Finding], outcomes: Sequence[Outcome]) -> Verdict:
    ordered = sorted(findings, key=lambda f: (f.severity is not Severity.ERROR, f.rule, f.sample or 0))
    return Verdict(waypoints.content_hash, tuple(ordered), tuple(outcome.margin for outcome in outcomes))


def _stroke(model: RobotModel, waypoints: Waypoints) -> Outcome:
    lower, upper = model.stroke.lower, model.stroke.upper
    room = np.minimum(waypoints.strokes - lower, upper - waypoints.strokes)
    findings = []
    for sample, foot, actuator in np.argwhere(room < -TOLERANCE):
        value = float(waypoints.strokes[sample, foot, actuator])
        findings.append(
            Finding(
                "stroke",
                Severity.ERROR,
                f"Motor {actuator + 1} of foot {foot + 1} would go to {value * 1000:.2f} mm at sample "
                f"{sample + 1}; its range is {lower * 1000:.1f} to {upper * 1000:.1f} mm. Shorten the step "
                "or change the body's height.",
                value,
                lower if value < lower else upper,
                int(sample),
                int(foot),
                int(actuator),
            )
        )
    return Outcome(RuleMargin("stroke", float(room.min()), "m"), tuple(findings))


def _deafness(waypoints: Waypoints) -> Outcome:
    seconds = deafness(waypoints)
    margin = RuleMargin("deafness", DEAF_LIMIT - seconds, "s")
    if seconds <= DEAF_LIMIT:
        return Outcome(margin)
    sentence = (
        f"The longest move keeps the robot from hearing Stop for {seconds:.1f} s; more than {DEAF_LIMIT} s. "
        "Choose a stop bound, which cuts long moves."
    )
    return Outcome(margin, (Finding("deafness", Severity.WARNING, sentence, seconds, DEAF_LIMIT),))


def _balance(plan: CheckedPlan) -> Outcome:
    """Ground point inside the support polygon.

    Of a motion whose velocities fit its positions it is the centre of pressure (DOMAIN.md 12); of every
    other the centre of mass (static stability margin).
    """
    t = plan.trajectory
    margins, what = balance_margins(plan.model, t)
    return _balance_outcome(margins, t.times, t.contact, what, TOLERANCE)


def balance_margins(model: RobotModel, t: Trajectory) -> tuple[Floats, str]:
    """(n,) distance of the point that balance is judged by to the support polygon's edge, m; and its name."""
    pressure = pressure_points(model, t)
    if pressure is None:
        return stability_margins(t.body_world[:, :2], t.feet_world, t.contact), "centre of mass"
    return stability_margins(pressure, t.feet_world, t.contact), "centre of pressure"


def pressure_points(model: RobotModel, t: Trajectory) -> Floats | None:
    """(n, 2) centre of pressure from each knot on, m; None for a motion whose accelerations are unknown.

    At the last knot, where the robot stands, it is under the centre of mass.
    """
    if not _moves_as_planned(t):
        return None
    return np.concatenate([trajectory_pressure(model, t), t.body_world[-1:, :2]])


def _moves_as_planned(t: Trajectory) -> bool:
    """Whether velocities are those of constant accelerations between knots."""
    if t.body_velocity is None or t.feet_velocity is None:
        return False
    half = np.diff(t.times)[:, None] / 2
    body_gap = np.diff(t.body_world, axis=0) - half * (t.body_velocity[1:] + t.body_velocity[:-1])
    feet_gap = np.diff(t.feet_world, axis=0) - half[..., None] * (t.feet_velocity[1:] + t.feet_velocity[:-1])
    return max(float(np.abs(body_gap).max()), float(np.abs(feet_gap).max())) <= TOLERANCE


def _balance_outcome(margins: Floats, times: Floats, contact: Bools, what: str, slack: float) -> Outcome:
    findings = []
    for first, last in _unbalanced_stretches(np.asarray(margins < BALANCE_RESERVE), contact):
        worst = first + int(margins[first : last + 1].argmin())
        span = f"({times[first]:.1f} to {times[last]:.1f} s)"
        if not np.isfinite(margins[worst]):
            sentence = (
                f"At {times[worst]:.1f} s no foot stands {span}: the robot falls. Keep three feet down."
            )
            findings.append(Finding("balance", Severity.ERROR, sentence, None, 0.0, worst))
            continue
        value = float(margins[worst])
        tips = value < -slack
        outcome = "the robot tips" if tips else "there is hardly any reserve"
        where = _support_words(value, [str(foot + 1) for foot in np.nonzero(contact[worst])[0]])
        sentence = f"At {times[worst]:.1f} s the {what} is {where[0]} {span}: {outcome}. {where[1]}"
        severity, limit = (Severity.ERROR, 0.0) if tips else (Severity.WARNING, BALANCE_RESERVE)
        findings.append(Finding("balance", severity, sentence, value, limit, worst))
    smallest = float(margins.min())
    known = smallest if np.isfinite(smallest) else None
    return Outcome(RuleMargin("balance", known, "m"), tuple(findings))


def _unbalanced_stretches(low: Bools, contact: Bools) -> list[tuple[int, int]]:
    """Runs of too small a margin; while fewer than three feet stand, one for each set of standing feet."""
    few = contact.sum(axis=1) < 3
    others = (contact[1:] != contact[:-1]).any(axis=1)
    cuts = np.nonzero(others & (few[1:] | few[:-1]))[0] + 1
    starts = [0, *cuts.tolist()]
    pieces = zip(starts, np.split(low, cuts), strict=True)
    return [(start + first, start + last) for start, piece in pieces for first, last in stretches(piece)]


def _support_words(value: float, standing: Sequence[str]) -> tuple[str, str]:
    """Where a point is by the feet that stand, and what to do."""
    distance = f"{abs(value) * 1000:.2f} mm"
    if len(standing) == 1:
        return f"{distance} from foot {standing[0]}, which stands alone", "Keep three feet down."
    if len(standing) == 2:
        words = f"{distance} from the line between feet {' and '.join(standing)}, which stand alone"
        return words, "Keep three feet down."
    side = "outside" if value < -TOLERANCE else "inside"
    words = f"{distance} {side} the edge of the support polygon of feet {', '.join(standing)}"
    return words, "Shift the body before the step, or ask the optimiser for a stability margin."


def _standing_balance(model: RobotModel, waypoints: Waypoints) -> Outcome:
    feet_module = foot_from_strokes(model.leg, waypoints.strokes)
    turned = np.einsum("lij,nlj->nli", model.R_robot_from_module, feet_module)
    feet_robot = turned + model.module_centres_robot
    height = feet_robot[..., 2] - feet_robot[..., 2].min(axis=1, keepdims=True)
    standing = np.asarray(height <= STANDING_DEPTH)
    margins = stability_margins(np.zeros((waypoints.count, 2)), feet_robot, standing)
    times = np.cumsum(waypoints.durations) - waypoints.durations[0]
    return _balance_outcome(margins, times, standing, "centre of mass", STROKE_BALANCE_SLACK)


def _clearance(plan: CheckedPlan) -> Outcome:
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


def _contact(plan: CheckedPlan) -> Outcome:
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


def _slip(plan: CheckedPlan) -> Outcome:
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


def _motor_speed(plan: CheckedPlan) -> Outcome:
    moves = np.abs(np.diff(plan.knots.strokes, axis=0))
    speeds = moves / np.maximum(plan.knots.durations[1:], 1e-9)[:, None, None]
    limit = plan.model.stroke.speed
    margin = RuleMargin("motor_speed", limit - float(speeds.max(initial=0.0)), "m/s")
    if float(speeds.max(initial=0.0)) <= limit + TOLERANCE:
        return Outcome(margin)
    sample, foot, actuator = (int(i) for i in np.unravel_index(int(speeds.argmax()), speeds.shape))
    value = float(speeds[sample, foot, actuator])
    sentence = (
        f"Motor {actuator + 1} of foot {foot + 1} would need {value * 1000:.1f} mm/s after sample "
        f"{sample + 1}; motors make {limit * 1000:.0f} mm/s, so the robot takes longer than planned there."
    )
    finding = Finding("motor_speed", Severity.WARNING, sentence, value, limit, sample, foot, actuator)
    return Outcome(margin, (finding,))


def _travel(plan: CheckedPlan, expected: Floats) -> Outcome:
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
