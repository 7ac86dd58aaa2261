"""Videos for the page and scripts: uploads and recordings, their facts and pictures."""

import threading
import time
import uuid
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from app.common.json import Json
from app.store.database import Database
from app.store.tables.video_store import VideoStore
from app.videos.files import MOST_RECORDED, Upload, VideoFiles
from app.vision.frame_source import PICTURES, Facts
from app.vision.services import VisionServices, VisionTask, ask
from app.vision.worker import ReadFacts, ReadPicture, ReadTimes, Source
from core.arrays import Floats
from core.errors import FootfallError, InputError, NotFoundError, StateError

LOOK_SECONDS = 30.0
"""Longest wait for a picture."""

FACTS_SECONDS = 600.0
"""Longest wait for a video's facts; of a damaged one every picture is looked at."""

MOST_DELETED = 30 * 86_400.0
"""A deleted video can be restored for so long, s of the folder's time (see `FolderTime`)."""


class VideoService:
    """Videos in the data folder; every method may be called from any thread.

    Args:
        data: the data folder.
        database: where is kept what is known of them.
        vision: what reads pictures.
        changed: told of a video that is new or another.
    """

    def __init__(
        self,
        data: Path,
        database: Database,
        vision: VisionServices,
        changed: Callable[[Json], None] = lambda view: None,
    ) -> None:
        self.files = VideoFiles(data)
        self._database, self._store = database, VideoStore(database)
        self._vision = vision
        self._changed = changed
        self._lock = threading.Lock()

    def views(self, run: str = "", *, is_deleted: bool = False) -> list[Json]:
        """Videos, the newest first, of one run or all."""
        trials = self._store.trials()
        found = self._store.listed(run, is_deleted=is_deleted).rows
        return [_view(row.view, trials.get(row.id, [])) for row in found]

    def unreadable(self, run: str = "", *, is_deleted: bool = False) -> list[Json]:
        """Videos that cannot be read; their files stay."""
        return self._store.listed(run, is_deleted=is_deleted).unreadable

    def view(self, video: str) -> Json:
        """One video."""
        return _view(self._known(video), self._store.trials(video).get(video, []))

    def begin(self, name: str, size: int | None) -> Upload:
        """Starts an upload; `keep` or `Upload.discard` ends it.

        Raises:
            InputError: it is too large.
            StateError: there is no room for it.
        """
        return self.files.begin(uuid.uuid4().hex[:12], name, size)

    def keep(self, upload: Upload) -> Json:
        """Keeps an upload that has come whole; a file that is kept already is not kept twice.

        Returns:
            The video; `again` says that it was there before.

        Raises:
            InputError: it is no video; nothing is left of it.
            sqlite3.Error: the database refuses it; nothing is left of it.
        """
        try:
            upload.finish()
            facts = self._facts(upload.partial, upload.name)
        except FootfallError:
            upload.discard()
            raise
        file = upload.partial.name.removeprefix(".").removesuffix(".partial")
        with self._lock:
            twin = self._twin(upload.content_hash)
            if twin is not None:
                upload.discard()
                return {**self.view(twin), "again": True}
            upload.partial.replace(self.files.path(file))
            content = {
                **_new(file.partition(".")[0], upload.name, "upload", file),
                **facts_content(facts),
                "sentence": facts.remark,
                "bytes": upload.size,
                "hash": upload.content_hash,
            }
            try:
                self._store.put(content)
            except Exception:
                self.files.remove(file)
                raise
            return {**self._tell(content["id"]), "again": False}

    def _twin(self, content_hash: str) -> str | None:
        """The kept video of the same content; None where there is none."""
        return next(
            (
                row.id
                for row in self._store.listed().rows
                if row.content.get("hash") == content_hash and self.files.path(row.content["file"]).exists()
            ),
            None,
        )

    def _facts(self, path: Path, name: str) -> Facts:
        try:
            facts: Facts = ask(self._vision.checkerboards, ReadFacts(path), FACTS_SECONDS)
        except InputError as refusal:
            raise InputError(refusal.sentence.replace(path.name, name), "file") from None
        return facts

    def begin_recording(self, name: str, run: str, camera: str) -> Json:
        """Keeps a recording that begins; its folder is made by whoever writes it."""
        video = uuid.uuid4().hex[:12]
        content = {
            **_new(video, name, "recording", video),
            "run": run,
            "camera": camera,
            "state": "recording",
        }
        return self.put(content)

    def put(self, content: Json) -> Json:
        """Keeps what is known of a video now, and tells of it."""
        self._store.put(content)
        return self._tell(content["id"])

    def _tell(self, video: str) -> Json:
        view = self.view(video)
        self._changed(view)
        return view

    def change(self, video: str, **changes: Any) -> Json:
        """Changes what is known of a video."""
        with self._lock:
            return self.put({**self._known(video), **changes})

    def tidy(self) -> None:
        """Says of recordings that a killed program left what became of them; old deleted videos go."""
        for row in self._store.listed().rows:
            if row.content["state"] == "recording":
                self.salvage(row.id, "The studio ended while this was recorded.")
        now = self._database.folder_time.now
        for row in self._store.listed(is_deleted=True).rows:
            is_old = row.deleted is not None and now - row.deleted > MOST_DELETED
            if is_old and row.content["state"] == "kept":
                self.files.remove(row.content["file"])
                self.change(row.id, state="removed", sentence="It was deleted more than 30 days ago.")

    def salvage(self, video: str, sentence: str) -> None:
        """Keeps what there is of a recording that was broken off; its facts follow once they are read.

        Args:
            video: its id.
            sentence: why it was broken off.
        """
        path = self.files.path(self._known(video)["file"])

        def done(facts: Facts) -> None:
            kept = f"{sentence} What was recorded until then is kept, and can be tracked."
            size = (path / PICTURES).stat().st_size
            self.change(video, state="kept", sentence=kept, bytes=size, **facts_content(facts))

        def failed(error: FootfallError) -> None:
            self.change(video, state="removed", sentence=f"{sentence} {error.sentence}")

        self._vision.checkerboards.ask(VisionTask(ReadFacts(path), done=done, failed=failed))

    def make_room(self) -> None:
        """Takes the oldest recordings' pictures away where all together are too many; trials stay."""
        total = 0
        rows = (*self._store.listed().rows, *self._store.listed(is_deleted=True).rows)
        for content in (row.content for row in rows):
            if content["kind"] != "recording" or content["state"] != "kept":
                continue
            total += content["bytes"]
            if total > MOST_RECORDED:
                self.files.remove(content["file"])
                sentence = (
                    f"Its pictures made room for newer ones (recordings keep {MOST_RECORDED / 1e9:g} GB)."
                )
                self.change(content["id"], state="removed", sentence=sentence)

    def delete(self, video: str) -> None:
        """Takes a video out of the list; `restore` brings it back."""
        if self._known(video)["state"] == "recording":
            raise _still_recorded()
        self._store.put_deleted(video, self._database.folder_time.now)
        self._changed(self.view(video))

    def restore(self, video: str) -> Json:
        """Brings a deleted video back."""
        self._known(video)
        self._store.put_deleted(video, None)
        return self._tell(video)

    def path(self, video: str) -> Path:
        """Where a video's pictures are.

        Raises:
            StateError: they were taken away, or are not all there yet.
        """
        content = self._known(video)
        if content["state"] == "recording":
            raise _still_recorded()
        path = self.files.path(content["file"])
        if content["state"] == "removed" or not path.exists():
            raise StateError(content["sentence"] or "The video's file is not on the disk any more.", "video")
        return path

    def source(self, video: str, frame: int | None, seconds: float | None = None) -> Source:
        """A picture of a video, by number or by time.

        Raises:
            InputError: the video ends before it.
        """
        path, number = self.path(video), frame or 0
        if seconds is not None:
            number = self._number_at(video, seconds)
        content = self._known(video)
        if content["frames"] and not 0 <= number < content["frames"]:
            raise InputError(
                f"“{content['name']}” has {content['frames']} pictures, 0 to {content['frames'] - 1}; there "
                f"is no picture {number}.",
                "frame",
            )
        return Source(path, number, name=f"picture {number}")

    def times(self, video: str) -> Floats:
        """(n,) time of each picture after the first, s.

        Facts by an earlier version, which counted the pictures that a file claims, are put right.
        """
        facts: Facts
        times: Floats
        facts, times = ask(self._vision.interactive, ReadTimes(self.path(video)), LOOK_SECONDS)
        if facts.count != self._known(video)["frames"]:
            self.change(video, **facts_content(facts))
        return times

    def _number_at(self, video: str, seconds: float) -> int:
        """The picture nearest to a time.

        Raises:
            InputError: the film is over by then.
        """
        times, content = self.times(video), self._known(video)
        if seconds > times[-1] + 1.0 / max(content["rate"], 1.0):
            raise InputError(
                f"“{content['name']}” lasts {times[-1]:.2f} s; there is no picture at {seconds:.2f} s.",
                "seconds",
            )
        return int(np.abs(times - seconds).argmin())

    def picture(self, source: Source, most: int | None) -> bytes:
        """A picture as a JPEG file, no wider than so many pixels."""
        file: bytes = ask(self._vision.interactive, ReadPicture(source, most), LOOK_SECONDS)
        return file

    def _known(self, video: str) -> Json:
        row = self._store.get(video)
        if row is None:
            raise NotFoundError(f"There is no video {video}.", "video")
        return row.view


def _still_recorded() -> StateError:
    return StateError("This video is being recorded. Wait for the end of its run.", "video")


def _new(video: str, name: str, kind: str, file: str) -> Json:
    return {
        "id": video,
        "name": name,
        "kind": kind,
        "made": time.time(),
        "file": file,
        "bytes": 0,
        "frames": 0,
        "rate": 0.0,
        "size": [0, 0],
        "seconds": 0.0,
        "run": "",
        "camera": "",
        "trial": "",
        "state": "kept",
        "sentence": "",
    }


def facts_content(facts: Facts) -> Json:
    """Facts as content."""
    return {
        "frames": facts.count,
        "rate": facts.rate,
        "size": list(facts.size),
        "seconds": facts.seconds,
    }


def _view(content: Json, trials: list[dict[str, str]]) -> Json:
    shown = {key: value for key, value in content.items() if key not in ("file", "hash")}
    return {**shown, "trials": trials}
