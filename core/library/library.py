"""The gaits that come with the program, built from the tables of `core/data`."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum
from functools import cache
from types import MappingProxyType
from typing import Any

import numpy as np

from core.data.tables import data_table
from core.errors import InputError
from core.gait.gait import Gait, Orientation, SequencePart, heading_step, with_return
from core.gait.options import GaitOptions
from core.library.for_robot import gait_for_robot
from core.library.patterns import LibraryPattern, library_pattern
from core.library.sequence import sequence_gait
from core.motion.contact_timeline import ContactTimeline, timeline_from_order, timeline_from_rows
from core.motion.heading_profile import HeadingProfile
from core.problem.motion_problem import Cost
from core.robot.model import load_robot
from core.segments.segment_table import Segment, SegmentTable, SegmentVocabulary

ROBOT = "deltawalker"
"""The robot of every built-in gait but the footfall patterns."""

SAMPLE_TIME = 0.4
"""Time between knots of the published gaits, s (docs/sources.md, Published gaits)."""

DEFAULT_SEGMENT_SAMPLES = 5
"""Samples of a segment in the published simulation data."""


class Group(StrEnum):
    """Where the page's list of gaits puts an entry."""

    FOR_ROBOT = "For this robot"
    """For the robot's clock: as fast as its firmware allows (docs/fastest.md)."""
    OPTIMISED = "Optimised"
    """For the optimiser, thesis 3.4."""
    BY_HAND = "By hand"
    """Segment tables, thesis 3.3."""
    APPENDIX = "Orders of Appendix A"
    """The same gaits with every foot order that the thesis tried."""
    TEXTBOOK = "Textbook"
    """Thesis Table 1.2."""
    PATTERNS = "Footfall patterns"
    """Gaits of the footfall-pattern thesis, for 4, 6 and 12 legs."""
    SEQUENCES = "Sequences"
    """Gaits of the other groups one after the other."""


@dataclass(frozen=True)
class ManualTag:
    """Which published manual gait an entry is."""

    family: str
    version: int


@dataclass(frozen=True)
class LibraryEntry:
    """A built-in gait, how it is called and where it is listed."""

    id: str
    gait: Gait
    manual: ManualTag | None
    group: Group
    walks: bool = True
    """Whether a motion of it keeps every limit of its robot."""


@cache
def default_vocabulary() -> SegmentVocabulary:
    """Named positions and segments of thesis Tables 3.2 to 3.4."""
    table = data_table("segments.toml")
    segments = {name: Segment(**values) for name, values in table["segments"].items()}
    return SegmentVocabulary(table["xy"], table["z"], segments)


@cache
def library() -> Mapping[str, LibraryEntry]:
    """Every built-in gait by its id, group by group, in the order of the page's list."""
    optimised = data_table("gaits.toml")["gait"]
    items = [
        *((Group.OPTIMISED, item) for item in optimised),
        *((Group.BY_HAND, item) for item in data_table("manual.toml")["gait"]),
        *((Group.APPENDIX, ordered) for item in optimised for ordered in _appendix_items(item)),
        *((Group.TEXTBOOK, item) for item in data_table("textbook.toml")["gait"]),
    ]
    singles = {item["id"]: _entry(group, item) for group, item in items}
    for pattern in library_patterns().values():
        singles[pattern.id] = LibraryEntry(pattern.id, pattern.gait, None, Group.PATTERNS, pattern.walks)
    sequences = (_sequence_entry(item, singles) for item in data_table("sequences.toml")["sequence"])
    for_robot = (_entry_for_robot(item, singles) for item in data_table("for_robot.toml")["gait"])
    return MappingProxyType(_by_id(for_robot) | singles | _by_id(sequences))


def _by_id(entries: Iterable[LibraryEntry]) -> dict[str, LibraryEntry]:
    return {entry.id: entry for entry in entries}


def _entry_for_robot(item: dict[str, Any], singles: Mapping[str, LibraryEntry]) -> LibraryEntry:
    return LibraryEntry(item["id"], gait_for_robot(item, singles[item["like"]].gait), None, Group.FOR_ROBOT)


@cache
def library_patterns() -> Mapping[str, LibraryPattern]:
    """The periodic patterns of the library by the id of the gait that each becomes."""
    found = (library_pattern(item) for item in data_table("patterns.toml")["pattern"])
    return MappingProxyType({pattern.id: pattern for pattern in found})


def _sequence_entry(item: dict[str, Any], singles: Mapping[str, LibraryEntry]) -> LibraryEntry:
    parts = [SequencePart(singles[part["gait"]].gait, part["times"], part["gait"]) for part in item["parts"]]
    gait = sequence_gait(item["name"], parts, item["note"])
    return LibraryEntry(item["id"], gait, None, Group.SEQUENCES)


