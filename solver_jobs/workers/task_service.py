"""The parent's side of the task service: one task at a time, in a process that is restarted when it dies.

For each kind of task, derive a `Task`, which defines the result of a cancelled one, and a
`TaskService` over a process whose body calls `run_tasks`.
"""

import itertools
import logging
import queue
import threading
from abc import ABC, abstractmethod
from collections.abc import Callable
from concurrent.futures import Future
from multiprocessing.connection import Connection
from typing import Any, ClassVar, Generic, TypeVar

from core.errors import FootfallError, StateError
from core.running_time import RunningClock
from solver_jobs.workers.spawning import NICENESS
from solver_jobs.workers.task_worker import Cancel, Progress, Submit, TaskResult
from solver_jobs.workers.worker_process import (
    POLL_SECONDS,
    SILENCE_SECONDS,
    WorkerEndedError,
    WorkerProcess,
    hung_sentence,
)

_log = logging.getLogger(__name__)

Payload = TypeVar("Payload")
Known = TypeVar("Known")
Result = TypeVar("Result")


class Task(ABC, Generic[Payload, Known, Result]):
    """A submitted task; any thread may wait for its result or cancel it.

    Args:
        task: what the process is given.
        progress: told what is known, from a thread of the service's.
    """

    grace: ClassVar[float] = 1.0
    """How long the process may take to end when asked, s; then it is ended itself."""
    remedy: ClassVar[str] = "Try again."
    """What a person does where the process hung."""

    def __init__(self, task: Payload, progress: Callable[[Known], object]) -> None:
        self.task = task
        self.is_ending = False
        self._progress = progress
        self._future: Future[Result] = Future()

    @property
    def is_done(self) -> bool:
        """Whether the answer is there."""
        return self._future.done()

    def result(self, timeout: float | None = None) -> Result:
        """Waits for the answer.

        Args:
            timeout: longest wait, s.

        Raises:
            FootfallError: it was refused, or cancelled where that leaves no answer.
            StateError: the service closed, or its process ended twice.
            TimeoutError: no answer in time.
        """
        return self._future.result(timeout)

    def when_done(self, tell: Callable[[], object]) -> None:
        """Calls back once the answer is there, from a thread of the service's; at once where it is."""
        self._future.add_done_callback(lambda done: tell())

    def cancel(self) -> None:
        """Ends it; one that is done stays as it is."""
        self.is_ending = True

    @abstractmethod
    def unanswered(self, seconds: float) -> Result:
        """The result of a cancelled task that the process did not finish within `seconds`.

        Raises:
            FootfallError: it has none.
        """

    def hung(self, sentence: str, seconds: float) -> Result:
        """The result of a task whose process hung and was ended.

        Args:
            sentence: tells a person.
            seconds: since the task's turn came.

        Raises:
            StateError: it has none.
        """
        del seconds
        raise StateError(sentence)

    def latest(self, begun: float, heard: float) -> float:
        """The time at which a process that has not answered counts as hung.

        Args:
            begun: when the question's turn came, s.
            heard: when the process told something last, s.
        """
        return heard + SILENCE_SECONDS

    def tell(self, known: Known) -> None:
        """Passes on what is known."""
        if not self.is_ending:
            self._progress(known)

    def answer(self, result: Result) -> None:
        """Ends the wait."""
        self._future.set_result(result)

    def fail(self, error: FootfallError) -> None:
        """Ends the wait with a sentence."""
        self._future.set_exception(error)


TaskT = TypeVar("TaskT", bound=Task[Any, Any, Any])


class TaskService(Generic[TaskT]):
    """Runs tasks in a process of its own, one after the other.

    Args:
        name: of what answers, as in a sentence: "pattern solver".
        body: what the process runs, given its end of the pipe and `warm_up` (see `run_tasks`).
        warm_up: what it does ahead of questions; None for what `body` makes of that.
        niceness: how far it stands back where cores are scarce.
    """

    def __init__(
        self,
        name: str,
        body: Callable[[Connection, Any], None],
        warm_up: Any = None,
        niceness: int = NICENESS,
    ) -> None:
        self._name = name
        self._worker = WorkerProcess(warm_up, body, f"footfall {name}", niceness)
        self._numbers = itertools.count(1)
        self._running = RunningClock(self._worker.clock)
        self._waiting: queue.SimpleQueue[TaskT | None] = queue.SimpleQueue()
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
                self._thread = threading.Thread(target=self._run, name=self._name, daemon=True)
                self._thread.start()

    def ask(self, question: TaskT) -> TaskT:
        """Begins a question, after those that were asked before; the first one starts the process."""
        self.start()
        with self._lock:
            if self._closed:
                question.fail(self._closing())
            else:
                self._waiting.put(question)
        return question

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
            while (question := self._waiting.get()) is not None:
                self._attend(question)
        finally:
            self._worker.kill()

    def _start_worker(self) -> None:
        """Starts the process ahead; where that fails, the next question tries again and says why."""
        try:
            self._worker.ensure_started()
        except OSError:
            _log.exception("The %s's process does not start", self._name)

    def _attend(self, question: TaskT) -> None:
        self._running.look()
        begun = self._running()
        try:
            try:
                result = self._serve(question, begun)
            except WorkerEndedError as ended:
                _log.warning("The %s's process ended (%s); a new one answers.", self._name, ended)
                result = self._serve(question, begun)
            question.answer(result)
        except FootfallError as error:
            question.fail(error)
        except (WorkerEndedError, OSError) as error:
            _log.exception("The %s gives no answer", self._name)
            question.fail(StateError(f"The {self._name}'s process ended twice ({error}). Try again."))
        except Exception as error:
            # The process is still at this question, and would take the next one for an end of it.
            _log.exception("A question to the %s broke off", self._name)
            self._worker.kill()
            question.fail(self._broke_off(repr(error)))

    def _serve(self, question: TaskT, begun: float) -> Any:
        """One answer of a living process.

        Raises:
            WorkerEndedError: the process ended in the middle.
            FootfallError: what was refused or cancelled, or the studio closes, or there is a bug.
        """
        if self._closed:
            raise self._closing()
        if question.is_ending:
            return question.unanswered(0.0)
        self._worker.ensure_started()
        number, heard, halted = next(self._numbers), self._running(), None
        self._worker.send(Submit(number, question.task))
        while not self._closed:
            message = self._worker.receive(POLL_SECONDS)
            self._running.look()
            now = self._running()
            if isinstance(message, TaskResult) and message.number == number:
                return self._result(message)
            if isinstance(message, Progress) and message.number == number:
                question.tell(message.known)
                heard = now
            if question.is_ending and halted is None:
                self._worker.send(Cancel(number))
                halted = now
            latest = question.latest(begun, heard) if halted is None else halted + question.grace
            if now > latest:
                self._worker.kill()
                self._start_worker()
                if halted is not None:
                    return question.unanswered(now - begun)
                sentence = hung_sentence(self._name, now - heard, question.remedy)
                _log.warning(sentence)
                return question.hung(sentence, now - begun)
        raise self._closing()

    def _result(self, message: TaskResult) -> Any:
        if message.refusal is not None:
            raise message.refusal
        if message.error:
            _log.error("The %s broke off: %s", self._name, message.error)
            raise self._broke_off(message.error.partition("\n")[0])
        return message.result

    def _broke_off(self, error: str) -> StateError:
        return StateError(f"The {self._name} broke off ({error}); this is a bug.")

    def _closing(self) -> StateError:
        return StateError(f"The studio is closing, so the {self._name} gives no answer.")
