"""Foot tracks out of videos for the command line, with progress on standard error."""

import sys
from pathlib import Path

from app.cameras.setup_schema import parse_setup
from app.cli.common.output import note
from app.export.trajectory_files import read_text
from app.videos.tracking_service import track_sentence
from app.vision.tracking import track_video
from core.errors import InputError
from core.vision.setup import TrackingSetup
from core.vision.track import FootTrack


def read_setup(path: Path) -> TrackingSetup:
    """A setup's file, complete enough to track with.

    Raises:
        InputError: it is no setup, or something is missing.
    """
    return parse_setup(read_text(path), str(path)).setup().tracking()


def tracked(path: Path, setup: TrackingSetup) -> FootTrack:
    """The feet's track in a video; says how far it is and what was not seen.

    Raises:
        InputError: it is no video, of another size than the setup's, or a foot is never seen.
    """
    if not path.exists():
        raise InputError(f"There is no file {path}.", str(path))
    is_shown = sys.stderr.isatty()

    def progress(share: float) -> bool:
        if is_shown:
            sys.stderr.write(f"\r{path}: {share:4.0%} tracked")
            sys.stderr.flush()
        return True

    found = track_video(path, setup, progress)
    if is_shown:
        sys.stderr.write("\r\033[K")
    if found is None:
        raise InputError(f"{path} was not tracked to its end.", str(path))
    note(f"{path}: {track_sentence(found)}")
    return found.track
