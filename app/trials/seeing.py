"""Everything that sees the robot: setups, videos, tracking."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from app.job_book import JobBook
from app.store.database import Database
from app.trials.desk import TrialDesk
from app.trials.eyes import open_eyes
from app.trials.setup_desk import SetupDesk
from app.trials.track_desk import TrackDesk
from app.trials.video_desk import VideoDesk

Content = dict[str, Any]


class Seeing:
    """Setups, videos and their tracking.

    Args:
        data: the data folder.
        database: where is kept what is known of them.
        book: the list of jobs.
        trials: where tracks go.
        later: does something on the session's thread.
        show_job: told of a job that changed, on the session's thread.
        publish: tells every page.

    Attributes:
        eyes: the processes that look at pictures.
        setups: how cameras see the platform.
        videos: uploads and recordings.
        tracks: videos that are tracked; for the session's thread.
    """

    def __init__(
        self,
        data: Path,
        database: Database,
        book: JobBook,
        trials: TrialDesk,
        later: Callable[[Callable[[], object]], None],
        show_job: Callable[[Content], object],
        publish: Callable[[Content], None],
    ) -> None:
        self._publish, self._show_job = publish, show_job
        self.eyes = open_eyes()
        self.setups = SetupDesk(database, self._tell_setups)
        self.videos = VideoDesk(
            data, database, self.eyes, lambda view: publish({"type": "video", "video": view})
        )
        self.videos.end_abandoned()
        self.tracks = TrackDesk(self.eyes, book, self.videos, self.setups, trials, later, self._show_tracking)

    def close(self) -> None:
        """Ends the processes."""
        self.eyes.close()

    def tell_trial(self, trial: str) -> None:
        """Tells every page of a new trial."""
        self._publish({"type": "trials", "trial": trial})

    def _tell_setups(self) -> None:
        self._publish({"type": "setups", "setups": self.setups.views()})

    def _show_tracking(self, job: Content) -> None:
        if job["state"] == "done":
            self.tell_trial(job["result"]["trial"])
        self._show_job(job)
