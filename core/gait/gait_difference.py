"""Describes the difference between two gaits in sentences, to help choose a version."""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum
from typing import Any

import numpy as np

from core.arrays import Floats
from core.gait.gait import Gait, SequencePart
from core.gait.held_feet import feet_words
from core.gait.options import GaitOptions
from core.gait.poses import POSE_LIMITS, Poses
from core.gait.recording import AS_RECORDED, RecordingFit
from core.motion.timeline_difference import timeline_difference
from core.robot.model import load_robot
from core.segments.segment_difference import table_difference

LONGEST_TEXT = 60
"""Characters of notes that are quoted; of longer ones the length is told."""

OPTION_WORDS: dict[str, tuple[str, float, str]] = {
    "clearance": ("Clearance", 1000.0, "mm"),
    "margin": ("Stability margin", 1000.0, "mm"),
    "body_speed": ("Body speed", 1000.0, "mm/s"),
    "foot_speed": ("Foot speed", 1000.0, "mm/s"),
    "plane_height": ("Body height", 1000.0, "mm"),
    "end_plane_height": ("Height at the end", 1000.0, "mm"),
    "friction": ("Friction", 1.0, ""),
    "motor_speed": ("Motor speed", 1000.0, "mm/s"),
    "motor_acceleration": ("Motor acceleration", 1000.0, "mm/s²"),
    "phase_knots": ("Phase length", 1.0, "samples"),
    "closing_knots": ("Final stance", 1.0, "samples"),
    "workspace": ("Reach", 1.0, ""),
    "cost": ("Cost", 1.0, ""),
    "boundary": ("Ends", 1.0, ""),
    "turning": ("Turning", 1.0, ""),
    "merge": ("Merging within", 1000.0, "mm"),
    "stop_bound": ("Stop bound", 1.0, "s"),
}
"""What a person calls each option, its factor from SI, and its unit."""

_UNSET = {"end_plane_height": "as at the start", "stop_bound": "none"}
_CHOICES = {"rest": "at rest", "periodic": "cycle", "return": "at the end", "goal+effort": "effort"}


@dataclass(frozen=True)
class DifferenceGroup:
    """Sentences on one side of a gait."""

    title: str
    sentences: tuple[str, ...]


def gait_difference(before: Gait, after: Gait) -> tuple[DifferenceGroup, ...]:
    """Lists what differs in `after`, in groups; empty if both gaits are equal.

    Of a sequence its parts are compared, and not what follows from them. The provenance of results is
    nobody's edit and is left out.

    Args:
        before: the gait that the sentences start from.
        after: the gait that they lead to.
    """
    chained = bool(before.sequence or after.sequence)
    groups = {
        "Gait": (*_head(before, after), *(() if chained else _motion(before, after))),
        "Parts": _parts(before.sequence, after.sequence),
        "Timeline": () if chained else timeline_difference(before.timeline, after.timeline),
        "Poses": _poses(before.poses, after.poses),
        "Segments": () if chained else table_difference(before.segment_table, after.segment_table),
        "Options": _options(before.options, after.options),
    }
    return tuple(DifferenceGroup(title, sentences) for title, sentences in groups.items() if sentences)


def _change(name: str, before: object, after: object) -> list[str]:
    return [] if before == after else [f"{name} {before} → {after}"]


def _head(before: Gait, after: Gait) -> list[str]:
    sentences = _change("Name", f"“{before.name}”", f"“{after.name}”")
    if before.notes != after.notes:
        sentences += _change("Notes", *_texts(before.notes, after.notes)) or ["Notes reworded"]
    if before.recorded != after.recorded:
        old, new = (f"motion of {g.recorded.file}" if g.recorded else "none" for g in (before, after))
        fits = (g.recorded.fit if g.recorded else AS_RECORDED for g in (before, after))
        sentences += _change("Recorded motion:", old, new) or _fit(*fits) or ["Recorded motion replaced"]
    return sentences


def _fit(before: RecordingFit, after: RecordingFit) -> list[str]:
    """How the recorded motion is changed in another way."""

    def beyond(fit: RecordingFit) -> str:
        return "refused" if fit.within_stroke is None else "clipped"

    heights = (
        _change(
            f"Recorded {part} raised by", *(f"{getattr(fit, part) * 1000:g} mm" for fit in (before, after))
        )
        for part in ("body", "feet")
    )
    return [
        *(sentence for sentences in heights for sentence in sentences),
        *_change("Recorded motion scaled to", *(f"{fit.scale * 100:g} %" for fit in (before, after))),
        *_change("Strokes beyond the range:", beyond(before), beyond(after)),
    ]


