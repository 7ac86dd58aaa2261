"""Sequence documents: made from the ids of gaits, edited, and brought up to date with them."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from enum import StrEnum

from app.documents.gait_json import motion_hash, require_size
from core.errors import FootfallError, InputError
from core.gait.gait import Gait, SequencePart
from core.library.resampling import resampled_gait, resampled_parts
from core.library.sequence import DERIVED, derived, sequence_gait

GaitOf = Callable[[str], Gait]
"""The gait of an id as it is now; raises where there is none."""


class SourceState(StrEnum):
    """How a part stands to the gait that it was copied from."""

    SAME = "same"
    CHANGED = "changed"
    """The gait moves differently by now."""
    GONE = "gone"
    """There is no such gait any more, or it is not known."""


@dataclass(frozen=True)
class PartReference:
    """A gait by its id, and how often it runs."""

    gait: str
    times: int


@dataclass(frozen=True)
class ResampledSequence:
    """A sequence whose parts were brought to one sample time, and a sentence on each that changed."""

    gait: Gait
    changes: tuple[str, ...]


def made_sequence(
    name: str, asked: Iterable[PartReference], gait_of: GaitOf, notes: str = "", *, resample: bool = False
) -> Gait:
    """A sequence of saved or open gaits; a sequence among them contributes its parts.

    Args:
        name: of the sequence.
        asked: its parts.
        gait_of: gives the gait of an id.
        notes: a person's words.
        resample: whether parts with other sample times are brought to one; else they are refused.

    Raises:
        FootfallError: there is no such gait, the parts do not fit together, or are too large together.
    """
    parts: list[SequencePart] = []
    for one in asked:
        gait = gait_of(one.gait)
        own = gait.sequence or (SequencePart(gait, one.times, one.gait),)
        parts += own * one.times if gait.sequence else own
    made = sequence_gait(name, resampled_parts(parts).parts if resample else parts, notes)
    require_size(made, name)
    return made


def normalise_sequence(before: Gait, after: Gait) -> Gait:
    """Normalises an edited sequence: keeps its parts and derives everything else from them.

    Raises:
        InputError: no part is left, a field that follows from the parts was changed, or parts do not fit.
    """
    if not after.sequence:
        raise InputError("A sequence has at least one part; delete the sequence instead.", "sequence")
    normalised = derived(after)
    for field in DERIVED:
        asked = getattr(after, field)
        if before.sequence and asked not in (getattr(before, field), getattr(normalised, field)):
            raise InputError(
                f"The {field.replace('_', ' ')} of a sequence follows from its parts. Edit the gait that a "
                "part comes from, and update the part.",
                field,
            )
    return normalised


def resampled(gait: Gait, sample_time: float | None = None) -> ResampledSequence:
    """A sequence whose parts have one sample time.

    Args:
        gait: the sequence; its parts may have different ones.
        sample_time: s; None for that of the most parts.

    Raises:
        FootfallError: it is no sequence, or its parts do not fit together with that sample time.
    """
    if not gait.sequence:
        raise InputError(f"“{gait.name}” is no sequence; only parts of a sequence are resampled.", "sequence")
    brought = resampled_parts(gait.sequence, sample_time)
    made = derived(replace(gait, sequence=brought.parts))
    require_size(made, gait.name)
    return ResampledSequence(made, brought.changes)


def source_states(gait: Gait, gait_of: GaitOf) -> tuple[SourceState, ...]:
    """How each part of a sequence stands to the gait that it was copied from."""
    return tuple(_state(part, gait_of) for part in gait.sequence)


def _state(part: SequencePart, gait_of: GaitOf) -> SourceState:
    if part.source is None:
        return SourceState.GONE
    try:
        now = gait_of(part.source)
    except FootfallError:
        return SourceState.GONE
    return SourceState.SAME if _moves_alike(now, part.gait) else SourceState.CHANGED


def _moves_alike(now: Gait, copy: Gait) -> bool:
    """Whether a copy is its source, or its source resampled."""
    if motion_hash(now) == motion_hash(copy):
        return True
    if now.poses is not None or now.timeline.sample_time == copy.timeline.sample_time:
        return False
    try:
        return motion_hash(resampled_gait(now, copy.timeline.sample_time)) == motion_hash(copy)
    except FootfallError:
        return False


def refreshed(gait: Gait, gait_of: GaitOf, only: int | None = None, *, resample: bool = False) -> Gait:
    """A sequence whose parts are the gaits as they are now, where they changed.

    Args:
        gait: the sequence.
        gait_of: gives the gait of an id.
        only: index of one part; None for all.
        resample: whether parts with other sample times are brought to one; else they are refused.

    Raises:
        InputError: it is no sequence or has no such part, a gait has become a sequence, parts do not fit, or
            are too large together.
    """
    if not gait.sequence:
        raise InputError(f"“{gait.name}” is no sequence; only a sequence takes gaits over.", "sequence")
    if only is not None and not 0 <= only < len(gait.sequence):
        raise InputError(f"The sequence has parts 0 to {len(gait.sequence) - 1}, and no {only}.", "part")
    parts = tuple(
        replace(part, gait=gait_of(part.source))
        if part.source is not None and only in (None, index) and _state(part, gait_of) is SourceState.CHANGED
        else part
        for index, part in enumerate(gait.sequence)
    )
    taken_over = derived(replace(gait, sequence=resampled_parts(parts).parts if resample else parts))
    require_size(taken_over, gait.name)
    return taken_over
