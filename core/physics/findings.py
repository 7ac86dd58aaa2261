"""The rules of a verdict that only a simulation can judge; limits and remedies stand with each of them."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from core.arrays import Bools, Floats, first_highest, stretches
from core.findings import TOLERANCE, Outcome, RuleMargin, Severity, found
from core.motion.support_polygon import stability_margins
from core.motion.way_made import LEAST_SHARE, WARNED_SHARE, WayMade
from core.physics.problem import Rig, SimulationProblem
from core.physics.report import SimulationReport
from core.wire.robot_time import ARRIVAL_THRESHOLD

TILT_LIMIT = float(np.radians(2.0))
"""A body that leans further rocks onto a foot that should be in the air, rad."""
SWING_LIMIT = 0.5
"""A foot that carries load for a larger part of a swing bears the robot that rocks onto it, or stays down;
feet that are in the air have at most 0.13 by measurement, those that bear a robot 0.87 and more."""
SIMULATED_ROCKING = ("simulated_tilt", "simulated_swing")
"""Rules that find a robot rocking onto a foot."""
KNOTS_ABOUT = 1
"""Knots before and after a moment at which a plan is looked at too."""
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
    force's limit are warnings, and so is rocking where the plan has less reserve than the robot
    needs. Samples are the plan's knots, times the simulated robot's.

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
    severity, edge = _rocking(report, problem, report.max_tilt_time)
    words = (
        f"In the simulation the body leans by {np.degrees(report.max_tilt):.1f}° at "
        f"{report.max_tilt_time:.1f} s; more than {np.degrees(TILT_LIMIT):.0f}° means that it rocks onto a "
        f"foot that should be in the air.{edge}"
    )
    remedy = "Shift the body over the standing feet before that step, or ask for a larger stability margin."
    place = _place(report, problem, report.max_tilt_time)
    finding = found(margin.rule, severity, words, remedy, report.max_tilt, TILT_LIMIT, **place)
    return Outcome(margin, (finding,))


def only_rocks(report: SimulationReport, problem: SimulationProblem) -> bool:
    """Whether a simulated robot does not fall and makes its way, however it leans.

    A robot with shared motors leans because it makes another motion than its plan: that is no rocking.
    """
    way = report.way
    shares = [share for share in (way.share, way.turn_share) if share is not None]
    reaches_end = not report.ended_early and len(report.arrival_times) == problem.waypoints.count
    is_judged = problem.rig is Rig.WALKING and not problem.model.is_coupled
    return is_judged and not report.fell and reaches_end and all(gets_on(share) for share in shares)


def rocking_words(report: SimulationReport, swinging: Bools) -> str:
    """What a robot that only rocks does, in a sentence.

    Args:
        report: of the run.
        swinging: (legs,) feet that should be in the air.
    """
    loads = np.where(swinging, report.swing_load, 0.0)
    foot = int(first_highest(loads))
    does = f"leans by up to {np.degrees(report.max_tilt):.1f}°"
    if loads[foot] > SWING_LIMIT:
        does = f"rocks onto foot {foot + 1}"
    return f"In the simulation of these waypoints the robot {does} and does not fall."


def _rocking(report: SimulationReport, problem: SimulationProblem, time: float) -> tuple[Severity, str]:
    """How bad it is that a robot rocks at a simulated time, and a sentence on it.

    It is expected where the plan has less reserve than the robot's own margin. Elsewhere the robot does
    otherwise than planned.
    """
    plan, knot = problem.plan, int(_place(report, problem, time)["sample"])
    margins = stability_margins(plan.body_world[:, :2], plan.feet_world, plan.contact)
    about = margins[max(knot - KNOTS_ABOUT, 0) : knot + KNOTS_ABOUT + 1]
    if not only_rocks(report, problem) or float(about.min()) > problem.model.margin:
        return Severity.ERROR, ""
    return (
        Severity.WARNING,
        " The plan has less reserve there than this robot needs, and the robot does not fall.",
    )


def _swing(report: SimulationReport, problem: SimulationProblem) -> Outcome:
    foot, share = int(report.swing_load.argmax()), float(report.swing_load.max())
    margin = RuleMargin("simulated_swing", SWING_LIMIT - share, "")
    if share <= SWING_LIMIT or report.fell or report.max_tilt > TILT_LIMIT:
        return Outcome(margin)
    time = float(report.swing_load_times[foot])
    severity, edge = _rocking(report, problem, time)
    words = (
        f"In the simulation foot {foot + 1} carries load for {share * 100:.0f} % of its swing about "
        f"{time:.1f} s; more than {SWING_LIMIT * 100:.0f} % means that the robot rocks onto it, or that it "
        f"does not leave the ground.{edge}"
    )
    remedy = "Ask for a larger stability margin, or for more clearance."
    place = _place(report, problem, time, foot)
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
    lost = _lost(report, problem)
    return travel_outcome("simulated_travel", report.way, "In the simulation the robot", lost)


def _heading(report: SimulationReport, problem: SimulationProblem) -> Outcome:
    lost = _lost(report, problem)
    return heading_outcome("simulated_heading", report.way, "In the simulation the body", lost)


@dataclass(frozen=True)
class Lost:
    """Where way or turn is lost.

    Args:
        words: a sentence on it.
        remedy: the way out.
        place: `sample`, `foot` and `time` at which to look.
    """

    words: str
    remedy: str
    place: dict[str, Any]


def travel_outcome(rule: str, way: WayMade, who: str, lost: Lost, least: float = LEAST_SHARE) -> Outcome:
    """A robot makes its way, and ends near where the plan ends.

    Args:
        rule: its name.
        way: what is made.
        who: how the sentence begins.
        lost: where way is lost.
        least: the part of the way below which it is an error.
    """
    if way.share is not None and not gets_full_share(way.share):
        goes = f"{who} goes {way.made * 1000:.1f} of {way.asked * 1000:.1f} mm"
        words = f"{goes}, {way.share * 100:.0f} % of its way."
        return _share_outcome(rule, way.share, words, lost, least)
    limit = max(TRAVEL_LIMIT, TRAVEL_SHARE * way.asked)
    if way.gap <= limit + TOLERANCE:
        return Outcome(_way_margin(rule, way.share, RuleMargin(rule, limit - way.gap, "m")))
    ends = f"{who} ends {way.gap * 1000:.1f} mm from where the plan ends, more than {limit * 1000:.1f} mm."
    words = f"{ends} {lost.words}"
    finding = found(rule, Severity.WARNING, words, lost.remedy, way.gap, limit, **lost.place)
    return Outcome(RuleMargin(rule, limit - way.gap, "m"), (finding,))


def heading_outcome(rule: str, way: WayMade, who: str, lost: Lost, least: float = LEAST_SHARE) -> Outcome:
    """A body makes its turn, and ends with the plan's heading; arguments as of `travel_outcome`."""
    if way.turn_share is not None and not gets_full_share(way.turn_share):
        words = (
            f"{who} turns by {np.degrees(way.made_turn):.1f} of {np.degrees(way.asked_turn):.1f}°, "
            f"{way.turn_share * 100:.0f} % of its turn."
        )
        return _share_outcome(rule, way.turn_share, words, lost, least)
    limit = max(HEADING_LIMIT, TRAVEL_SHARE * way.asked_turn)
    if way.turn_gap <= limit:
        return Outcome(_way_margin(rule, way.turn_share, RuleMargin(rule, limit - way.turn_gap, "rad")))
    words = (
        f"{who} ends turned {np.degrees(way.turn_gap):.1f}° from the plan's heading, more than "
        f"{np.degrees(limit):.0f}°. {lost.words}"
    )
    finding = found(rule, Severity.WARNING, words, lost.remedy, way.turn_gap, limit, **lost.place)
    return Outcome(RuleMargin(rule, limit - way.turn_gap, "rad"), (finding,))


