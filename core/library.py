"""The gaits that come with the program, built from the data beside this file."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources
from types import MappingProxyType
from typing import Any

from core.errors import InputError
from core.gait import Gait, GaitOptions, Orientation, heading_step
from core.segments import Segment, SegmentTable, SegmentVocabulary
from core.timeline import timeline_from_order

SAMPLE_TIME = 0.4
"""Time between knots of the published gaits, s (DOMAIN.md, Gaits)."""

DEFAULT_SEGMENT_SAMPLES = 5
"""Samples of a segment in the published simulation data."""


@dataclass(frozen=True)
class ManualTag:
    """Which published manual gait an entry is."""

    family: str
    version: int


@dataclass(frozen=True)
class LibraryEntry:
    """A built-in gait and how it is called."""

    id: str
    gait: Gait
    manual: ManualTag | None


def _read(name: str) -> dict[str, Any]:
    return tomllib.loads(resources.files("core.data").joinpath(name).read_text("utf-8"))


@cache
def default_vocabulary() -> SegmentVocabulary:
    """Named positions and segments of thesis Tables 3.2 to 3.4."""
    table = _read("segments.toml")
    segments = {name: Segment(**values) for name, values in table["segments"].items()}
    return SegmentVocabulary(table["xy"], table["z"], segments)


@cache
def library() -> Mapping[str, LibraryEntry]:
    """Every built-in gait by its id, in the order of the page's list."""
    entries = (_entry(item) for item in _read("gaits.toml")["gait"])
    return MappingProxyType({entry.id: entry for entry in entries})


def _entry(item: dict[str, Any]) -> LibraryEntry:
    orientation = Orientation(item["orientation"])
    order = tuple(item["order"])
    table, tag = None, None
    timeline = timeline_from_order(len(order), order, sample_time=SAMPLE_TIME)
    if "manual" in item:
        manual = item["manual"]
        rows = tuple(tuple(name.strip() for name in row.split(",")) for row in item["table"])
        table = SegmentTable(rows, DEFAULT_SEGMENT_SAMPLES, manual["repeat_from"], default_vocabulary())
        tag = ManualTag(manual["family"], manual["version"])
        timeline = table.timeline(SAMPLE_TIME)
    gait = Gait(
        name=item["name"],
        robot="deltawalker",
        orientation=orientation,
        direction=1,
        order=order,
        step=heading_step(orientation, item["step"]),
        iterations=1,
        timeline=timeline,
        segment_table=table,
        options=GaitOptions(margin=item.get("margin", 0.0)),
    )
    return LibraryEntry(item["id"], gait, tag)


def optimised_entry(name: str) -> LibraryEntry:
    """The built-in gait for the optimiser.

    Raises:
        InputError: there is none of that name.
    """
    entry = library().get(name)
    if entry is None or entry.manual is not None:
        names = [e.id for e in library().values() if e.manual is None]
        raise InputError(f"There is no gait “{name}” to optimise; choose one of {', '.join(names)}.", "GAIT")
    return entry


def manual_entry(family: str, version: int) -> LibraryEntry:
    """The published manual gait of a family and version.

    Raises:
        InputError: there is none.
    """
    entries = {(e.manual.family, e.manual.version): e for e in library().values() if e.manual is not None}
    families = sorted({known for known, _ in entries})
    if family not in families:
        raise InputError(f"There is no manual gait “{family}”; choose one of {', '.join(families)}.", "GAIT")
    if (family, version) not in entries:
        versions = sorted(v for f, v in entries if f == family)
        raise InputError(
            f"{family} has no version {version}; choose one of {', '.join(map(str, versions))}.", "--version"
        )
    return entries[family, version]
