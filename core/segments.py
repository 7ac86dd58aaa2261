"""Segment tables: per foot, a row of named straight-line segments between named positions (thesis 3.3)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from core.arrays import Bools, Floats
from core.errors import InputError
from core.timeline import ContactTimeline


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
        for name, segment in self.segments.items():
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
    """Named segments, a row a foot.

    Args:
        rows: (legs) rows of names, all of one length.
        samples_per_segment: samples of each segment, both its ends included.
        repeat_from: number of the segment, counted from 1, at which further iterations begin.
        vocabulary: what the names mean.
    """

    rows: tuple[tuple[str, ...], ...]
    samples_per_segment: int
    repeat_from: int
    vocabulary: SegmentVocabulary

    def __post_init__(self) -> None:
        if self.samples_per_segment < 2:
            raise InputError(
                f"A segment has {self.samples_per_segment} samples; it needs at least 2 for its two ends.",
                "samples_per_segment",
            )
        for foot, row in enumerate(self.rows, 1):
            if len(row) != len(self.rows[0]):
                raise InputError(
                    f"Foot {foot} has {len(row)} segments; it needs {len(self.rows[0])}, as foot 1 has.",
                    "segment_table",
                )
            self._require_continuous(foot, row)
        if not 1 <= self.repeat_from <= self.segment_count:
            raise InputError(f"repeat_from must lie in 1 to {self.segment_count}.", "repeat_from")

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

    @property
    def segment_count(self) -> int:
        """Number of segments of one iteration, the opening ones included."""
        return len(self.rows[0])

    def repeated(self, iterations: int) -> SegmentTable:
        """The table run through several times: from `repeat_from` on, again and again."""
        again = [row[self.repeat_from - 1 :] * (iterations - 1) for row in self.rows]
        rows = tuple(row + more for row, more in zip(self.rows, again, strict=True))
        return replace(self, rows=rows)

    def turned(self, quarter_turns: int) -> SegmentTable:
        """The same rows for the feet a number of quarter turns further on."""
        legs = len(self.rows)
        shift = (quarter_turns * legs // 4) % legs
        return replace(self, rows=self.rows[legs - shift :] + self.rows[: legs - shift])

    def feet_displacements(self, step_xy: Floats, deepest: float) -> Floats:
        """Displacement of each foot from its module's centre at each sample, in the robot's axes.

        Args:
            step_xy: (2,) displacement that Step stands for, m.
            deepest: z of a centred foot at stroke 0, m (negative).

        Returns:
            (samples, legs, 3) m, linear within each segment, both ends included.
        """
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
        """(legs, samples) true where the segment is in the air."""
        swings = [[self.vocabulary.segments[name].swing for name in row] for row in self.rows]
        return np.repeat(np.array(swings, dtype=np.bool_), self.samples_per_segment, axis=1)

    def timeline(self, sample_time: float) -> ContactTimeline:
        """The contact timeline that the table implies; nothing locked."""
        stance = ~self.swing_samples()
        return ContactTimeline(stance, np.zeros_like(stance), sample_time)
