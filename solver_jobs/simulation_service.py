"""The parent's hold on the simulator's process."""

from __future__ import annotations

import itertools
import logging
import queue
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future

from core.errors import FootfallError, SimulationCancelledError, StateError
from core.physics.problem import SimulationProblem
from solver_jobs.handle import WorkerEndedError, WorkerHandle
from solver_jobs.simulation_worker import Answer, Halt, Share, Simulate, Simulated, run_simulation_worker

_log = logging.getLogger(__name__)

POLL_SECONDS = 0.02
"""How soon a wish to end is noticed."""
GRACE_SECONDS = 2.0
"""How long the process may take to end a run when asked; then it is ended itself."""
SILENCE_SECONDS = 120.0
"""A process that tells nothing for so long is stuck; it tells its share many times a second."""


class Simulation:
    """A simulation that was asked for; any thread may wait for it or end it.

    Args:
        asked: the problem and its number.
        progress: told the share that is done, from a thread of the simulator's.
    """

    def __init__(self, asked: Simulate, progress: Callable[[float], object]) -> None:
        self.asked = asked
        self.is_cancelled = False
        self._progress = progress
        self._future: Future[Simulated] = Future()

    @property
    def is_done(self) -> bool:
        """Whether the answer is there."""
        return self._future.done()

    def result(self, timeout: float | None = None) -> Simulated:
        """Waits for the answer.

        Args:
            timeout: longest wait, s.

        Raises:
            SimulationCancelledError: it was cancelled.
            CheckError: a leg's chain opened, or the engine diverged.
            StateError: the simulator closed, or its process ended twice.
            TimeoutError: no answer in time.
        """
        return self._future.result(timeout)

    def cancel(self) -> None:
        """Ends it; one that is done stays as it is."""
        self.is_cancelled = True

    def tell(self, share: float) -> None:
        """Passes on the share that is done."""
        if not self.is_cancelled:
            self._progress(share)

    def answer(self, result: Simulated) -> None:
        """Ends the wait."""
        self._future.set_result(result)

    def fail(self, error: FootfallError) -> None:
        """Ends the wait with a sentence."""
        self._future.set_exception(error)


class Simulator:
    """Simulations in a process of their own, one after the other; it is started anew where it ends.

    Args:
        warm_up: a problem that is run ahead; None for nothing.
    """

    def __init__(self, warm_up: SimulationProblem | None = None) -> None:
        self._worker = WorkerHandle(warm_up, run_simulation_worker, "footfall-simulator")
        self._numbers = itertools.count(1)
        self._waiting: queue.SimpleQueue[Simulation | None] = queue.SimpleQueue()
        self._lock = threading.Lock()
        self._thread: threading.Thread | None = None
        self._closed = False

    @property
    def process_id(self) -> int | None:
        """The process's number, or None where none runs."""
        return self._worker.process_id

    def submit(
        self,
        problem: SimulationProblem,
        variations: int = 0,
        *,
        seed: int = 0,
        progress: Callable[[float], object] = lambda share: None,
    ) -> Simulation:
        """Begins a simulation, after those that were asked for before; the first one starts the process.

        Args:
            problem: what is asked.
            variations: how many variations of its parameters are run as well.
            seed: of the variations.
            progress: told the share that is done, from a thread of the simulator's.
        """
        simulation = Simulation(Simulate(next(self._numbers), problem, variations, seed), progress)
        with self._lock:
            if self._closed:
                simulation.fail(_closing())
                return simulation
            if self._thread is None:
                self._thread = threading.Thread(target=self._run, name="simulations", daemon=True)
                self._thread.start()
            self._waiting.put(simulation)
        return simulation

    def close(self) -> None:
        """Ends the process and whatever waits for it."""
        with self._lock:
            self._closed = True
            self._waiting.put(None)
            thread = self._thread
        if thread is not None:
            thread.join()

    def _run(self) -> None:
        try:
            while (simulation := self._waiting.get()) is not None:
                self._attend(simulation)
        finally:
            self._worker.kill()

    def _attend(self, simulation: Simulation) -> None:
        try:
            try:
                result = self._serve(simulation)
            except WorkerEndedError as ended:
                _log.warning("The simulator's process ended (%s); a new one simulates.", ended)
                result = self._serve(simulation)
            simulation.answer(result)
        except FootfallError as error:
            simulation.fail(error)
        except (WorkerEndedError, OSError) as error:
            _log.exception("The simulator gives no answer")
            simulation.fail(StateError(f"The simulator's process ended twice ({error}). Try again."))
        except Exception as error:
            # The process is still at this run, and would take the next question for an end of it.
            _log.exception("A simulation broke off")
            self._worker.kill()
            simulation.fail(StateError(f"The simulation broke off ({error!r}); this is a bug."))

    def _serve(self, simulation: Simulation) -> Simulated:
        """One simulation in a living process.

        Raises:
            WorkerEndedError: the process ended in the middle.
            FootfallError: what was refused or cancelled, or the studio closes, or there is a bug.
        """
        if simulation.is_cancelled and not self._closed:
            raise _cancelled()
        self._worker.ensure_started()
        number = simulation.asked.number
        self._worker.send(simulation.asked)
        latest, halted = time.monotonic() + SILENCE_SECONDS, False
        while not self._closed:
            message = self._worker.receive(POLL_SECONDS)
            if isinstance(message, Answer) and message.number == number:
                return _result(message)
            if isinstance(message, Share) and message.number == number:
                simulation.tell(message.share)
                latest = latest if halted else time.monotonic() + SILENCE_SECONDS
            if simulation.is_cancelled and not halted:
                self._worker.send(Halt(number))
                latest, halted = time.monotonic() + GRACE_SECONDS, True
            if time.monotonic() > latest:
                self._worker.kill()
                raise _cancelled() if halted else StateError("The simulator hangs and was ended. Try again.")
        raise _closing()


def _result(message: Answer) -> Simulated:
    if message.refusal is not None:
        raise message.refusal
    if message.result is None:
        _log.error("The simulator broke off: %s", message.error)
        first = message.error.partition("\n")[0]
        raise StateError(f"The simulator broke off ({first}); this is a bug.")
    return message.result


def _cancelled() -> SimulationCancelledError:
    return SimulationCancelledError("The simulation was cancelled.")


def _closing() -> StateError:
    return StateError("The studio is closing, so nothing was simulated.")
