"""The rules of a verdict that only a simulation can judge; limits and remedies stand with each of them."""

from typing import Any

import numpy as np

from core.arrays import Floats, stretches
from core.findings import TOLERANCE, Outcome, RuleMargin, Severity, found
from core.motion.balance import BALANCE_RESERVE
from core.motion.support_polygon import stability_margins
from core.motion.way_made import LEAST_SHARE, WARNED_SHARE
from core.physics.problem import Rig, SimulationProblem
from core.physics.report import SimulationReport
from core.wire.robot_time import ARRIVAL_THRESHOLD

TILT_LIMIT = float(np.radians(2.0))
"""A body that leans further rocks onto a foot that should be in the air, rad."""
SWING_LIMIT = 0.5
"""A foot that carries load for a larger part of a swing bears the robot that rocks onto it, or stays down;
feet that are in the air have at most 0.13 by measurement, those that bear a robot 0.87 and more."""
EDGE = 0.0001
"""A plan whose centre of mass is so far outside its support still rests on the edge, m."""
SLIP_LIMIT = 0.001
"""A sole that slides further during one stance gets a warning, m."""
BALANCE_LIMIT = 0.0
"""A centre of mass beyond the feet that carry load is held up by the width of the soles alone, m."""
TRAVEL_LIMIT = 0.003
"""A robot that ends further from where it was to go gets a warning, m; motors within the firmware's threshold
of their last waypoint leave a body up to 2.5 mm away …"""
TRAVEL_SHARE = 0.1
"""… or further than this part of the planned way or turn, where that is more."""
SHARE_TOLERANCE = 1e-6
"""Parts of a way this near are one."""
HEADING_LIMIT = float(np.radians(2.0))
"""A robot that ends with another heading gets a warning, rad."""
SEE_SLIDES = "See there what slides or leans, and correct that first."
TRACK_LIMIT = ARRIVAL_THRESHOLD
"""A motor further from its ramp than the firmware's threshold gets a warning, m."""
SATURATION_LIMIT = 0.01
"""A motor whose force is at its limit for a larger part of the time gets a warning."""


def physics_outcomes(report: SimulationReport, problem: SimulationProblem) -> tuple[Outcome, ...]:
    """What the rules say of a simulated run.

    Falling, tilting, load on a swinging foot, ending early and less than half of the way or turn are errors;
    slip, lost balance, less of the way or turn than asked, motors that fall behind and motors at their
    force's limit are warnings. Samples are the plan's knots, times the simulated robot's.

    Args:
        report: of the run.
        problem: what was asked.
    """
    rules = [_fall, _end, _tilt, _swing, _slip, _balance, _tracking, _saturation]
    if problem.rig is Rig.WALKING:
        rules += [_travel, _heading]
    return tuple(rule(report, problem) for rule in rules)


def _fall(report: SimulationReport, problem: SimulationProblem) -> Outcome:
    margin = RuleMargin("simulated_fall", None, "rad")
    if report.fell_time is None:
        return Outcome(margin)
    words = (
        f"In the simulation the robot falls over at {report.fell_time:.1f} s; it leans by "
        f"{np.degrees(report.max_tilt):.0f}° at most."
    )
    remedy = "Shift the body over the standing feet before each step, or ask for a larger stability margin."
    place = _place(report, problem, report.fell_time)
    finding = found(margin.rule, Severity.ERROR, words, remedy, report.max_tilt, TILT_LIMIT, **place)
    return Outcome(margin, (finding,))


def _end(report: SimulationReport, problem: SimulationProblem) -> Outcome:
    margin = RuleMargin("simulated_end", None, "")
    missing = problem.waypoints.count - len(report.arrival_times)
    if not report.ended_early and not missing:
        return Outcome(margin)
    words = (
        f"The simulation ended {missing} of {problem.waypoints.count} waypoints early: "
        f"{(report.ended_early or 'no reason is known').rstrip('.')}."
    )
    place = _place(report, problem, float(report.arrival_times[-1]))
    remedy = "Correct the findings above, then simulate again."
    return Outcome(margin, (found(margin.rule, Severity.ERROR, words, remedy, float(missing), 0.0, **place),))


