"""The rules for robots whose motors share actuators, which judge the motion that is made of a plan."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from core.arrays import Bools, Floats, first_highest, first_lowest, first_place
from core.checks.checked_plan import CheckedPlan
from core.checks.ground import CLEARANCE_LIMIT, SLIP_LIMIT
from core.checks.made_plan import (
    RULE,
    MadePlan,
    MadePoses,
    RealSwing,
    made_plan,
    made_poses,
    made_words,
    missed_strokes,
)
from core.findings import TOLERANCE, Finding, Outcome, RuleMargin, Severity, found
from core.gait.held_feet import feet_words
from core.motion.balance import BALANCE_RESERVE
from core.motion.way_made import COMES_BACK, LEAST_SHARE
from core.physics.findings import TILT_LIMIT, Lost, heading_outcome, travel_outcome
from core.robot.coupled_strokes import real_strokes
from core.robot.model import RobotModel
from core.wire.waypoint_merging import plan_of_knots
from core.wire.waypoints import Waypoints

RESIDUAL_LIMIT = 0.001
"""Strokes that are missed by more get a warning; the firmware takes so much for arrived, m."""
SIMULATE = "Move feet that share a motor alike, and simulate: physics knows it more exactly."
OVER_FEET = "Shift the body over the feet that really stand before each step."
SLIDING_LIMIT = 0.003
"""A foot that slides no further in a whole run is not looked at where only waypoints are known, m."""
MOST_SLIDING = 1.2
"""Feet that slide further than this times the robot's way show that it does not walk, by measurement."""
ESTIMATE_SHARE = 0.25
"""An estimated way may be so much of the asked one too long; with nine motors it is at most 0.2 by
measurement, and with five, where it is more, no foot lifts."""
MORE_MOTORS = "Choose a robot with more motors."
MOVE_ALIKE = "Move feet that share a motor alike, or choose a robot with more motors."


def check_made(plan: CheckedPlan, *, is_simulated: bool = False) -> list[Outcome]:
    """How a robot with shared motors rests, leans, lifts, slides and goes along a plan.

    Args:
        plan: what is checked.
        is_simulated: whether the physics judges these waypoints too. It knows more exactly how far the robot
            goes and whether it walks, so that what forbids it here is a warning then.
    """
    model, t = plan.model, plan.trajectory
    way = plan_of_knots(model, t, plan.waypoints) if plan.way is None else plan.way
    made = made_plan(model, t, way)
    outcomes = [
        *_rest(made.poses, plan.asked.margin),
        _strokes(model, missed_strokes(model, t), t.times, made),
        _lift(made),
        _slip(made),
        *_way(made),
    ]
    return [_warned(outcome) for outcome in outcomes] if is_simulated else outcomes


def _warned(outcome: Outcome) -> Outcome:
    findings = (replace(finding, severity=Severity.WARNING) for finding in outcome.findings)
    return replace(outcome, findings=tuple(findings))


def check_made_waypoints(model: RobotModel, waypoints: Waypoints) -> list[Outcome]:
    """What waypoints alone can show of a robot with shared motors: how it rests, leans, lifts and slides."""
    made = replace(waypoints, strokes=real_strokes(model, waypoints.strokes))
    times = np.cumsum(waypoints.durations) - waypoints.durations[0]
    poses = made_poses(model, made, np.arange(waypoints.count), times)
    residual = waypoints.strokes - made.strokes
    return [*_rest(poses, 0.0), _strokes(model, residual, times), _steps(model, poses)]


def _steps(model: RobotModel, poses: MadePoses) -> Outcome:
    """A foot that slides far lifts at some time, and feet slide less than the robot goes."""
    motion = poses.motion
    slides, rises = motion.slides.sum(axis=0), np.nan_to_num(motion.heights).max(axis=0)
    reach = float(np.linalg.norm(model.module_centres_robot[:, :2], axis=1).mean())
    away = np.hypot(np.linalg.norm(motion.middles, axis=1), reach * motion.headings)
    goes = float(away[-1] if away[-1] >= COMES_BACK * away.max() else away.max())
    mean, limit = float(slides.mean()), max(MOST_SLIDING * goes, SLIDING_LIMIT)
    findings = []
    for foot in np.nonzero((slides > SLIDING_LIMIT) & (rises < CLEARANCE_LIMIT - TOLERANCE))[0].tolist():
        words = (
            f"Foot {foot + 1} never comes more than {max(rises[foot], 0.0) * 1000:.1f} mm above the ground, "
            f"and slides by {slides[foot] * 1000:.1f} mm."
        )
        value = float(rises[foot])
        findings.append(found("slip", Severity.ERROR, words, MORE_MOTORS, value, CLEARANCE_LIMIT, foot=foot))
    if mean > limit:
        foot = int(first_highest(slides))
        words = (
            f"The feet slide by {mean * 1000:.1f} mm on average, and the robot goes {goes * 1000:.1f} mm. "
            f"Foot {foot + 1} slides most, by {slides[foot] * 1000:.1f} mm."
        )
        findings.append(found("slip", Severity.ERROR, words, MOVE_ALIKE, mean, limit, foot=foot))
    return Outcome(RuleMargin("slip", limit - mean, "m"), tuple(findings))


