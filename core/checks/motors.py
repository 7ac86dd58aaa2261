"""Rules on motors and firmware: range, speed, acceleration, size and time of a move, deafness for Stop."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from core.arrays import SAME, Bools, Floats, first_highest, first_place, stretches
from core.checks.checked_plan import WITHIN, Beyond, CheckedPlan, knot_place
from core.findings import TOLERANCE, Finding, Outcome, RuleMargin, Severity, found
from core.motion.speeds import motor_accelerations, motor_speeds
from core.motion.within_stroke import NOT_CLIPPED, clipped_words
from core.robot.kinematics import REMEDY
from core.robot.model import RobotModel
from core.wire.messages import LONGEST_DURATION, SHORTEST_DURATION
from core.wire.robot_time import ARRIVAL_THRESHOLD, ARRIVED, deafness, largest_moves, ramp_time
from core.wire.waypoints import Waypoints

DEAF_LIMIT = 2.5
"""A plan during which the robot does not hear Stop for longer is not fit, s."""
DEAF_SLACK = ramp_time(SAME)
"""Excess over the limit that is no finding, s: cutting long moves leaves as much."""


def check_strokes(
    model: RobotModel, waypoints: Waypoints, times: Floats | None = None, beyond: Beyond = WITHIN
) -> Outcome:
    """Every motor stays within its range; strokes that were clipped for it are a warning.

    Args:
        model: the robot.
        waypoints: one a knot, or what is sent.
        times: (count,) the plan's time of each, s; None where it is not known.
        beyond: where the motion leaves the range.
    """
    lower, upper = model.stroke.lower, model.stroke.upper
    room = np.minimum(waypoints.strokes - lower, upper - waypoints.strokes)
    findings = [*_clipped(beyond.clipped, times), *_unreached(beyond.unreached, times)]
    # A motion that was refused for the least excess does not pass here.
    slack = TOLERANCE if beyond.unreached is None else NOT_CLIPPED
    for foot in range(room.shape[1]):
        for first, last in stretches(np.asarray(room[:, foot].min(axis=-1) < -slack)):
            findings.append(_beyond_range(model, waypoints, times, foot, (first, last)))
    return Outcome(RuleMargin("stroke", float(room.min()), "m"), tuple(findings))


def _beyond_range(
    model: RobotModel, waypoints: Waypoints, times: Floats | None, foot: int, samples: tuple[int, int]
) -> Finding:
    """A foot's motors leave their range for some samples; it names the motor that goes furthest beyond."""
    lower, upper = model.stroke.lower, model.stroke.upper
    first, last = samples
    strokes = waypoints.strokes[first : last + 1, foot]
    sample, actuator = first_place(np.maximum(lower - strokes, strokes - upper))
    value, sample = float(strokes[sample, actuator]), first + sample
    place: dict[str, Any] = {"sample": sample, "foot": foot, "actuator": actuator}
    if times is not None:
        place["time"] = float(times[sample])
    stretch = "" if first == last else f" (samples {first + 1} to {last + 1})"
    words = (
        f"Motor {actuator + 1} of foot {foot + 1} would go to {value * 1000:.2f} mm at sample "
        f"{sample + 1}{stretch}; its range is {lower * 1000:.1f} to {upper * 1000:.1f} mm."
    )
    limit = lower if value < lower else upper
    return found("stroke", Severity.ERROR, words, REMEDY, value, limit, **place)


def _clipped(clipped: Floats | None, times: Floats | None) -> list[Finding]:
    if clipped is None or not clipped.any():
        return []
    sample, foot, actuator = first_place(clipped)
    place: dict[str, Any] = {"sample": sample, "foot": foot, "actuator": actuator}
    if times is not None:
        place["time"] = float(times[sample])
    words = f"Strokes beyond the motors' range were clipped, {clipped_words(clipped)}."
    remedy = "Raise or lower the body, or make the motion smaller, to keep the whole motion."
    return [found("stroke", Severity.WARNING, words, remedy, float(clipped.max()), 0.0, **place)]


