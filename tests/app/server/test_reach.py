"""The studio says who can reach it, and its token holds on loopback as elsewhere."""

from __future__ import annotations

import re
from pathlib import Path
from urllib.parse import urlsplit

import pytest

from app.cli import main
from app.server import reach
from app.server.reach import who_can_reach
from tests.support.raw_request import UPGRADE, status_of
from tests.support.studio_process import running_studio, text_of, wait_for


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "::1"])
def test_on_loopback_an_open_studio_names_the_option_that_closes_it(host: str) -> None:
    assert "--token" in who_can_reach(host, has_token=False)
    assert "--token" not in who_can_reach(host, has_token=True)
    assert "this computer" in who_can_reach(host, has_token=True)


@pytest.mark.parametrize(
    ("host", "named"), [("10.1.2.3", "10.1.2.3"), ("0.0.0.0", "192.168.7.5"), ("::", "192.168.7.5")]
)
def test_beyond_loopback_it_names_the_address_and_that_nothing_is_encrypted(
    monkeypatch: pytest.MonkeyPatch, host: str, named: str
) -> None:
    monkeypatch.setattr(reach, "network_address", lambda: "192.168.7.5")
    assert named in who_can_reach(host, has_token=True)
    assert "not encrypted" in who_can_reach(host, has_token=True)


def test_without_a_network_there_is_no_address_to_name(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(reach, "network_address", lambda: None)
    assert "None" not in who_can_reach("0.0.0.0", has_token=True)


@pytest.mark.parametrize("word", ["short", "with a blank in it", "a" * 201, "unprintable\x7f!"])
def test_a_token_that_cannot_be_one_is_refused(
    word: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["serve", "--token", word, "--data", str(tmp_path), "--no-browser", "--port", "0"]
    assert main(words) == 2
    assert "--token" in capsys.readouterr().err


def test_on_loopback_too_a_token_is_made_said_and_demanded(tmp_path: Path) -> None:
    with running_studio(tmp_path, "--token") as studio:
        place = urlsplit(studio.url)
        token, port = place.query.removeprefix("token="), place.port or 0
        assert re.fullmatch(r"[\w-]{20,}", token)
        who = who_can_reach("127.0.0.1", has_token=True)
        wait_for(lambda: who in text_of(studio.said), "it says who can reach it")
        shown = {"Authorization": f"Bearer {token}"}
        for path, headers in (
            ("/", {}),
            ("/api/robot", {}),
            ("/api/events", UPGRADE),
            ("/viser/ws", UPGRADE),
        ):
            assert status_of(port, path, headers) == 403
            assert status_of(port, path, headers | shown) in (200, 101)
        assert status_of(port, "/api/robot/stop", {"Content-Length": "0"}, "POST") == 403
        assert status_of(port, "/api/robot/stop", shown | {"Content-Length": "0"}, "POST") == 200
