"""Foreign hosts, foreign pages and missing tokens are refused, on HTTP and web sockets."""

from __future__ import annotations

from urllib.parse import urljoin

import pytest
from fastapi import FastAPI, WebSocket
from fastapi.responses import HTMLResponse
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

    @app.get("/")
    @app.get("/docs")
    @app.get("/x")
    async def page() -> HTMLResponse:
        return HTMLResponse("page", headers={"content-security-policy": "default-src 'self'"})

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


def test_each_studio_of_a_computer_has_a_cookie_of_its_own() -> None:
    public = client("0.0.0.0", TOKEN, "http://10.1.2.3:8400")
    named = public.get(f"/?token={TOKEN}").headers["set-cookie"].split("=")[0]
    other = client("0.0.0.0", TOKEN, "http://10.1.2.3:8401").get(f"/?token={TOKEN}")
    assert other.headers["set-cookie"].split("=")[0] != named
    cookies = f"a/b=c; {{=1; x; footfall_token_8401=of-another-studio; {named}={TOKEN}"
    answer = client("0.0.0.0", TOKEN, "http://10.1.2.3:8400").get("/", headers={"cookie": cookies})
    assert answer.status_code == 200


def test_one_request_tries_one_cookie() -> None:
    cookies = f"footfall_token=x; footfall_token_1=y; footfall_token_2={TOKEN}"
    answer = client("0.0.0.0", TOKEN, "http://10.1.2.3:8400").get("/", headers={"cookie": cookies})
    assert answer.status_code == 403


@pytest.mark.parametrize(
    "path",
    ["//evil.example/x", "/%2Fevil.example/x", "///evil.example", "/%5Cevil.example", "/%09/evil.example"],
)
def test_the_token_leads_to_no_other_host(path: str) -> None:
    public = client("0.0.0.0", TOKEN, "http://10.1.2.3:8400")
    location = public.get(f"http://10.1.2.3:8400{path}?token={TOKEN}").headers["location"]
    assert urljoin("http://10.1.2.3:8400/", location).startswith("http://10.1.2.3:8400/")
    assert location[:2] not in ("//", "/\\", "/\t")


def test_the_rest_of_an_address_stays_when_the_token_goes() -> None:
    public = client("0.0.0.0", TOKEN, "http://10.1.2.3:8400")
    answer = public.get(f"/x?gait=s%20gait&token={TOKEN}&empty=")
    assert answer.headers["location"] == "/x?gait=s+gait&empty="


OPENED = {"sec-fetch-mode": "navigate", "sec-fetch-dest": "document"}


@pytest.mark.parametrize("site", ["cross-site", "same-site", "something new"])
@pytest.mark.parametrize(
    ("method", "path", "how", "status"),
    [
        ("GET", "/", OPENED, 200),
        ("GET", "/docs", OPENED, 200),
        ("HEAD", "/", OPENED, 403),
        ("POST", "/", OPENED, 403),
        ("GET", "/", {}, 403),
        ("GET", "/", OPENED | {"sec-fetch-dest": "iframe"}, 403),
        ("GET", "/", OPENED | {"sec-fetch-mode": "no-cors"}, 403),
        ("GET", "/x", OPENED, 403),
        ("GET", "/api/health", OPENED, 403),
        ("POST", "/api/robot/stop", OPENED, 403),
    ],
)
def test_other_sites_may_open_a_page_and_nothing_else(
    site: str, method: str, path: str, how: dict[str, str], status: int
) -> None:
    assert client().request(method, path, headers={"sec-fetch-site": site, **how}).status_code == status


@pytest.mark.parametrize("site", ["same-origin", "none"])
def test_our_own_page_and_typed_addresses_may_ask_for_everything(site: str) -> None:
    for method, path in (("GET", "/"), ("GET", "/api/health"), ("POST", "/api/robot/stop")):
        assert client().request(method, path, headers={"sec-fetch-site": site}).status_code == 200


@pytest.mark.parametrize("site", ["cross-site", "same-site"])
def test_no_other_site_opens_a_socket(site: str) -> None:
    headers = {"sec-fetch-site": site, **OPENED}
    with (
        pytest.raises(WebSocketDisconnect),
        client().websocket_connect("ws://127.0.0.1:8400/api/events", headers=headers),
    ):
        pass


def test_a_link_on_another_site_ends_here_before_the_page_opens() -> None:
    public = client("127.0.0.1", TOKEN)
    answer = public.get(f"/?gait=walk&token={TOKEN}", headers={"sec-fetch-site": "cross-site", **OPENED})
    assert answer.status_code == 200
    assert 'content="0;url=/?gait=walk"' in answer.text
    assert "samesite=strict" in answer.headers["set-cookie"].lower()
    assert public.get("/?gait=walk", headers={"sec-fetch-site": "same-origin"}).text == "page"


@pytest.mark.parametrize("name", ["host", "origin", "sec-fetch-site"])
def test_a_header_that_comes_twice_is_refused(name: str) -> None:
    value = {"host": "127.0.0.1:8400", "origin": "http://127.0.0.1:8400", "sec-fetch-site": "none"}[name]
    twice = [(name, value), (name, value)]
    assert client().get("/api/health", headers=twice[:1]).status_code == 200
    assert client().get("/api/health", headers=twice).status_code == 403


@pytest.mark.parametrize(
    ("path", "policy"), [("/", "default-src 'self'"), ("/api/health", PAGE_POLICY), ("/none", PAGE_POLICY)]
)
@pytest.mark.parametrize("host", ["127.0.0.1", "evil.example"])
def test_every_answer_has_security_headers_also_a_refusal(path: str, policy: str, host: str) -> None:
    answer = client().get(path, headers={"host": host})
    wanted = policy if answer.status_code == 200 else PAGE_POLICY
    assert answer.headers.get_list("content-security-policy") == [wanted]
    assert answer.headers["x-content-type-options"] == "nosniff"
    assert answer.headers["referrer-policy"] == "no-referrer"
    assert answer.headers["cross-origin-resource-policy"] == "same-origin"
