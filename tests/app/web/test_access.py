"""Foreign hosts, foreign pages and missing tokens are refused, on HTTP and web sockets."""

from __future__ import annotations

import pytest
from fastapi import FastAPI, WebSocket
from starlette.middleware import Middleware
from starlette.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from app.web.access import PAGE_POLICY, Access, Guard


def client(
    host: str = "127.0.0.1", token: str | None = None, base: str = "http://127.0.0.1:8400"
) -> TestClient:
    app = FastAPI(middleware=[Middleware(Guard, access=Access(host, token))])

    @app.get("/api/health")
    async def health() -> str:
        return "ok"

    @app.post("/api/robot/stop")
    async def stop() -> dict[str, str]:
        return {"robot": "stopping"}

    @app.websocket("/api/events")
    async def events(socket: WebSocket) -> None:
        await socket.accept()
        await socket.send_text("hello")
        await socket.close()

    return TestClient(app, base_url=base, follow_redirects=False)


@pytest.mark.parametrize("host", ["127.0.0.1:8400", "localhost:8400", "[::1]:8400"])
def test_our_own_names_are_answered(host: str) -> None:
    answer = client().get("/api/health", headers={"host": host})
    assert answer.status_code == 200
    assert answer.headers["content-security-policy"] == PAGE_POLICY


@pytest.mark.parametrize("host", ["evil.example", "127.0.0.1.evil.example", "", "[", "10.0.0.1:8400"])
def test_foreign_hosts_are_refused(host: str) -> None:
    answer = client().get("/api/health", headers={"host": host})
    assert answer.status_code == 403
    assert "does not answer for the host" in answer.json()["error"]


@pytest.mark.parametrize("origin", ["http://evil.example", "http://127.0.0.1:9999", "null"])
def test_foreign_origins_are_refused_on_http_and_sockets(origin: str) -> None:
    assert client().get("/api/health", headers={"origin": origin}).status_code == 403
    with (
        pytest.raises(WebSocketDisconnect),
        client().websocket_connect("ws://127.0.0.1:8400/api/events", headers={"origin": origin}),
    ):
        pass


def test_our_own_page_may_open_the_socket() -> None:
    headers = {"origin": "http://127.0.0.1:8400"}
    with client().websocket_connect("ws://127.0.0.1:8400/api/events", headers=headers) as socket:
        assert socket.receive_text() == "hello"


TOKEN = "a-token-of-enough-letters"


def test_a_public_address_demands_its_token() -> None:
    public = client("0.0.0.0", TOKEN, "http://10.1.2.3:8400")
    assert public.get("/api/health").status_code == 403
    assert public.get("/api/health", headers={"authorization": "Bearer wrong"}).status_code == 403
    assert public.get("/api/health", headers={"authorization": f"Bearer {TOKEN}"}).status_code == 200
    assert public.get("/api/health", headers={"host": "rebound.example"}).status_code == 403


def test_a_deed_with_its_token_in_the_address_is_done_and_not_sent_elsewhere() -> None:
    public = client("0.0.0.0", TOKEN, "http://10.1.2.3:8400")
    assert public.post(f"/api/robot/stop?token={TOKEN}").json() == {"robot": "stopping"}
    assert public.post("/api/robot/stop?token=wrong").status_code == 403


def test_the_printed_address_sets_a_cookie_and_hides_the_token() -> None:
    public = client("0.0.0.0", TOKEN, "http://10.1.2.3:8400")
    answer = public.get(f"/api/health?token={TOKEN}")
    assert answer.status_code == 303
    assert answer.headers["location"] == "/api/health"
    assert "httponly" in answer.headers["set-cookie"].lower()
    assert public.get("/api/health").status_code == 200
