"""Chunks on a Dask cluster: the same work, file and hash as on this machine alone."""

import logging
import time
from collections.abc import Callable, Generator
from contextlib import ExitStack
from typing import Any

from app.atlas.run import DoneChunk
from app.common.version import VERSION
from core.atlas.space import AtlasSpace
from core.errors import InputError, StateError
from core.running_time import Deadline
from solver_jobs import RUN_AGAIN, Chunk, evaluated_chunk, hung_sentence

LOCAL = "local"
CONNECT_SECONDS = 15
"""How long a cluster may take to answer."""
AHEAD = 2
"""Chunks that each worker is given ahead."""
WAIT_SECONDS = 0.2
"""Between looks for a wish to end."""
GONE_SECONDS = 30.0
"""A cluster without a worker for so long counts as gone."""
SILENCE_SECONDS = 1800.0
"""Workers of which none is done with a chunk for so long hang; a chunk takes a minute or two."""
TRIES = 4
"""Workers that may die with a chunk before the run ends."""


class DaskEngine:
    """Workers of a Dask cluster.

    Args:
        address: of its scheduler, such as `tcp://node1:8786`, or `local` for one on this machine.
        workers: processes of a local one.

    Raises:
        InputError: Dask is not installed, or the address is none.
    """

    def __init__(self, address: str, workers: int) -> None:
        try:
            import distributed
        except ImportError as error:
            raise InputError(
                "Dask needs the optional package distributed. Install footfall-studio[cluster], or leave "
                "--dask out.",
                "--dask",
            ) from error
        if address != LOCAL and "://" not in address:
            raise InputError(
                f"--dask is {address}; it must be “{LOCAL}”, or a scheduler's address such as "
                "tcp://node1:8786.",
                "--dask",
            )
        self._dask: Any = distributed
        self._address = address
        self._workers = workers

    def run(
        self, space: AtlasSpace, chunks: list[Chunk], go_on: Callable[[], bool]
    ) -> Generator[DoneChunk | None]:
        """Chunks as they are done; a chunk whose worker dies is given to another one.

        Raises:
            InputError: there is no cluster, or its workers run another version of the program.
            StateError: the cluster went away.
        """
        logging.getLogger("distributed").setLevel(logging.CRITICAL)
        with ExitStack() as opened:
            client = self._client(opened)
            self._require_version(client)
            content = space.content()
            waiting = chunks[::-1]
            running: dict[Any, Chunk] = {}
            silence = Deadline(SILENCE_SECONDS, time.monotonic)
            while (waiting or running) and go_on():
                while waiting and len(running) < AHEAD * max(self._count(client), 1):
                    chunk = waiting.pop()
                    future = client.submit(
                        evaluated_chunk, content, chunk.first, chunk.count, pure=False, retries=TRIES
                    )
                    running[future] = chunk
                try:
                    done = self._dask.wait(
                        list(running), timeout=WAIT_SECONDS, return_when="FIRST_COMPLETED"
                    ).done
                except self._dask.TimeoutError:
                    done = ()
                self._require_alive(client)
                if done:
                    silence = Deadline(SILENCE_SECONDS, time.monotonic)
                elif silence.is_over:
                    raise StateError(
                        hung_sentence(f"cluster at {self._address}", SILENCE_SECONDS, RUN_AGAIN), "--dask"
                    )
                for future in done:
                    chunk = running.pop(future)
                    if future.status in ("cancelled", "lost"):
                        waiting.append(chunk)
                        continue
                    yield DoneChunk(chunk, self._gaits(future))
                yield None

    def _client(self, opened: ExitStack) -> Any:
        try:
            if self._address == LOCAL:
                cluster = self._dask.LocalCluster(
                    n_workers=self._workers,
                    threads_per_worker=1,
                    dashboard_address=None,
                    silence_logs=logging.CRITICAL,
                )
                return opened.enter_context(self._dask.Client(opened.enter_context(cluster)))
            return opened.enter_context(self._dask.Client(self._address, timeout=CONNECT_SECONDS))
        except (OSError, ValueError, self._dask.TimeoutError) as error:
            raise InputError(
                f"No Dask scheduler answers at {self._address}. Start one (docs/atlas.md), or leave --dask "
                "out to use this computer.",
                "--dask",
            ) from error

    def _require_version(self, client: Any) -> None:
        """All workers run this version of the program.

        Raises:
            InputError: one does not, or the cluster has no worker.
        """
        try:
            client.wait_for_workers(1, timeout=CONNECT_SECONDS)
            versions = set(client.run(program_version).values())
        except (self._dask.TimeoutError, OSError) as error:
            raise InputError(
                f"The cluster at {self._address} has no worker. Start workers (docs/atlas.md).", "--dask"
            ) from error
        except ModuleNotFoundError as error:
            raise InputError(
                f"A worker of {self._address} has no Footfall Studio {VERSION}. Install it there.", "--dask"
            ) from error
        if versions != {VERSION}:
            other = ", ".join(sorted(versions - {VERSION}))
            raise InputError(
                f"A worker of {self._address} runs version {other}, and this is {VERSION}. Install the same "
                "version there.",
                "--dask",
            )

    def _count(self, client: Any) -> int:
        return len(client.scheduler_info(n_workers=-1)["workers"])

    def _require_alive(self, client: Any) -> None:
        """The connection to the scheduler holds.

        Raises:
            StateError: it does not.
        """
        if client.status != "running":
            raise StateError(
                f"The cluster at {self._address} went away. What was computed is kept; run again to go on.",
                "--dask",
            )

    def _gaits(self, future: Any) -> Any:
        """Gaits of a chunk that is done.

        Raises:
            StateError: its workers died with it, or the program failed there.
        """
        try:
            return future.result()
        except self._dask.KilledWorker as error:
            raise StateError(
                f"{TRIES} workers of {self._address} died with the same chunk. What was computed is kept; "
                "look whether they have enough memory, and run again to go on.",
                "--dask",
            ) from error
        except self._dask.CancelledError as error:
            raise StateError(
                f"The cluster at {self._address} went away. What was computed is kept; run again to go on.",
                "--dask",
            ) from error


def program_version() -> str:
    """The version of the program where this runs."""
    return VERSION
