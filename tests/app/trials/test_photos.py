"""Photos of trials: kept small and without place and time, refused with a sentence, deleted, brought back."""

from __future__ import annotations

import io
from pathlib import Path

import pytest
from PIL import Image

from app.store.database import Database
from app.trials import photos as limits
from app.trials.photos import TrialPhotos
from app.trials.service import TrialDescription, TrialService
from app.vision.services import VisionServices
from core.errors import InputError, NotFoundError
from tests.core.vision.test_image_header import picture
from tests.support.trials.tracks import stepping_track


@pytest.fixture
def service(database: Database) -> TrialService:
    return TrialService(database)


@pytest.fixture
def trial(service: TrialService) -> str:
    summary = service.add(stepping_track((0.01, 0.0), 1), TrialDescription("first", "Ada", 1.0, 1), None)
    return str(summary["id"])


@pytest.fixture
def photos(service: TrialService, database: Database, tmp_path: Path, vision: VisionServices) -> TrialPhotos:
    return TrialPhotos(service, database, tmp_path, vision)


def test_a_photo_is_kept_smaller_with_a_thumbnail_and_nothing_but_the_picture(
    photos: TrialPhotos, trial: str
) -> None:
    exif = Image.Exif()
    exif[0x010F] = "a camera's maker"
    photo = photos.add(trial, picture("JPEG", (2400, 1200), exif=exif), "tape.jpg", "Ada")
    assert (photo["width"], photo["height"], photo["by"]) == (1600, 800, "Ada")
    kept = Image.open(io.BytesIO(photos.picture(trial, photo["id"])))
    small = Image.open(io.BytesIO(photos.picture(trial, photo["id"], is_small=True)))
    assert (kept.format, kept.size, small.size) == ("JPEG", (1600, 800), (240, 120))
    assert not kept.getexif()
    assert [one["id"] for one in photos.photos(trial)] == [photo["id"]]


def test_a_caption_is_kept_and_a_deleted_photo_comes_back(photos: TrialPhotos, trial: str) -> None:
    photo = photos.add(trial, picture("PNG", (20, 10)), "tape.png", "")["id"]
    assert photos.caption(trial, photo, "new tape")["caption"] == "new tape"
    photos.delete(trial, photo)
    assert photos.photos(trial) == []
    assert photos.restore(trial, photo)["caption"] == "new tape"
    assert [one["id"] for one in photos.photos(trial)] == [photo]


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "no PNG or JPEG"),
        (b"GIF89a" + b"\0" * 60, "no PNG or JPEG"),
        (picture("PNG", (30, 20))[:40], "no picture that can be read"),
        (picture("PNG", (30, 20))[:16] + b"\0\1\0\0\0\1\0\0" + b"\0" * 40, "65536 × 65536 pixels"),
    ],
)
def test_what_is_no_picture_or_unpacks_too_large_leaves_nothing(
    photos: TrialPhotos, trial: str, tmp_path: Path, content: bytes, words: str
) -> None:
    with pytest.raises(InputError, match=words):
        photos.add(trial, content, "tape", "")
    assert photos.photos(trial) == []
    assert not (tmp_path / "trial-photos").exists()


def test_a_file_too_large_and_a_photo_too_many_are_refused(
    photos: TrialPhotos, trial: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    content = picture("PNG", (20, 10))
    monkeypatch.setattr(limits, "MOST_PHOTOS", 1)
    photos.add(trial, content, "tape", "")
    with pytest.raises(InputError, match="This trial has 1 photos"):
        photos.add(trial, content, "tape", "")
    with pytest.raises(InputError, match="more than 20 MB"):
        photos.add(trial, content + b"\0" * limits.MOST_BYTES, "tape", "")


def test_photos_of_other_trials_and_lost_files_are_not_found(
    photos: TrialPhotos, trial: str, tmp_path: Path
) -> None:
    photo = photos.add(trial, picture("PNG", (20, 10)), "tape", "")["id"]
    with pytest.raises(NotFoundError):
        photos.photos("none")
    with pytest.raises(NotFoundError, match="has no photo none"):
        photos.delete(trial, "none")
    with pytest.raises(NotFoundError, match="has no photo"):
        photos.picture("none", photo)
    (tmp_path / "trial-photos" / f"{photo}.jpg").unlink()
    with pytest.raises(NotFoundError, match="is gone"):
        photos.picture(trial, photo)
