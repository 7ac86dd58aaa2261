"""How much a peer has not taken yet of what it was sent."""

import asyncio
import fcntl
import struct
import sys
import termios


def untaken_bytes(transport: asyncio.WriteTransport) -> int:
    """Bytes that wait for the peer, here and in the system's buffer where that tells.

    Linux asks for more only when a third of its buffer is free: on a slow line, minutes may pass before our
    own buffer shrinks, while the peer takes bytes all the time.
    """
    waiting = transport.get_write_buffer_size()
    if waiting == 0 or sys.platform != "linux":
        return waiting
    try:
        line = transport.get_extra_info("socket").fileno()
        return waiting + int(struct.unpack("i", fcntl.ioctl(line, termios.TIOCOUTQ, bytes(4)))[0])
    except (OSError, ValueError):  # the line is closed
        return waiting
