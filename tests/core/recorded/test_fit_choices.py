"""A recording beyond the motors' range can be kept in several ways; each works and says its price."""

from __future__ import annotations

import pytest

from core.errors import InputError
from core.gait.gait import Gait
from core.gait.recording import Recording, RecordingFit, WithinStroke
from core.library.library import library
from core.motion.within_stroke import beyond_range
from core.recorded.fit_choices import fit_choices, refitted
from core.recorded.recorded_motion import gait_motion
from tests.support.beyond_range import MODEL, recorded_gait


def recording_of(gait: Gait) -> Recording:
    assert gait.recorded is not None
    return gait.recorded


def test_every_way_is_within_the_range_and_keeps_the_file() -> None:
    gait = recorded_gait(0.002)
    ways = list(fit_choices(gait, recording_of(gait)))
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
    scaled = list(fit_choices(gait, recording_of(gait)))[-1].gait
    scale = recording_of(scaled).fit.scale
    assert scaled.step == pytest.approx([scale * value for value in gait.step], abs=1e-9)


def test_the_body_is_raised_by_no_more_than_is_needed() -> None:
    gait = recorded_gait(0.002)
    raised = list(fit_choices(gait, recording_of(gait)))[1]
    fit = recording_of(raised.gait).fit
    assert 0 < fit.body <= 0.002
    less = refitted(gait, RecordingFit(body=fit.body - 0.0001))
    assert beyond_range(MODEL, gait_motion(less, recording_of(less), MODEL).trajectory).any()


def test_beyond_five_millimetres_only_the_body_and_the_scale_help() -> None:
    gait = recorded_gait(0.008)
    assert [way.label.split()[0] for way in fit_choices(gait, recording_of(gait))] == ["Raise"]


def test_a_gait_without_a_recording_and_absurd_values_are_refused() -> None:
    with pytest.raises(InputError, match="has no recorded motion"):
        refitted(library()["walk"].gait, RecordingFit(within_stroke=WithinStroke.CLIP))
    with pytest.raises(InputError, match="would be raised by 60 mm"):
        RecordingFit(body=0.06)
    with pytest.raises(InputError, match="would be scaled by nan"):
        RecordingFit(scale=float("nan"))


def test_the_question_about_the_frame_is_asked_once() -> None:
    gait = recorded_gait(0.022)
    (asked, *_) = fit_choices(gait, recording_of(gait))
    assert asked.label == "Correct the heights"
    labels = [choice.label for choice in fit_choices(asked.gait, recording_of(asked.gait))]
    assert labels
    assert "Correct the heights" not in labels


def test_a_choice_that_was_made_is_not_offered_again() -> None:
    gait = recorded_gait(0.002)
    for choice in fit_choices(gait, recording_of(gait)):
        for next_one in fit_choices(choice.gait, recording_of(choice.gait)):
            assert next_one.gait != choice.gait, next_one.label


def test_a_body_that_would_be_raised_too_far_is_not_offered() -> None:
    gait = recorded_gait(0.06)
    assert [choice.label.split()[0] for choice in fit_choices(gait, recording_of(gait))] == []
