"""The relay between a browser and Viser, against a stand-in for Viser."""

import json
from collections.abc import Iterator, Mapping, Sequence
from threading import Thread

import httpx2
import numpy as np
import pytest
from fastapi import FastAPI
from numpy.typing import NDArray
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import ClientConnection, connect
from websockets.sync.server import ServerConnection, serve
from websockets.typing import Subprotocol

from app.routes.viser_proxy import client_page, is_refused, make_viser_router, node_names
from core.errors import InputError
from tests.support.page.serving import serving
from tests.support.studio_process import wait_for

PROTOCOL = Subprotocol("viser-v9")
LARGE = 3_000_000


class StandIn:
    """Echoes what it gets.

    A text "large" is answered by many bytes, "heads" by what came with the request, "bye" by closing,
    "no" by closing with a reason.
    """

    relay_headers: Mapping[str, str] = {"X-Only": "the relay"}

    def __init__(self, port: int) -> None:
        self.port = port
        self.placed: list[tuple[list[str], NDArray[np.float32]]] = []

    def place(self, names: Sequence[str], poses: NDArray[np.float32]) -> None:
        if len(names) != len(poses):
            raise InputError("Give one pose a node.", "poses")
        self.placed.append((list(names), poses.copy()))


def answer(socket: ServerConnection) -> None:
    for message in socket:
        if message == "large":
            socket.send(b"x" * LARGE)
        elif message == "heads":
            sent = socket.request.headers.raw_items() if socket.request else ()
            socket.send(json.dumps([[name.lower(), value] for name, value in sent]))
        elif message == "bye":
            socket.close(1000)
        elif message == "no":
            socket.close(1003, "Reload the page.")
        else:
            socket.send(message)


@pytest.fixture
def stand_in() -> Iterator[StandIn]:
    with serve(answer, "127.0.0.1", 0, subprotocols=[PROTOCOL], compression=None) as server:
        thread = Thread(target=server.serve_forever)
        thread.start()
        yield StandIn(server.socket.getsockname()[1])
        server.shutdown()
        thread.join(5)


@pytest.fixture
def host(stand_in: StandIn) -> Iterator[str]:
    app = FastAPI()
    app.include_router(make_viser_router(lambda _: stand_in))
    with serving(app) as address:
        yield address


def browser(host: str) -> ClientConnection:
    return connect(f"ws://{host}/viser/ws", subprotocols=[Subprotocol("other"), PROTOCOL], max_size=None)


def test_both_directions_are_relayed_with_the_servers_choice_of_protocol(host: str) -> None:
    with browser(host) as socket:
        assert socket.subprotocol == PROTOCOL
        socket.send(b"\x81hello")
        assert socket.recv(5) == b"\x81hello"
        socket.send("text")
        assert socket.recv(5) == "text"
        socket.send("large")
        assert len(socket.recv(5)) == LARGE


def test_viser_gets_the_relays_own_headers_and_none_of_the_browsers(host: str, stand_in: StandIn) -> None:
    own = {"Cookie": "footfall_token=x", "Origin": "http://evil.example", "X-Only": "a browser"}
    with connect(f"ws://{host}/viser/ws", subprotocols=[PROTOCOL], additional_headers=own) as socket:
        socket.send("heads")
        sent = json.loads(socket.recv(5))
    assert [value for name, value in sent if name == "x-only"] == ["the relay"]
    assert [value for name, value in sent if name == "host"] == [f"127.0.0.1:{stand_in.port}"]
    assert not {"cookie", "origin"} & {name for name, _ in sent}


@pytest.mark.parametrize("name", ["ShareUrlRequest", "ShareUrlDisconnect"])
def test_a_request_for_a_public_tunnel_is_dropped(host: str, name: str) -> None:
    packed = b"\x81\xa4type" + bytes([0xA0 + len(name)]) + name.encode()
    assert is_refused(packed)
    with browser(host) as socket:
        socket.send(packed)
        socket.send(b"after")
        assert socket.recv(5) == b"after"


def test_the_browser_learns_that_viser_went(host: str) -> None:
    with browser(host) as socket:
        socket.send("bye")
        with pytest.raises(ConnectionClosed):
            socket.recv(5)


def test_the_browser_learns_why_viser_refused_a_message(host: str) -> None:
    with browser(host) as socket:
        socket.send("no")
        with pytest.raises(ConnectionClosed):
            socket.recv(5)
        assert (socket.close_code, socket.close_reason) == (1003, "Reload the page.")


def test_a_scene_that_does_not_answer_refuses_the_browser() -> None:
    app = FastAPI()
    app.include_router(make_viser_router(lambda _: StandIn(port=9)))
    with serving(app) as host, pytest.raises(Exception, match="403"):
        browser(host)


def test_a_browser_too_many_is_refused_until_another_one_goes(
    host: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("app.routes.viser_proxy.MOST_RELAYS", 2)

    def is_relayed() -> bool:
        try:
            with browser(host) as third:
                third.send("text")
                return third.recv(5) == "text"
        except InvalidStatus:
            return False

    with browser(host) as first:
        with browser(host):
            assert not is_relayed()
        wait_for(is_relayed, "a place is free")
        first.send("text")
        assert first.recv(5) == "text"


def test_the_page_is_the_installed_client_with_our_head_and_policy(host: str) -> None:
    answered = httpx2.get(f"http://{host}/viser/")
    assert answered.content == client_page()
    assert answered.text.index("document.hasFocus") < answered.text.index('content="Viser client"')
    policy = answered.headers["content-security-policy"]
    assert "frame-ancestors 'self'" in policy
    assert "'unsafe-eval'" not in policy
    again = httpx2.get(f"http://{host}/viser/", headers={"If-None-Match": answered.headers["etag"]})
    assert again.status_code == 304


def test_poses_from_a_page_move_the_nodes(host: str, stand_in: StandIn) -> None:
    pose = np.arange(14, dtype="<f4")
    with connect(f"ws://{host}/viser/poses") as socket:
        socket.send(json.dumps(["/a", "/b"]))
        socket.send(pose.tobytes())
        assert socket.recv(5) == "shown"
    names, placed = stand_in.placed[0]
    assert names == ["/a", "/b"]
    assert np.array_equal(placed.ravel(), pose)


NO_NAMES = ["", "[", "5", "null", '"/a"', '{"/a": 1}', "[1e400]", "[null]", "[" * 100_000, "9" * 5000]


@pytest.mark.parametrize("text", NO_NAMES)
def test_what_is_no_list_of_texts_is_refused_as_names(text: str) -> None:
    with pytest.raises(InputError, match="Send a JSON list of texts"):
        node_names(text)


def test_names_may_hold_any_text() -> None:
    assert node_names('["/a", "", "\\ud800"]') == ["/a", "", "\ud800"]


@pytest.mark.parametrize(
    ("names", "values"),
    [("", b""), ("[", b""), ("[" * 100_000, b""), ('["/a"]', b"\0" * 27), ('["/a"]', b"\0" * 56)],
    ids=["empty", "cut off", "deep", "no whole pose", "a pose too many"],
)
def test_poses_that_do_not_fit_close_the_socket(host: str, names: str, values: bytes) -> None:
    with connect(f"ws://{host}/viser/poses") as socket:
        socket.send(names)
        if values:
            socket.send(values)
        with pytest.raises(ConnectionClosed):
            socket.recv(5)
        assert socket.close_code == 1003
        assert (socket.close_reason or "").endswith(".")
