"""What the vision processes do with pictures, so that neither event loop nor bridge waits for it."""

import base64
from collections import OrderedDict
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from app.common.json import Json
from app.vision.blobs import Blob, Mask, blobs_of, find_feet, in_colours, mask_of, shown_mask
from app.vision.checkerboard import board_corners, lens_of_corners, straightened
from app.vision.frame_source import Facts, FrameSource
from app.vision.tracking import VideoTrack, open_frames, track_video
from app.vision.video_io import Picture, jpeg, read_picture, scaled, silence_libraries, use_one_thread
from core.arrays import Floats
from core.errors import InputError
from core.vision.camera import BlobLimits, ColourRange, Lens
from core.vision.image_header import picture_size, require_readable
from core.vision.setup import TrackingSetup
from solver_jobs import Report, run_tasks

MOST_OPEN = 3
"""Videos that are kept open to be looked at."""


class FrameSourceCache:
    """The videos that were looked at last, open, each with its last picture."""

    def __init__(self) -> None:
        self._open: OrderedDict[Path, FrameSource] = OrderedDict()
        self._last: tuple[Path, int, Picture] | None = None

    def frames(self, path: Path) -> FrameSource:
        """A video, opened where it is not."""
        if path not in self._open:
            self._open[path] = open_frames(path)
            if len(self._open) > MOST_OPEN:
                self._open.popitem(last=False)[1].close()
        self._open.move_to_end(path)
        return self._open[path]

    def picture(self, path: Path, number: int) -> Picture:
        """One picture of a video."""
        if self._last is None or self._last[:2] != (path, number):
            self._last = (path, number, self.frames(path).picture(number))
        return self._last[2]


class VisionRequest(Protocol):
    """Something to do with pictures."""

    def answer(self, repository: FrameSourceCache, report: Report) -> Any:
        """Does it."""


@dataclass(frozen=True)
class ReadFacts:
    """Facts of a video that holds two pictures at least."""

    path: Path

    def answer(self, repository: FrameSourceCache, report: Report) -> Facts:
        """Reads them."""
        del repository
        frames = open_frames(self.path, lambda: report(0.0))
        try:
            if frames.facts.count < 2:
                raise InputError(f"{self.path.name} holds one picture; a track needs at least two.", "file")
            frames.picture(0)
            return frames.facts
        finally:
            frames.close()


@dataclass(frozen=True)
class ReadTimes:
    """Facts of a video, and (n,) the time of each picture after the first, s."""

    path: Path

    def answer(self, repository: FrameSourceCache, report: Report) -> tuple[Facts, Floats]:
        """Reads them."""
        del report
        frames = repository.frames(self.path)
        return frames.facts, frames.times


@dataclass(frozen=True)
class Source:
    """A picture: of a video, or given as a file.

    Args:
        path: of the video; None where the picture is given.
        number: of the picture in it.
        file: the picture.
        name: of the file, for messages.
    """

    path: Path | None = None
    number: int = 0
    file: bytes = b""
    name: str = "picture"

    def picture(self, repository: FrameSourceCache) -> Picture:
        """The picture.

        Raises:
            InputError: it is none, or too large.
        """
        if self.path is None:
            size = picture_size(self.file, self.name)
            require_readable(size.width, size.height, self.name)
            return read_picture(self.file, self.name)
        return repository.picture(self.path, self.number)


@dataclass(frozen=True)
class ReadPicture:
    """A picture as a JPEG file, no wider than so many pixels."""

    source: Source
    most: int | None

    def answer(self, repository: FrameSourceCache, report: Report) -> bytes:
        """Writes it."""
        del report
        return jpeg(scaled(self.source.picture(repository), self.most))


@dataclass(frozen=True)
class PhotoFiles:
    """A photo and its thumbnail as JPEG files.

    Args:
        size: width and height of the photo, px.
        file: the photo.
        small: the thumbnail.
    """

    size: tuple[int, int]
    file: bytes
    small: bytes


@dataclass(frozen=True)
class MakePhoto:
    """A picture and its thumbnail, each no wider than so many pixels and nothing but the picture."""

    source: Source
    most: int
    most_small: int

    def answer(self, repository: FrameSourceCache, report: Report) -> PhotoFiles:
        """Writes them."""
        del report
        picture = scaled(self.source.picture(repository), self.most)
        size = (picture.shape[1], picture.shape[0])
        return PhotoFiles(size, jpeg(picture), jpeg(scaled(picture, self.most_small)))


