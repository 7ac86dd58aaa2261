"""Pages, and programs that show the token and ask far too much, from a process of their own."""

import asyncio
import contextlib
import multiprocessing
import os
from collections.abc import AsyncIterator, Awaitable, Callable, Iterator
from dataclasses import dataclass
from multiprocessing.connection import Connection

LOOK_SECONDS = 0.5
"""Between two looks of a page at a gait, s."""

REST_SECONDS = 0.05
"""Between two attempts of a visitor, s."""

JUNK_BYTES = 2_000
NUMBERS = (4_000_000, 490_000)
"""Numbers in large bodies: more than are read, and about as many as are."""

PATHS = ("/api/gaits/walk/view", "/api/gaits", "/api/jobs", "/api/robot")
LARGE_PATHS = ("POST /api/gaits", "POST /api/trials", "POST /api/gaits/walk/live", "PUT /api/gaits/walk")
EVENTS = (
    "GET /api/events?page={page} HTTP/1.1\r\n{head}Connection: Upgrade\r\nUpgrade: websocket\r\n"
    "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n"
)


@dataclass(frozen=True)
class Crowd:
    """Visitors of each kind.

    Args:
        pages: each has a socket of events, and looks at a gait from time to time.
        hurried: ask again as soon as they have their answer.
        junk: send what is no HTTP.
        large: send bodies of a few million numbers.
        openings: open a socket of events and end it.
    """

    pages: int = 20
    hurried: int = 16
    junk: int = 8
    large: int = 8
    openings: int = 8


NOBODY = Crowd(0, 0, 0, 0, 0)


@contextlib.contextmanager
def crowded(address: tuple[str, int], token: str, crowd: Crowd) -> Iterator[None]:
    """Has a crowd at a server meanwhile.

    Args:
        address: the server's.
        token: all of them show it.
        crowd: how many visitors there are.
    """
    if crowd == NOBODY:
        yield
        return
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe()
    process = context.Process(target=_run, args=(theirs, address, token, crowd), daemon=True)
    process.start()
    ours.recv()
    try:
        yield
    finally:
        process.terminate()
        process.join()


def _run(pipe: Connection, address: tuple[str, int], token: str, crowd: Crowd) -> None:
    asyncio.run(_Visitors(address, token).visit(pipe, crowd))


class _Visitors:
    def __init__(self, address: tuple[str, int], token: str) -> None:
        self._address = address
        self._head = f"Host: 127.0.0.1:{address[1]}\r\nAuthorization: Bearer {token}\r\n"
        self._large = [b"[" + b"0," * count + b"0]" for count in NUMBERS]

    async def visit(self, pipe: Connection, crowd: Crowd) -> None:
        """Begins, tells that, and goes on until the process is ended."""
        kinds = (
            (self._page, crowd.pages),
            (self._hurry, crowd.hurried),
            (self._send_junk, crowd.junk),
            (self._send_large, crowd.large),
            (self._open_socket, crowd.openings),
        )
        async with asyncio.TaskGroup() as group:
            for kind, count in kinds:
                for number in range(count):
                    group.create_task(self._again(kind, number))
            await asyncio.sleep(LOOK_SECONDS)
            pipe.send(None)

    async def _again(self, kind: Callable[[int], Awaitable[None]], number: int) -> None:
        while True:
            # A visitor that the studio sends away comes back.
            with contextlib.suppress(OSError, asyncio.IncompleteReadError, ValueError):
                await kind(number)
            await asyncio.sleep(REST_SECONDS)

    async def _page(self, number: int) -> None:
        async with self._line() as (reader, writer):
            writer.write(EVENTS.format(page=f"page-{number}", head=self._head).encode())
            reading = asyncio.create_task(_read_all(reader))
            try:
                while not reading.done():
                    async with self._line() as (answers, asking):
                        asking.write(self._request(f"GET {PATHS[0]}"))
                        await _read_answer(answers)
                    await asyncio.sleep(LOOK_SECONDS)
            finally:
                reading.cancel()

    async def _hurry(self, number: int) -> None:
        async with self._line() as (reader, writer):
            while True:
                writer.write(self._request(f"GET {PATHS[number % len(PATHS)]}"))
                await _read_answer(reader)

    async def _send_junk(self, number: int) -> None:
        del number
        async with self._line() as (reader, writer):
            writer.write(os.urandom(JUNK_BYTES) + b"\r\n\r\n")
            await asyncio.wait_for(reader.read(), LOOK_SECONDS)

    async def _send_large(self, number: int) -> None:
        body = self._large[number // len(LARGE_PATHS) % len(self._large)]
        async with self._line() as (reader, writer):
            writer.write(self._request(LARGE_PATHS[number % len(LARGE_PATHS)], len(body)))
            writer.write(body)
            await writer.drain()
            await _read_answer(reader)

    async def _open_socket(self, number: int) -> None:
        async with self._line() as (reader, writer):
            writer.write(EVENTS.format(page=f"gone-{number}", head=self._head).encode())
            await reader.readuntil(b"\r\n\r\n")

    def _request(self, line: str, length: int = 0) -> bytes:
        body = f"Content-Type: application/json\r\nContent-Length: {length}\r\n" if length else ""
        return f"{line} HTTP/1.1\r\n{self._head}{body}\r\n".encode()

    @contextlib.asynccontextmanager
    async def _line(self) -> AsyncIterator[tuple[asyncio.StreamReader, asyncio.StreamWriter]]:
        reader, writer = await asyncio.open_connection(*self._address)
        try:
            yield reader, writer
        finally:
            writer.close()


async def _read_all(reader: asyncio.StreamReader) -> None:
    while await reader.read(65_536):
        pass


async def _read_answer(reader: asyncio.StreamReader) -> None:
    head = await reader.readuntil(b"\r\n\r\n")
    length = next(
        int(line.split(b":")[1])
        for line in head.lower().split(b"\r\n")
        if line.startswith(b"content-length:")
    )
    await reader.readexactly(length)
