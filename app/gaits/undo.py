"""Applies an undo or redo to a gait and keeps what others changed since."""

from dataclasses import replace

from app.documents.gait_json import gait_from_content
from app.gaits.normalise import asks_anew, normalise, require_locks
from app.undo.history import UndoResult
from core.errors import FootfallError, StateError
from core.gait.gait import Gait
from core.library.sequence import derived
from core.recorded.recorded_motion import gait_trajectory
from core.robot.model import load_robot


def merged_gait(present: Gait, step: UndoResult) -> Gait:
    """The document after an undo or redo; merged with edits of others, it must stay consistent.

    Raises:
        StateError: it does not.
    """
    try:
        gait = gait_from_content(step.content)
        if not step.exact:
            if gait.sequence:
                return derived(gait)
            require_locks(present, gait)
            _require_recorded(present, gait, step)
            whole, notice = normalise(present, gait)
            if notice is not None or replace(whole, provenance=gait.provenance) != gait:
                raise StateError(
                    "The timeline would no longer agree with the segment table or the feet held up.",
                    "history",
                )
            return whole
    except FootfallError as error:
        raise StateError(
            f"“{step.label}” does not fit what others changed since: {error.sentence} "
            "Change it by hand, or restore an earlier version.",
            error.where,
        ) from error
    return gait


def _require_recorded(present: Gait, gait: Gait, step: UndoResult) -> None:
    """A recorded motion is still of the gait that the document asks for.

    Raises:
        InputError: the motion itself cannot be of this gait.
        StateError: others changed what it binds: step, order, options, timeline and all that a motion is of.
    """
    if gait.recorded is None:
        return
    gait_trajectory(gait, gait.recorded, load_robot(gait.robot))
    own = present if present.recorded == gait.recorded else gait_from_content(step.alone)
    if asks_anew(own, replace(gait, recorded=own.recorded)):
        raise StateError(
            f"The recorded motion of {gait.recorded.file} is not what the gait would ask for.",
            "recorded",
        )
