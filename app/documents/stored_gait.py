"""Gait documents that the studio kept itself, also those of its earlier versions, which had other bounds."""

from dataclasses import dataclass
from typing import Any

from app.common.json import Json
from app.documents.gait_json import gait_from_content
from core.gait.gait import Gait
from core.gait.options import OPTION_BOUNDS, sayable
from core.text.documents import json_content
from core.text.json_size import require_few_values

_KNOTS = ("phase_knots", "closing_knots")
"""Options without bounds in earlier versions; nothing but a timeline that is drawn anew depends on them."""


@dataclass(frozen=True)
class StoredGait:
    """A document as it was kept.

    Args:
        gait: the gait.
        notice: what of it is different now, in a sentence; None where nothing is.
    """

    gait: Gait
    notice: str | None = None


def stored_gait(text: str | bytes, where: str = "gait") -> StoredGait:
    """Reads a document that the studio kept (see `parse_gait`).

    Raises:
        InputError: it cannot be read.
    """
    require_few_values(text, where)
    return stored_content(json_content(text, where), where)


def stored_content(content: Any, where: str = "gait") -> StoredGait:
    """Reads a kept document that is already parsed JSON (see `stored_gait`)."""
    if not isinstance(content, dict):
        return StoredGait(gait_from_content(content, where))
    limited, changes = _limited(content)
    knots = (
        f"Kept by an earlier version with {' and '.join(dict.fromkeys(changes))}. {_SAME}" if changes else ""
    )
    limited, margin = _with_least_margin(limited)
    notice = " ".join(filter(None, (knots, margin))) or None
    return StoredGait(gait_from_content(limited, where), notice)


_SAME = "The timeline is as it was; drawing it anew takes the new number."
_NEGATIVE = "Kept by an earlier version with a stability margin of {:g} mm (now 0): a margin is at least 0."


def _limited(content: Json) -> tuple[Json, list[str]]:
    """A document, and the parts of a sequence, with the numbers of knots that are possible now."""
    changes: list[str] = []
    options = content.get("options")
    if isinstance(options, dict):
        limited = {name: _bounded(name, options[name], changes) for name in _KNOTS if name in options}
        content = {**content, "options": {**options, **limited}}
    parts = content.get("sequence")
    if isinstance(parts, list):
        content = {**content, "sequence": [_part(part, changes) for part in parts]}
    return content, changes


def _with_least_margin(content: Json) -> tuple[Json, str]:
    """A document, and its parts, with margin 0 in the place of a negative one; and the sentence about it."""
    sentence = ""
    options = content.get("options")
    margin = options.get("margin") if isinstance(options, dict) else None
    if isinstance(options, dict) and isinstance(margin, int | float) and margin < 0:
        content, sentence = (
            {**content, "options": {**options, "margin": 0.0}},
            _NEGATIVE.format(margin * 1000),
        )
    parts = content.get("sequence")
    for number, part in enumerate(parts if isinstance(parts, list) else []):
        if isinstance(part, dict) and isinstance(part.get("gait"), dict):
            gait, words = _with_least_margin(part["gait"])
            content = {**content, "sequence": [*content["sequence"]]}
            content["sequence"][number] = {**part, "gait": gait}
            sentence = sentence or words
    return content, sentence


def _part(part: Any, changes: list[str]) -> Any:
    if not isinstance(part, dict) or not isinstance(part.get("gait"), dict):
        return part
    gait, within = _limited(part["gait"])
    changes += within
    return {**part, "gait": gait}


def _bounded(name: str, value: Any, changes: list[str]) -> Any:
    if not isinstance(value, int) or isinstance(value, bool):
        return value
    bounds = OPTION_BOUNDS[name]
    limited = int(min(max(value, bounds.least), bounds.most))
    if limited != value:
        changes.append(f"a {sayable(name)} of {value}{bounds.unit} (now {limited})")
    return limited
