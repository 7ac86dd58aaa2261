"""Applies an undo or redo to a gait and keeps what others changed since."""

from dataclasses import dataclass, replace

from app.documents.stored_gait import stored_content
from app.gaits.normalise import asks_anew, normalise, require_locks
from app.gaits.open_gait import gait_of
from app.undo.history import History, UndoResult
from core.errors import FootfallError, StateError
from core.gait.gait import Gait
from core.library.sequence import derived
from core.recorded.recorded_motion import gait_trajectory
from core.robot.model import load_robot


@dataclass(frozen=True)
class SkippedState:
    """A document in the history that undo and redo step over.

    Args:
        position: in the history.
        document: its text.
        sentence: why.
    """

    position: int
    document: str
    sentence: str


def without_unreadable(
    history: History, others: frozenset[str], *, again: bool
) -> tuple[History, tuple[SkippedState, ...]]:
    """The history whose next undo, or redo, ends at a document that can be shown; and what it skips.

    Args:
        history: the gait's history.
        others: the other pages that are connected.
        again: whether it is about redo.

    Raises:
        StateError: other edits stand in between, so that nothing can be skipped.
    """
    skipped: list[SkippedState] = []
    while (action := history.redoable(others) if again else history.undoable(others)) is not None:
        position = action.position if again else action.position - 1
        entry, label = history.entries[position], history.label_of(action)
        try:
            gait_of(entry)
            break
        except FootfallError as error:
            place = "after" if again else "before"
            state = f"The state {place} “{label}” cannot be shown"
            if not history.can_skip(action, others, again=again):
                verb = "done again" if again else "undone"
                raise StateError(
                    f"{state}, so that “{label}” cannot be {verb}: {error.sentence} "
                    "Restore an earlier version.",
                    "history",
                ) from error
            skipped.append(
                SkippedState(position, entry.document, f"{state} and is skipped: {error.sentence}")
            )
            history = history.skipping(action, again=again)
    return history, tuple(skipped)


def merged_gait(present: Gait, step: UndoResult) -> Gait:
    """The document after an undo or redo; merged with edits of others, it must stay consistent.

    Raises:
        StateError: it does not.
    """
    try:
        gait = stored_content(step.content).gait
        if not step.exact:
            if gait.sequence:
                return derived(gait)
            require_locks(present, gait)
            _require_recorded(present, gait, step)
            whole, notice = normalise(present, gait)
            if notice is not None or replace(whole, provenance=gait.provenance) != gait:
                disagree = "The timeline would no longer agree with the segment table or the feet held up."
                raise StateError(notice or disagree, "history")
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
    own = present if present.recorded == gait.recorded else stored_content(step.alone).gait
    if asks_anew(own, replace(gait, recorded=own.recorded)):
        raise StateError(
            f"The recorded motion of {gait.recorded.file} is not what the gait would ask for.",
            "recorded",
        )
