"""Feet in a rendered video are found where they were drawn; what cannot be used is said."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from app.vision.tracking import VideoTrack, missing_remarks, track_of_pixels, track_video
from app.vision.video_file import VideoFile
from core.errors import InputError
from core.vision import image_header as picture_size
from core.vision.camera import FOOT_COLOURS
from core.vision.setup import TrackingSetup
from tests.support.trials.rendered import LENS, VIEW, Hidden, write_video
from tests.support.trials.retimed import retimed
from tests.support.trials.tracks import RATE, stepping_track

SETUP = TrackingSetup(VIEW, LENS)
HIDDEN = Hidden(2, 60, 73)
FALSE_FRAME = 150
TRACK = stepping_track((0.012, 0.003), 1)


@pytest.fixture(scope="module")
def video(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("video") / "walk.avi"
    write_video(path, TRACK.feet, RATE, (HIDDEN,), false_spot=FALSE_FRAME)
    return path


@pytest.fixture(scope="module")
def found(video: Path) -> VideoTrack:
    result = track_video(video, SETUP)
    assert result is not None
    return result


@pytest.mark.heavy
def test_feet_are_found_within_half_a_millimetre(found: VideoTrack) -> None:
    assert found.track.frame_rate == pytest.approx(RATE)
    away = np.linalg.norm(found.track.feet - TRACK.feet, axis=2)
    assert np.median(away, axis=0).max() <= 0.0005
    assert np.quantile(away[~found.track.filled], 0.99) <= 0.001


@pytest.mark.heavy
def test_a_hidden_foot_is_a_marked_gap(found: VideoTrack) -> None:
    assert (HIDDEN.foot, HIDDEN.first, HIDDEN.last - 1) in found.track.gaps
    assert not found.false[HIDDEN.first : HIDDEN.last].any()


def test_a_spot_where_the_foot_cannot_be_is_marked_as_false(found: VideoTrack) -> None:
    assert [tuple(place) for place in np.argwhere(found.false)] == [(FALSE_FRAME, 0)]
    assert found.track.filled[FALSE_FRAME, 0]
    assert np.linalg.norm(found.track.feet[FALSE_FRAME, 0] - TRACK.feet[FALSE_FRAME, 0]) < 0.001


@pytest.mark.heavy
def test_without_the_lens_places_are_wrong(video: Path) -> None:
    bent = track_video(video, replace(SETUP, lens=None))
    assert bent is not None
    assert np.median(np.linalg.norm(bent.track.feet - TRACK.feet, axis=2)) > 0.0005


def test_pictures_of_another_size_than_the_setups_are_refused(video: Path) -> None:
    with pytest.raises(InputError, match=r"1280 × 720 px; these have 640 × 480"):
        track_video(video, replace(SETUP, size=(1280, 720)))


def test_pictures_that_are_missing_are_a_gap_of_every_foot() -> None:
    pixels = np.full((20, 4, 2), 100.0)
    times = np.delete(np.arange(26) / RATE, np.s_[8:14])
    found = track_of_pixels(times, pixels, replace(SETUP, lens=None), "camera")
    assert found.track.gaps == tuple((foot, 8, 13) for foot in range(4))
    np.testing.assert_allclose(found.track.times, np.arange(26) / RATE, atol=1e-9)


def test_pictures_that_are_missing_or_show_no_foot_are_said_and_are_no_feet_that_were_not_seen() -> None:
    pixels = np.full((20, 4, 2), 100.0)
    pixels[3] = np.nan
    pixels[12, 1] = np.nan
    found = track_of_pixels(
        np.delete(np.arange(22) / RATE, [8, 9]), pixels, replace(SETUP, lens=None), "camera"
    )
    assert np.flatnonzero(found.missing).tolist() == [3, 8, 9]
    assert [tuple(place) for place in np.argwhere(found.unseen)] == [(14, 1)]
    assert missing_remarks(found)[0].startswith("3 pictures are missing or without any foot;")
    assert missing_remarks(replace(found, missing=found.missing & False)) == ()


def test_pictures_of_a_film_whose_rate_varies_have_the_times_that_it_says(tmp_path: Path) -> None:
    even, path = tmp_path / "even.mp4", tmp_path / "phone.mp4"
    write_video(even, TRACK.feet[:30], RATE, code="mp4v")
    usual = np.diff([time for time, _ in VideoFile(even).pictures()])
    np.testing.assert_allclose(usual, 1.0 / RATE, atol=1e-4)
    path.write_bytes(retimed(even.read_bytes(), [1] * 15 + [3] * 15))
    found = track_video(path, SETUP)
    assert found is not None
    between = np.concatenate([np.ones(15), np.full(14, 3.0)]) / RATE
    np.testing.assert_allclose(np.diff(found.track.times), between, atol=1e-4)
    assert not found.missing.any()


def test_a_film_whose_times_jump_by_days_is_refused() -> None:
    with pytest.raises(InputError, match=r"walk\.mp4 lasts 11\.1 h, 1200001 frames; at most"):
        track_of_pixels(np.array([0.0, 1 / 30, 2 / 30, 40_000.0]), np.zeros((4, 4, 2)), SETUP, "walk.mp4")


def test_tracking_ends_when_it_is_told_to(video: Path) -> None:
    shares: list[float] = []

    def enough(share: float) -> bool:
        shares.append(share)
        return len(shares) < 2

    assert track_video(video, SETUP, enough) is None
    assert 0.0 < shares[0] < shares[1] < 1.0


def test_a_colour_that_no_foot_has_is_named_by_its_foot(video: Path) -> None:
    colours = (*FOOT_COLOURS[:3], replace(FOOT_COLOURS[3], hue=(0.8, 0.85)))
    with pytest.raises(InputError, match="foot 4 is seen in no frame"):
        track_video(video, replace(SETUP, colours=colours))


def test_a_video_whose_pictures_are_too_large_is_refused(
    video: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(picture_size, "MOST_PIXELS", 640 * 480 - 1)
    with pytest.raises(InputError, match="640 × 480 pixels"):
        track_video(video, SETUP)


def test_a_file_that_is_no_video_is_refused(tmp_path: Path) -> None:
    (tmp_path / "notes.avi").write_text("no video")
    with pytest.raises(InputError, match="cannot be read as a video"):
        track_video(tmp_path / "notes.avi", SETUP)


@pytest.mark.parametrize(
    ("name", "head"),
    [
        ("list.m3u8", "#EXTM3U\n#EXT-X-TARGETDURATION:9\n#EXTINF:9.0,\n{}\n#EXT-X-ENDLIST\n"),
        ("list.avi", "ffconcat version 1.0\nfile {}\n"),
    ],
)
def test_a_list_that_names_another_video_is_none(video: Path, name: str, head: str) -> None:
    named = video.with_name(name)
    named.write_bytes(head.format(video.name).encode() + b"#\0\n")
    with pytest.raises(InputError, match="cannot be read as a video"):
        track_video(named, SETUP)