@dataclass(frozen=True, eq=False)
class DetectBlobs:
    """A picture with what tracking would find in it.

    Args:
        source: of the picture.
        foot: whose colour is looked at, 0-based; None for no foot's.
        colours: of all feet.
        limits: which spots may be a foot.
        setup: for places on the platform; None where it is not known yet.
        shows_mask: whether only what has the foot's colour is shown in colour.
        most: width of the picture that is shown, px; None shows none.
    """

    source: Source
    foot: int | None
    colours: tuple[ColourRange, ...]
    limits: BlobLimits
    setup: TrackingSetup | None
    shows_mask: bool
    most: int | None

    def answer(self, repository: FrameSourceCache, report: Report) -> Json:
        """Looks."""
        del report
        picture = self.source.picture(repository)
        height, width = picture.shape[:2]
        if self.setup is not None:
            self.setup.require_size((width, height))
        feet = _feet(find_feet(picture, self.colours, self.limits), self.setup)
        whole = {"size": [width, height], "feet": feet}
        if self.foot is None:
            return {**whole, "picture": self._shown(picture), "spots": [], "more": 0, "chosen": None}
        mask = mask_of(in_colours(picture), self.colours[self.foot])
        blobs, more = blobs_of(mask, self.limits)
        fit = [index for index, blob in enumerate(blobs) if blob.refusal is None]
        masked = (mask, blobs) if self.shows_mask else None
        return {
            **whole,
            "picture": self._shown(picture, masked),
            "spots": [{**_blob(asdict(blob)), "fit": blob.refusal is None} for blob in blobs],
            "more": more,
            "chosen": fit[0] if fit else None,
        }

    def _shown(self, picture: Picture, masked: tuple[Mask, tuple[Blob, ...]] | None = None) -> str:
        if self.most is None:
            return ""
        small = scaled(picture, self.most) if masked is None else shown_mask(picture, *masked, self.most)
        return data_url(jpeg(small))


def _blob(values: Json) -> Json:
    return {
        "reason": values.pop("refusal"),
        **values,
        "pixel": [round(value, 2) for value in values["pixel"]],
    }


def _feet(pixels: Floats, setup: TrackingSetup | None) -> list[Json | None]:
    places = np.full(pixels.shape, np.nan) if setup is None else setup.places(pixels) * 100.0
    return [
        None
        if np.isnan(pixel).any()
        else {
            "pixel": np.round(pixel, 2).tolist(),
            "place_cm": None if np.isnan(place).any() else np.round(place, 3).tolist(),
        }
        for pixel, place in zip(pixels, places, strict=True)
    ]


def data_url(file: bytes) -> str:
    """A JPEG file as an address that holds it."""
    return "data:image/jpeg;base64," + base64.b64encode(file).decode()


@dataclass(frozen=True)
class FindCheckerboard:
    """Where a checkerboard's inner corners are in a picture."""

    source: Source
    corners: tuple[int, int]

    def answer(self, repository: FrameSourceCache, report: Report) -> Json:
        """Looks for them."""
        del report
        picture = self.source.picture(repository)
        found = board_corners(picture, self.corners)
        height, width = picture.shape[:2]
        return {
            "name": self.source.name,
            "frame": None if self.source.path is None else self.source.number,
            "size": [width, height],
            "found": found is not None,
            "points": [] if found is None else np.round(found.reshape(-1, 2).astype(float), 3).tolist(),
        }


@dataclass(frozen=True, eq=False)
class FitLens:
    """A lens out of boards that were found.

    Args:
        boards: (corners, 2) px, one for each picture.
        size: of the pictures, px.
        corners: inner corners along the board's two sides.
    """

    boards: Sequence[Floats]
    size: tuple[int, int]
    corners: tuple[int, int]

    def answer(self, repository: FrameSourceCache, report: Report) -> Json:
        """Computes it."""
        del repository, report
        boards = [np.asarray(board, dtype=np.float32).reshape(-1, 1, 2) for board in self.boards]
        found = lens_of_corners(boards, self.size, self.corners)
        return {
            "matrix": found.lens.matrix.tolist(),
            "distortion": found.lens.distortion.tolist(),
            "rms_px": found.unexplained,
            "each": list(found.each),
        }


@dataclass(frozen=True, eq=False)
class Straighten:
    """A picture as a lens without distortion would have it, as a JPEG file."""

    source: Source
    lens: Lens

    def answer(self, repository: FrameSourceCache, report: Report) -> bytes:
        """Bends it."""
        del report
        return jpeg(straightened(self.source.picture(repository), self.lens))


@dataclass(frozen=True, eq=False)
class TrackFeet:
    """The feet's track in a video; None where it was ended."""

    path: Path
    setup: TrackingSetup

    def answer(self, repository: FrameSourceCache, report: Report) -> VideoTrack | None:
        """Follows the feet."""
        del repository
        return track_video(self.path, self.setup, report)


def run_picture_worker(pipe: Connection, warm_up: None) -> None:
    """Body of the process.

    Args:
        pipe: the worker's end.
        warm_up: nothing.
    """
    del warm_up
    use_one_thread()
    silence_libraries()
    repository = FrameSourceCache()

    def work(task: VisionRequest, report: Report) -> Any:
        return task.answer(repository, report)

    run_tasks(pipe, work)
