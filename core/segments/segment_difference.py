"""What sets two segment tables apart, in sentences that count feet and segments from 1."""

from collections.abc import Callable, Mapping
from difflib import SequenceMatcher
from itertools import zip_longest
from typing import TypeVar

from core.segments.segment_table import Segment, SegmentTable

Meaning = TypeVar("Meaning")


def table_difference(before: SegmentTable | None, after: SegmentTable | None) -> tuple[str, ...]:
    """Sentences on the rows, how they repeat, and what their names mean."""
    if before is None or after is None:
        if before is not None:
            return ("The segment table is gone: the gait is drawn",)
        return () if after is None else (f"A segment table of {after.segment_count} segments",)
    return (
        *_figures(before, after),
        *_rows("", before.rows, after.rows),
        *_link(before, after),
        *_words(before, after),
    )


def _figures(before: SegmentTable, after: SegmentTable) -> list[str]:
    figures = {
        "Samples a segment": (before.samples_per_segment, after.samples_per_segment),
        "The repeating part begins at segment": (before.repeat_from, after.repeat_from),
        "The repeating part ends at segment": (_end(before), _end(after)),
    }
    return [f"{name} {old} → {new}" for name, (old, new) in figures.items() if old != new]


def _end(table: SegmentTable) -> str:
    return "the last" if table.repeat_to is None else str(table.repeat_to)


def _link(before: SegmentTable, after: SegmentTable) -> list[str]:
    if bool(before.link) != bool(after.link):
        return ["Iterations are linked" if after.link else "Iterations are no longer linked"]
    return _rows("Link: ", before.link, after.link)


def _rows(prefix: str, before: tuple[tuple[str, ...], ...], after: tuple[tuple[str, ...], ...]) -> list[str]:
    sentences = []
    for foot, (old, new) in enumerate(zip_longest(before, after, fillvalue=()), 1):
        if len(old) == len(new):
            pairs = enumerate(zip(old, new, strict=True), 1)
            sentences += [f"{prefix}Segment {at} of foot {foot}: {a} → {b}" for at, (a, b) in pairs if a != b]
        else:
            sentences += [f"{prefix}Foot {foot}: {words}" for words in _moves(old, new)]
    return sentences


def _moves(before: tuple[str, ...], after: tuple[str, ...]) -> list[str]:
    """How a row becomes one of another length."""
    words = []
    for kind, a, b, c, d in SequenceMatcher(None, before, after, autojunk=False).get_opcodes():
        old, new = ", ".join(before[a:b]), ", ".join(after[c:d])
        if kind == "replace":
            words.append(f"{old} → {new} from segment {c + 1} on")
        elif kind == "insert":
            words.append(f"{new} added as segment {_numbers(c, d)}")
        elif kind == "delete":
            words.append(f"{old} taken out at segment {_numbers(a, b)}")
    return words


def _numbers(first: int, after: int) -> str:
    return str(first + 1) if after - first == 1 else f"{first + 1}–{after}"


def _words(before: SegmentTable, after: SegmentTable) -> list[str]:
    old, new = before.vocabulary, after.vocabulary
    return [
        *_named("Position", old.xy, new.xy, lambda factor: f"{factor:g} of the step"),
        *_named("Height", old.z, new.z, lambda z: f"{z * 1000:g} mm"),
        *_named("Definition of", old.segments, new.segments, _segment),
    ]


def _named(
    kind: str, before: Mapping[str, Meaning], after: Mapping[str, Meaning], text: Callable[[Meaning], str]
) -> list[str]:
    sentences = [f"{kind} {name} is gone" for name in before if name not in after]
    for name, meaning in after.items():
        if name not in before:
            sentences.append(f"{kind} {name} is new: {text(meaning)}")
        elif before[name] != meaning:
            sentences.append(f"{kind} {name}: {text(before[name])} → {text(meaning)}")
    return sentences


def _segment(segment: Segment) -> str:
    return f"{segment.start} to {segment.end}, {'swing' if segment.swing else 'stance'}"
