"""Gait documents of a published row: ours, and the published motion as the folder's file holds it."""

from dataclasses import replace
from enum import StrEnum

from app.export.import_gait import read_gait
from app.plans.make_plan import Solve
from app.published.own_gait import own_gait
from app.published.problems import walker
from app.published.reference import Reference, read_published
from app.published.reference_figures import recorded_path
from app.published.reference_folder import PublishedFolder
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
    table: PublishedTable, row: PublishedRow, source: Source, published: PublishedFolder, solve: Solve
) -> Gait:
    """The document of a row.

    Args:
        table: of the row.
        row: which one.
        source: ours, or the published motion.
        published: the folder of the published data.
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
    reference = published.reference
    path = None if reference is None else recorded_path(table, row, reference)
    if path is None:
        reason = published.remedy if reference is None else f"It is not in {published.name}."
        raise NotFoundError(
            f"The published motion of {row_title(row)} is not at hand. {reason} Or open ours.", "source"
        )
    of_file = replace(row, gait=replace(row.gait, iterations=row.gait.motion_iterations))
    name = f"{row_title(of_file)}, published ({table.name})"
    return read_gait(read_published(path), path.name, name=name, robot=walker().name, fit=CLIPPED).gait