def _rest(poses: MadePoses, asked: float) -> Iterator[Outcome]:
    """The centre of mass stays over the feet that stand, and the body upright."""
    margins, standing = poses.motion.margins, poses.motion.standing
    smallest, worst = float(margins.min()), int(first_lowest(margins))
    reserve, place = max(BALANCE_RESERVE, asked), poses.place(worst)
    findings = []
    if not np.isfinite(smallest):
        words = f"At {place['time']:.1f} s the centre of mass is beyond all feet: the robot falls."
        findings.append(found("balance", Severity.ERROR, words, OVER_FEET, None, 0.0, **place))
    elif smallest < reserve - TOLERANCE:
        words = (
            f"At {place['time']:.1f} s the centre of mass is {smallest * 1000:.2f} mm inside the edge of the "
            f"support polygon of {_names(standing[worst])}, which carry it then, where "
            f"{reserve * 1000:.1f} mm is asked: the robot rocks onto other feet."
        )
        findings.append(found("balance", Severity.WARNING, words, OVER_FEET, smallest, reserve, **place))
    known = smallest if np.isfinite(smallest) else None
    yield Outcome(RuleMargin("balance", known, "m"), tuple(findings))
    if known is not None:
        yield _lean(poses)


def _lean(poses: MadePoses) -> Outcome:
    """The body stays as upright as a walking one in physics."""
    lean, standing = poses.motion.lean, poses.motion.standing
    most, worst = float(lean.max()), int(first_highest(lean))
    margin, place = RuleMargin("lean", TILT_LIMIT - most, "rad"), poses.place(worst)
    if most <= TILT_LIMIT:
        return Outcome(margin)
    words = (
        f"The body leans by {np.degrees(most):.1f}° at {place['time']:.1f} s, since it rests on "
        f"{_names(standing[worst])} then. At most {np.degrees(TILT_LIMIT):.0f}° are allowed."
    )
    return Outcome(margin, (found("lean", Severity.ERROR, words, MOVE_ALIKE, most, TILT_LIMIT, **place),))


def _names(standing: Bools) -> str:
    """(legs,) feet that stand, such as `feet 2, 3 and 5`."""
    return feet_words(tuple((np.nonzero(standing)[0] + 1).tolist()))


def _strokes(model: RobotModel, residual: Floats, times: Floats, made: MadePlan | None = None) -> Outcome:
    """Strokes (n, legs, 3) that are missed by more than the firmware takes for arrived, m."""
    missed = np.abs(np.nan_to_num(residual))
    largest = float(missed.max())
    margin = RuleMargin(RULE, RESIDUAL_LIMIT - largest, "m")
    if largest <= RESIDUAL_LIMIT:
        return Outcome(margin)
    sample, foot, actuator = first_place(missed)
    what = "" if made is None else f" The robot makes another motion: {made_words(made)}"
    words = (
        f"{model.actuator_count} motors cannot make {model.motor_count} strokes: that of motor "
        f"{actuator + 1} of foot {foot + 1} is {largest * 1000:.1f} mm off at sample {sample + 1}, where "
        f"{RESIDUAL_LIMIT * 1000:.0f} mm is allowed.{what}"
    )
    place = {"sample": sample, "foot": foot, "actuator": actuator, "time": float(times[sample])}
    return Outcome(
        margin, (found(RULE, Severity.WARNING, words, MOVE_ALIKE, largest, RESIDUAL_LIMIT, **place),)
    )


def _lift(made: MadePlan) -> Outcome:
    """A foot that swings leaves the ground."""
    least = min((swing.rise for swing in made.swings), default=CLEARANCE_LIMIT)
    margin = RuleMargin("clearance", least - CLEARANCE_LIMIT, "m")
    return Outcome(margin, tuple(_dragged(made, swing) for swing in made.dragged))


def _dragged(made: MadePlan, swing: RealSwing) -> Finding:
    words = (
        f"Foot {swing.foot + 1} does not lift in its swing from {made.poses.times[swing.first]:.1f} s: with "
        f"{made.model.actuator_count} motors it comes at most {max(swing.rise, 0.0) * 1000:.1f} mm above the "
        f"ground, where {CLEARANCE_LIMIT * 1000:.0f} mm is needed, so it slides."
    )
    place = {**made.poses.place(swing.highest), "foot": swing.foot}
    value, limit = swing.rise, CLEARANCE_LIMIT
    return found("clearance", Severity.ERROR, words, MORE_MOTORS, value, limit, **place)


def _slip(made: MadePlan) -> Outcome:
    """A foot that should stand stays where it is."""
    slides, worst = made.slides
    findings = []
    for foot in np.nonzero(slides > SLIP_LIMIT + TOLERANCE)[0].tolist():
        value, pose = float(slides[foot]), worst[foot]
        words = (
            f"Foot {foot + 1} slides by {value * 1000:.1f} mm while it stands, most of it near "
            f"{made.poses.times[pose]:.1f} s. The limit is {SLIP_LIMIT * 1000:.1f} mm."
        )
        place = {**made.poses.place(pose), "foot": foot}
        findings.append(found("slip", Severity.WARNING, words, MOVE_ALIKE, value, SLIP_LIMIT, **place))
    return Outcome(RuleMargin("slip", SLIP_LIMIT - float(slides.max()), "m"), tuple(findings))


def _way(made: MadePlan) -> list[Outcome]:
    """The robot gets as far as planned, by an estimate from geometry and friction alone."""
    slides, worst = made.slides
    foot = int(first_highest(slides))
    lost = Lost(
        f"This is an estimate. Foot {foot + 1} slides most, by {slides[foot] * 1000:.1f} mm in a stance.",
        SIMULATE,
        {**made.poses.place(worst[foot]), "foot": foot},
    )
    least = LEAST_SHARE + ESTIMATE_SHARE
    return [
        travel_outcome("made_travel", made.way, "The robot", lost, least),
        heading_outcome("made_heading", made.way, "The body", lost, least),
    ]
