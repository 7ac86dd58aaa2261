"""Foot tracks out of videos for the command line, with progress on standard error."""

from pathlib import Path

from app.cameras.setup_schema import parse_setup
from app.cli.common.output import note
from app.cli.common.progress import clear_line, rewrite_line
from app.export.trajectory_files import read_text
from app.videos.tracking_service import track_sentence
from app.vision.tracking import track_video
from app.vision.video_io import silence_libraries
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
    if path.is_dir():
        raise InputError(f"{path} is a folder; name a film in it.", str(path))

    def progress(share: float) -> bool:
        rewrite_line(f"{path}: {share:4.0%} tracked")
        return True

    end_silence = silence_libraries()
    try:
        found = track_video(path, setup, progress)
        clear_line()
    finally:
        end_silence()
    if found is None:
        raise InputError(f"{path} was not tracked to its end.", str(path))
    note(f"{path}: {track_sentence(found)}")
    return found.track
