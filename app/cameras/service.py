"""Cameras of the computer that the studio runs on: which there are, what each is for, live pictures."""

import threading
from collections.abc import Callable, Sequence
from pathlib import Path

from app.cameras.address import DEVICE, CameraAddress
from app.cameras.process import CameraProcess
from app.cameras.setup_service import CameraSetupService
from app.common.json import Json
from app.store.database import Database
from app.store.tables.camera_setup_store import CameraSetupStore
from core.errors import InputError, NotFoundError

DEVICES = Path("/sys/class/video4linux")
"""Where Linux lists cameras."""

PICTURE_SECONDS = 15.0
"""Longest wait for a picture; a camera takes seconds to start."""

UNDER, SIDE = "under", "side"
"""What a camera is for: tracking from under the platform, or looking only."""


class CameraService:
    """The cameras; every method may be called from any thread.

    Args:
        database: where is kept what each is for.
        setups: how cameras see the platform.
        files: video files that are played as cameras.
        changed: called when the list is another.

    Attributes:
        tell: tells that the list is another.
    """

    def __init__(
        self,
        database: Database,
        setups: CameraSetupService,
        files: Sequence[CameraAddress] = (),
        changed: Callable[[], None] = lambda: None,
    ) -> None:
        self._store = CameraSetupStore(database)
        self._setups = setups
        self._files = {one.id: one for one in files}
        self.tell = changed
        self._lock = threading.Lock()
        self._links: dict[str, CameraProcess] = {}
        self._is_closed = False

    def stand_by(self) -> None:
        """Starts the cameras that record with the run, so that they see its first move."""
        for camera, kept in self._store.cameras().items():
            if kept["records"] and camera in self._addresses():
                self._live(camera)

    def views(self) -> list[Json]:
        """All cameras, and those of the computer that record with the run though they are unplugged."""
        kept, addresses = self._store.cameras(), self._addresses()
        gone = {
            camera: CameraAddress(camera, one["name"], f"/dev/{camera}", False)
            for camera, one in kept.items()
            if one["records"] and camera not in addresses and DEVICE.fullmatch(camera)
        }
        everything = {**addresses, **gone}
        return [self._view(everything[camera], kept.get(camera), camera in gone) for camera in everything]

    def view(self, camera: str) -> Json:
        """One camera."""
        found = next((view for view in self.views() if view["id"] == camera), None)
        if found is None:
            raise self._unknown(camera)
        return found

    def change(self, camera: str, changes: Json) -> Json:
        """Changes what a camera is for.

        Raises:
            NotFoundError: there is none.
            InputError: it is to track and record without a complete setup.
        """
        view = self.view(camera)
        settings = {key: view[key] for key in ("name", "use", "setup", "records")} | changes
        if settings["setup"]:
            self._setups.view(settings["setup"])
        if settings["records"] and settings["use"] == UNDER:
            if not settings["setup"]:
                raise InputError(
                    f"“{view['name']}” is set to find the feet but has no setup. Choose one, or use "
                    "it from the "
                    "side.",
                    "setup",
                )
            self._setups.complete(settings["setup"])
        self._store.put_camera(camera, settings)
        link = self._links.get(camera)
        if settings["records"] and camera in self._addresses():
            self._live(camera)
        elif link is not None:
            link.is_kept = False
        self.tell()
        return self.view(camera)

    def picture(self, camera: str, most: int | None = None) -> bytes:
        """The next picture as a JPEG file.

        Raises:
            NotFoundError: there is none.
            CameraError: it is unplugged.
        """
        return self._live(camera).picture(most, PICTURE_SECONDS)

    def recording(self) -> list[Json]:
        """The cameras that are to record with the run, also unplugged ones."""
        return [view for view in self.views() if view["records"]]

    def link(self, camera: str) -> CameraProcess:
        """A camera's process, started where it does not go on.

        Raises:
            NotFoundError: it is unplugged.
        """
        return self._live(camera)

    def close(self) -> None:
        """Ends every camera's process."""
        with self._lock:
            self._is_closed = True
            links = tuple(self._links.values())
        for link in links:
            link.close()

    def _live(self, camera: str) -> CameraProcess:
        """A camera's process, started where it does not go on."""
        address = self._addresses().get(camera)
        if address is None:
            raise self._unknown(camera)
        records = bool(self._store.cameras().get(camera, {}).get("records"))
        with self._lock:
            link = self._links.get(camera)
            if link is None or not link.is_open:
                if self._is_closed:
                    raise InputError("The studio is closing.", "camera")
                link = self._links[camera] = CameraProcess(address, self.tell)
            link.is_kept = records
        return link

    def _addresses(self) -> dict[str, CameraAddress]:
        return {**self._files, **{one.id: one for one in devices()}}

    def _view(self, address: CameraAddress, kept: Json | None, is_gone: bool = False) -> Json:
        link = self._links.get(address.id)
        state, sentence, size, rate = _state(link)
        if is_gone:
            state, sentence = "unplugged", f"The camera “{address.name}” is unplugged. Plug it in again."
        settings = kept or {"use": UNDER, "setup": "", "records": False}
        return {
            "id": address.id,
            "name": address.name,
            "kind": "file" if address.is_file else "device",
            "state": state,
            "sentence": sentence,
            "size": size,
            "rate": rate,
            **{key: settings[key] for key in ("use", "setup", "records")},
            "recording": link is not None and link.is_open and link.is_recording,
        }

    def _unknown(self, camera: str) -> NotFoundError:
        return NotFoundError(f"There is no camera {camera}. Plug it in and look again.", "camera")


def _state(link: CameraProcess | None) -> tuple[str, str, list[int] | None, float | None]:
    if link is None or not link.is_open:
        return "idle", "", None, None
    standing = link.standing
    if standing is None:
        return "starting", "", None, None
    size = None if standing.size is None else list(standing.size)
    return "live" if standing.is_live else "unplugged", standing.sentence, size, standing.rate


def devices(folder: Path = DEVICES) -> list[CameraAddress]:
    """Cameras that are plugged in; of those with several entries the one that gives pictures."""
    found = []
    for entry in sorted(folder.glob("video*")):
        try:
            index = (entry / "index").read_text().strip()
            name = (entry / "name").read_text().strip()
        except OSError:
            continue
        if index == "0":
            found.append(CameraAddress(entry.name, name, f"/dev/{entry.name}", False))
    return found
