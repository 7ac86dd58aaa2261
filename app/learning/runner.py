"""Simulations of gaits for learning, on several processes at once."""

import threading
from collections.abc import Callable, Iterator, Sequence
from typing import Protocol

from core.errors import SimulationCancelledError
from core.identification.learning import Task, Walk
from core.physics.parameters import PhysicsSet
from core.trials.displacement import Displacement


class BatchHandle(Protocol):
    """Simulations under way; `solver_jobs.BatchSimulation` in the studio."""

    def result(self) -> tuple[Displacement | None, ...]:
        """Waits for their answer."""

    def cancel(self) -> None:
        """Ends them."""


class BatchTier(Protocol):
    """Interface to the batch simulator; the studio passes `solver_jobs.BatchSimulator`."""

    def submit(self, walk: Walk, sets: Sequence[PhysicsSet]) -> BatchHandle:
        """Begins some simulations of a gait."""


class WalkRunner:
    """Simulates gaits, as `core.identification.learning.learn` asks for it.

    Args:
        tiers: each simulates one gait at a time.
        walks: the gaits.
        told: hears how many simulations are done, from any thread.
    """

    def __init__(
        self, tiers: Sequence[BatchTier], walks: Sequence[Walk], told: Callable[[int], object]
    ) -> None:
        self._tiers = tiers
        self._walks = walks
        self._told = told
        self._lock = threading.Lock()
        self._done = 0
        self._is_cancelled = False
        self._on: set[BatchHandle] = set()

    def cancel(self) -> None:
        """Ends what is on and what would follow; any thread may call."""
        with self._lock:
            self._is_cancelled = True
            for handle in self._on:
                handle.cancel()

    def __call__(self, tasks: Sequence[Task]) -> list[Displacement | None]:
        """Simulates, in any order, and answers in the order of the tasks.

        Raises:
            SimulationCancelledError: it was cancelled.
            FootfallError: a simulation was refused.
        """
        answers: list[Displacement | None] = [None] * len(tasks)
        failures: list[Exception] = []
        waiting = iter(range(len(tasks)))

        def work(tier: BatchTier) -> None:
            try:
                while not failures and (number := self._next(waiting)) is not None:
                    gait, physics = tasks[number]
                    answers[number] = self._one(tier, self._walks[gait], physics)
            except Exception as error:  # it belongs to whoever asked
                failures.append(error)

        threads = [threading.Thread(target=work, args=(tier,), daemon=True) for tier in self._tiers]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        if failures:
            raise failures[0]
        return answers

    def _next(self, waiting: Iterator[int]) -> int | None:
        with self._lock:
            return next(waiting, None)

    def _one(self, tier: BatchTier, walk: Walk, physics: PhysicsSet) -> Displacement | None:
        with self._lock:
            if self._is_cancelled:
                raise SimulationCancelledError("Learning was cancelled.")
            handle = tier.submit(walk, (physics,))
            self._on.add(handle)
        try:
            (displacement,) = handle.result()
        finally:
            with self._lock:
                self._on.discard(handle)
        with self._lock:
            self._done += 1
            done = self._done
        self._told(done)
        return displacement
