"""A gait of a space as a document."""

from dataclasses import replace

from core.atlas.point import AtlasPoint
from core.errors import InputError
from core.gait.gait import Gait, Orientation, drawn_timeline
from core.gait.held_feet import HeldFeet
from core.gait.poses import Poses
from core.library.new_gait import default_phase_knots, drawn_gait
from core.pose_gaits.gait_poses import new_pose_gait
from core.robot.model import RobotModel

CYCLES = 3
"""Iterations of a gait for the robot's clock that is opened: from the standard stance to rest."""


def drawn_document(point: AtlasPoint, model: RobotModel, name: str) -> Gait:
    """A drawn gait with the parameters of a point, at direction 1.

    Args:
        point: of a space of drawn gaits.
        model: its robot.
        name: what a person calls it.

    Raises:
        InputError: a parameter is none that a drawn gait can have.
    """
    knots = default_phase_knots(model)
    gait = drawn_gait(model, name, Orientation.FBS, point.order, point.step, phase_knots=knots)
    held = replace(gait, held=HeldFeet(point.lost, point.lost), step=(point.step_x, point.step_y, point.turn))
    asked = held.with_options(
        margin=point.margin,
        clearance=point.clearance,
        plane_height=point.height,
        stop_bound=point.stop_bound,
    )
    return replace(asked, timeline=drawn_timeline(asked))


def pose_document(point: AtlasPoint, model: RobotModel, name: str) -> Gait:
    """A gait for the robot's clock with the parameters of a point, without poses, from stance to rest.

    Args:
        point: of a space of gaits for the robot's clock.
        model: its robot; its numbers are those of its parameters file.
        name: what a person calls it.

    Raises:
        InputError: the robot's numbers are others, which a document cannot say.
    """
    if point.numbers:
        key = point.numbers[0][0]
        raise InputError(
            f"This gait is of a robot with another {key} than {model.title}. A gait file cannot say that "
            "yet; its figures stand in the atlas.",
            key,
        )
    gait = drawn_gait(model, name, Orientation.FBS, point.order, point.step, iterations=CYCLES)
    asked = replace(gait, step=(point.step_x, point.step_y, point.turn)).with_options(
        margin=point.margin, clearance=point.clearance, stop_bound=point.stop_bound
    )
    poses = Poses(free_step=False, overlap=point.overlap)
    return new_pose_gait(name, asked, poses, model)
