"""The parent's side of the live tier: sends problems to its process, and restarts it when it dies."""

import itertools
import logging
import threading
import time
from collections.abc import Callable
from concurrent.futures import CancelledError, Future, InvalidStateError
from concurrent.futures import TimeoutError as FutureTimeout
from contextlib import suppress
from typing import Any

from core.gait.gait import Gait
from core.problem.initial_guess import initial_guess
from core.problem.motion_problem import MotionProblem
from core.running_time import Deadline
from solver_jobs.remedies.limit import Limit
from solver_jobs.remedies.remedy import Remedy, RemedySearch
from solver_jobs.results.motion import Evidence, MotionResult, SolveStatus
from solver_jobs.workers.live_worker import (
    Answered,
    EndSearch,
    FindLimit,
    FindRemedies,
    Found,
    Question,
    SolveLive,
    run_live_worker,
)
from solver_jobs.workers.worker_process import WorkerEndedError, WorkerProcess

_log = logging.getLogger(__name__)

LOAD_SECONDS = 20.0
"""How long a process may take for its answer that was started in the place of one that had ended."""


POLL_SECONDS = 0.05
"""Between two looks whether a search shall go on."""

END_SECONDS = 5.0
"""How long a search may take to end; a process that takes longer is ended."""


class LiveSolverError(Exception):
    """A bug in the live tier's process; the text says which."""


