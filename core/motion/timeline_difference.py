"""What sets two contact timelines apart, in sentences that count feet and samples from 1."""

from collections.abc import Iterable

import numpy as np

from core.arrays import Bools
from core.motion.contact_timeline import ContactTimeline

MOST_STRETCHES = 4
"""Stretches that a sentence names."""

Stretch = tuple[int, int]
"""First and last sample, 0-based."""


def timeline_difference(before: ContactTimeline, after: ContactTimeline) -> tuple[str, ...]:
    """Sentences on length, swings and locks; the feet are compared as far as either has them."""
    sentences = []
    if before.sample_count != after.sample_count:
        sentences.append(f"{before.sample_count} samples → {after.sample_count} samples")
    if before.sample_time != after.sample_time:
        sentences.append(f"Sample time {before.sample_time:g} s → {after.sample_time:g} s")
    for foot in range(max(before.leg_count, after.leg_count)):
        old, new = _stretches(~before.stance, foot), _stretches(~after.stance, foot)
        sentences += _swing_sentences(foot + 1, old, new)
    for foot in range(max(before.leg_count, after.leg_count)):
        sentences += _lock_sentences(foot + 1, _cells(before.locked, foot), _cells(after.locked, foot))
    return tuple(sentences)


def samples_text(stretches: Iterable[Stretch]) -> str:
    """Stretches as a person counts them: "samples 6–10 and 16"."""
    texts = [str(first + 1) if first == last else f"{first + 1}–{last + 1}" for first, last in stretches]
    word = "sample" if len(texts) == 1 and "–" not in texts[0] else "samples"
    if len(texts) > MOST_STRETCHES:
        texts = [*texts[:MOST_STRETCHES], f"{len(texts) - MOST_STRETCHES} more stretches"]
    joined = texts[0] if len(texts) == 1 else f"{', '.join(texts[:-1])} and {texts[-1]}"
    return f"{word} {joined}"


def _cells(layer: Bools, foot: int) -> frozenset[int]:
    """Samples at which a layer is set; none for a foot that is not there."""
    return frozenset(np.nonzero(layer[foot])[0].tolist()) if foot < len(layer) else frozenset()


def _stretches(layer: Bools, foot: int) -> list[Stretch]:
    return _runs(_cells(layer, foot))


def _runs(samples: frozenset[int]) -> list[Stretch]:
    runs: list[Stretch] = []
    for sample in sorted(samples):
        if runs and runs[-1][1] == sample - 1:
            runs[-1] = (runs[-1][0], sample)
        else:
            runs.append((sample, sample))
    return runs


def _swing_sentences(foot: int, before: list[Stretch], after: list[Stretch]) -> list[str]:
    gone = [swing for swing in before if swing not in after]
    come = [swing for swing in after if swing not in before]
    if gone and come:
        instead = samples_text(gone).partition(" ")[2]
        return [f"Foot {foot} swings at {samples_text(come)} instead of {instead}"]
    if come:
        also = " also" if before else ""
        return [f"Foot {foot}{also} swings at {samples_text(come)}"]
    return [f"Foot {foot} no longer swings at {samples_text(gone)}"] if gone else []


def _lock_sentences(foot: int, before: frozenset[int], after: frozenset[int]) -> list[str]:
    locked, free = _runs(after - before), _runs(before - after)
    sentences = [f"Foot {foot} is locked at {samples_text(locked)}"] if locked else []
    return [*sentences, f"Foot {foot} is no longer locked at {samples_text(free)}"] if free else sentences
