"""Pictures say their kind and size before they are unpacked; what is none is refused."""

from __future__ import annotations

import io

import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from core.errors import InputError
from core.vision.image_header import MOST_PIXELS, PictureSize, picture_size, require_readable


def picture(form: str, size: tuple[int, int], **options: object) -> bytes:
    file = io.BytesIO()
    Image.new("RGB", size, "#2e9e5b").save(file, form, **options)
    return file.getvalue()


@given(st.sampled_from(["PNG", "JPEG"]), st.integers(1, 300), st.integers(1, 300))
def test_a_picture_says_its_size(form: str, width: int, height: int) -> None:
    content = picture(form, (width, height))
    assert picture_size(content, "it") == PictureSize(form.lower(), width, height)


def test_a_jpeg_says_its_size_behind_other_segments_and_padding() -> None:
    content = picture("JPEG", (70, 30), progressive=True, comment=b"tape", exif=b"Exif\0\0" + b"\0" * 500)
    padded = content[:2] + b"\xff" * 3 + content[2:]
    assert picture_size(padded, "it") == PictureSize("jpeg", 70, 30)


@given(st.binary(max_size=200))
def test_what_is_no_picture_is_refused(content: bytes) -> None:
    with pytest.raises(InputError, match="it is no PNG or JPEG picture"):
        picture_size(content, "it")


@pytest.mark.parametrize("form", ["PNG", "JPEG"])
@pytest.mark.parametrize("kept", [2, 10, 20])
def test_a_picture_that_is_cut_short_is_refused(form: str, kept: int) -> None:
    with pytest.raises(InputError, match="cut short"):
        picture_size(picture(form, (70, 30))[:kept], "it")


def test_a_picture_that_takes_too_much_memory_is_refused() -> None:
    require_readable(MOST_PIXELS, 1, "it")
    with pytest.raises(InputError, match=r"it has 10000 × 5001 pixels; at most 50 million"):
        require_readable(10_000, 5_001, "it")