def _tilt(report: SimulationReport, problem: SimulationProblem) -> Outcome:
    margin = RuleMargin("simulated_tilt", TILT_LIMIT - report.max_tilt, "rad")
    if report.max_tilt <= TILT_LIMIT or report.fell:
        return Outcome(margin)
    words = (
        f"In the simulation the body leans by {np.degrees(report.max_tilt):.1f}° at "
        f"{report.max_tilt_time:.1f} s; more than {np.degrees(TILT_LIMIT):.0f}° means that it rocks onto a "
        f"foot that should be in the air.{_edge_words(problem)}"
    )
    remedy = "Shift the body over the standing feet before that step, or ask for a larger stability margin."
    place = _place(report, problem, report.max_tilt_time)
    finding = found(margin.rule, _rocking(problem), words, remedy, report.max_tilt, TILT_LIMIT, **place)
    return Outcome(margin, (finding,))


def _rests_on_edge(problem: SimulationProblem) -> bool:
    """Whether the plan, if it is what the robot makes, has no reserve of balance and loses none."""
    plan = problem.plan
    if problem.model.is_coupled:
        return False
    least = float(stability_margins(plan.body_world[:, :2], plan.feet_world, plan.contact).min())
    return -EDGE <= least < BALANCE_RESERVE - TOLERANCE


def _rocking(problem: SimulationProblem) -> Severity:
    """How bad it is to rock: where the plan itself rests on an edge, little decides whether a robot does."""
    return Severity.WARNING if _rests_on_edge(problem) else Severity.ERROR


def _edge_words(problem: SimulationProblem) -> str:
    if not _rests_on_edge(problem):
        return ""
    return (
        " The plan rests on the edge of its support there, so that very little decides whether a robot rocks."
    )


def _swing(report: SimulationReport, problem: SimulationProblem) -> Outcome:
    foot, share = int(report.swing_load.argmax()), float(report.swing_load.max())
    margin = RuleMargin("simulated_swing", SWING_LIMIT - share, "")
    if share <= SWING_LIMIT or report.fell or report.max_tilt > TILT_LIMIT:
        return Outcome(margin)
    time = float(report.swing_load_times[foot])
    words = (
        f"In the simulation foot {foot + 1} carries load for {share * 100:.0f} % of its swing about "
        f"{time:.1f} s; more than {SWING_LIMIT * 100:.0f} % means that the robot rocks onto it, or that it "
        f"does not leave the ground.{_edge_words(problem)}"
    )
    remedy = "Ask for a larger stability margin, or for more clearance."
    place = _place(report, problem, time, foot)
    severity = _rocking(problem)
    return Outcome(margin, (found(margin.rule, severity, words, remedy, share, SWING_LIMIT, **place),))


def longest_slides(report: SimulationReport, problem: SimulationProblem) -> tuple[Floats, list[int]]:
    """(legs,) the longest way that each sole slid in one stance, m, and the move in which it slid most."""
    legs = problem.model.leg_count
    longest, worst = np.zeros(legs), [0] * legs
    for foot in range(legs):
        for first, last in stretches(problem.standing[:, foot]):
            slid = report.slip_samples[first : last + 1, foot]
            if slid.sum() > longest[foot]:
                longest[foot], worst[foot] = slid.sum(), first + int(slid.argmax())
    return longest, worst


def _slip(report: SimulationReport, problem: SimulationProblem) -> Outcome:
    slides, moves = longest_slides(report, problem)
    findings = []
    for foot in np.nonzero(slides > SLIP_LIMIT + TOLERANCE)[0]:
        time = float(report.arrival_times[moves[foot]])
        words = (
            f"In the simulation foot {foot + 1} slides {slides[foot] * 1000:.1f} mm during one stance, "
            f"most of it near {time:.1f} s. The limit is {SLIP_LIMIT * 1000:.0f} mm."
        )
        remedy = "Keep standing feet still in the plan, or expect the robot to go less far."
        place = _place(report, problem, time, int(foot))
        value = float(slides[foot])
        findings.append(found("simulated_slip", Severity.WARNING, words, remedy, value, SLIP_LIMIT, **place))
    return Outcome(RuleMargin("simulated_slip", SLIP_LIMIT - float(slides.max()), "m"), tuple(findings))


