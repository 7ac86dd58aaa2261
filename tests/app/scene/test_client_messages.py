"""Of what a 3D client sends, Viser gets where its camera is, and nothing that it cannot read."""

from __future__ import annotations

import contextlib
import dataclasses
from typing import Any

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st
from viser import _messages

from app.scene.client_messages import Camera, is_camera
from core.errors import InputError
from tests.support.client_camera import CAMERA


def packed(content: Any) -> bytes:
    return msgspec.msgpack.encode(content)


def test_a_camera_is_passed_on() -> None:
    assert is_camera(packed(CAMERA))


def test_the_fields_are_those_of_the_installed_viser() -> None:
    names = {field.name for field in dataclasses.fields(_messages.ViewerCameraMessage)}
    assert {field.name for field in msgspec.structs.fields(Camera)} == names


@pytest.mark.parametrize("kind", ["CommandTriggerMessage", "ShareUrlRequest", "", "no kind of Viser's"])
def test_other_kinds_are_dropped(kind: str) -> None:
    assert not is_camera(packed({"type": kind, "name": [1]}))


@pytest.mark.parametrize("field", CAMERA)
@pytest.mark.parametrize("value", [None, [1, "x"], [1] * 9, {}])
def test_a_camera_with_a_wrong_field_is_refused(field: str, value: Any) -> None:
    with pytest.raises(InputError, match="Reload the page"):
        is_camera(packed({**CAMERA, field: value}))


@pytest.mark.parametrize("field", [field for field in CAMERA if field != "type"])
def test_a_camera_without_a_field_is_refused(field: str) -> None:
    with pytest.raises(InputError):
        is_camera(packed({name: value for name, value in CAMERA.items() if name != field}))


@pytest.mark.parametrize(
    "data",
    ["text", "", b"", b"\xc1", b"\x91" * 100_000, b"\x81\xa1a" + b"\x91" * 100_000, packed({}), packed(5)],
)
def test_what_is_no_message_is_refused(data: bytes | str) -> None:
    with pytest.raises(InputError):
        is_camera(data)


@given(st.binary(max_size=40))
def test_no_bytes_do_more_harm_than_a_refusal(data: bytes) -> None:
    with contextlib.suppress(InputError):
        assert not is_camera(data)
