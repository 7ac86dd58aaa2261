"""Finishes a drawing by the rules of footfall patterns: the pattern solver's problem, and its result."""

from __future__ import annotations

from dataclasses import replace

from core.arrays import Bools
from core.errors import FootfallError
from core.gait.gait import Gait, with_iterations
from core.patterns.limits import walking_rules
from core.patterns.problem import PatternProblem
from core.patterns.sources import completion_problem
from core.patterns.to_gait import completed_gait, order_of
from core.robot.model import RobotModel
from solver_jobs.remedies.arms import arm_caution
from solver_jobs.remedies.layout import with_ends
from solver_jobs.remedies.remedy import Remedy, RemedyKind, order_words
from solver_jobs.results.motion import MotionResult

LABEL = "Finish the drawing for me"


def completion_question(gait: Gait, model: RobotModel) -> PatternProblem | None:
    """The problem of finding footfalls close to a drawing, with one swing for each foot and iteration.

    Args:
        gait: the drawing.
        model: its robot.

    Returns:
        None if the drawing cannot be finished this way: its iterations differ, for example, or feet are held
        in the air, while the rules require a swing of every foot.
    """
    if gait.held.any:
        return None
    try:
        one = _one_iteration(gait, model)
        return completion_problem(one, rules=walking_rules(one))
    except FootfallError:
        return None


def completed_drawing(gait: Gait, model: RobotModel, stance: Bools) -> Gait:
    """The gait with the footfalls of a solution in all its iterations.

    Args:
        gait: the drawing.
        model: its robot.
        stance: (legs, samples) of one iteration.
    """
    one = completed_gait(_one_iteration(gait, model), stance)
    drawn = replace(one, order=order_of(stance, one.quarter_turns))
    return with_iterations(drawn, gait.iterations)


def completion_remedy(asked: Gait, gait: Gait, model: RobotModel, motion: MotionResult) -> Remedy:
    """The remedy that offers a finished drawing.

    Args:
        asked: the drawing before it was finished.
        gait: the finished drawing.
        model: its robot.
        motion: the motion of the finished drawing.
    """
    words = f"{order_words(gait)}, as near to your drawing as the rules of footfall patterns allow."
    margin = gait.options.margin
    if margin != asked.options.margin:
        words += f" Margin {margin * 1000:g} mm."
    return Remedy(RemedyKind.COMPLETED, LABEL, words, gait, motion, arm_caution(gait, model, motion))


def _one_iteration(gait: Gait, model: RobotModel) -> Gait:
    """One iteration with its ends mended and the robot's own margin.

    Raises:
        InputError: the gait cannot be reduced to one iteration.
    """
    mended = with_ends(gait).with_options(margin=max(gait.options.margin, model.margin))
    return mended if mended.iterations == 1 else with_iterations(mended, 1)
