"""Photos of a trial: kept as JPEG files in the data folder, without what the camera wrote into them."""

import threading
import time
import uuid
from pathlib import Path
from typing import Any

from app.common.json import Json
from app.store.database import Database
from app.store.gait_files import PHOTOS, require_folder
from app.store.plain_file import read_plain_file, write_atomically
from app.store.tables.photo_store import PhotoStore
from app.trials.service import TrialService
from app.vision.services import VisionServices, ask
from app.vision.worker import MakePhoto, PhotoFiles, Source
from core.errors import FootfallError, InputError, NotFoundError

MOST_BYTES = 20_000_000
"""Bytes of a picture file as it comes."""
MOST_PHOTOS = 24
"""Photos of a trial."""
KEPT_WIDTH, SMALL_WIDTH = 1600, 240
"""Widest that a photo and its thumbnail are kept, px."""
LOOK_SECONDS = 60.0
"""Longest wait for a picture that is made smaller."""


class TrialPhotos:
    """The photos of trials; every method may be called from any thread.

    Args:
        service: the trials.
        database: where is kept what is known of photos.
        data: the data folder; pictures lie in its folder `trial-photos`.
        vision: what reads pictures.
    """

    def __init__(self, service: TrialService, database: Database, data: Path, vision: VisionServices) -> None:
        self._service = service
        self._store = PhotoStore(database)
        self._folder = data / PHOTOS
        self._vision = vision
        self._lock = threading.Lock()

    def photos(self, trial: str) -> list[Json]:
        """A trial's photos, in the order in which they came."""
        self._service.record(trial)
        return [row.content for row in self._store.of_trial(trial).rows]

    def unreadable(self, trial: str) -> list[Json]:
        """A trial's photos that cannot be read."""
        return self._store.of_trial(trial).unreadable

    def add(self, trial: str, content: bytes, name: str, by: str) -> Json:
        """Keeps a photo, no wider than `KEPT_WIDTH` and with nothing in it but the picture.

        Args:
            trial: its id.
            content: of a PNG or JPEG file.
            name: of the file.
            by: who adds it.

        Raises:
            InputError: it is no such picture, too large, or one too many.
            StateError: the trial is deleted.
        """
        self._service.require_listed(trial)
        check_bytes(len(content), name)
        task = MakePhoto(Source(file=content, name=name), KEPT_WIDTH, SMALL_WIDTH)
        made: PhotoFiles = ask(self._vision.interactive, task, LOOK_SECONDS)
        photo: Json = {
            "id": uuid.uuid4().hex[:12],
            "trial": trial,
            "made": time.time(),
            "by": by,
            "name": name,
            "caption": "",
            "width": made.size[0],
            "height": made.size[1],
        }
        with self._lock:
            if len(self._store.of_trial(trial).rows) >= MOST_PHOTOS:
                raise InputError(
                    f"This trial has {MOST_PHOTOS} photos, and no more are kept. Delete one.", name
                )
            require_folder(self._folder)
            paths = self._path(photo["id"]), self._path(photo["id"], is_small=True)
            try:
                write_atomically(paths[0], made.file)
                write_atomically(paths[1], made.small, lambda: self._store.add(photo))
            except FootfallError:
                for path in paths:
                    path.unlink(missing_ok=True)
                raise
        return photo

    def caption(self, trial: str, photo: str, caption: str) -> Json:
        """Keeps what a person says of a photo."""
        self._service.require_listed(trial)
        content = {**self._known(trial, photo), "caption": caption}
        self._store.change(content)
        return content

    def delete(self, trial: str, photo: str) -> None:
        """Takes a photo away; `restore` brings it back."""
        self._service.require_listed(trial)
        self._known(trial, photo)
        self._store.put_deleted(photo, time.time())

    def restore(self, trial: str, photo: str) -> Json:
        """Brings a deleted photo back."""
        self._service.require_listed(trial)
        content = self._known(trial, photo)
        self._store.put_deleted(photo, None)
        return content

    def picture(self, trial: str, photo: str, *, is_small: bool = False) -> bytes:
        """A photo as a JPEG file, or its thumbnail.

        Raises:
            NotFoundError: there is none, or its file is gone.
        """
        self._known(trial, photo)
        try:
            return read_plain_file(self._path(photo, is_small=is_small), MOST_BYTES)
        except FileNotFoundError as error:
            raise NotFoundError(f"The file of photo {photo} is gone.", "photo") from error

    def _known(self, trial: str, photo: str) -> dict[str, Any]:
        row = self._store.get(trial, photo)
        if row is None:
            raise NotFoundError(f"The trial {trial} has no photo {photo}.", "photo")
        return row.content

    def _path(self, photo: str, *, is_small: bool = False) -> Path:
        return self._folder / (f"{photo}-small.jpg" if is_small else f"{photo}.jpg")


def check_bytes(count: int, name: str) -> None:
    """Refuses a picture file that is too large, also before all of it is there.

    Raises:
        InputError: it is.
    """
    if count > MOST_BYTES:
        raise InputError(
            f"{name} has more than {MOST_BYTES // 1_000_000} MB. Make the picture smaller.", name
        )