def _balance(report: SimulationReport, problem: SimulationProblem) -> Outcome:
    margin = RuleMargin("simulated_balance", report.min_margin, "m")
    value, time = report.min_margin, report.min_margin_time
    if value is None or time is None or value >= BALANCE_LIMIT - TOLERANCE:
        return Outcome(margin)
    words = (
        f"In the simulation the centre of mass is {-value * 1000:.1f} mm outside the middles of the feet "
        f"that carry load at {time:.1f} s; only the width of the soles holds the robot there."
    )
    remedy = "Ask for a larger stability margin, or shift the body further before that step."
    place = _place(report, problem, time)
    return Outcome(
        margin, (found(margin.rule, Severity.WARNING, words, remedy, value, BALANCE_LIMIT, **place),)
    )


def _travel(report: SimulationReport, problem: SimulationProblem) -> Outcome:
    way, rule = report.way, "simulated_travel"
    if way.share is not None and not is_made(way.share):
        words = (
            f"In the simulation the robot goes {way.made * 1000:.1f} of {way.asked * 1000:.1f} mm, "
            f"{way.share * 100:.0f} % of its way. {_lost(report, problem)}"
        )
        return share_outcome(rule, way.share, words, SEE_SLIDES, _slide_place(report, problem))
    limit = max(TRAVEL_LIMIT, TRAVEL_SHARE * way.asked)
    margin = RuleMargin(rule, limit - way.gap, "m")
    if way.gap <= limit + TOLERANCE:
        return Outcome(margin if way.share is None else share_margin(rule, way.share))
    words = (
        f"In the simulation the robot ends {way.gap * 1000:.1f} mm from where the plan ends, more than "
        f"{limit * 1000:.1f} mm. {_lost(report, problem)}"
    )
    place = _slide_place(report, problem)
    return Outcome(margin, (found(rule, Severity.WARNING, words, SEE_SLIDES, way.gap, limit, **place),))


def _heading(report: SimulationReport, problem: SimulationProblem) -> Outcome:
    way, rule = report.way, "simulated_heading"
    if way.turn_share is not None and not is_made(way.turn_share):
        words = (
            f"In the simulation the body turns by {np.degrees(way.made_turn):.1f} of "
            f"{np.degrees(way.asked_turn):.1f}°, {way.turn_share * 100:.0f} % of its turn. "
            f"{_lost(report, problem)}"
        )
        return share_outcome(rule, way.turn_share, words, SEE_SLIDES, _slide_place(report, problem))
    limit = max(HEADING_LIMIT, TRAVEL_SHARE * way.asked_turn)
    margin = RuleMargin(rule, limit - way.turn_gap, "rad")
    if way.turn_gap <= limit:
        return Outcome(margin if way.turn_share is None else share_margin(rule, way.turn_share))
    words = (
        f"In the simulation the body turns by {np.degrees(report.heading):.1f}°; the plan says "
        f"{np.degrees(report.planned_heading):.1f}°, which is more than {np.degrees(limit):.0f}° off. "
        f"{_lost(report, problem)}"
    )
    place = _slide_place(report, problem)
    return Outcome(margin, (found(rule, Severity.WARNING, words, SEE_SLIDES, way.turn_gap, limit, **place),))


def _lost(report: SimulationReport, problem: SimulationProblem) -> str:
    """Where way is lost, in a sentence: a run that ends early, feet that slide, or neither."""
    missing = problem.waypoints.count - len(report.arrival_times)
    if missing:
        time = float(report.arrival_times[-1])
        return f"The run ended at {time:.1f} s, {missing} of {problem.waypoints.count} waypoints early."
    slides, moves = longest_slides(report, problem)
    foot = int(slides.argmax())
    if slides[foot] > SLIP_LIMIT:
        time = float(report.arrival_times[moves[foot]])
        return (
            f"Foot {foot + 1} slides most, by {slides[foot] * 1000:.1f} mm in one stance about {time:.1f} s."
        )
    return (
        f"No foot slides by more than {SLIP_LIMIT * 1000:.0f} mm in a stance: the body leans by up to "
        f"{np.degrees(report.max_tilt):.1f}°, and motors stop up to {ARRIVAL_THRESHOLD * 1000:.0f} mm short."
    )


def _slide_place(report: SimulationReport, problem: SimulationProblem) -> dict[str, Any]:
    """Where a foot slides most, so that one can look at it."""
    slides, moves = longest_slides(report, problem)
    foot = int(slides.argmax())
    return _place(report, problem, float(report.arrival_times[moves[foot]]), foot)