def group_ids(group: Group) -> tuple[str, ...]:
    """Ids of the built-in gaits of a group, in the order of the page's list."""
    return tuple(entry.id for entry in library().values() if entry.group is group)


def appendix_orders() -> dict[str, tuple[tuple[int, ...], ...]]:
    """The foot orders of the thesis's Appendix A by gait, four each, version 1 first."""
    items = (item for item in data_table("gaits.toml")["gait"] if "appendix" in item)
    return {item["id"]: tuple(tuple(order) for order in item["appendix"]) for item in items}


def _appendix_items(item: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """The gait once for each of its foot orders."""
    for version, order in enumerate(item.get("appendix", ()), 1):
        words = "-".join(map(str, order))
        yield item | {
            "id": f"{item['id']}-order-{version}",
            "name": f"{item['name']}, order {words}",
            "order": order,
            "note": f"Version {version} of the gait's foot orders in thesis Appendix A.",
        }


def _entry(group: Group, item: dict[str, Any]) -> LibraryEntry:
    orientation = Orientation(item["orientation"])
    table, tag = None, None
    timeline = _timeline(item)
    if "manual" in item:
        table, tag = _table(item), ManualTag(item["manual"]["family"], item["manual"]["version"])
        timeline = table.timeline(SAMPLE_TIME)
    yaw = float(np.radians(item.get("yaw_deg", 0.0)))
    gait = Gait(
        name=item["name"],
        robot=ROBOT,
        orientation=orientation,
        direction=1,
        order=tuple(item["order"]),
        step=(*heading_step(orientation, item["step"])[:2], yaw),
        iterations=1,
        timeline=timeline,
        segment_table=table,
        options=_options(item),
        notes=item.get("note", ""),
    )
    return LibraryEntry(item["id"], with_return(gait, load_robot(ROBOT)), tag, group, item.get("walks", True))


def _timeline(item: dict[str, Any]) -> ContactTimeline:
    """Phases as they are drawn, or the order's own timeline."""
    if "phases" not in item:
        return timeline_from_order(len(item["order"]), item["order"], sample_time=SAMPLE_TIME)
    knots = GaitOptions.phase_knots
    rows = ["".join(phase * knots for phase in row) for row in item["phases"]]
    return timeline_from_rows(rows, SAMPLE_TIME)


def _table(item: dict[str, Any]) -> SegmentTable:
    rows, link = (
        tuple(tuple(name.strip() for name in row.split(",")) for row in item[part])
        for part in ("table", "link")
    )
    first, last = item["manual"]["repeat"]
    return SegmentTable(rows, DEFAULT_SEGMENT_SAMPLES, first, default_vocabulary(), last, link)


def _options(item: dict[str, Any]) -> GaitOptions:
    return GaitOptions(
        margin=item.get("margin", GaitOptions.margin),
        plane_height=item.get("plane_height", GaitOptions.plane_height),
        motor_speed=item.get("motor_speed"),
        turning=HeadingProfile(item.get("turning", HeadingProfile.STEADY)),
        cost=Cost.GENTLE,
    )


def optimised_entry(name: str) -> LibraryEntry:
    """The built-in gait for an optimiser: of trajectories, or of poses for the robot's clock.

    Raises:
        InputError: there is none of that name.
    """
    entry = library().get(name)
    if entry is None or entry.manual is not None or entry.group is Group.SEQUENCES:
        names = ", ".join(group_ids(Group.OPTIMISED))
        raise InputError(
            f"There is no gait “{name}” to optimise; choose one of {names}, or another that "
            "`footfall gaits` lists and that is neither made by hand nor a sequence.",
            "GAIT",
        )
    return entry


def manual_entry(family: str, version: int) -> LibraryEntry:
    """The published manual gait of a family and version.

    Raises:
        InputError: there is none.
    """
    entries = {(e.manual.family, e.manual.version): e for e in library().values() if e.manual is not None}
    families = tuple(dict.fromkeys(known for known, _ in entries))
    if family not in families:
        raise InputError(f"There is no manual gait “{family}”; choose one of {', '.join(families)}.", "GAIT")
    if (family, version) not in entries:
        versions = sorted(v for f, v in entries if f == family)
        raise InputError(
            f"{family} has no version {version}; choose one of {', '.join(map(str, versions))}.", "--version"
        )
    return entries[family, version]


def order_name(order: tuple[int, ...]) -> str | None:
    """Id of the optimised gait with this circular foot order, or None."""
    for entry in library().values():
        own = entry.gait.order
        is_straight = entry.group is Group.OPTIMISED and entry.gait.step[2] == 0.0
        if is_straight and order in [own[first:] + own[:first] for first in range(len(own))]:
            return entry.id
    return None
