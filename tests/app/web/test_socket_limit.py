"""A web socket on which too long a message comes is closed; others go on."""

from __future__ import annotations

import pytest
from fastapi import FastAPI, WebSocket
from starlette.middleware import Middleware
from starlette.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from app.web.socket_limit import MOST_MESSAGE, MOST_SIGNAL, SocketLimit

SOCKETS = {"/api/events": MOST_SIGNAL, "/viser/ws": MOST_MESSAGE}


@pytest.fixture
def taken() -> list[int]:
    """The lengths that the application got."""
    return []


@pytest.fixture
def client(taken: list[int]) -> TestClient:
    app = FastAPI(middleware=[Middleware(SocketLimit)])

    @app.websocket("/{path:path}")
    async def socket(socket: WebSocket) -> None:
        await socket.accept()
        while (message := await socket.receive())["type"] == "websocket.receive":
            taken.append(len(message.get("text") or message["bytes"]))
            await socket.send_text("taken")
        await socket.send_text("too late, and harmless")

    return TestClient(app)


@pytest.mark.parametrize(("path", "most"), SOCKETS.items())
@pytest.mark.parametrize(("kind", "letter"), [("text", "x"), ("text", "€"), ("bytes", b"x")])
def test_one_byte_too_many_closes_the_socket(
    client: TestClient, taken: list[int], path: str, most: int, kind: str, letter: str | bytes
) -> None:
    count = most // len(letter.encode() if isinstance(letter, str) else letter)
    with client.websocket_connect(path) as socket:
        socket.send({"type": "websocket.receive", kind: letter * count})
        assert socket.receive_text() == "taken"
        socket.send({"type": "websocket.receive", kind: letter * (count + 1)})
        with pytest.raises(WebSocketDisconnect) as closed:
            socket.receive_text()
    assert closed.value.code == 1009
    assert taken == [count]
