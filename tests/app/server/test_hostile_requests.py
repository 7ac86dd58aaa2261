"""Requests that break off and messages that are too long, sent to the real process: no harm, no traceback."""

from __future__ import annotations

import json
import socket
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from tests.support.studio_process import StudioProcess, running_studio, text_of, wait_for

MOST_GROWTH_KB = 16_000
"""Memory that a message of 63 MB may cost; the rest of the studio breathes too."""

JSON_BODY = "Content-Type: application/json\r\n"
BROKEN_OFF = {
    "PUT /api/gaits/walk": JSON_BODY,
    "POST /api/gaits/walk/live": JSON_BODY,
    "POST /api/gaits/import?name=a.csv": "",
    "POST /api/jobs": JSON_BODY,
    "POST /api/robot/arm": JSON_BODY,
    "POST /api/trials": "",
    "POST /api/trials/none/photos": "",
    "POST /api/videos?name=a.mp4": "",
    "POST /api/camera-setups": JSON_BODY,
}
"""Requests with bodies, by what their heads hold besides."""


@pytest.fixture(scope="module")
def studio(lent_studio: StudioProcess) -> StudioProcess:
    return lent_studio


def memory_kb(studio: StudioProcess, name: str) -> int:
    """A figure of the process's memory: `VmRSS` is what it has, `VmHWM` the most that it has had."""
    lines = Path(f"/proc/{studio.pid}/status").read_text().splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith(f"{name}:"))


def line_to(studio: StudioProcess) -> socket.socket:
    place = urlsplit(studio.url)
    return socket.create_connection((place.hostname or "", place.port or 0), timeout=60)


@pytest.mark.parametrize("request_line", BROKEN_OFF)
def test_a_body_that_breaks_off_leaves_no_traceback(studio: StudioProcess, request_line: str) -> None:
    said = text_of(studio.said)
    with line_to(studio) as line:
        host = urlsplit(studio.url).netloc
        head = f"{request_line} HTTP/1.1\r\nHost: {host}\r\n{BROKEN_OFF[request_line]}"
        line.sendall(f'{head}Content-Length: 1000\r\n\r\n{{"a":'.encode())
        line.shutdown(socket.SHUT_WR)
        line.recv(1000)
    assert studio.ask("GET", "/api/health").status == 200
    assert "Traceback" not in text_of(studio.said)[len(said) :]


def test_a_message_of_63_mb_is_not_taken(tmp_path: Path) -> None:
    """The studio is one of its own: nothing that another file began goes on in it."""
    with running_studio(tmp_path) as studio:
        events_url = studio.url.replace("http", "ws") + "api/events"
        with connect(events_url, max_size=None) as events:
            json.loads(events.recv(60))
            events.ping().wait(60)
        before = memory_kb(studio, "VmRSS")
        with connect(events_url, max_size=None) as events:
            json.loads(events.recv(60))
            with pytest.raises(ConnectionClosed):
                events.send("x" * 63_000_000)
        assert studio.ask("GET", "/api/health").status == 200
        assert memory_kb(studio, "VmHWM") - before < MOST_GROWTH_KB


def test_what_is_no_text_is_a_sign_of_life(studio: StudioProcess) -> None:
    said = text_of(studio.said)
    with connect(studio.url.replace("http", "ws") + "api/events", max_size=None) as events:
        json.loads(events.recv(60))
        events.send(b"\0")
        events.ping().wait(60)
        events.send("stop Ada")
        wait_for(lambda: studio.robot()["robot"] is not None, "the studio answers")
        events.ping().wait(60)
    assert "Traceback" not in text_of(studio.said)[len(said) :]
