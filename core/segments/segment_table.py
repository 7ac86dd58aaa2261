"""Segment tables: per foot, a row of named straight-line segments between named positions (thesis 3.3)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from core.arrays import Bools, Floats
from core.errors import InputError
from core.motion.contact_timeline import MAX_SAMPLES, ContactTimeline
from core.robot.model import StrokeLimits

MOST_STEPS = 10.0
"""Largest multiple of the step that a named place may be."""

MOST_HEIGHT = 0.1
"""Longest stroke of a named height, m; a guard against mm given for m."""

MOST_LETTERS = 40
"""Characters that the name of a segment, place or height may have."""


@dataclass(frozen=True)
class Segment:
    """A straight way of one foot between two named positions such as `Home-Base`, or a wait at one."""

    start: str
    end: str
    swing: bool


@dataclass(frozen=True)
class SegmentVocabulary:
    """What the names in a table mean (thesis Tables 3.2 to 3.4).

    Args:
        xy: multiple of the step's displacement, by name.
        z: motor stroke of a centred foot, m, by name.
        segments: by name.
    """

    xy: Mapping[str, float]
    z: Mapping[str, float]
    segments: Mapping[str, Segment]

    def __post_init__(self) -> None:
        for name in ("xy", "z", "segments"):
            object.__setattr__(self, name, MappingProxyType(dict(getattr(self, name))))
        for axis, what, values, least, most, unit in (
            ("xy", "place", self.xy, -MOST_STEPS, MOST_STEPS, "times the step"),
            ("z", "height", self.z, 0.0, MOST_HEIGHT, "m"),
        ):
            for name, value in values.items():
                _require_name(name, what)
                if not least <= value <= most:
                    raise InputError(
                        f"The {what} “{name}” is {value:g} {unit}; it must lie between {least:g} and "
                        f"{most:g}.",
                        f"segment_table.definitions.{axis}",
                    )
        for name, segment in self.segments.items():
            _require_name(name, "segment")
            for position in (segment.start, segment.end):
                xy, _, z = position.partition("-")
                if xy not in self.xy or z not in self.z:
                    raise InputError(f"Segment “{name}” uses the unknown position “{position}”.", name)

    def position(self, name: str, step_xy: Floats, deepest: float) -> Floats:
        """Displacement of a foot from its module's centre, in the robot's axes.

        Args:
            name: such as `Step-Base`.
            step_xy: (2,) displacement that Step stands for, m.
            deepest: z of a centred foot at stroke 0, m (negative).

        Returns:
            (3,) m, z from the actuator plane.
        """
        xy, _, z = name.partition("-")
        return np.array([*(self.xy[xy] * step_xy), deepest - self.z[z]])


@dataclass(frozen=True)
class SegmentTable:
    """Named segments of one iteration, a row a foot, and how iterations follow one another.

    An iteration is the first segments, the repeating part and the last segments (thesis 3.3.1). Between two
    iterations the last segments of one and the first of the next give way to `link`, in which the next
    foot steps while the foot before it resets, so that the robot does not pause.

    Args:
        rows: (legs) rows of names, all of one length.
        samples_per_segment: samples of each segment, both its ends included.
        repeat_from: number of the segment, counted from 1, with which the repeating part begins.
        vocabulary: what the names mean.
        repeat_to: number of its last segment; None for the last of the table.
        link: (legs) rows of names that lead from one iteration into the next; empty for none.
    """

    rows: tuple[tuple[str, ...], ...]
    samples_per_segment: int
    repeat_from: int
    vocabulary: SegmentVocabulary
    repeat_to: int | None = None
    link: tuple[tuple[str, ...], ...] = ()

    def __post_init__(self) -> None:
        if self.samples_per_segment < 2:
            raise InputError(
                f"A segment has {self.samples_per_segment} samples; it needs at least 2 for its two ends.",
                "samples_per_segment",
            )
        _require_even(self.rows, "segment_table")
        for foot, row in enumerate(self.rows, 1):
            self._require_continuous(foot, row)
        if self.repeat_to is not None and not 1 <= self.repeat_to <= self.segment_count:
            raise InputError(
                f"repeat_to is {self.repeat_to}; it must lie in 1 to {self.segment_count}.", "repeat_to"
            )
        if not 1 <= self.repeat_from <= self.last_repeated:
            raise InputError(
                f"repeat_from is {self.repeat_from}; it must lie in 1 to {self.last_repeated}.",
                "repeat_from",
            )
        if self.link and len(self.link) != len(self.rows):
            raise InputError(
                f"The link has {len(self.link)} feet; it needs {len(self.rows)}, as the table has.", "link"
            )
        _require_even(self.link, "link")

    def _require_continuous(self, foot: int, row: tuple[str, ...]) -> None:
        known = self.vocabulary.segments
        for index, name in enumerate(row, 1):
            if name not in known:
                raise InputError(
                    f"Foot {foot}, segment {index}: there is no “{name}”; known are {', '.join(known)}.",
                    "segment_table",
                )
            before = known[row[index - 2]].end if index > 1 else known[name].start
            if before != known[name].start:
                raise InputError(
                    f"Foot {foot}, segment {index}: “{name}” starts at {known[name].start}, but the foot "
                    f"is at {before} then. Choose a segment that starts there.",
                    "segment_table",
                )

    def _require_length(self) -> None:
        """The samples are no more than a timeline takes, before they are counted out."""
        if self.segment_count * self.samples_per_segment > MAX_SAMPLES:
            raise InputError(
                f"{self.segment_count} segments of {self.samples_per_segment} samples are more than "
                f"{MAX_SAMPLES} samples in all. Take fewer of either.",
                "samples_per_segment",
            )

    @property
    def segment_count(self) -> int:
        """Number of segments of one iteration, the opening ones included."""
        return len(self.rows[0])

    @property
    def last_repeated(self) -> int:
        """Number of the repeating part's last segment, counted from 1."""
        return self.segment_count if self.repeat_to is None else self.repeat_to

    def repeated(self, iterations: int) -> SegmentTable:
        """The table run through several times, all iterations written out.

        Raises:
            InputError: a foot is elsewhere after one iteration than where the next goes on.
        """
        first, last = self.repeat_from - 1, self.last_repeated
        links = self.link or ((),) * len(self.rows)
        rows = tuple(
            row[:last] + (link + row[first:last]) * (iterations - 1) + row[last:]
            for row, link in zip(self.rows, links, strict=True)
        )
        return replace(self, rows=rows, repeat_from=1, repeat_to=None, link=())

    def turned(self, quarter_turns: int) -> SegmentTable:
        """The same rows for the feet a number of quarter turns further on."""
        legs = len(self.rows)
        shift = (quarter_turns * legs // 4) % legs
        rows, link = (r[legs - shift :] + r[: legs - shift] for r in (self.rows, self.link))
        return replace(self, rows=rows, link=link)

    def turned_back(self, quarter_turns: int) -> SegmentTable:
        """The table that `turned` makes this one of."""
        legs = len(self.rows)
        shift = (quarter_turns * legs // 4) % legs
        rows, link = (r[shift:] + r[:shift] for r in (self.rows, self.link))
        return replace(self, rows=rows, link=link)

    @property
    def chains(self) -> bool:
        """Whether one iteration can follow another."""
        try:
            self.repeated(2)
        except InputError:
            return False
        return True

    def feet_displacements(self, step_xy: Floats, deepest: float) -> Floats:
        """Displacement of each foot from its module's centre at each sample, in the robot's axes.

        Args:
            step_xy: (2,) displacement that Step stands for, m.
            deepest: z of a centred foot at stroke 0, m (negative).

        Returns:
            (samples, legs, 3) m, linear within each segment, both ends included.

        Raises:
            InputError: they are too many.
        """
        self._require_length()
        fractions = np.linspace(0.0, 1.0, self.samples_per_segment)[:, None]
        tracks = []
        for row in self.rows:
            pieces = []
            for name in row:
                segment = self.vocabulary.segments[name]
                start = self.vocabulary.position(segment.start, step_xy, deepest)
                end = self.vocabulary.position(segment.end, step_xy, deepest)
                pieces.append(start + fractions * (end - start))
            tracks.append(np.concatenate(pieces))
        return np.stack(tracks, axis=1)

    def swing_samples(self) -> Bools:
        """(legs, samples) true where the segment is in the air.

        Raises:
            InputError: they are too many.
        """
        self._require_length()
        swings = [[self.vocabulary.segments[name].swing for name in row] for row in self.rows]
        return np.repeat(np.array(swings, dtype=np.bool_), self.samples_per_segment, axis=1)

    def timeline(self, sample_time: float) -> ContactTimeline:
        """The contact timeline that the table implies; nothing locked."""
        stance = ~self.swing_samples()
        return ContactTimeline(stance, np.zeros_like(stance), sample_time)


def require_heights(heights: Mapping[str, float], stroke: StrokeLimits) -> None:
    """Every named height is a stroke within the travel of a robot's motors.

    Args:
        heights: motor stroke of a centred foot, m, by name.
        stroke: limits of every motor.

    Raises:
        InputError: one is not.
    """
    for name, height in heights.items():
        if not 0.0 <= height <= stroke.travel:
            raise InputError(
                f"The height “{name}” is {height * 1000:g} mm; the robot's motors travel 0 to "
                f"{stroke.travel * 1000:g} mm and reach {stroke.lower * 1000:g} to "
                f"{stroke.upper * 1000:g} mm of it. Choose a height between these.",
                f"segment_table.definitions.z.{name}",
            )


def _require_name(name: str, what: str) -> None:
    """A name can stand in a cell of a spreadsheet, and that of a place before the hyphen of a position."""
    barred = [c for c in '\t\r\n,;"' + ("-" if what == "place" else "") if c in name]
    if barred or not name.strip() or name != name.strip() or len(name) > MOST_LETTERS:
        raise InputError(
            f"The {what} “{name}” cannot be called so: a name has 1 to {MOST_LETTERS} characters, no tabs, "
            f"commas, semicolons, quotes{' or hyphens' if what == 'place' else ''}, and no blanks around it.",
            "segment_table.definitions",
        )


def _require_even(rows: Sequence[Sequence[str]], where: str) -> None:
    """Every foot has as many segments as foot 1."""
    for foot, row in enumerate(rows, 1):
        if len(row) != len(rows[0]):
            raise InputError(
                f"Foot {foot} has {len(row)} segments; it needs {len(rows[0])}, as foot 1 has.", where
            )
