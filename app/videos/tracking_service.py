"""Tracking videos as jobs in the list: asked for by video, done in a process of its own, then kept as trials.

Only the command queue's thread calls this.
"""

import uuid
from collections.abc import Callable
from dataclasses import dataclass

from app.cameras.setup_service import CameraSetupService
from app.common.json import Json
from app.jobs.job_tracker import JobTracker
from app.jobs.repository import JobRepository
from app.runs.service import RunService
from app.trials.planned import PlannedFeet
from app.trials.run_trial import run_trial
from app.trials.service import TrialDescription, TrialService
from app.trials.track_source import TrackRecord, TrackSource
from app.videos.service import VideoService
from app.vision.services import VisionServices, VisionTask
from app.vision.tracking import VideoTrack, missing_remarks
from app.vision.worker import TrackFeet
from core.errors import FootfallError

KIND = "track"
"""What pages and scripts call these jobs."""


@dataclass(frozen=True, eq=False)
class TrackingJob:
    """What is to be tracked.

    Args:
        video: id of the video.
        setup: id of the setup.
        words: what a person says of the trial.
        planned: where the feet were to be; None where that is not known.
    """

    video: str
    setup: str
    words: TrialDescription
    planned: PlannedFeet | None


class TrackingService:
    """Videos that are tracked.

    Args:
        vision: what looks at pictures.
        job_repository: the list of jobs.
        videos: which videos there are.
        setups: which setups there are.
        trials: where tracks go.
        runs: the records of runs.
        later: does something on the command queue's thread.
        shown: told of a job that changed, on the command queue's thread.
    """

    def __init__(
        self,
        vision: VisionServices,
        job_repository: JobRepository,
        videos: VideoService,
        setups: CameraSetupService,
        trials: TrialService,
        runs: RunService,
        later: Callable[[Callable[[], None]], object],
        shown: Callable[[Json], object],
    ) -> None:
        self._vision, self._job_repository = vision, job_repository
        self._videos, self._setups, self._trials, self._runs = videos, setups, trials, runs
        self._running = JobTracker(job_repository, later, shown, "Follows the feet.")

    def submit(self, order: TrackingJob) -> Json:
        """Starts tracking.

        Raises:
            NotFoundError: there is no such video.
            InputError: the setup is not complete, or for pictures of another size.
            StateError: the video's file is gone.
        """
        video, path = self._videos.view(order.video), self._videos.path(order.video)
        setup, revision = self._setups.complete(order.setup)
        tracking = setup.tracking()
        tracking.require_size((video["size"][0], video["size"][1]))
        source = TrackSource(order.video, video["camera"], order.setup, setup.name, revision)
        job_id = uuid.uuid4().hex[:12]
        words = order.words
        seen = {"video": order.video, "video_name": video["name"], "share": 0.0}
        job = self._job_repository.begin(
            job_id, KIND, words.gait, words.gait_name or video["name"], "", **seen
        )
        look = VisionTask(
            TrackFeet(path, tracking),
            self._running.teller(job_id),
            lambda found: self._tracked(job_id, order, source, found),
            lambda error: self._running.end(job_id, {"state": "failed", "sentence": error.sentence}),
        )
        self._running.begin(job_id, look)
        self._vision.tracker.ask(look)
        return job

    def cancel(self, job_id: str) -> Json:
        """Asks a job to end; one that ended already stays as it is."""
        return self._running.cancel(job_id)

    def _tracked(
        self, job_id: str, order: TrackingJob, source: TrackSource, found: VideoTrack | None
    ) -> None:
        """Keeps a track as a trial; on the tracker's thread."""
        if found is None:
            self._running.end(job_id, {"state": "cancelled", "sentence": "Cancelled."})
            return
        try:
            trial = self._kept(order, source, found)
        except FootfallError as error:
            self._running.end(job_id, {"state": "failed", "sentence": error.sentence})
            return
        result = track_figures(trial["id"], found)
        self._running.end(
            job_id, {"state": "done", "sentence": track_sentence(found), "share": 1.0, "result": result}
        )

    def _kept(self, order: TrackingJob, source: TrackSource, found: VideoTrack) -> Json:
        """The trial; that of a recorded run counts from the run's first waypoint, as the run's log tells."""
        words, video = order.words, self._videos.view(order.video)
        if video["kind"] != "recording" or words.run != video["run"]:
            track_record = TrackRecord(found, source, missing_remarks(found))
            return self._trials.add(found.track, words, order.planned, track_record)
        made = run_trial(self._runs.record(words.run), found)
        track_record = TrackRecord(
            made.found, source, (*missing_remarks(made.found), *made.remarks), made.ends
        )
        return self._trials.add(made.found.track, words, made.planned, track_record)


def track_figures(trial: str, found: VideoTrack) -> Json:
    """What a track amounts to, for the list of jobs."""
    return {
        "trial": trial,
        "frames": int(found.track.times.size),
        "seconds": float(found.track.times[-1] - found.track.times[0]),
        "missing": int(found.missing.sum()),
        "unseen": int(found.unseen.sum()),
        "false": int(found.false.sum()),
    }


def track_sentence(found: VideoTrack) -> str:
    """A track in one sentence."""
    frames, rate = found.track.times.size, found.track.frame_rate
    return (
        f"{frames} frames at {rate:.1f} a second; {int(found.unseen.sum())} foot positions were "
        f"not seen and {int(found.false.sum())} were false, all filled by straight lines and marked."
        + "".join(f" {remark}" for remark in missing_remarks(found))
    )
