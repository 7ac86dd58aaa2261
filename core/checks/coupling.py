"""The rule for robots whose motors share actuators: what of the strokes is lost, and whether feet lift."""

from dataclasses import dataclass

import numpy as np

from core.arrays import Floats, first_highest, first_place, stretches
from core.findings import TOLERANCE, Finding, Outcome, RuleMargin, Severity, found
from core.gait.manual_motion import stance_slip
from core.motion.trajectory import Trajectory
from core.robot.coupled_strokes import heights_over_standing, real_feet, real_strokes
from core.robot.kinematics import free_strokes
from core.robot.model import RobotModel

RULE = "coupling"
RESIDUAL_LIMIT = 0.001
"""Strokes that are missed by more get a warning; the firmware takes so much for arrived, m."""


@dataclass(frozen=True)
class RealSwing:
    """How high a foot really rises in one of its swings.

    Args:
        foot: 0-based.
        first: sample with which it begins, 0-based.
        highest: sample at which it is highest.
        rise: height there over the plane of the standing feet, m.
    """

    foot: int
    first: int
    highest: int
    rise: float


def coupling_residual(model: RobotModel, trajectory: Trajectory) -> Floats:
    """(n, legs, 3) h − C·u: by how much each wanted stroke is longer than the one that is made, m."""
    wanted = free_strokes(model, trajectory.feet_world, trajectory.pose(model))
    return wanted - real_strokes(model, wanted)


def real_heights(model: RobotModel, trajectory: Trajectory) -> Floats:
    """(n, legs) height of each real foot over the plane of the standing ones, m; nan where there is none."""
    t = trajectory
    return heights_over_standing(real_feet(model, t.feet_world, t.pose(model)), t.contact)


def real_swings(model: RobotModel, trajectory: Trajectory) -> tuple[RealSwing, ...]:
    """Every swing with its real height, by foot and then by time.

    A swing is left out in which three standing feet never make a plane to measure from.
    """
    t = trajectory
    heights = real_heights(model, trajectory)
    found = []
    for foot in range(t.leg_count):
        for first, last in stretches(np.asarray(~t.contact[:, foot])):
            rises = heights[first : last + 1, foot]
            if not np.isnan(rises).all():
                highest = first + int(first_highest(rises))
                found.append(RealSwing(foot, first, highest, float(heights[highest, foot])))
    return tuple(found)


def coupling_note(model: RobotModel, trajectory: Trajectory) -> str:
    """What a plan should say of motors that share actuators; nothing where none do."""
    if not model.is_coupled:
        return ""
    off = float(np.abs(np.nan_to_num(coupling_residual(model, trajectory))).max())
    return (
        f"It takes every stroke as free, but {model.actuator_count} motors drive the {model.motor_count} "
        f"strokes, which are up to {off * 1000:.1f} mm off: Check says what the feet really do."
    )


def check_coupling(model: RobotModel, trajectory: Trajectory, lift_limit: float) -> Outcome:
    """What the coupled motors lose, and what the feet then really do.

    Args:
        model: a robot with fewer actuators than motors.
        trajectory: what is wanted.
        lift_limit: a swing that rises less drags, m.
    """
    residual = np.abs(np.nan_to_num(coupling_residual(model, trajectory)))
    largest = float(residual.max())
    margin = RuleMargin(RULE, RESIDUAL_LIMIT - largest, "m")
    swings = real_swings(model, trajectory)
    dragged = [swing for swing in swings if swing.rise < lift_limit - TOLERANCE]
    findings = [_dragged(model, trajectory, swing, lift_limit) for swing in dragged]
    if largest > RESIDUAL_LIMIT:
        sample, foot, actuator = first_place(residual)
        words = (
            f"{model.actuator_count} motors cannot make {model.motor_count} strokes: that of motor "
            f"{actuator + 1} of foot {foot + 1} is {largest * 1000:.1f} mm off at sample {sample + 1}, where "
            f"{RESIDUAL_LIMIT * 1000:.0f} mm is allowed. {_feet_words(model, trajectory)} "
            f"{_lifted(swings, dragged)} The other rules judge the planned motion."
        )
        remedy = "Move feet that share a motor alike, or choose a robot with more motors."
        place = {
            "sample": sample,
            "foot": foot,
            "actuator": actuator,
            "time": float(trajectory.times[sample]),
        }
        findings.append(found(RULE, Severity.WARNING, words, remedy, largest, RESIDUAL_LIMIT, **place))
    return Outcome(margin, tuple(findings))


def _dragged(model: RobotModel, t: Trajectory, swing: RealSwing, limit: float) -> Finding:
    words = (
        f"Foot {swing.foot + 1} does not lift in its swing from {t.times[swing.first]:.1f} s: with "
        f"{model.actuator_count} motors it comes at most {max(swing.rise, 0.0) * 1000:.1f} mm above the "
        f"standing feet, where {limit * 1000:.0f} mm is needed, so it slides."
    )
    place = {"sample": swing.highest, "foot": swing.foot, "time": float(t.times[swing.highest])}
    return found(RULE, Severity.ERROR, words, "Choose a robot with more motors.", swing.rise, limit, **place)


def _feet_words(model: RobotModel, t: Trajectory) -> str:
    """How far feet go astray and slide, in words, the body where it should be."""
    feet = real_feet(model, t.feet_world, t.pose(model))
    astray = float(np.linalg.norm(feet - t.feet_world, axis=-1).max())
    slide = float(stance_slip(feet, t.contact).max())
    return f"Feet go up to {astray * 1000:.1f} mm elsewhere, and slide up to {slide * 1000:.1f} mm standing."


def _lifted(swings: tuple[RealSwing, ...], dragged: list[RealSwing]) -> str:
    """How many swings lift, in words."""
    if not swings:
        return "No swing leaves three feet standing to measure from."
    lifting = len(swings) - len(dragged)
    if dragged:
        return f"{lifting or 'None'} of {len(swings)} swings really lift{'' if lifting > 1 else 's'}."
    least = min(swing.rise for swing in swings)
    return f"Every foot still lifts, by {least * 1000:.1f} mm or more."