def is_made(share: float) -> bool:
    """Whether so much of a way or a turn gets no warning."""
    return share >= WARNED_SHARE - SHARE_TOLERANCE


def walks(share: float, least: float = LEAST_SHARE) -> bool:
    """Whether so much of a way or a turn is no error."""
    return share >= least - SHARE_TOLERANCE


def share_margin(rule: str, share: float) -> RuleMargin:
    """How far a made part of a way or a turn stays from a warning."""
    return RuleMargin(rule, share - WARNED_SHARE, "")


def share_outcome(
    rule: str, share: float, words: str, remedy: str, place: dict[str, Any], *, least: float = LEAST_SHARE
) -> Outcome:
    """A way or a turn of which a part is made: too little is a warning, less than the least an error.

    Args:
        rule: its name.
        share: the part.
        words: what is made, in sentences.
        remedy: the way out.
        place: where most of it is lost.
        least: the part below which it is an error.
    """
    margin = share_margin(rule, share)
    if is_made(share):
        return Outcome(margin)
    goes = walks(share, least)
    severity, limit = (Severity.WARNING, WARNED_SHARE) if goes else (Severity.ERROR, least)
    allowed = f"Less than {limit * 100:.0f} % {'gets a warning' if goes else 'is no walk'}."
    return Outcome(margin, (found(rule, severity, f"{words} {allowed}", remedy, share, limit, **place),))


def _tracking(report: SimulationReport, problem: SimulationProblem) -> Outcome:
    foot, motor, value = _worst_motor(report.motor_error)
    margin = RuleMargin("simulated_motors", TRACK_LIMIT - value, "m")
    if value <= TRACK_LIMIT + TOLERANCE:
        return Outcome(margin)
    time = float(report.motor_error_times[foot, motor])
    words = (
        f"In the simulation motor {motor + 1} of foot {foot + 1} is {value * 1000:.2f} mm behind its ramp at "
        f"{time:.1f} s. The firmware counts a motor as arrived within {TRACK_LIMIT * 1000:.1f} mm."
    )
    remedy = "Lighten the load on that foot, or make the step shorter."
    place = _place(report, problem, time, foot, motor)
    return Outcome(
        margin, (found(margin.rule, Severity.WARNING, words, remedy, value, TRACK_LIMIT, **place),)
    )


def _saturation(report: SimulationReport, problem: SimulationProblem) -> Outcome:
    foot, motor, share = _worst_motor(report.saturation)
    margin = RuleMargin("simulated_force", SATURATION_LIMIT - share, "")
    if share <= SATURATION_LIMIT:
        return Outcome(margin)
    time = float(report.peak_force_times[foot, motor])
    words = (
        f"In the simulation motor {motor + 1} of foot {foot + 1} is at its limit of "
        f"{report.peak_forces[foot, motor]:.1f} N for {share * 100:.0f} % of the time, as at {time:.1f} s; "
        f"the limit is {SATURATION_LIMIT * 100:.0f} %."
    )
    remedy = "Keep the feet nearer to their modules' middles, or lighten the load on that foot."
    place = _place(report, problem, time, foot, motor)
    finding = found(margin.rule, Severity.WARNING, words, remedy, share, SATURATION_LIMIT, **place)
    return Outcome(margin, (finding,))


def _worst_motor(values: Floats) -> tuple[int, int, float]:
    """Foot, motor and value of the largest of (legs, 3)."""
    foot, motor = (int(i) for i in np.unravel_index(int(values.argmax()), values.shape))
    return foot, motor, float(values[foot, motor])


def _place(
    report: SimulationReport,
    problem: SimulationProblem,
    time: float,
    foot: int | None = None,
    actuator: int | None = None,
) -> dict[str, Any]:
    """Where a finding is: the plan's knot with which the move ends that was under way at a simulated time."""
    move = min(int(np.searchsorted(report.arrival_times, time)), problem.waypoints.count - 1)
    knots = problem.plan.times
    knot = min(int(np.searchsorted(knots, problem.times[move] - 1e-9)), len(knots) - 1)
    return {"sample": knot, "foot": foot, "actuator": actuator, "time": time}