def _unreached(unreached: Bools | None, times: Floats | None) -> list[Finding]:
    findings = []
    for foot in range(0 if unreached is None else unreached.shape[1]):
        for first, last in [] if unreached is None else stretches(unreached[:, foot]):
            place: dict[str, Any] = {"sample": first, "foot": foot}
            if times is not None:
                place["time"] = float(times[first])
            words = f"No rod is long enough for foot {foot + 1} {_samples(first, last)}."
            findings.append(found("stroke", Severity.ERROR, words, REMEDY, None, 0.0, **place))
    return findings


def _samples(first: int, last: int) -> str:
    return f"at sample {first + 1}" if first == last else f"at samples {first + 1} to {last + 1}"


def check_deafness(waypoints: Waypoints, kept: Sequence[int] | None = None) -> Outcome:
    """No move keeps the robot from hearing Stop for too long.

    Args:
        waypoints: what is sent.
        kept: (count,) knot of each waypoint; None where each is its own.
    """
    seconds = deafness(waypoints)
    margin = RuleMargin("deafness", DEAF_LIMIT - seconds, "s")
    if seconds <= DEAF_LIMIT + DEAF_SLACK:
        return Outcome(margin)
    number = int(first_highest(largest_moves(waypoints))) + 1
    words = (
        f"The move to waypoint {number + 1} keeps the robot from hearing Stop for {seconds:.1f} s; at most "
        f"{DEAF_LIMIT} s may be sent."
    )
    remedy = f"Choose a stop bound of at most {DEAF_LIMIT} s, which cuts long moves."
    sample = number if kept is None else kept[number]
    finding = found("deafness", Severity.ERROR, words, remedy, seconds, DEAF_LIMIT, sample=sample)
    return Outcome(margin, (finding,))


def check_durations(waypoints: Waypoints, kept: Sequence[int] | None = None) -> Outcome:
    """Every waypoint has a planned time that a message can carry.

    Args:
        waypoints: what is sent.
        kept: (count,) knot of each waypoint; None where each is its own.
    """
    durations = waypoints.durations
    room = np.minimum(durations - SHORTEST_DURATION, LONGEST_DURATION - durations)
    margin = RuleMargin("duration", float(room.min()), "s")
    wrong = np.nonzero(room < -TOLERANCE)[0]
    if not wrong.size:
        return Outcome(margin)
    first, value = int(wrong[0]), float(durations[wrong[0]])
    others = f" (and {wrong.size - 1} more)" if wrong.size > 1 else ""
    words = (
        f"Waypoint {first + 1}{others} has a duration of {value:g} s; it must lie in "
        f"{SHORTEST_DURATION:g} to {LONGEST_DURATION:g} s, which is what a message can carry."
    )
    remedy = "Give each waypoint the time that its move is planned for."
    limit = SHORTEST_DURATION if value < SHORTEST_DURATION else LONGEST_DURATION
    sample = first if kept is None else kept[first]
    return Outcome(margin, (found("duration", Severity.ERROR, words, remedy, value, limit, sample=sample),))


def check_move_size(plan: CheckedPlan) -> Outcome:
    """Every move is larger than the firmware's threshold, within which it takes a waypoint for reached.

    Where waypoints are merged within that threshold, those that are left with less to go are needed for what
    stands between them, and no finding (see `still_note`).
    """
    still, smallest = _still_waypoints(plan.waypoints)
    is_merged = plan.way is not None and plan.way.merge >= ARRIVAL_THRESHOLD - TOLERANCE
    if not still or is_merged:
        known = None if still or not np.isfinite(smallest) else smallest - ARRIVAL_THRESHOLD
        return Outcome(RuleMargin("move_size", known, "m"))
    margin = RuleMargin("move_size", smallest - ARRIVAL_THRESHOLD, "m")
    remedy = f"Merge waypoints within {ARRIVAL_THRESHOLD * 1000:.1f} mm."
    sample = still[0] if plan.way is None else plan.way.kept[still[0]]
    place = knot_place(plan, sample)
    words = _still_words(still, plan.waypoints)
    finding = found("move_size", Severity.WARNING, words, remedy, smallest, ARRIVAL_THRESHOLD, **place)
    return Outcome(margin, (finding,))


def still_note(plan: CheckedPlan) -> str:
    """How many merged waypoints the firmware does not move to, in a sentence; nothing for none."""
    still, _ = _still_waypoints(plan.waypoints)
    return _still_words(still, plan.waypoints) if still else ""


