"""What an edit does to the recorded motion and the provenance that a gait carries."""

from __future__ import annotations

from dataclasses import replace

from app.documents.gait_json import asked_hash
from core.gait.gait import Gait

SET_ASIDE = "The recorded motion of {file} was set aside; the motion is computed now. Undo brings it back."


def normalise_results(before: Gait, after: Gait, notice: str | None = None) -> tuple[Gait, str | None]:
    """Sets a recorded motion aside where the edit asks for another one, and keeps the right provenance.

    Args:
        before: the document as it was.
        after: the changed document, normalised in all other respects.
        notice: what the edit had to set aside so far.

    Returns:
        The gait, and a sentence where something was set aside.
    """
    recording = before.recorded
    if recording is not None and after.recorded in (None, recording) and asks_anew(before, after):
        sentences = (notice, SET_ASIDE.format(file=recording.file))
        after, notice = replace(after, recorded=None), " ".join(filter(None, sentences))
    return _with_provenance(before, after), notice


def asks_anew(before: Gait, after: Gait) -> bool:
    """Whether an edit asks for another motion: more than words, orientation and locks were changed."""
    timeline = replace(after.timeline, locked=before.timeline.locked) if _same_size(before, after) else None
    same = replace(
        after,
        name=before.name,
        notes=before.notes,
        orientation=before.orientation,
        provenance=before.provenance,
        timeline=timeline or after.timeline,
    )
    return same != before


def _same_size(before: Gait, after: Gait) -> bool:
    return before.timeline.stance.shape == after.timeline.stance.shape


def _with_provenance(before: Gait, after: Gait) -> Gait:
    """Results are the server's: a page that does not know one yet cannot undo it by its next edit."""
    own = after.provenance
    if own == before.provenance or (own is not None and own.motion == asked_hash(after)):
        return after
    return replace(after, provenance=before.provenance)
