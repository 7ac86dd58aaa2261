"""The parent's hold on the pattern solver's process."""

from __future__ import annotations

import itertools
import logging
import queue
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future

from core.errors import FootfallError, StateError
from core.patterns.problem import PatternProblem, PatternProgress, PatternResult, PatternStatus
from solver_jobs.handle import WorkerEndedError, WorkerHandle
from solver_jobs.pattern_worker import Find, Found, Halt, Known, run_pattern_worker

_log = logging.getLogger(__name__)

POLL_SECONDS = 0.02
"""How soon a wish to end is noticed."""

GRACE_SECONDS = 1.0
"""How long the process may take to end a search when asked; then it is ended itself."""

EXPLAIN_SECONDS = 30.0
"""How much longer than its limit a search may take, since a clash is explained after it is proven."""


class PatternSearch:
    """A search that was asked for; any thread may wait for it or end it.

    Args:
        number: tells it from others.
        problem: what is sought.
        count: how many different patterns.
        seconds: longest search.
        progress: told what is known, at most every 50 ms, from a thread of the solver's.
    """

    def __init__(
        self,
        number: int,
        problem: PatternProblem,
        count: int,
        seconds: float,
        progress: Callable[[PatternProgress], object],
    ) -> None:
        self.find = Find(number, problem, count, seconds)
        self.known: PatternProgress | None = None
        self.is_ending = False
        self.is_cancelled = False
        self._progress = progress
        self._future: Future[PatternResult] = Future()

    @property
    def is_done(self) -> bool:
        """Whether the answer is there."""
        return self._future.done()

    def result(self, timeout: float | None = None) -> PatternResult:
        """Waits for the answer.

        Args:
            timeout: longest wait, s.

        Raises:
            StateError: the solver closed, or its process ended twice.
            TimeoutError: no answer in time.
        """
        return self._future.result(timeout)

    def use_now(self) -> None:
        """Ends the search with the best pattern yet."""
        self.is_ending = True

    def cancel(self) -> None:
        """Ends the search; nothing of it is used."""
        self.is_cancelled = self.is_ending = True

    def tell(self, progress: PatternProgress) -> None:
        """Passes on what is known."""
        self.known = progress
        if not self.is_ending:
            self._progress(progress)

    def answer(self, result: PatternResult) -> None:
        """Ends the wait; what was cancelled has no patterns."""
        if self.is_cancelled:
            result = PatternResult(PatternStatus.CANCELLED, (), result.bound, result.solve_seconds)
        self._future.set_result(result)

    def fail(self, error: FootfallError) -> None:
        """Ends the wait with a sentence."""
        self._future.set_exception(error)

    def from_progress(self, seconds: float) -> PatternResult:
        """An answer out of what was last known, where the process gave none."""
        known = self.known
        bound = None if known is None else known.bound
        if known is None or known.pattern is None:
            return PatternResult(PatternStatus.CANCELLED, (), bound, seconds)
        return PatternResult(PatternStatus.FEASIBLE, (known.pattern,), bound, seconds)


class PatternSolver:
    """Searches in a process of their own, one after the other; it is started anew where it ends.

    Args:
        warm_up: a problem that is solved ahead; None for a small one.
    """

    def __init__(self, warm_up: PatternProblem | None = None) -> None:
        self._worker = WorkerHandle(warm_up, run_pattern_worker, "footfall-patterns")
        self._numbers = itertools.count(1)
        self._waiting: queue.SimpleQueue[PatternSearch | None] = queue.SimpleQueue()
        self._lock = threading.Lock()
        self._thread: threading.Thread | None = None
        self._closed = False

    @property
    def process_id(self) -> int | None:
        """The process's number, or None where none runs."""
        return self._worker.process_id

    def start(self) -> None:
        """Starts the process ahead of questions."""
        with self._lock:
            if self._thread is None and not self._closed:
                self._thread = threading.Thread(target=self._run, name="pattern-searches", daemon=True)
                self._thread.start()

    def submit(
        self,
        problem: PatternProblem,
        *,
        count: int = 1,
        seconds: float = 30.0,
        progress: Callable[[PatternProgress], object] = lambda known: None,
    ) -> PatternSearch:
        """Begins a search, after those that were asked for before.

        Args:
            problem: what is sought.
            count: how many different patterns, the best first.
            seconds: longest search.
            progress: told what is known, at most every 50 ms, from a thread of the solver's.
        """
        search = PatternSearch(next(self._numbers), problem, count, seconds, progress)
        self.start()
        with self._lock:
            if self._closed:
                search.fail(_closing())
            else:
                self._waiting.put(search)
        return search

    def solve(self, problem: PatternProblem, *, count: int = 1, seconds: float = 30.0) -> PatternResult:
        """Searches and waits for the answer (see `submit`, and `PatternSearch.result`)."""
        return self.submit(problem, count=count, seconds=seconds).result()

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
            self._start_worker()
            while (search := self._waiting.get()) is not None:
                self._attend(search)
        finally:
            self._worker.kill()

    def _start_worker(self) -> None:
        """Starts the process ahead; where that fails, the next search tries again and says why."""
        try:
            self._worker.ensure_started()
        except OSError:
            _log.exception("The pattern solver's process does not start")

    def _attend(self, search: PatternSearch) -> None:
        begin = time.monotonic()
        try:
            try:
                result = self._serve(search, begin)
            except WorkerEndedError as ended:
                _log.warning("The pattern solver's process ended (%s); a new one searches.", ended)
                result = self._serve(search, begin)
            search.answer(result)
        except FootfallError as error:
            search.fail(error)
        except (WorkerEndedError, OSError) as error:
            _log.exception("The pattern solver gives no answer")
            search.fail(StateError(f"The pattern solver's process ended twice ({error}). Try again."))
        except Exception as error:
            # The process is still at this search, and would take the next question for an end of it.
            _log.exception("A pattern search broke off")
            self._worker.kill()
            search.fail(StateError(f"The search broke off ({error!r}); this is a bug."))

    def _serve(self, search: PatternSearch, begin: float) -> PatternResult:
        """One search in a living process.

        Raises:
            WorkerEndedError: the process ended in the middle.
            StateError: the studio closes, or there is a bug.
        """
        if self._closed:
            raise _closing()
        if search.is_ending:
            return search.from_progress(0.0)
        self._worker.ensure_started()
        self._worker.send(search.find)
        latest = begin + search.find.seconds + EXPLAIN_SECONDS
        halted = False
        while not self._closed:
            message = self._worker.receive(POLL_SECONDS)
            if isinstance(message, Found) and message.number == search.find.number:
                return _result(message)
            if isinstance(message, Known) and message.number == search.find.number:
                search.tell(message.progress)
            now = time.monotonic()
            if search.is_ending and not halted:
                self._worker.send(Halt(search.find.number))
                latest, halted = now + GRACE_SECONDS, True
            if now > latest:
                self._worker.kill()
                self._start_worker()
                return search.from_progress(now - begin)
        raise _closing()


def _result(message: Found) -> PatternResult:
    if message.result is None:
        _log.error("The pattern solver broke off: %s", message.error)
        first = message.error.partition("\n")[0]
        raise StateError(f"The pattern solver broke off ({first}); this is a bug.")
    return message.result


def _closing() -> StateError:
    return StateError("The studio is closing, so the pattern was not searched for.")
