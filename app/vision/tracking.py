"""Tracks feet in pictures: finds each foot, maps it to the platform, marks gaps and outliers."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from app.vision.blobs import find_feet
from app.vision.frame_source import FrameSource
from app.vision.recording_file import Recording
from app.vision.video_file import VideoFile
from core.arrays import Bools, Floats
from core.errors import InputError
from core.vision.outliers import find_outliers
from core.vision.setup import TrackingSetup
from core.vision.track import FootTrack, filled_track

MISSED = 2.5
"""Pictures that are farther apart than so many usual intervals have others missing between them."""

ABOUT = 9
"""Intervals by whose median the usual one is told."""

MOST_FRAMES = 1_000_000
"""Frames of a track, those that are put in included: four hours at 60 pictures a second, and a guard."""

TELL_EVERY = 20
"""Pictures between two reports of progress."""


@dataclass(frozen=True, eq=False)
class VideoTrack:
    """A track, and what was wrong on the way.

    Args:
        track: with its gaps filled and marked.
        unseen: (n, feet) no spot of the foot's colour was fit, though another foot is in the picture.
        false: (n, feet) a spot was found where the foot cannot have been.
        missing: (n,) there was no picture, or none of the feet is in it.
        remark: what is missing of the film, in a sentence; "" where nothing is.
    """

    track: FootTrack
    unseen: Bools
    false: Bools
    missing: Bools
    remark: str = ""


def open_frames(path: Path, tell: Callable[[], object] = lambda: None) -> FrameSource:
    """Opens a recording's folder or a video file.

    Args:
        path: of either.
        tell: called again and again while a long file is looked through.

    Raises:
        InputError: it is neither.
    """
    return Recording(path) if path.is_dir() else VideoFile(path, tell)


def track_video(
    path: Path, setup: TrackingSetup, progress: Callable[[float], bool] = lambda share: True
) -> VideoTrack | None:
    """Follows the feet through a video file or a recording.

    Args:
        path: of the file, or the recording's folder.
        setup: lens, platform, colours.
        progress: told the share that is done, 0 to 1; false ends it.

    Returns:
        The track; None where it was ended.

    Raises:
        InputError: it is no video, of another size than the setup's, or a foot is never seen.
    """
    frames = open_frames(path)
    times: list[float] = []
    pixels: list[Floats] = []
    try:
        setup.require_size(frames.facts.size)
        for time, frame in frames.pictures():
            times.append(time)
            pixels.append(find_feet(frame, setup.colours, setup.limits))
            done = min(1.0, len(pixels) / max(frames.facts.count, 1))
            if len(pixels) % TELL_EVERY == 0 and not progress(done):
                return None
    finally:
        frames.close()
    found = track_of_pixels(np.array(times), np.array(pixels), setup, path.name)
    return replace(found, remark=frames.facts.remark)


def track_of_pixels(times: Floats, pixels: Floats, setup: TrackingSetup, name: str) -> VideoTrack:
    """A track out of where each foot was found in each picture.

    Where pictures are missing, frames are put in that saw no foot, so that the time without pictures is a gap
    like any other.

    Args:
        times: (n,) of the pictures, s, increasing.
        pixels: (n, feet, 2) px, nan where a foot was not found.
        setup: lens and platform.
        name: of the video, for messages.

    Raises:
        InputError: there are fewer than two pictures, or a foot is never seen.
    """
    if len(times) < 2:
        raise InputError(f"{name} holds {len(times)} pictures; a track needs at least two.", name)
    every, ask = _with_missing(times, pixels, name)
    feet = setup.places(ask)
    unseen = np.asarray(np.isnan(feet).any(axis=2))
    missing = np.asarray(unseen.all(axis=1))
    false = find_outliers(every, feet)
    feet[false] = math.nan
    return VideoTrack(filled_track(every, feet, name), unseen & ~missing[:, None], false, missing)


def missing_remarks(found: VideoTrack) -> tuple[str, ...]:
    """Sentences about what is missing of a film and how many of its pictures are; nothing where none is."""
    remarks = (found.remark,) if found.remark else ()
    count = int(found.missing.sum())
    if not count:
        return remarks
    what = "1 picture is" if count == 1 else f"{count} pictures are"
    filled = "the feet are filled by straight lines there and marked."
    return (*remarks, f"{what} missing or without any foot; {filled}")


def _usual_about(gaps: Floats) -> Floats:
    """The usual interval about each one, since a camera may slow down for a while: (n - 1,) s of the same."""
    around = np.pad(gaps, ABOUT // 2, mode="median")
    return np.asarray(np.median(sliding_window_view(around, ABOUT), axis=1))


def _with_missing(times: Floats, pixels: Floats, name: str) -> tuple[Floats, Floats]:
    gaps = np.diff(times)
    usual = _usual_about(gaps)
    missing = np.where(gaps > MISSED * usual, np.rint(gaps / usual) - 1, 0)
    if (frames := len(times) + missing.sum()) > MOST_FRAMES:
        raise InputError(
            f"By its pictures' times {name} lasts {np.ptp(times) / 3600:.1f} h, {frames:.0f} frames; at "
            f"most {MOST_FRAMES} are tracked. Save it again with a constant frame rate, or cut it.",
            name,
        )
    missing = missing.astype(np.int64)
    places = np.concatenate([[0], np.cumsum(1 + missing)])
    every = np.interp(np.arange(places[-1] + 1), places, times)
    ask = np.full((len(every), *pixels.shape[1:]), math.nan)
    ask[places] = pixels
    return every, ask
