"""Viser's own port answers the relay and nobody else, and shares the scene with nobody."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from typing import Any

import msgspec
import pytest
import viser
from viser import _messages
from websockets.asyncio import server as websockets_server
from websockets.asyncio.server import serve
from websockets.sync.client import connect
from websockets.typing import Subprotocol

from app.scene.server import SceneServer
from core.errors import StateError
from tests.support.client_camera import CAMERA
from tests.support.raw_request import UPGRADE, status_of

FOREIGN: dict[str, dict[str, str | None]] = {
    "no secret": {"X-Footfall-Relay": None},
    "wrong secret": {"X-Footfall-Relay": "a" * 43},
    "secret that is no text": {"X-Footfall-Relay": "\xff\xfe"},
    "foreign Origin": {"Origin": "http://evil.example"},
    "null Origin": {"Origin": "null"},
    "Origin of the port": {"Origin": "http://127.0.0.1"},
    "foreign Host": {"Host": "evil.example"},
    "no Host": {"Host": ""},
    "cross-site": {"Sec-Fetch-Site": "cross-site"},
}
"""How a request differs from the relay's."""


@pytest.fixture(scope="module")
def scene() -> Iterator[SceneServer]:
    scene = SceneServer("deltawalker")
    scene.start()
    yield scene
    scene.stop()


@pytest.mark.parametrize("kind", ["HTTP", "web socket"])
@pytest.mark.parametrize("path", ["/", "/index.html", "/nothing"])
@pytest.mark.parametrize("who", FOREIGN)
def test_all_but_the_relay_are_refused(scene: SceneServer, kind: str, path: str, who: str) -> None:
    headers: dict[str, str | None]
    headers = {**scene.relay_headers, **FOREIGN[who], **(UPGRADE if kind == "web socket" else {})}
    sent = {name: value for name, value in headers.items() if value is not None}
    assert status_of(scene.port, path, sent) == 403


def test_the_relay_is_let_in(scene: SceneServer) -> None:
    assert status_of(scene.port, "/", scene.relay_headers) == 200
    assert status_of(scene.port, "/", {**scene.relay_headers, **UPGRADE}) == 101


def test_each_scene_has_a_secret_of_its_own(scene: SceneServer) -> None:
    secret, other = scene.relay_headers, SceneServer("deltawalker").relay_headers
    assert secret != other
    assert all(len(value) >= 43 for value in secret.values())


def test_a_client_cannot_have_the_scene_shared(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[str] = []
    for name in ("request_share_url", "disconnect_share_url"):
        monkeypatch.setattr(viser.ViserServer, name, lambda self, name=name: asked.append(name))
    scene = SceneServer("deltawalker")
    scene.start()
    try:
        viser_server = scene._running()
        after = threading.Event()
        viser_server._websock_server.register_handler(_messages.ViewerCameraMessage, lambda *_: after.set())
        with connect(
            f"ws://127.0.0.1:{scene.port}",
            subprotocols=[Subprotocol(f"viser-v{viser.__version__}")],
            additional_headers=scene.relay_headers,
            max_size=None,
        ) as client:
            client.send(packed("ShareUrlRequest"))
            client.send(packed("ShareUrlDisconnect"))
            client.send(msgspec.msgpack.encode(CAMERA))
            assert after.wait(30)
            viser_server._thread_executor.submit(lambda: None).result(30)
    finally:
        scene.stop()
    assert asked == []


def packed(kind: str, *fields: str) -> bytes:
    """A client's message with texts of that name, as MessagePack."""
    texts = [text for field in ("type", *fields) for text in (field, kind)]
    return bytes([0x80 + len(texts) // 2]) + b"".join(
        bytes([0xA0 + len(text)]) + text.encode() for text in texts
    )


def test_a_viser_that_starts_otherwise_is_not_left_open(monkeypatch: pytest.MonkeyPatch) -> None:
    started: list[viser.ViserServer] = []

    class OtherViser(viser.ViserServer):
        def __init__(self, **options: Any) -> None:
            started.append(self)
            with monkeypatch.context() as inside:
                inside.setattr(websockets_server, "serve", serve)
                super().__init__(**options)

    monkeypatch.setattr(viser, "ViserServer", OtherViser)
    with pytest.raises(StateError, match="cannot be kept to this studio"):
        SceneServer("deltawalker").start()
    with pytest.raises(OSError, match="refused"):
        status_of(started[0].get_port(), "/", {})
