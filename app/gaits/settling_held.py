"""What an edit does to the feet that a gait holds up: they are in the air where it says so."""

from __future__ import annotations

from dataclasses import replace

from core.gait.gait import Gait
from core.gait.held_feet import HeldFeet, feet_words
from core.gait.held_rules import require_swinging, standing_of


def normalise_held_feet(gait: Gait, notice: str | None, *, is_said: bool) -> tuple[Gait, str | None]:
    """Takes back that feet are held up which an edit of the timeline has put down there.

    Args:
        gait: the changed document, normalised in all other respects.
        notice: what the edit had to set aside so far.
        is_said: whether the edit itself says which feet are held.

    Returns:
        The gait, and a sentence where something was set aside.

    Raises:
        InputError: the edit itself says that a foot is held up which stands there.
    """
    if gait.segment_table is not None:
        return gait, notice
    if is_said:
        require_swinging(gait.timeline, gait.held)
    down = standing_of(gait.timeline, gait.held)
    if not down.any:
        return gait, notice
    start, end = (
        tuple(foot for foot in held if foot not in stands)
        for held, stands in ((gait.held.start, down.start), (gait.held.end, down.end))
    )
    sentences = [notice]
    for feet, sample in ((down.start, "first"), (down.end, "last")):
        if feet:
            several = len(feet) > 1
            sentences.append(
                f"{feet_words(feet).capitalize()} {'stand' if several else 'stands'} at the {sample} sample "
                f"now, so {'they are' if several else 'it is'} no longer held up there."
            )
    return replace(gait, held=HeldFeet(start, end)), " ".join(filter(None, sentences))
