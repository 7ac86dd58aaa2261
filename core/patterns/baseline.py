"""The baseline that the footfall-pattern thesis compares with (F 4.2): joints blended from gait to gait.

F's robots have joint angles; here a joint's place is a motor's stroke. Over the time of the transition
h(k) = (1 − s)·h₁(k) + s·h₂(k), s = k / (n − 1): the first gait goes on cyclically from its cursor, the second
one runs cyclically up to its cursor. Nothing looks at which feet stand.

What the robot then does is judged at rest at each sample: forward kinematics give its feet, the body rests
on the three lowest of them that have its centre of mass between them, and on others that are as low to
`STANDING_DEPTH`, and it goes where these feet slip least. The stability margin is that of a level body, on
its lowest feet: where it is negative the body tips, until it rests tilted.
"""

from dataclasses import dataclass
from itertools import combinations

import numpy as np

from core.arrays import Bools, Floats, stretches
from core.errors import InputError
from core.motion.balance import STANDING_DEPTH
from core.motion.support_polygon import stability_margins
from core.robot.kinematics import BodyPose, walker_feet
from core.robot.model import RobotModel

FALL = np.radians(1.0)
"""A robot that tips by less is not said to fall, rad; feet that swing 3 mm high let it tip by some 2°."""

_INSIDE = -1e-9
"""Shares of a weight above this are not negative."""


@dataclass(frozen=True)
class TransitionFigures:
    """What a transition is compared by.

    Args:
        speed: of the body along its way, the mean over the transition, m/s; negative backwards.
        margin: the smallest static stability margin: how far inside the polygon of the feet that a level
            body stands on the centre of mass is, m; negative outside.
        tilt: the largest tilt of the body where it rests, rad.
        falls: how many times the centre of mass leaves that polygon and the body tips by `FALL` or more.
    """

    speed: float
    margin: float
    tilt: float
    falls: int


def blended_strokes(first: Floats, at: int, second: Floats, to: int, samples: int) -> Floats:
    """(samples, legs, 3) strokes blended linearly between two cyclic motions, m.

    Args:
        first: (m, legs, 3) one cycle of the gait that is left.
        at: its sample at which the transition begins.
        second: (l, legs, 3) one cycle of the gait that follows.
        to: its sample at which the transition ends.
        samples: of the transition, both ends included.

    Raises:
        InputError: fewer than two samples.
    """
    if samples < 2:
        raise InputError(f"A transition of {samples} samples has no time; it needs at least 2.", "samples")
    k = np.arange(samples)
    share = (k / (samples - 1))[:, None, None]
    before, after = first[(at + k) % len(first)], second[(to - samples + 1 + k) % len(second)]
    return np.asarray((1.0 - share) * before + share * after)


def level_feet(feet_robot: Floats) -> Bools:
    """(n, legs) feet that a level body stands on: the lowest, and those within `STANDING_DEPTH` of it."""
    heights = feet_robot[..., 2]
    return np.asarray(heights - heights.min(axis=1, keepdims=True) <= STANDING_DEPTH)


@dataclass(frozen=True, eq=False)
class Resting:
    """How a body rests on its feet at each sample.

    Args:
        standing: (n, legs) feet on the ground.
        tilt: (n,) of the body, rad; a quarter turn where no three feet have the centre of mass between them.
    """

    standing: Bools
    tilt: Floats


def resting(feet_robot: Floats) -> Resting:
    """A body with its centre of mass over the origin rests on the lowest plane through its feet there.

    Of all three feet with the origin between them those carry it whose plane is lowest at the origin; no
    other foot is then below that plane.

    Args:
        feet_robot: (n, legs, 3) platform centres in the robot's axes, m.
    """
    triples = np.array(list(combinations(range(feet_robot.shape[1]), 3)))
    corners = feet_robot[:, triples]
    rows = np.concatenate([corners[..., :2], np.ones((*corners.shape[:-1], 1))], axis=-1)
    # A plane z = a·x + b·y + c through three feet, and the shares of the weight that each carries.
    flat = np.abs(np.linalg.det(rows)) < 1e-12
    rows = np.where(flat[..., None, None], np.eye(3), rows)
    planes = np.linalg.solve(rows, corners[..., 2:])[..., 0]
    shares = np.linalg.solve(np.swapaxes(rows, -1, -2), np.array([[0.0], [0.0], [1.0]]))[..., 0]
    carries = (shares >= _INSIDE).all(axis=-1) & ~flat
    best = np.where(carries, planes[..., 2], np.inf).argmin(axis=1)
    plane = np.take_along_axis(planes, best[:, None, None], axis=1)[:, 0]
    above = feet_robot[..., 2] - (feet_robot[..., :2] @ plane[:, :2, None])[..., 0] - plane[:, 2:]
    rests = carries.any(axis=1)
    tilt = np.where(rests, np.arctan(np.hypot(plane[:, 0], plane[:, 1])), np.pi / 2)
    standing = np.where(rests[:, None], above <= STANDING_DEPTH, level_feet(feet_robot))
    return Resting(np.asarray(standing), np.asarray(tilt))


def body_way(feet_robot: Floats, standing: Bools) -> Floats:
    """(n − 1, 2) how far the body goes between samples: −mean Δfoot over the feet that stand at both, m.

    That is the move of a level body of constant heading at which those feet slip least (least squares);
    where none stands at both samples it stays.
    """
    both = standing[1:] & standing[:-1]
    moved = np.diff(feet_robot[..., :2], axis=0) * both[..., None]
    return np.asarray(-moved.sum(axis=1) / np.maximum(both.sum(axis=1), 1)[:, None])


def figures_of_strokes(
    model: RobotModel, strokes: Floats, sample_time: float, heading: float
) -> TransitionFigures:
    """What strokes alone make of a transition, at rest at each sample.

    Args:
        model: the robot.
        strokes: (n, legs, 3) m.
        sample_time: s.
        heading: which way the gaits go, rad from +x.
    """
    pose = BodyPose(np.zeros((len(strokes), 3)), np.zeros(len(strokes)))
    feet = walker_feet(model, strokes, pose)
    rest = resting(feet)
    margins = stability_margins(np.zeros((len(strokes), 2)), feet, level_feet(feet))
    way = body_way(feet, rest.standing).sum(axis=0)
    return figures(way, margins, rest.tilt, sample_time, heading)


def figures(
    way: Floats, margins: Floats, tilt: Floats, sample_time: float, heading: float
) -> TransitionFigures:
    """The figures of a transition.

    Args:
        way: (2,) of the body in the transition, m.
        margins: (n,) static stability margin at each sample, m.
        tilt: (n,) of the body that rests on its feet, rad.
        sample_time: s.
        heading: which way the gaits go, rad from +x.
    """
    along = float(way @ [np.cos(heading), np.sin(heading)])
    fallen = np.asarray((margins < 0.0) & (tilt >= FALL))
    seconds = (len(margins) - 1) * sample_time
    return TransitionFigures(along / seconds, float(margins.min()), float(tilt.max()), len(stretches(fallen)))
