"""What is said of an address or a port at which the studio cannot listen."""

from __future__ import annotations

import errno
import os
import socket

import pytest

from app.server.launch import listen
from core.errors import InputError


@pytest.mark.parametrize(
    ("host", "sentence"),
    [
        ("nosuch.invalid", "No address nosuch.invalid is known. Correct --host"),
        ("a..b", "No address a..b is known. Correct --host"),
        ("203.0.113.7", "203.0.113.7 is no address of this computer. Give one of its own with --host"),
        ("2001:db8::7", "2001:db8::7 is no address of this computer. Give one of its own with --host"),
    ],
)
def test_a_wrong_address_is_a_sentence_about_it(host: str, sentence: str) -> None:
    with pytest.raises(InputError) as refusal:
        listen(host, 0)
    assert refusal.value.sentence.startswith(sentence)
    assert refusal.value.where == "--host"


def test_a_port_in_use_is_a_sentence_about_it() -> None:
    with listen("127.0.0.1", 0) as busy:
        port = busy.getsockname()[1]
        with pytest.raises(InputError, match="End the program that uses it, or choose another"):
            listen("127.0.0.1", port)


@pytest.mark.parametrize(
    ("number", "remedy"),
    [(errno.EACCES, "Choose one above 1023 with --port."), (errno.EIO, "Choose another with --port.")],
)
def test_the_remedy_fits_the_reason(monkeypatch: pytest.MonkeyPatch, number: int, remedy: str) -> None:
    def refuse(listening: socket.socket, address: tuple[str, int]) -> None:
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr(socket.socket, "bind", refuse)
    with pytest.raises(InputError) as refusal:
        listen("127.0.0.1", 80)
    reason = os.strerror(number)
    assert refusal.value.sentence == f"Port 80 on 127.0.0.1 cannot be used: {reason}. {remedy}"
