"""What motors and firmware can do: range, speed, acceleration, the size of a move, and deafness for Stop."""

from __future__ import annotations

import numpy as np

from core.checked_plan import CheckedPlan
from core.findings import TOLERANCE, Finding, Outcome, RuleMargin, Severity
from core.robot import RobotModel
from core.waypoints import Waypoints
from core.wire_timing import deafness

DEAF_LIMIT = 2.5
"""A plan during which Stop takes longer gets a warning, s."""


def check_strokes(model: RobotModel, waypoints: Waypoints) -> Outcome:
    """Every motor stays within its range."""
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


def check_deafness(waypoints: Waypoints) -> Outcome:
    """No move keeps the robot from hearing Stop for too long."""
    seconds = deafness(waypoints)
    margin = RuleMargin("deafness", DEAF_LIMIT - seconds, "s")
    if seconds <= DEAF_LIMIT:
        return Outcome(margin)
    sentence = (
        f"The longest move keeps the robot from hearing Stop for {seconds:.1f} s; more than {DEAF_LIMIT} s. "
        "Choose a stop bound, which cuts long moves."
    )
    return Outcome(margin, (Finding("deafness", Severity.WARNING, sentence, seconds, DEAF_LIMIT),))


def check_motor_speed(plan: CheckedPlan) -> Outcome:
    """Motors can follow the plan in its own time."""
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