def _poses(before: Poses | None, after: Poses | None) -> tuple[str, ...]:
    """What gaits for the robot's clock ask beside the rest; the poses that were found are nobody's edit."""
    if before is None or after is None:
        return () if before is after else (f"Made for the robot's clock: {_yes(before)} → {_yes(after)}",)
    sentences = _change(
        "Step length:", *("fastest" if poses.free_step else "as set" for poses in (before, after))
    )
    for name in POSE_LIMITS:
        old, new = getattr(before, name) * 1000, getattr(after, name) * 1000
        words = name.replace("_", " ").capitalize()
        sentences += [] if old == new else _change(words, *(f"{text} mm" for text in _apart(old, new)))
    sways = [f"{np.degrees(poses.sway):.4g}°" for poses in (before, after)]
    sentences += _change("Sway of the heading:", *sways)
    sentences += _change(
        "Overlapping swings:", *("yes" if poses.overlap else "no" for poses in (before, after))
    )
    sentences += _change("Pinned poses:", *(_pinned(poses) for poses in (before, after)))
    return tuple(sentences)


def _pinned(poses: Poses) -> str:
    """Which poses are pinned, and where."""
    places = (
        f"{pin.pose} ({abs(pin.along) * 1000:.2f} mm {'behind' if pin.along < 0 else 'ahead'}, "
        f"{abs(pin.sideways) * 1000:.2f} mm to the {'right' if pin.sideways < 0 else 'left'})"
        for pin in poses.pinned
    )
    return ", ".join(places) or "none"


def _yes(poses: Poses | None) -> str:
    return "no" if poses is None else "yes"


def _texts(before: str, after: str) -> tuple[str, str]:
    texts = (before, after)
    if all(len(text) <= LONGEST_TEXT for text in texts):
        return f"“{before}”", f"“{after}”"
    return f"of {len(before)} characters", f"of {len(after)} characters"


def _motion(before: Gait, after: Gait) -> list[str]:
    old, new = np.array(before.step), np.array(after.step)
    orders = ("-".join(map(str, gait.order)) for gait in (before, after))
    return [
        *_change("Robot", *(load_robot(gait.robot).title for gait in (before, after))),
        *_change("Orientation", before.orientation.value, after.orientation.value),
        *_change("Direction", before.direction, after.direction),
        *_change("Foot order", *orders),
        *(_step(old[:2] * 1000, new[:2] * 1000) if (old[:2] != new[:2]).any() else []),
        *_change("Turn", *(f"{yaw}°" for yaw in _apart(*np.rad2deg([old[2], new[2]])))),
        *_change("Iterations", before.iterations, after.iterations),
        *_change("Held up at the start:", *(_feet(gait.held.start) for gait in (before, after))),
        *_change("Held up at the end:", *(_feet(gait.held.end) for gait in (before, after))),
    ]


def _feet(feet: tuple[int, ...]) -> str:
    return feet_words(feet) if feet else "none"


def _step(before: Floats, after: Floats) -> list[str]:
    """Steps in mm: their length where they point the same way, else both components."""
    if abs(before[0] * after[1] - before[1] * after[0]) < 1e-9 and before @ after >= 0:
        lengths = _apart(float(np.hypot(*before)), float(np.hypot(*after)))
        return _change("Step", *(f"{length} mm" for length in lengths))
    components = [_apart(old, new) for old, new in zip(before.tolist(), after.tolist(), strict=True)]
    return _change("Step", *(f"({x}, {y}) mm" for x, y in zip(*components, strict=True)))


def _apart(before: float, after: float) -> tuple[str, str]:
    """Two numbers with as few digits as tell them apart."""
    texts = (f"{before:.1f}", f"{after:.1f}")
    exact = abs(before * 10 - round(before * 10)) + abs(after * 10 - round(after * 10)) < 1e-6
    for digits in (4, 6, 9, 12, 17):
        if exact and texts[0] != texts[1]:
            return texts
        exact, texts = True, (f"{before:.{digits}g}", f"{after:.{digits}g}")
    return texts


def _parts(before: tuple[SequencePart, ...], after: tuple[SequencePart, ...]) -> tuple[str, ...]:
    if before == after:
        return ()
    old, new = ([_part(part) for part in parts] for parts in (before, after))
    texts = [", ".join(parts) or "none" for parts in (old, new)]
    return tuple(_change("Parts:", *texts)) or ("A part's gait was brought up to date",)


def _part(part: SequencePart) -> str:
    return f"{part.times} × {part.gait.name}{' from rest' if part.restarts else ''}"


def _options(before: GaitOptions, after: GaitOptions) -> tuple[str, ...]:
    sentences = []
    for field, (name, factor, unit) in OPTION_WORDS.items():
        old, new = getattr(before, field), getattr(after, field)
        if old != new:
            numbers = [value * factor for value in (old, new) if isinstance(value, int | float)]
            figures = iter(_apart(*numbers) if len(numbers) == 2 else [f"{value:.6g}" for value in numbers])
            texts = [_value(field, value, unit, figures) for value in (old, new)]
            sentences.append(f"{name} {texts[0]} → {texts[1]}")
    return tuple(sentences)


def _value(field: str, value: Any, unit: str, figures: Iterator[str]) -> str:
    if value is None:
        return _UNSET.get(field, "without limit")
    if isinstance(value, Enum):
        return _CHOICES.get(str(value.value), str(value.value))
    return f"{next(figures)} {unit}".strip()
