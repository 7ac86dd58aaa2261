"""Hypothesis strategies for everything that a gait document can hold."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime

import numpy as np
from hypothesis import strategies as st

from core.gait.gait import Gait, Orientation, SequencePart
from core.gait.held_feet import HeldFeet
from core.gait.options import GaitOptions
from core.gait.provenance import Provenance
from core.gait.recording import Recording, RecordingForm
from core.gait.step import without_rounding
from core.motion.contact_timeline import ContactTimeline
from core.motion.heading_profile import HeadingProfile
from core.names import is_visible
from core.problem.motion_problem import Boundary, Cost, Workspace
from core.robot.model import ROBOT_NAMES, load_robot
from core.segments.segment_table import Segment, SegmentTable, SegmentVocabulary

WORDS = st.text(min_size=1, max_size=12)
LINES = st.text(max_size=120)
LENGTH = st.floats(-0.1, 0.1)


def timelines(legs: int) -> st.SearchStrategy[ContactTimeline]:
    """Timelines of any contact with any cells locked."""

    def timeline(samples: int, seed: int, sample_time: float) -> ContactTimeline:
        cells = np.random.default_rng(seed).random((2, legs, samples)) < 0.5
        return ContactTimeline(cells[0], cells[1], sample_time)

    return st.builds(timeline, st.integers(2, 60), st.integers(0, 2**32 - 1), st.floats(0.01, 5.0))


def _or_none(values: st.SearchStrategy[float]) -> st.SearchStrategy[float | None]:
    return st.none() | values


def options() -> st.SearchStrategy[GaitOptions]:
    """Options anywhere within their bounds."""
    return st.builds(
        GaitOptions,
        clearance=st.floats(0, 0.02),
        margin=st.floats(0.0, 0.05),
        body_speed=st.floats(0.0005, 1.0),
        plane_height=st.floats(0.03, 0.1),
        workspace=st.sampled_from(Workspace),
        cost=st.sampled_from(Cost),
        phase_knots=st.integers(2, 50),
        closing_knots=st.integers(0, 100),
        end_plane_height=_or_none(st.floats(0.03, 0.1)),
        friction=_or_none(st.floats(0.01, 10.0)),
        motor_speed=_or_none(st.floats(0.0005, 1.0)),
        motor_acceleration=_or_none(st.floats(0.0005, 10.0)),
        boundary=st.sampled_from(Boundary),
        turning=st.sampled_from(HeadingProfile),
    )


@st.composite
def segment_tables(draw: st.DrawFn, legs: int) -> SegmentTable:
    """Continuous tables over a vocabulary of their own, with or without a link."""
    names = st.text("abcxyzÄß ", min_size=1, max_size=4).filter(lambda name: name == name.strip())
    xy = draw(st.dictionaries(names, st.floats(-2, 2), min_size=1, max_size=3))
    z = draw(st.dictionaries(names, st.floats(0, 0.02), min_size=1, max_size=2))
    places = [f"{x}-{height}" for x in xy for height in z]
    segments = {f"wait at {place}": Segment(place, place, swing=False) for place in places}
    for start, end in draw(st.lists(st.tuples(*[st.sampled_from(places)] * 2), max_size=5)):
        segments[f"{start} to {end}"] = Segment(start, end, swing=draw(st.booleans()))
    count = draw(st.integers(1, 6))
    rows = tuple(draw(_ways(segments, count)) for _ in range(legs))
    first = draw(st.integers(1, count))
    return SegmentTable(
        rows=rows,
        samples_per_segment=draw(st.integers(2, 9)),
        repeat_from=first,
        vocabulary=SegmentVocabulary(xy, z, segments),
        repeat_to=draw(st.none() | st.integers(first, count)),
        link=draw(_links(sorted(segments), legs)),
    )


def _links(names: list[str], legs: int) -> st.SearchStrategy[tuple[tuple[str, ...], ...]]:
    """No link, or rows of one length."""
    row = st.lists(st.sampled_from(names), min_size=2, max_size=2).map(tuple)
    return st.just(()) | st.lists(row, min_size=legs, max_size=legs).map(tuple)


@st.composite
def _ways(draw: st.DrawFn, segments: dict[str, Segment], count: int) -> tuple[str, ...]:
    """A row of segments, each from where the one before ends."""
    row = [draw(st.sampled_from(sorted(segments)))]
    while len(row) < count:
        here = segments[row[-1]].end
        row.append(draw(st.sampled_from(sorted(n for n, s in segments.items() if s.start == here))))
    return tuple(row)


def recordings() -> st.SearchStrategy[Recording]:
    """Recordings of any text; they need hold no motion."""
    assumed = st.lists(LINES, max_size=3).map(tuple)
    trajectory = st.builds(
        Recording, WORDS, st.just(RecordingForm.TRAJECTORY), LINES, st.none() | LINES, assumed
    )
    waypoints = st.builds(Recording, WORDS, st.just(RecordingForm.WAYPOINTS), LINES, st.none(), assumed)
    return trajectory | waypoints


def provenances() -> st.SearchStrategy[Provenance]:
    """Provenances of any result."""
    digest = st.text("0123456789abcdef", min_size=64, max_size=64)
    word = st.text(st.characters(min_codepoint=32, max_codepoint=126), min_size=1, max_size=20)
    moment = st.datetimes(datetime(2000, 1, 1), datetime(2100, 1, 1), timezones=st.just(UTC))
    return st.builds(
        Provenance,
        motion=digest,
        trajectory=digest,
        method=word,
        solver=word,
        status=word,
        seconds=st.floats(0, 1e5),
        made=moment.map(datetime.isoformat),
        program=word,
    )


def held_feet(legs: int) -> st.SearchStrategy[HeldFeet]:
    """Any feet but all of them, held up at either end."""
    feet = st.lists(st.integers(1, legs), unique=True, max_size=legs - 1).map(tuple)
    return st.builds(HeldFeet, feet, feet)


@st.composite
def gaits(draw: st.DrawFn) -> Gait:
    """Documents of single gaits with everything that they can hold, fitting together or not."""
    robot = draw(st.sampled_from(ROBOT_NAMES))
    legs = load_robot(robot).leg_count
    gait = Gait(
        name=draw(st.text(min_size=1, max_size=20).filter(is_visible)),
        robot=robot,
        orientation=draw(st.sampled_from(Orientation)),
        direction=draw(st.integers(1, 4)),
        order=tuple(draw(st.permutations(range(1, legs + 1)))),
        step=without_rounding((draw(LENGTH), draw(LENGTH), draw(st.floats(-np.pi, np.pi)))),
        iterations=draw(st.integers(1, 20)),
        timeline=draw(timelines(legs)),
        options=draw(options()),
        notes=draw(LINES),
        provenance=draw(st.none() | provenances()),
        held=draw(held_feet(legs)),
    )
    kind = draw(st.sampled_from(["computed", "table", "recorded"]))
    if kind == "table":
        return replace(gait, segment_table=draw(segment_tables(legs)))
    return replace(gait, recorded=draw(recordings())) if kind == "recorded" else gait


@st.composite
def documents(draw: st.DrawFn) -> Gait:
    """Single gaits and sequences of them."""
    gait = draw(gaits())
    if draw(st.booleans()):
        return gait
    part = st.builds(SequencePart, gaits(), st.integers(1, 20), st.none() | WORDS)
    parts = draw(st.lists(part, min_size=1, max_size=2))
    return replace(gait, sequence=tuple(parts), segment_table=None, recorded=None)
