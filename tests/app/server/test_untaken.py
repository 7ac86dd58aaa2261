"""What a peer has not taken yet of what it was sent."""

from __future__ import annotations

import asyncio
import socket
import sys

import pytest

from app.server.untaken import untaken_bytes
from tests.support.own_loop import run_apart
from tests.support.studio_process import wait_for

SENT, READ = 16_000_000, 300_000
"""Bytes; the first are more than the system's buffers take, the second less than makes it ask for more."""


@pytest.mark.skipif(sys.platform != "linux", reason="other systems do not tell what their buffers hold")
def test_whatever_a_slow_peer_takes_counts_at_once() -> None:
    async def reads_a_little(line: socket.socket, peer: socket.socket) -> None:
        transport, _ = await asyncio.get_running_loop().connect_accepted_socket(asyncio.Protocol, line)
        transport.write(b"x" * SENT)
        in_studio = transport.get_write_buffer_size()
        before = untaken_bytes(transport)
        taken = 0
        while taken < READ:
            taken += len(peer.recv(READ - taken))
        wait_for(lambda: untaken_bytes(transport) < before, "what was taken is seen", 10)
        assert transport.get_write_buffer_size() == in_studio > 0
        transport.abort()

    with socket.create_server(("127.0.0.1", 0)) as listening, socket.socket() as peer:
        peer.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 65536)
        peer.connect(listening.getsockname())
        run_apart(reads_a_little(listening.accept()[0], peer))