def _still_words(still: list[int], waypoints: Waypoints) -> str:
    return (
        f"At {len(still)} of {waypoints.count} waypoints, first at waypoint {still[0] + 1}, no motor has "
        f"more than {ARRIVAL_THRESHOLD * 1000:.1f} mm to go: the firmware takes them for reached and moves "
        "nothing."
    )


def _still_waypoints(waypoints: Waypoints) -> tuple[list[int], float]:
    """Waypoints at which the firmware finds every motor near enough, and the smallest way to any, m.

    A waypoint that repeats the pose before it is a wait and no move.
    """
    here, still, smallest = waypoints.strokes[0], [], np.inf
    for index in range(1, waypoints.count):
        distance = float(np.abs(waypoints.strokes[index] - here).max())
        if distance <= TOLERANCE:
            continue
        smallest = min(smallest, distance)
        if distance > ARRIVED:
            here = waypoints.strokes[index]
        else:
            still.append(index)
    return still, float(smallest)


def check_motor_speed(plan: CheckedPlan) -> Outcome:
    """Motors can follow the plan in its own time, and keep the speed that the document allows."""
    limit, asked = plan.model.stroke.speed, plan.asked.motor_speed
    if asked is None or asked >= limit:
        moves = np.abs(np.diff(plan.knots.strokes, axis=0))
        speeds = moves / np.maximum(plan.knots.durations[1:], 1e-9)[:, None, None]
        so = f"motors make {limit * 1000:.0f} mm/s, so the robot takes longer than planned there."
        remedy = "Give the step more time where that matters."
    else:
        limit, speeds = asked, np.nan_to_num(motor_speeds(plan.model, plan.trajectory))
        so, remedy = f"the gait allows {limit * 1000:g} mm/s.", "Optimise again, or allow more."
    value, place, motor = _worst(plan, speeds, "mm/s")
    margin = RuleMargin("motor_speed", limit - value, "m/s")
    if value <= limit + TOLERANCE:
        return Outcome(margin)
    words = f"{motor}; {so}"
    finding = found("motor_speed", Severity.WARNING, words, remedy, value, limit, **place)
    return Outcome(margin, (finding,))


def check_motor_acceleration(plan: CheckedPlan) -> list[Outcome]:
    """Motors keep the acceleration that the document allows; nothing where it sets none.

    The robot's own is no limit of a plan: its firmware ramps to and from each waypoint (see
    `acceleration_note`).
    """
    limit = plan.asked.motor_acceleration
    if limit is None:
        return []
    needed = np.nan_to_num(motor_accelerations(plan.model, plan.trajectory))
    value, place, motor = _worst(plan, needed, "mm/s²")
    margin = RuleMargin("motor_acceleration", limit - value, "m/s²")
    if value <= limit + TOLERANCE:
        return [Outcome(margin)]
    words = f"{motor}; the gait allows {limit * 1000:g} mm/s²."
    remedy = "Optimise again, or allow more."
    return [
        Outcome(
            margin, (found("motor_acceleration", Severity.WARNING, words, remedy, value, limit, **place),)
        )
    ]


def acceleration_note(plan: CheckedPlan) -> str:
    """A sentence on how far the plan's motor acceleration exceeds the robot's; empty if it does not."""
    needed = float(np.nan_to_num(motor_accelerations(plan.model, plan.trajectory)).max(initial=0.0))
    limit = plan.model.stroke.acceleration
    if needed <= limit + TOLERANCE:
        return ""
    return (
        f"The plan needs motor accelerations of up to {needed * 1000:.1f} mm/s², the robot's motors make "
        f"{limit * 1000:.0f} mm/s². The robot keeps the path but needs more time."
    )


def _worst(plan: CheckedPlan, values: Floats, unit: str) -> tuple[float, dict[str, Any], str]:
    """The largest of (n, legs, 3) values, its place, and what motor needs it, in words."""
    sample, foot, actuator = first_place(values)
    place = {**knot_place(plan, sample), "foot": foot, "actuator": actuator}
    value = float(values.max())
    motor = f"Motor {actuator + 1} of foot {foot + 1}"
    return value, place, f"{motor} would need {value * 1000:.1f} {unit} after sample {sample + 1}"
