"""Phase lists: every timeline comes back, and what fits no sample is refused with foot and phase."""

from __future__ import annotations

import json
from contextlib import suppress
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from core.errors import InputError
from core.library.library import library
from core.motion.contact_timeline import ContactTimeline, timeline_from_rows
from core.motion.phase_list import format_phases, parse_phases


@st.composite
def timelines(draw: st.DrawFn) -> ContactTimeline:
    shape = (draw(st.sampled_from([1, 4, 6, 12])), draw(st.integers(2, 60)))
    stance = draw(arrays(np.bool_, shape))
    return ContactTimeline(stance, np.zeros_like(stance), draw(st.floats(0.001, 60.0)))


@given(timelines())
def test_a_timeline_comes_back_from_its_phases(timeline: ContactTimeline) -> None:
    assert parse_phases(format_phases(timeline)) == timeline


@given(timelines(), st.integers(1, 5))
def test_a_finer_sample_time_that_divides_every_phase_repeats_the_samples(
    timeline: ContactTimeline, parts: int
) -> None:
    sample_time = timeline.sample_time / parts
    if sample_time < 0.001:
        return
    finer = parse_phases(format_phases(timeline), sample_time)
    assert np.array_equal(finer.stance, np.repeat(timeline.stance, parts, axis=1))


def test_the_phases_of_walk_are_five_knots_each() -> None:
    content = json.loads(format_phases(library()["walk"].gait.timeline))
    assert content["feet"][2] == {
        "in_contact_at_start": True,
        "phase_durations": [pytest.approx(2.0), pytest.approx(2.0), pytest.approx(14.0)],
    }
    assert [sum(foot["phase_durations"]) for foot in content["feet"]] == [pytest.approx(18.0)] * 4


def test_a_phase_of_no_whole_samples_is_refused() -> None:
    text = format_phases(timeline_from_rows(["110011", "111111"], 0.4))
    with pytest.raises(InputError, match=r"foot 1, phase 1 lasts 0.8 s, which is 2.66667 samples of 0.3 s"):
        parse_phases(text, 0.3)


def changed(**fields: Any) -> str:
    content = json.loads(format_phases(timeline_from_rows(["1100", "1111"], 0.5)))
    return json.dumps({**content, **fields})


anything = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(
            st.sampled_from(["sample_time", "feet", "in_contact_at_start", "phase_durations"]),
            inner,
            max_size=4,
        )
    ),
    max_leaves=12,
)


@given(anything)
def test_any_json_is_read_or_refused_with_a_sentence(content: object) -> None:
    if isinstance(content, dict):
        content = {**content, "format": "footfall-phases", "version": 1}
    with suppress(InputError):
        assert parse_phases(json.dumps(content)).leg_count >= 1


def foot(start: Any, durations: Any) -> dict[str, Any]:
    return {"in_contact_at_start": start, "phase_durations": durations}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("not json", "is not JSON"),
        ("[" * 100_000, "is not JSON"),
        ("[]", "is no phase list"),
        (changed(format="footfall-gait"), "is no phase list"),
        (changed(version=2), "has version 2; this program reads version 1"),
        (changed(version=True), "has version true"),
        (changed(sample_time=None), "a sample time of none"),
        (changed(sample_time=0.0001), "between 0.001 and 60 s"),
        (changed(sample_time=10**400), r"line 1, column \d+ \(sample_time\): 1000.* is not a finite number"),
        (changed(feet={}), "must be a list of 1 to 100 feet"),
        (changed(feet=[]), "must be a list of 1 to 100 feet"),
        (changed(feet=[7]), "foot 1: “in_contact_at_start”"),
        (changed(feet=[foot("yes", [1.0])]), "foot 1: “in_contact_at_start”"),
        (changed(feet=[foot(True, [])]), "foot 1: “phase_durations”"),
        (changed(feet=[foot(True, [1.0, 0.0])]), "foot 1, phase 2: 0.0 must be a time"),
        (changed(feet=[foot(True, [1.0, -1.0])]), "foot 1, phase 2: -1.0 must be a time"),
        (
            changed(feet=[foot(True, [1.0, float("nan")])]),
            r"column \d+ \(phase_durations\): NaN is not a finite number",
        ),
        (changed(feet=[foot(True, [1.0, 10**400])]), "is not a finite number"),
        (changed(feet=[foot(True, [1.0, True])]), "foot 1, phase 2: true must be a time"),
        (changed(feet=[foot(True, [0.1])]), "foot 1, phase 1 lasts 0.1 s, which is 0.2 samples"),
        (changed(feet=[foot(True, [1001.0])]), "more than 2000 samples of 0.5 s"),
        (
            changed(feet=[foot(True, [1.0]), foot(True, [1.5])]),
            "foot 2 last 1.5 s in all, those of foot 1 1 s",
        ),
        (changed(feet=[foot(True, [0.5])]), "it needs 2 to 2000"),
    ],
)
def test_what_is_no_phase_list_is_refused_with_a_sentence(text: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        parse_phases(text)
