"""The gait of the library behind a row of a published table."""

from dataclasses import replace

from core.gait.gait import Gait, drawn_timeline, heading_step
from core.library.library import SAMPLE_TIME, library, manual_entry
from core.published.tables import PublishedRow, PublishedTable, RowGait
from core.segments.segment_table import SegmentTable

_TITLES = {"walk": "Walk", "amble": "Amble", "s-gait": "S-Gait", "c-gait": "C-Gait"}
"""Names of the gaits as the thesis prints them."""


def family_title(gait: RowGait) -> str:
    """The name of a row's gait as the thesis prints it."""
    return _TITLES[gait.family]


def published_gait(table: PublishedTable, row: PublishedRow) -> Gait:
    """The gait of a row as a document of its own: library gait, order, step, direction and iterations.

    Args:
        table: the row's.
        row: the row.
    """
    of = row.gait
    base = library()[of.family].gait if of.version is None else manual_entry(of.family, of.version).gait
    segments = base.segment_table
    gait = _optimised(of, base) if segments is None else _by_hand(of, base, segments)
    return replace(gait, name=f"{row_title(row)} ({table.name})", notes=f"The gait of {table.source}.")


def _optimised(of: RowGait, gait: Gait) -> Gait:
    order = gait.order if of.order is None else feet_of_roles(gait, of.order)
    step = heading_step(gait.orientation, of.step)
    changed = replace(gait, order=order, step=step, direction=of.direction, iterations=of.iterations)
    return replace(changed, timeline=drawn_timeline(changed))


def _by_hand(of: RowGait, gait: Gait, segments: SegmentTable) -> Gait:
    timeline = segments.repeated(of.iterations).turned(of.direction - 1).timeline(SAMPLE_TIME)
    step = heading_step(gait.orientation, of.step)
    return replace(gait, step=step, direction=of.direction, iterations=of.iterations, timeline=timeline)


def feet_of_roles(gait: Gait, roles: tuple[str, ...]) -> tuple[int, ...]:
    """Feet of roles such as `Back Left`, counted from 1, at direction 1."""
    names = replace(gait, direction=1, timeline=gait.timeline.turned(-gait.quarter_turns)).roles
    return tuple(names.index("".join(word[0] for word in role.split())) + 1 for role in roles)


def row_title(row: PublishedRow) -> str:
    """The gait of a row for a person, such as `Walk 10 mm` or `Walk version 0 × 3`."""
    gait = row.gait
    parts = [family_title(gait)]
    if gait.version is not None:
        parts.append(f"version {gait.version}")
    else:
        parts.append(f"{gait.step * 1000:.3g} mm")
    if gait.order is not None:
        parts.append("-".join(map(str, feet_of_roles(library()[gait.family].gait, gait.order))))
    if gait.iterations > 1:
        parts.append(f"× {gait.iterations}")
    return " ".join(parts)
