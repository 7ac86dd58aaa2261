"""Rules for held feet, checked against robot and timeline; each refusal names what to do."""

import numpy as np

from core.arrays import Bools
from core.errors import InputError
from core.gait.held_feet import HeldFeet, feet_words
from core.motion.contact_timeline import ContactTimeline


def require_feet(held: HeldFeet, legs: int) -> None:
    """Every held foot is one of the robot's, and some others are left to stand on.

    Raises:
        InputError: naming the first that is not, or the end at which none is left.
    """
    for name, feet in (("start", held.start), ("end", held.end)):
        if len(feet) >= legs:
            raise InputError(
                f"held.{name} names every foot, and the robot would fall. Keep at least three down.",
                f"held.{name}",
            )
        for foot in feet:
            if not 1 <= foot <= legs:
                raise InputError(
                    f"held.{name} names foot {foot}; the gait has feet 1 to {legs}.", f"held.{name}"
                )


def standing_of(timeline: ContactTimeline, held: HeldFeet) -> HeldFeet:
    """Those of the held feet that stand, by a timeline, where they are held."""
    stance = timeline.stance
    start, end = (
        tuple(foot for foot in feet if stance[foot - 1, sample])
        for feet, sample in ((held.start, 0), (held.end, -1))
    )
    return HeldFeet(start, end)


def require_swinging(timeline: ContactTimeline, held: HeldFeet) -> None:
    """Held feet are in the air where they are held.

    Raises:
        InputError: naming those that stand there, and what to do.
    """
    down = standing_of(timeline, held)
    for feet, sample, end in ((down.start, "first", "start"), (down.end, "last", "end")):
        if feet:
            verbs = ("are", "stand", "them") if len(feet) > 1 else ("is", "stands", "it")
            raise InputError(
                f"{feet_words(feet).capitalize()} {verbs[0]} to be held up at the {sample} sample but "
                f"{verbs[1]} there. Set the {sample} sample to swing, or do not hold {verbs[2]} up.",
                f"held.{end}",
            )


def require_repeatable(held: HeldFeet) -> None:
    """A gait can follow itself: it ends with the same feet held up as it begins.

    Raises:
        InputError: it does not.
    """
    if held.start != held.end:
        raise InputError(
            f"The gait cannot be repeated: {_unlike(held)}. Hold the same feet at both ends, or run it once.",
            "iterations",
        )


def require_rest(timeline: ContactTimeline, held: HeldFeet, *, cycle: bool) -> None:
    """Every foot rests at the ends of a gait: it stands there, or is held up.

    From rest a swing may begin with the first sample, but not be that one sample.

    Args:
        timeline: which foot stands when.
        held: feet that are in the air on purpose.
        cycle: whether the last sample is the first one, moved on.

    Raises:
        InputError: naming the feet that do not, and what to do.
    """
    require_swinging(timeline, held)
    stance = timeline.stance
    first, last = (_flags(feet, timeline.leg_count) for feet in (held.start, held.end))
    _require_lasting(stance[:, 1], first, "first")
    _require_lasting(stance[:, -2], last, "last")
    _require_standing(stance[:, -1] | last, "last")
    if cycle:
        _require_standing(stance[:, 0] | first, "first")
        _require_same(held)
    _require_lifting(stance[:, 0] | first, stance[:, 1])


def _flags(feet: tuple[int, ...], legs: int) -> Bools:
    flags = np.zeros(legs, dtype=np.bool_)
    flags[[foot - 1 for foot in feet]] = True
    return flags


def _names(feet: Bools) -> tuple[str, bool]:
    """Feet as a person calls them, and whether there are several."""
    found = tuple(int(foot) + 1 for foot in np.nonzero(feet)[0])
    return feet_words(found).capitalize(), len(found) > 1


def _require_lasting(beside: Bools, held: Bools, sample: str) -> None:
    if (held & beside).any():
        names, several = _names(held & beside)
        way = "come down from" if sample == "first" else "rise to"
        raise InputError(
            f"{names} {'are' if several else 'is'} held up at the {sample} sample alone, where everything "
            f"rests, and cannot {way} there in no time. Let the swing last longer.",
            "timeline",
        )


def _require_standing(rests: Bools, sample: str) -> None:
    floating = [str(f + 1) for f in np.nonzero(~rests)[0]]
    if floating:
        raise InputError(
            f"Foot {', '.join(floating)} is in the air at the {sample} sample; every foot must stand there. "
            f"Set the {sample} sample to stance, or hold it up.",
            "timeline",
        )


def _require_same(held: HeldFeet) -> None:
    if held.start != held.end:
        raise InputError(
            f"The gait is a cycle, which ends as it begins, but {_unlike(held)}. Hold the same feet at both "
            "ends, or set Ends to “at rest” (boundary).",
            "held",
        )


def _unlike(held: HeldFeet) -> str:
    start, end = (feet_words(feet) if feet else "none" for feet in (held.start, held.end))
    return f"at its start it holds {start} up and at its end {end}"


def _require_lifting(rests: Bools, following: Bools) -> None:
    lost = [str(foot + 1) for foot in np.nonzero(~rests & following)[0]]
    if lost:
        raise InputError(
            f"Foot {', '.join(lost)} is in the air at the first sample alone, where everything rests, and "
            "cannot lift. Set the first sample to stance, or let the swing go on.",
            "timeline",
        )
