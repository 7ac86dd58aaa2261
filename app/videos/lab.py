"""The lab's cameras put together: setups, videos, tracking, cameras, recordings of runs."""

import threading
from collections.abc import Callable, Sequence
from pathlib import Path

from app.cameras.address import CameraAddress
from app.cameras.service import CameraService
from app.cameras.setup_service import CameraSetupService
from app.common.json import Json
from app.jobs.repository import JobRepository
from app.runs.service import RunService
from app.store.database import Database
from app.trials.service import TrialService
from app.videos.run_recording import RunRecordings
from app.videos.service import VideoService
from app.videos.tracking_service import TrackingService
from app.vision.services import open_vision_services


class Lab:
    """Setups, videos and their tracking.

    Args:
        data: the data folder.
        database: where is kept what is known of them.
        job_repository: the list of jobs.
        trials: where tracks go.
        runs: the records of runs.
        files: video files that are played as cameras.
        later: does something on the command queue's thread.
        show_job: told of a job that changed, on the command queue's thread.
        publish: tells every page.

    Attributes:
        vision: the processes that look at pictures.
        setups: how cameras see the platform.
        videos: uploads and recordings.
        tracks: videos that are tracked; for the command queue's thread.
        cameras: of this computer.
        recordings: of runs.
    """

    def __init__(
        self,
        data: Path,
        database: Database,
        job_repository: JobRepository,
        trials: TrialService,
        runs: RunService,
        files: Sequence[CameraAddress],
        later: Callable[[Callable[[], object]], None],
        show_job: Callable[[Json], object],
        publish: Callable[[Json], None],
    ) -> None:
        self._publish, self._show_job = publish, show_job
        self.vision = open_vision_services()
        self.setups = CameraSetupService(database, self._tell_setups)
        self.videos = VideoService(
            data, database, self.vision, lambda view: publish({"type": "video", "video": view})
        )
        self.videos.tidy()
        self.tracks = TrackingService(
            self.vision, job_repository, self.videos, self.setups, trials, runs, later, self._show_tracking
        )

        self._is_telling = threading.Lock()
        self.cameras = CameraService(database, self.setups, files, self._tell_cameras)
        self.cameras.stand_by()
        self.recordings = RunRecordings(
            database, self.cameras, self.setups, self.videos, runs, trials, self.tell_trial
        )

    def close(self) -> None:
        """Ends recordings and processes."""
        self.recordings.close()
        self.cameras.close()
        self.vision.close()

    def tell_trial(self, trial: str) -> None:
        """Tells every page of a new trial."""
        self._publish({"type": "trials", "trial": trial})

    def _tell_setups(self) -> None:
        self._publish({"type": "setups", "setups": self.setups.views()})

    def _tell_cameras(self) -> None:
        with self._is_telling:  # the last to tell is the last that looked
            self._publish({"type": "cameras", "cameras": self.cameras.views()})

    def _show_tracking(self, job: Json) -> None:
        if job["state"] == "done":
            self.tell_trial(job["result"]["trial"])
        self._show_job(job)
