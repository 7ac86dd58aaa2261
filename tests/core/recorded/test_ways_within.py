"""A recording beyond the motors' range can be kept in several ways; each works and says its price."""

from __future__ import annotations

import pytest

from core.errors import InputError
from core.gait.gait import Gait
from core.gait.recording import Recording, RecordingFit, WithinStroke
from core.library.library import library
from core.motion.within_stroke import beyond_range
from core.recorded.recorded_motion import gait_motion
from core.recorded.ways_within import refitted, ways_within
from tests.support.beyond_range import MODEL, recorded_gait


def recording_of(gait: Gait) -> Recording:
    assert gait.recorded is not None
    return gait.recorded


def test_every_way_is_within_the_range_and_keeps_the_file() -> None:
    gait = recorded_gait(0.002)
    ways = list(ways_within(gait, recording_of(gait)))
    assert [way.label.split()[0] for way in ways] == ["Keep", "Raise", "Scale"]
    for way in ways:
        recording = recording_of(way.gait)
        motion = gait_motion(way.gait, recording, MODEL)
        assert not beyond_range(MODEL, motion.trajectory).any(), way.label
        assert recording.text == recording_of(gait).text
        assert way.gait.name == gait.name
        assert (motion.trajectory.contact == way.gait.timeline.contact).all()


def test_a_scaled_motion_asks_for_the_scaled_step() -> None:
    gait = recorded_gait(0.002)
    scaled = list(ways_within(gait, recording_of(gait)))[-1].gait
    scale = recording_of(scaled).fit.scale
    assert scaled.step == pytest.approx([scale * value for value in gait.step], abs=1e-9)


def test_the_body_is_raised_by_no_more_than_is_needed() -> None:
    gait = recorded_gait(0.002)
    raised = list(ways_within(gait, recording_of(gait)))[1]
    fit = recording_of(raised.gait).fit
    assert 0 < fit.body <= 0.002
    less = refitted(gait, RecordingFit(body=fit.body - 0.0001))
    assert beyond_range(MODEL, gait_motion(less, recording_of(less), MODEL).trajectory).any()


def test_beyond_five_millimetres_only_the_body_and_the_scale_help() -> None:
    gait = recorded_gait(0.008)
    assert [way.label.split()[0] for way in ways_within(gait, recording_of(gait))] == ["Raise"]


def test_a_gait_without_a_recording_and_absurd_values_are_refused() -> None:
    with pytest.raises(InputError, match="has no recorded motion"):
        refitted(library()["walk"].gait, RecordingFit(within_stroke=WithinStroke.CLIP))
    with pytest.raises(InputError, match="would be raised by 60 mm"):
        RecordingFit(body=0.06)
    with pytest.raises(InputError, match="would be scaled by nan"):
        RecordingFit(scale=float("nan"))
