"""Turns a pose of the robot into the last segment of a segment table."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import count
from string import ascii_lowercase

import numpy as np

from core.arrays import Floats
from core.errors import InputError
from core.gait.gait import Gait
from core.jog.check import DOWN_DEPTH
from core.motion.trajectory import quarter_turn
from core.robot.kinematics import feet_in_robot
from core.robot.leg import foot_from_strokes
from core.robot.model import RobotModel
from core.segments.segment_table import MOST_STEPS, Segment, SegmentTable, SegmentVocabulary, require_heights

SAME = 0.00025
"""A place or height that is nearer than this is taken for the pose's, m."""

PLACE_DECIMALS, HEIGHT_DECIMALS = 3, 5
"""Decimals of a new place, a multiple of the step, and of a new height, m."""


@dataclass(frozen=True)
class PoseSegment:
    """A table with a pose at its end.

    Args:
        table: the whole table.
        name: of the pose.
        beside: (legs,) how far each foot of the robot stands beside the line of the step, which named places
            cannot say, m.
    """

    table: SegmentTable
    name: str
    beside: Floats


@dataclass(frozen=True)
class _FootPose:
    """A foot of direction 1: multiple of the step, stroke of a centred foot in m, and in the air or not."""

    place: float
    height: float
    swing: bool


def pose_to_segment(gait: Gait, model: RobotModel, strokes: Floats) -> PoseSegment:
    """Adds a segment to a gait's table in which every foot goes to where strokes put it.

    A place is d·s/|s|² for a foot's displacement d from its module's centre and the step's s. Places,
    heights and segments that are there already are used again; new ones are called after the pose, with a
    letter where it needs several. The part that iterations repeat stays as it is.

    Args:
        gait: with a segment table.
        model: its robot.
        strokes: (legs, 3) of the pose, m.

    Raises:
        InputError: the gait has no table or no step, or a foot is where no name can say.
    """
    if gait.segment_table is None:
        raise InputError(
            f"“{gait.name}” has no segment table for the pose. Make one under Segments first.",
            "segment_table",
        )
    feet, beside = _feet(gait, model, strokes)
    table = gait.segment_table
    name = _fresh_name(table.vocabulary)
    xy, z = dict(table.vocabulary.xy), dict(table.vocabulary.z)
    segments = dict(table.vocabulary.segments)
    length = float(np.linalg.norm(gait.step[:2]))
    rows = []
    for foot, row in zip(feet, table.rows, strict=True):
        place = _named(xy, foot.place, SAME / length, name)
        height = _named(z, foot.height, SAME, name)
        way = Segment(segments[row[-1]].end, f"{place}-{height}", foot.swing)
        rows.append((*row, _way(segments, way, f"To {name}")))
    require_heights(z, model.stroke)
    vocabulary = SegmentVocabulary(xy, z, segments)
    longer = replace(table, rows=tuple(rows), vocabulary=vocabulary, repeat_to=table.last_repeated)
    return PoseSegment(longer, name, beside)


def _feet(gait: Gait, model: RobotModel, strokes: Floats) -> tuple[list[_FootPose], Floats]:
    """Feet in the order of the table's rows, and how far those of the robot are beside the step's line."""
    step = np.array(gait.step[:2])
    square = float(step @ step)
    if square == 0.0:
        raise InputError(
            "The gait has no step, and a place is named as a multiple of it. Give it a step first.", "step"
        )
    feet = feet_in_robot(model, strokes)
    away = (feet - model.module_centres_robot)[:, :2] @ quarter_turn(gait.quarter_turns)[:2, :2]
    places = away @ step / square
    beside = np.linalg.norm(away - places[:, None] * step, axis=1)
    far = int(np.abs(places).argmax())
    if abs(places[far]) > MOST_STEPS:
        raise InputError(
            f"Foot {far + 1} stands at {places[far]:.1f} times the step, which is more than "
            f"{MOST_STEPS:.0f} times. Take a longer step.",
            "step",
        )
    deepest = float(foot_from_strokes(model.leg, np.zeros(3))[2])
    heights, up = deepest - feet[:, 2], feet[:, 2] > feet[:, 2].min() + DOWN_DEPTH
    poses = [
        _FootPose(round(float(a), PLACE_DECIMALS), round(float(h), HEIGHT_DECIMALS), bool(swing))
        for a, h, swing in zip(places, heights, up, strict=True)
    ]
    shift = gait.quarter_turns * model.leg_count // 4
    return [poses[(row + shift) % model.leg_count] for row in range(model.leg_count)], beside


def _fresh_name(vocabulary: SegmentVocabulary) -> str:
    taken = {*vocabulary.xy, *vocabulary.z, *vocabulary.segments}
    return next(name for name in (f"Pose {n}" for n in count(1)) if not any(name in one for one in taken))


def _named(values: dict[str, float], value: float, same: float, stem: str) -> str:
    """The nearest name that means as good as the value, or a new one."""
    near = min(values, key=lambda one: abs(values[one] - value))
    if abs(values[near] - value) <= same:
        return near
    name = _lettered(values, stem)
    values[name] = value
    return name


def _way(segments: dict[str, Segment], way: Segment, stem: str) -> str:
    """The name of a way; of a new one where there is none like it."""
    for name, segment in segments.items():
        if segment == way:
            return name
    name = _lettered(segments, stem)
    segments[name] = way
    return name


def _lettered(taken: Mapping[str, object], stem: str) -> str:
    """The stem, or the stem with the next letter of which there is none yet."""
    names = [stem, *(f"{stem} {letter}" for letter in ascii_lowercase[1:])]
    return next(name for name in names if name not in taken)
