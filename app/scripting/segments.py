"""Segment tables for scripts: gaits in words, a row of named segments for each foot."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from app.scripting.gaits import Gait, gait
from app.scripting.html import Cell, table
from core.errors import InputError
from core.gait.gait import Gait as Document
from core.library.library import default_vocabulary
from core.patterns.to_gait import order_of
from core.segments.from_timeline import table_from_timeline
from core.segments.segment_table import SegmentTable


@dataclass(frozen=True, eq=False, repr=False)
class Segments:
    """A segment table: in each segment every foot does one named thing. `footfall.segments` gives one.

    Args:
        table: the table in full, of one iteration; its heights are strokes in m.
        document: the gait that it belongs to.

    Raises:
        InputError: by `changed` and `gait`, where segments do not fit together.

    Example:
        >>> import footfall as ff
        >>> table = ff.segments("walk-manual-0")
        >>> table.rows[0][:3], table.samples
        (('Push A', 'Wait A', 'Wait A'), 5)
    """

    table: SegmentTable
    document: Document

    @property
    def rows(self) -> tuple[tuple[str, ...], ...]:
        """For each foot the names of its segments, one after the other."""
        return self.table.rows

    @property
    def count(self) -> int:
        """Number of segments of an iteration."""
        return self.table.segment_count

    @property
    def samples(self) -> int:
        """Samples of each segment, both its ends included."""
        return self.table.samples_per_segment

    @property
    def vocabulary(self) -> dict[str, tuple[str, str]]:
        """From where to where each named segment leads, such as `Home-Base` to `Step-Base`."""
        return {name: (one.start, one.end) for name, one in self.table.vocabulary.segments.items()}

    def changed(self, foot: int, row: Sequence[str]) -> Segments:
        """The table with other segments of one foot.

        Args:
            foot: from 1.
            row: as many names as the table has segments, each of the `vocabulary`.

        Raises:
            InputError: there is no such foot or segment, or one does not start where the one before ends.

        Example:
            >>> import footfall as ff
            >>> table = ff.segments("walk-manual-0")
            >>> swapped = table.changed(2, table.rows[2]).changed(3, table.rows[1])
            >>> swapped.gait().stance.shape
            (4, 55)
        """
        if not 1 <= foot <= len(self.rows):
            raise InputError(f"There is no foot {foot}; the table has {len(self.rows)}.", "foot")
        if len(row) != self.count:
            raise InputError(f"Foot {foot} is given {len(row)} segments; the table has {self.count}.", "row")
        rows = (*self.rows[: foot - 1], tuple(row), *self.rows[foot:])
        return replace(self, table=replace(self.table, rows=rows))

    def gait(self, name: str | None = None) -> Gait:
        """The gait that walks the table; its timeline follows from the table.

        Args:
            name: what it is called; the name of the gait that the table belongs to where None.

        Returns:
            A gait, for `footfall.plan`; nothing has to be solved. Its step is in m.

        Raises:
            InputError: a foot ends an iteration elsewhere than the next one begins.

        Example:
            >>> import footfall as ff
            >>> ff.plan(ff.segments("walk-manual-0").gait()).status
            'given'
        """
        of = self.document
        turned = self.table.repeated(of.iterations).turned(of.quarter_turns)
        timeline = turned.timeline(of.timeline.sample_time)
        order = order_of(timeline.stance, of.quarter_turns)
        made = replace(of, segment_table=self.table, order=order, timeline=timeline, recorded=None)
        return Gait(made if name is None else replace(made, name=name))

    def __repr__(self) -> str:
        return f"Segments of “{self.document.name}”: {self.count} of {self.samples} samples"

    def _repr_html_(self) -> str:
        heads = ["foot", *map(str, range(1, self.count + 1))]
        rows: list[list[Cell]] = [[foot, *row] for foot, row in enumerate(self.rows, 1)]
        return table(heads, rows, repr(self))


def segments(source: str | Path | Gait) -> Segments:
    """The segment table of a gait: its own, or one that implies exactly its drawn footfalls.

    Args:
        source: a gait as for `footfall.gait`.

    Returns:
        The table; places are multiples of the step, heights are strokes in m.

    Raises:
        InputError: there is no such gait, or no table implies its footfalls; the sentence says what to draw.

    Example:
        >>> import footfall as ff
        >>> ff.segments("walk-manual-0").count
        11
    """
    document = gait(source).document
    if document.sequence or document.poses is not None:
        raise InputError(
            f"“{document.name}” is a sequence or made for the robot's clock; it has no segments.",
            "source",
        )
    if document.segment_table is not None:
        return Segments(document.segment_table, document)
    made = table_from_timeline(
        document.timeline, document.iterations, document.quarter_turns, default_vocabulary()
    )
    return Segments(made, document)
