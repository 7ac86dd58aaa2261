"""Gait documents of a published row: ours, and the published motion as the folder's file holds it."""

from dataclasses import replace
from enum import StrEnum

from app.export.import_gait import read_gait
from app.export.trajectory_files import read_text
from app.plans.make_plan import Solve
from app.published.own_gait import own_gait
from app.published.problems import walker
from app.published.reference import Reference
from app.published.reference_figures import recorded_path
from core.errors import CheckError, NotFoundError
from core.gait.gait import Gait
from core.gait.recording import RecordingFit, WithinStroke
from core.published.gaits import published_gait, row_title
from core.published.tables import PublishedRow, PublishedTable

CLIPPED = RecordingFit(within_stroke=WithinStroke.CLIP)
"""The published program kept each stroke within the motors' range (docs/physics.md)."""


class Source(StrEnum):
    """The gait that a row opens."""

    OURS = "ours"
    PUBLISHED = "published"


def sources_of(table: PublishedTable, row: PublishedRow, reference: Reference | None) -> tuple[Source, ...]:
    """The gaits that a row can open."""
    has_motion = reference is not None and recorded_path(table, row, reference) is not None
    return (Source.OURS, Source.PUBLISHED) if has_motion else (Source.OURS,)


def opened_gait(
    table: PublishedTable, row: PublishedRow, source: Source, reference: Reference | None, solve: Solve
) -> Gait:
    """The document of a row.

    Args:
        table: of the row.
        row: which one.
        source: ours, or the published motion.
        reference: the published data, where it is at hand.
        solve: asks the live tier for the margin that our gait can have.

    Raises:
        NotFoundError: the published motion is not at hand.
        InputError: its file cannot be read.
    """
    if source is Source.OURS:
        gait = published_gait(table, row)
        try:
            return own_gait(gait, solve).gait
        except CheckError:  # its page says why it has no motion
            return gait
    path = None if reference is None else recorded_path(table, row, reference)
    if path is None:
        raise NotFoundError(
            f"The published motion of {row_title(row)} is not at hand. Name the folder of the published data "
            "that holds it, or open ours.",
            "source",
        )
    of_file = replace(row, gait=replace(row.gait, iterations=row.gait.motion_iterations))
    name = f"{row_title(of_file)}, published ({table.name})"
    return read_gait(read_text(path), path.name, name=name, robot=walker().name, fit=CLIPPED).gait