def gets_full_share(share: float) -> bool:
    """Whether so much of a way or a turn gets no warning."""
    return share >= WARNED_SHARE - SHARE_TOLERANCE


def gets_on(share: float, least: float = LEAST_SHARE) -> bool:
    """Whether so much of a way or a turn is no error."""
    return share >= least - SHARE_TOLERANCE


def _way_margin(rule: str, share: float | None, gap: RuleMargin) -> RuleMargin:
    """How far a part that is made stays from a warning; where none is asked, how far the gap does."""
    return gap if share is None else RuleMargin(rule, share - WARNED_SHARE, "")


def _share_outcome(rule: str, share: float, words: str, lost: Lost, least: float) -> Outcome:
    """Too little of a way or a turn is a warning, less than the least part an error."""
    is_walk = gets_on(share, least)
    severity, limit = (Severity.WARNING, WARNED_SHARE) if is_walk else (Severity.ERROR, least)
    allowed = f"Less than {limit * 100:.0f} % {'gets a warning' if is_walk else 'is no walk'}."
    sentence = f"{words} {lost.words} {allowed}"
    finding = found(rule, severity, sentence, lost.remedy, share, limit, **lost.place)
    return Outcome(RuleMargin(rule, share - WARNED_SHARE, ""), (finding,))


def _lost(report: SimulationReport, problem: SimulationProblem) -> Lost:
    """Where way is lost: in a run that ends early, by feet that slide, or by neither."""
    slides, moves = longest_slides(report, problem)
    foot = int(slides.argmax())
    time = float(report.arrival_times[moves[foot]])
    place = _place(report, problem, time, foot)
    missing = problem.waypoints.count - len(report.arrival_times)
    if missing:
        ended = float(report.arrival_times[-1])
        words = f"The run ended at {ended:.1f} s, {missing} of {problem.waypoints.count} waypoints early."
    elif slides[foot] > SLIP_LIMIT:
        words = (
            f"Foot {foot + 1} slides most, by {slides[foot] * 1000:.1f} mm in one stance about {time:.1f} s."
        )
    else:
        words = (
            f"No foot slides by more than {SLIP_LIMIT * 1000:.0f} mm in a stance: the body leans by up to "
            f"{np.degrees(report.max_tilt):.1f}°, and motors stop up to {ARRIVAL_THRESHOLD * 1000:.0f} mm "
            "short."
        )
    return Lost(words, SEE_SLIDES, place)


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
