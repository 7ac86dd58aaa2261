"""What a robot allows a pattern: how far and how fast its body goes, how long a swing takes."""

import math
from dataclasses import replace

import numpy as np

from core.gait.gait import Gait
from core.gait.options import GaitOptions
from core.patterns.problem import BalanceModel, PatternRules
from core.robot.leg import strokes_from_foot
from core.robot.model import RobotModel

_DIRECTIONS, _FINENESS, _FURTHEST = 24, 0.00025, 0.05
"""How the reach of a foot is sampled: directions, m, m."""

SWING_SHARE = 0.75
"""Share of a foot's speed limit that its way can use; the rest goes into rising and sinking."""

SHORTEST_SWING = 3
"""Samples that a foot needs to rise, to be up and to sink."""


def body_reach(model: RobotModel, plane_height: float) -> float:
    """How far the body can be moved over feet that stand under their modules, in the worst direction, m.

    Args:
        model: the robot.
        plane_height: of the actuator plane above the standing feet's platforms, m.
    """
    angles = np.arange(_DIRECTIONS) * 2 * np.pi / _DIRECTIONS
    radii = np.arange(0.0, _FURTHEST, _FINENESS)
    feet = np.empty((len(radii), _DIRECTIONS, 3))
    feet[..., 0] = radii[:, None] * np.cos(angles)
    feet[..., 1] = radii[:, None] * np.sin(angles)
    feet[..., 2] = -plane_height
    strokes = strokes_from_foot(model.leg, feet)
    within = (strokes >= model.stroke.lower) & (strokes <= model.stroke.upper)
    every = within.all(axis=(1, 2))
    return float(radii[max(int(np.argmin(np.append(every, False))) - 1, 0)])


def balance_model(model: RobotModel, plane_height: float, speed: float, travel: float) -> BalanceModel:
    """Where the feet of a robot stand and how the body can move over them.

    The feet are taken to stand under their modules. A foot is half a step ahead or behind when it lands or
    lifts, and that much less can the body be moved.

    Args:
        model: the robot.
        plane_height: of the actuator plane above the standing feet's platforms, m.
        speed: of the body at most, m/s.
        travel: the body's travel an iteration, m.
    """
    feet = np.asarray(model.module_centres_robot[:, :2])
    reach = max(body_reach(model, plane_height) - travel / 2, 0.0)
    return BalanceModel(feet - feet.mean(axis=0), reach, speed)


def shared_balance(model: RobotModel, *gaits: Gait) -> BalanceModel:
    """The balance model that holds in every one of some gaits.

    Args:
        model: their robot.
        gaits: at least one.
    """
    return balance_model(
        model,
        max(gait.options.plane_height for gait in gaits),
        min(gait.options.body_speed for gait in gaits),
        max(float(np.hypot(*gait.step[:2])) for gait in gaits),
    )


def own_balance(model: RobotModel, travel: float = 0.010) -> BalanceModel:
    """A robot's balance model at the usual height and speed (see `balance_model`)."""
    return balance_model(model, GaitOptions.plane_height, GaitOptions.body_speed, travel)


def needed_swing(*gaits: Gait) -> int:
    """How many samples a swing takes at least, so that a robot's feet can take the gaits' steps.

    A foot has to travel a step L within its swing: that takes L / (¾·v·dt) samples, v the smallest limit of
    its speed in the gaits, and at least three, one each to rise, to be up and to sink.

    Args:
        gaits: both sides of a transition, or one gait.
    """
    longest = max(float(np.hypot(*gait.step[:2])) for gait in gaits)
    sample_time = min(gait.timeline.sample_time for gait in gaits)
    speed = SWING_SHARE * min(gait.options.foot_speed for gait in gaits)
    return max(math.ceil(longest / (speed * sample_time) - 1e-9), SHORTEST_SWING)


def walkable(rules: PatternRules, *gaits: Gait) -> PatternRules:
    """Rules whose swings are at least as long as the feet need (see `needed_swing`).

    Args:
        rules: the others stay; a rule on swings that is off or smaller is set.
        gaits: both sides of a transition, or one gait.
    """
    needed = needed_swing(*gaits)
    return replace(
        rules,
        shortest_swing=max(rules.shortest_swing or 0, needed),
        least_swing=max(rules.least_swing or 0, needed),
    )


def walking_rules(*gaits: Gait) -> PatternRules:
    """F's rules with swings that a robot's feet can do, and balance with the larger of the gaits' margins.

    Args:
        gaits: both sides of a transition, or one gait.
    """
    margin = max(gait.options.margin for gait in gaits)
    return walkable(PatternRules(balance=margin), *gaits)
