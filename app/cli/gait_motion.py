"""The motion of a gait document; a motion that the document lacks is solved now."""

from functools import partial
from pathlib import Path

from app.cli.commands_gait import optimise
from app.cli.common.output import note
from app.documents.gait_json import parse_gait
from app.export.trajectory_files import read_text
from app.plans.sequence_plan import steps_between
from core.arrays import Floats
from core.errors import CheckError, FootfallError, InfeasibleError
from core.gait.gait import Gait, SequencePart
from core.gait.manual_motion import manual_motion
from core.library.new_gait import with_robot
from core.library.sequence import chain_runs, part_name, require_own, run_of
from core.motion.trajectory import Trajectory
from core.pose_gaits.gait_poses import confirmed_gait, pose_problem, with_poses
from core.pose_gaits.pose_gait import PoseGait
from core.recorded.recorded_motion import gait_motion
from core.robot.model import load_robot
from solver_jobs import SolveStatus, solve_live, solve_poses


def checked_gait(path: Path, robot: str | None) -> tuple[Gait, Trajectory, Floats | None]:
    """A gait file as it is checked, its motion, and how far recorded strokes were clipped, m.

    Args:
        path: of the file.
        robot: another robot; None for the gait's own.
    """
    gait = parse_gait(read_text(path), path.name)
    if robot is not None:
        gait = with_robot(gait, load_robot(robot))
    if gait.poses is not None:
        # What was left to the search, such as the step, is then in the document that the motion is held to.
        gait = with_poses(gait, poses_of(gait))
    return gait, *_motion_of(gait)


def trajectory_of(gait: Gait) -> Trajectory:
    """Recorded, by hand table, or solved now and confirmed; of a sequence those of its parts, chained.

    Raises:
        InputError: the recorded motion is not that of the document.
        InfeasibleError: there is no motion.
        CheckError: the optimiser found none that the checker confirms.
    """
    return _motion_of(gait)[0]


def _motion_of(gait: Gait) -> tuple[Trajectory, Floats | None]:
    """The motion, and how far recorded strokes were clipped, m (see `trajectory_of`)."""
    model = load_robot(gait.robot)
    if gait.sequence:
        parts = [_part_motion(index, part) for index, part in enumerate(gait.sequence)]
        whole = chain_runs(gait, model, [motion for motion, _ in parts], partial(steps_between, solve_live))
        require_own(gait, whole)
        return whole.trajectory, whole.clipped([clipped for _, clipped in parts])
    if gait.poses is not None:
        return poses_of(gait).trajectory, None
    if gait.recorded is not None:
        recorded = gait_motion(gait, gait.recorded, model)
        return recorded.trajectory, recorded.clipped
    if gait.segment_table is not None:
        return manual_motion(gait, model).trajectory, None
    verified = optimise(gait)
    if verified.has_motion:
        if verified.status is not SolveStatus.SOLVED:
            note(" ".join(verified.explanation))
        return verified.trajectory, None
    sentence = " ".join(verified.explanation) or "The optimiser found no motion."
    if verified.status is SolveStatus.INFEASIBLE:
        raise InfeasibleError(sentence, gait.name)
    raise CheckError(sentence, gait.name)


def poses_of(gait: Gait) -> PoseGait:
    """The poses that the document has for what it asks; where it has none they are searched for now.

    Raises:
        InfeasibleError: none were found.
        CheckError: the search gave no poses that the checker confirms.
    """
    model = load_robot(gait.robot)
    found = confirmed_gait(gait, model)
    if found is not None:
        return found
    is_bare = gait.poses is None or gait.poses.found is None
    why = "has no poses yet" if is_bare else "has changed since its poses were found"
    note(f"“{gait.name}” {why}. The poses are searched for now.")
    result = solve_poses(pose_problem(gait, model))
    if result.gait is not None:
        return result.gait
    sentence = " ".join(result.explanation)
    kind = InfeasibleError if result.status is SolveStatus.INFEASIBLE else CheckError
    raise kind(sentence, gait.name)


def _part_motion(index: int, part: SequencePart) -> tuple[Trajectory, Floats | None]:
    """The motion of a part with all its iterations; a refusal says which part it is about.

    Raises:
        InfeasibleError: there is no motion.
        CheckError: no motion was confirmed, or the part makes none.
    """
    try:
        return _motion_of(run_of(part).gait)
    except FootfallError as refusal:
        sentence = f"{part_name(index, part)}, has no motion: {refusal.sentence}"
        kind = InfeasibleError if isinstance(refusal, InfeasibleError) else CheckError
        raise kind(sentence, "sequence") from refusal
