"""`--within-stroke`: motions that leave the motors' range, refused or kept within it."""

from argparse import ArgumentParser, Namespace

from app.cli.common.argument_types import one_of, words_of
from app.cli.common.output import note
from core.arrays import Floats
from core.errors import FootfallError
from core.gait.recording import WithinStroke
from core.motion.trajectory import Trajectory
from core.motion.within_stroke import clipped_motion, clipped_words
from core.robot.kinematics import REMEDY, UnreachableError
from core.robot.model import RobotModel

OPTION = "--within-stroke clip"


def add_within_stroke(parser: ArgumentParser) -> None:
    """Adds the option."""
    text = "clip: strokes beyond the motors' range go to its end (default: such a motion is refused)"
    parser.add_argument(
        "--within-stroke", type=one_of(WithinStroke), metavar=words_of(WithinStroke), default=None, help=text
    )


def kept_within(
    options: Namespace, model: RobotModel, trajectory: Trajectory, recorded: Floats | None = None
) -> tuple[Trajectory, Floats | None]:
    """The motion as the option asks, and how far each stroke was clipped, m; None where none could be.

    Args:
        options: of the command.
        model: the robot.
        trajectory: the motion.
        recorded: how far strokes were clipped already, as a gait document asks, m.

    Raises:
        UnreachableError: the motion leaves the range and the option is not given; the sentence names it.
        InputError: it is too far beyond the range to be clipped.
    """
    if options.within_stroke is None:
        require_within(model, trajectory)
        clipped = recorded
    else:
        kept = clipped_motion(model, trajectory)
        trajectory, clipped = kept.trajectory, kept.clipped if recorded is None else recorded
    if clipped is not None and clipped.any():
        note(f"Strokes beyond the motors' range were clipped, {clipped_words(clipped)}.")
    return trajectory, clipped


def require_within(model: RobotModel, trajectory: Trajectory) -> None:
    """The motion stays within the motors' range.

    Raises:
        UnreachableError: it does not; the sentence says what `--within-stroke clip` would do.
    """
    try:
        trajectory.strokes(model)
    except UnreachableError as refusal:
        try:
            clipped = clipped_motion(model, trajectory).clipped
        except FootfallError as too_far:
            help_words = f"{OPTION} does not help: {too_far.sentence}"
        else:
            help_words = f"Or keep its strokes within the range with {OPTION}: {clipped_words(clipped)}."
        raise refusal.with_remedy(f"{REMEDY} {help_words}") from refusal
