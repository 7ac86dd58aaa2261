"""The source of a trial's track that a camera saw: which camera, when, and what was not seen."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.common.json import Json
from app.vision.tracking import VideoTrack
from core.arrays import Bools, stretches
from core.vision.track import FootTrack

FITTING = 0.015
"""Feet that stand farther from the plan's than this at the first frame are not those feet, m."""


ASTRAY_DEG = 15.0
"""A walk that went farther than this to a side of its plan is remarked on."""
LEAST_WAY_CM = 0.3
"""Feet that end nearer than this to where they began went in no direction."""


@dataclass(frozen=True)
class TrackSource:
    """Where a track was seen.

    Args:
        video: id of the video, or "".
        camera: name of the camera, or "".
        setup: id of the camera's setup, or "" where it came as a file.
        setup_name: its name.
        setup_revision: its revision.
    """

    video: str
    camera: str
    setup: str
    setup_name: str
    setup_revision: int


@dataclass(frozen=True, eq=False)
class TrackRecord:
    """A track as it was seen, with the time of each frame.

    Args:
        found: the track and what was wrong.
        source: from where; None where the track came as a file.
        remarks: sentences about what is missing.
        run_ends: last frame of each iteration by the run's own log; None where it does not tell.
    """

    found: VideoTrack
    source: TrackSource | None
    remarks: tuple[str, ...] = ()
    run_ends: tuple[int, ...] | None = None

    def content(self) -> Json:
        """As it is kept."""
        return {
            "source": None if self.source is None else vars(self.source),
            "times": self.found.track.times.tolist(),
            "unseen": marks(self.found.unseen),
            "false": marks(self.found.false),
            "remarks": list(self.remarks),
            "run_ends": None if self.run_ends is None else list(self.run_ends),
        }


def filed_record(track: FootTrack) -> TrackRecord:
    """What is kept of a track that came as a file with frame times."""
    nothing = np.zeros(track.filled.shape, dtype=np.bool_)
    return TrackRecord(VideoTrack(track, nothing, nothing, nothing[:, 0]), None)


def marks(marked: Bools) -> list[dict[str, int]]:
    """Marked stretches as feet from 1 with first and last frame."""
    return [
        {"foot": foot + 1, "first": int(first), "last": int(last)}
        for foot in range(marked.shape[1])
        for first, last in stretches(marked[:, foot])
    ]


def fit_content(gaps_cm: list[float]) -> Json:
    """Whether feet stand at the first frame as the plan's, and what to do where they do not.

    Args:
        gaps_cm: how far each foot is from the plan's.
    """
    worst = max(gaps_cm)
    fits = worst <= FITTING * 100.0
    sentence = (
        None
        if fits
        else f"At the first frame foot {gaps_cm.index(worst) + 1} stands {worst:.1f} cm from where the plan "
        "has it. Are the colours of two feet exchanged, is the picture mirrored, or is this another gait?"
    )
    return {"residual_cm": worst, "fits": fits, "fit_sentence": sentence}


def astray_content(tracked: Mapping[str, Any], planned: Mapping[str, Any]) -> Json:
    """How far to the left of the plan's direction a trial went, and a sentence where that is far.

    Args:
        tracked: figures of the trial (`app.trials.figures.feet_content`).
        planned: those of its plan, in the same frame.
    """
    if min(tracked["net_distance"], planned["net_distance"]) < LEAST_WAY_CM:
        return {"astray_deg": None, "astray_sentence": None}
    left = (tracked["net_angle_deg"] - planned["net_angle_deg"] + 180.0) % 360.0 - 180.0
    side = "left" if left > 0 else "right"
    sentence = (
        f"The robot went {abs(left):.0f}° to the {side} of the plan. Did a foot slip or the cable pull, or "
        "are these the tracks of another gait?"
    )
    return {"astray_deg": left, "astray_sentence": sentence if abs(left) > ASTRAY_DEG else None}