class LiveSolver:
    """Runs the live tier in a process of its own, which is restarted when it dies.

    A broken solver cannot take the robot's program with it. Any thread may ask.

    Args:
        warm_up: a problem that is solved ahead, so that the first answer comes at once.
    """

    def __init__(self, warm_up: MotionProblem | None = None) -> None:
        self._warm_up = warm_up
        self._numbers = itertools.count(1)
        self._lock = threading.Lock()
        self._waiting: dict[int, Future[Any]] = {}
        self._told: dict[int, Callable[[Remedy], object]] = {}
        self._worker: WorkerProcess | None = None
        self._closed = False

    @property
    def process_id(self) -> int | None:
        """The process's number, or None where none runs."""
        worker = self._worker
        return None if worker is None else worker.process_id

    def start(self) -> None:
        """Starts the process ahead of questions."""
        with self._lock:
            self._ensure_started()

    def solve(self, problem: MotionProblem, timeout: float = 2.0) -> MotionResult:
        """Solves a problem.

        Args:
            problem: what is asked.
            timeout: longest wait, s; a process that takes longer is ended.

        Returns:
            The result; failed, with a sentence, where the process gave none.
        """
        begin = time.perf_counter()
        try:
            result: MotionResult = self._ask(lambda number: SolveLive(number, problem), timeout)
        except LiveSolverError as error:
            _log.error("The live solver broke off: %s", error)
            first = str(error).partition("\n")[0]
            return _no_answer(problem, f"The live solver broke off ({first}); this is a bug.")
        except (FutureTimeout, CancelledError, OSError) as error:
            _log.warning("The live solver gave no answer: %r", error)
            seconds = time.perf_counter() - begin
            return _no_answer(
                problem,
                f"The live solver gave no answer within {seconds:.1f} s. Edit again, or press Optimise.",
            )
        return result

    def remedies(
        self,
        gait: Gait,
        tell: Callable[[Remedy], object] = lambda remedy: None,
        *,
        tips: bool = False,
        go_on: Callable[[], bool] = lambda: True,
        timeout: float = 40.0,
    ) -> RemedySearch:
        """Changes of a gait that make it walk, by the live tier; plans come before it.

        Args:
            gait: one without a motion, or one that tips.
            tell: told of each as it is found, from a thread of the solver's.
            tips: whether the gait has a motion and tips in physics.
            go_on: false ends the search with what was found.
            timeout: then the search is ended with what was found, s.
        """
        limit = Deadline(timeout, time.monotonic)

        def question(number: int) -> FindRemedies:
            self._told[number] = tell
            return FindRemedies(number, gait, tips)

        try:
            found: RemedySearch = self._ask(
                question,
                timeout + END_SECONDS,
                lambda: go_on() and not limit.is_over,
            )
        except (FutureTimeout, CancelledError, OSError, LiveSolverError) as error:
            _log.warning("The live solver found no remedies: %r", error)
            return RemedySearch((), complete=False)
        return found

    def limit(self, gait: Gait, which: Limit, timeout: float = 10.0) -> float | None:
        """How far one number of a gait can go (see `solver_jobs.remedies.limit`); plans come before it.

        Args:
            gait: a drawing.
            which: the number.
            timeout: then the search is ended without an answer, s.

        Returns:
            The value, m or rad; None where none works, or no answer came.
        """
        limit = Deadline(timeout, time.monotonic)
        try:
            found: float | None = self._ask(
                lambda number: FindLimit(number, gait, which),
                timeout + END_SECONDS,
                lambda: not limit.is_over,
            )
        except (FutureTimeout, CancelledError, OSError, LiveSolverError) as error:
            _log.warning("The live solver found no limit: %r", error)
            return None
        return found

    def close(self) -> None:
        """Ends the process."""
        with self._lock:
            self._closed = True
            self._end()

    def _ask(
        self, message: Callable[[int], Question], timeout: float, go_on: Callable[[], bool] | None = None
    ) -> Any:
        """Sends a request, and sends it again if the process was dead or dies meanwhile."""
        try:
            return self._ask_once(message, timeout, go_on)
        except FutureTimeout:
            raise
        except (OSError, CancelledError):
            if self._closed:
                raise
            return self._ask_once(message, max(timeout, LOAD_SECONDS), go_on)

    def _ask_once(
        self, message: Callable[[int], Question], timeout: float, go_on: Callable[[], bool] | None
    ) -> Any:
        number = next(self._numbers)
        future: Future[Any] = Future()
        try:
            with self._lock:
                worker = self._ensure_started()
                self._waiting[number] = future
                worker.send(message(number))
            deadline = Deadline(timeout, time.monotonic)
            while not deadline.is_over:
                if go_on is not None and not go_on():
                    deadline, go_on = Deadline(END_SECONDS, time.monotonic), None
                    with suppress(WorkerEndedError):  # then nobody waits any more
                        worker.send(EndSearch(number))
                with suppress(FutureTimeout):
                    return future.result(min(POLL_SECONDS, timeout))
            raise FutureTimeout
        except FutureTimeout:
            with self._lock:
                if not self._closed:
                    self._end()
            raise
        finally:
            self._waiting.pop(number, None)
            self._told.pop(number, None)

    def _ensure_started(self) -> WorkerProcess:
        """A living process; the lock is held."""
        if self._closed:
            raise CancelledError("the studio is closing")
        if self._worker is not None and self._worker.process_id is not None:
            return self._worker
        self._end()
        worker = WorkerProcess(self._warm_up, run_live_worker, "footfall-live")
        worker.ensure_started()
        self._worker = worker
        threading.Thread(target=self._receive, args=(worker,), name="live-answers", daemon=True).start()
        return worker

    def _receive(self, worker: WorkerProcess) -> None:
        """Hands answers to whoever waits, as long as the process lives."""
        try:
            while True:
                answer = worker.receive()
                if isinstance(answer, Found):
                    self._told.get(answer.number, _nobody)(answer.remedy)
                elif isinstance(answer, Answered):
                    self._take(answer)
        except WorkerEndedError as ended:
            _log.debug("The live solver's process ended (%s).", ended)
            with self._lock:
                if self._worker is worker:
                    self._end()

    def _take(self, answer: Answered) -> None:
        future = self._waiting.get(answer.number)
        if future is None or future.done():
            return
        with suppress(InvalidStateError):  # whoever asked has just given up waiting
            if answer.error:
                future.set_exception(LiveSolverError(answer.error))
            else:
                future.set_result(answer.value)

    def _give_up(self) -> None:
        for future in list(self._waiting.values()):
            future.cancel()

    def _end(self) -> None:
        """Ends the process and whoever waits for it; the lock is held."""
        worker, self._worker = self._worker, None
        if worker is not None:
            worker.kill()
        self._give_up()


def _nobody(remedy: Remedy) -> None:
    """Whoever asked has given up waiting."""


def _no_answer(problem: MotionProblem, sentence: str) -> MotionResult:
    drawing = initial_guess(problem)
    return MotionResult(
        status=SolveStatus.FAILED,
        solver_word="",
        explanation=(sentence,),
        evidence=Evidence.DIAGNOSED,
        iterations=(),
        objective=None,
        solve_seconds=0.0,
        build_seconds=0.0,
        trajectory=drawing,
        initial=drawing,
    )
