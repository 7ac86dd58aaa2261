"""Phase lists in and out: for each foot whether it stands at first, and how long each phase lasts.

The form is that of towr (Winkler et al. 2018): an initial contact flag and phase durations a foot, which by
turns are stance and swing. A sample of a timeline stands for the time until the next one, so that a phase of
k samples lasts k times the sample time, and the phases of n samples last n times the sample time.
"""

import json
from itertools import groupby
from math import isfinite
from typing import Any

import numpy as np

from core.arrays import Bools
from core.errors import InputError
from core.motion.contact_timeline import MAX_SAMPLES, ContactTimeline
from core.text.documents import as_written, json_content

PHASES_FORMAT = "footfall-phases"
WHOLE = 1e-6
"""A phase is a whole number of samples within this part of one; durations are rounded sums of decimals."""
MOST_FEET = 100


def format_phases(timeline: ContactTimeline) -> str:
    """Writes a timeline as JSON: `feet`, each with `in_contact_at_start` and `phase_durations` in s.

    Locked cells are not part of it.
    """
    content = {
        "format": PHASES_FORMAT,
        "version": 1,
        "sample_time": timeline.sample_time,
        "feet": [_phases(row, timeline.sample_time) for row in timeline.stance],
    }
    return json.dumps(content, indent=2) + "\n"


def _phases(row: Bools, sample_time: float) -> dict[str, Any]:
    counts = [len(list(run)) for _, run in groupby(row.tolist())]
    return {"in_contact_at_start": bool(row[0]), "phase_durations": [n * sample_time for n in counts]}


def parse_phases(text: str, sample_time: float | None = None, name: str = "phase list") -> ContactTimeline:
    """Reads a phase list into a timeline with nothing locked.

    Args:
        text: the JSON text.
        sample_time: time between samples, s; the list's own where None.
        name: the file's name, for messages.

    Raises:
        InputError: naming foot and phase of what does not fit, such as a phase of no whole samples.
    """
    content = _content(text, name)
    chosen = _sample_time(content, sample_time, name)
    feet = content.get("feet")
    if not isinstance(feet, list) or not 1 <= len(feet) <= MOST_FEET:
        raise InputError(f"{name}: “feet” must be a list of 1 to {MOST_FEET} feet.", f"{name}.feet")
    rows = [_row(foot, number, chosen, name) for number, foot in enumerate(feet, 1)]
    for number, row in enumerate(rows, 1):
        if len(row) != len(rows[0]):
            raise InputError(
                f"{name}: the phases of foot {number} last {len(row) * chosen:g} s in all, those of foot 1 "
                f"{len(rows[0]) * chosen:g} s; every foot needs the same.",
                f"{name}.feet.{number - 1}",
            )
    stance = np.array(rows, dtype=np.bool_)
    return ContactTimeline(stance, np.zeros_like(stance), chosen)


def _sample_time(content: dict[str, Any], sample_time: float | None, name: str) -> float:
    chosen: Any = content.get("sample_time") if sample_time is None else sample_time
    if not _is_number(chosen) or not 0.001 <= chosen <= 60:
        words = "none" if chosen is None else as_written(chosen)
        raise InputError(
            f"{name} is to be read with a sample time of {words}; give one between 0.001 and 60 s.",
            f"{name}.sample_time",
        )
    return float(chosen)


def _content(text: str, name: str) -> dict[str, Any]:
    content = json_content(text, name)
    if not isinstance(content, dict) or content.get("format") != PHASES_FORMAT:
        raise InputError(f'{name} is no phase list: "format" must be "{PHASES_FORMAT}".', f"{name}.format")
    if content.get("version") != 1 or isinstance(content["version"], bool):
        raise InputError(
            f"{name} has version {as_written(content.get('version'))}; this program reads version 1.",
            f"{name}.version",
        )
    return content


def _row(foot: Any, number: int, sample_time: float, name: str) -> list[bool]:
    where = f"{name}.feet.{number - 1}"
    if not isinstance(foot, dict) or not isinstance(foot.get("in_contact_at_start"), bool):
        raise InputError(f"{name}, foot {number}: “in_contact_at_start” must be true or false.", where)
    durations = foot.get("phase_durations")
    if not isinstance(durations, list) or not durations:
        raise InputError(f"{name}, foot {number}: “phase_durations” must be a list of seconds.", where)
    row: list[bool] = []
    stands = foot["in_contact_at_start"]
    for phase, duration in enumerate(durations, 1):
        row += [stands] * _samples(duration, sample_time, f"{name}, foot {number}, phase {phase}", where)
        stands = not stands
        if len(row) > MAX_SAMPLES:
            raise InputError(
                f"{name}, foot {number}: more than {MAX_SAMPLES} samples of {sample_time:g} s, the most that "
                "a timeline has. Choose a longer sample time.",
                where,
            )
    return row


def _samples(duration: Any, sample_time: float, words: str, where: str) -> int:
    """How many samples a phase has."""
    if not _is_number(duration) or not 0 < duration <= MAX_SAMPLES * 60:
        raise InputError(f"{words}: {as_written(duration)} must be a time in s above 0.", where)
    samples = float(duration) / sample_time
    if round(samples) < 1 or abs(samples - round(samples)) > WHOLE:
        raise InputError(
            f"{words} lasts {duration:g} s, which is {samples:g} samples of {sample_time:g} s; it must be a "
            "whole number of them. Change the duration, or choose a sample time that divides every phase.",
            where,
        )
    return round(samples)


def _is_number(value: Any) -> bool:
    try:
        return isinstance(value, int | float) and not isinstance(value, bool) and isfinite(value)
    except OverflowError:
        return False
