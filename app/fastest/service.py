"""Searches for the fastest gait as jobs in the list, and the prices of options."""

import logging
import threading
import uuid
from collections.abc import Callable
from dataclasses import dataclass, field

from app.common.json import Json
from app.fastest.idle_search import IdleSearch
from app.fastest.price_search import PriceSearch
from app.fastest.prices import Prices
from app.fastest.request import FastestRequest
from app.fastest.search import BOUNDS, FOOT_ORDERS, Searched, search_content, searched, tried_content
from app.jobs.job_tracker import JobTracker
from app.jobs.repository import JobRepository
from core.errors import FootfallError, StateError
from core.pose_gaits.pose_problem import PoseProblem
from solver_jobs import SearchStep, SolveStatus

_log = logging.getLogger(__name__)

KIND = "fastest"
"""The kind of these jobs, as pages and scripts name it."""
Show = Callable[[Json | None], object]
"""Called with each new state, and with None at the end; from another thread."""
_SHARES = {FOOT_ORDERS: (0.0, 0.25), BOUNDS: (0.25, 0.75)}
"""Where in a search with a front its parts begin, and how much of it they are."""


@dataclass(frozen=True, eq=False)
class Work:
    """Something that goes on in a thread of its own, and can be ended.

    Args:
        ending: set to end it.
    """

    ending: threading.Event = field(default_factory=threading.Event)

    def cancel(self) -> None:
        """Ends it."""
        self.ending.set()


class FastestService:
    """Searches and prices share a few processes, started when they are first needed.

    `submit` and `cancel` belong to the command queue's thread; `prices` may be called from any.

    Args:
        job_repository: the list of jobs.
        later: does something on the command queue's thread.
        shown: told of each job that changed, on the command queue's thread.
    """

    def __init__(
        self,
        job_repository: JobRepository,
        later: Callable[[Callable[[], None]], object],
        shown: Callable[[Json], object],
    ) -> None:
        self._job_repository = job_repository
        self._tracker = JobTracker(job_repository, later, shown, "Tries foot orders.")
        self._idle = IdleSearch()
        self._prices = Prices()
        self._lock = threading.Lock()
        self._on: dict[Work, threading.Thread] = {}
        self._closed = False

    def submit(self, request: FastestRequest, has_front: bool) -> Json:
        """Starts a search over all foot orders.

        Args:
            request: what is asked; its order is chosen.
            has_front: whether other margins and stop bounds are tried too.

        Raises:
            InputError: the request asks for what such a gait cannot have.
            StateError: a search is on.
        """
        problem = request.problem()
        if self._tracker.contents():
            raise StateError(
                "A search for the fastest gait is on. Wait for it, or cancel it in Jobs.", "search"
            )
        job_id = uuid.uuid4().hex[:12]
        seen = {"share": 0.0, "request": vars(request), "front": has_front, "tried": []}
        job = self._job_repository.begin(job_id, KIND, "", request.model.title, "", **seen)
        work = Work()
        self._tracker.begin(job_id, work)
        self._start(work, lambda: self._run(job_id, problem, has_front, work))
        return job

    def cancel(self, job_id: str) -> Json:
        """Asks a search to end; one that ended already stays as it is."""
        return self._tracker.cancel(job_id)

    def _run(self, job_id: str, problem: PoseProblem, has_front: bool, work: Work) -> None:
        tell = self._tracker.teller(job_id)
        tried: list[Json] = []

        def report(part: str, step: SearchStep) -> None:
            self._prices.keep(step.newest)
            tried.append(tried_content(step.newest))
            begin, width = _SHARES[part] if has_front else (0.0, 1.0)
            sentence = f"{part}: {step.done} of {step.count} tried."
            tell(begin + width * step.done / step.count, {"sentence": sentence, "tried": list(tried)})

        try:
            with self._idle.use() as search:
                end = _end(searched(search, problem, None, has_front, report, work.ending), work)
        except FootfallError as error:
            end = {"state": "failed", "sentence": error.sentence}
        except Exception as error:
            _log.exception("A search for the fastest gait broke off")
            end = _broke_off(error)
        if not self._closed:  # else it counts as interrupted
            self._tracker.end(job_id, {**end, "tried": tried})

    def prices(self, request: FastestRequest, show: Show) -> Callable[[], None]:
        """Looks for the prices of every option of a request.

        Args:
            request: the gait that is requested.
            show: called with the options and the prices that are known, with each new price, then with None.

        Returns:
            A function that ends it.

        Raises:
            InputError: the request asks for what such a gait cannot have.
        """
        work = Work()
        listed = PriceSearch(request, self._prices, work.ending)
        self._start(work, lambda: self._price(listed, show))
        return work.cancel

    def _price(self, listed: PriceSearch, show: Show) -> None:
        try:
            show({"options": listed.content()})
            if not listed.is_complete:
                with self._idle.use() as search:
                    listed.run(search, show)
        except FootfallError as error:
            show({"sentence": error.sentence})
        except Exception as error:
            _log.exception("The search for prices broke off")
            show({"sentence": _broke_off(error)["sentence"]})
        finally:
            show(None)

    def _start(self, work: Work, act: Callable[[], None]) -> None:
        def run() -> None:
            try:
                act()
            finally:
                with self._lock:
                    self._on.pop(work, None)

        thread = threading.Thread(target=run, name="fastest", daemon=True)
        with self._lock:
            if self._closed:
                raise StateError("The studio is closing.", "studio")
            self._on[work] = thread
            thread.start()

    def close(self) -> None:
        """Ends what is on, and the processes."""
        with self._lock:
            self._closed = True
            running = dict(self._on)
        for work in running:
            work.cancel()
        for thread in running.values():
            thread.join()
        self._idle.close()


def _end(found: Searched, work: Work) -> Json:
    """The state in which a search ends."""
    tried = (*found.tried, *found.others)
    failed = sum(one.result.status not in (SolveStatus.SOLVED, SolveStatus.INFEASIBLE) for one in tried)
    if work.ending.is_set():
        return {"state": "cancelled", "sentence": "Cancelled."}
    if found.ranked:
        result = {key: value for key, value in search_content(found).items() if key != "tried"}
        broken = f", {failed} broke off" if failed else ""
        sentence = f"{len(tried)} gaits were tried{broken}."
        return {"state": "done", "sentence": sentence, "share": 1.0, "result": result}
    if failed:
        return {"state": "failed", "sentence": f"{failed} of {len(tried)} searches broke off. Search again."}
    return {"state": "infeasible", "sentence": f"None of {len(tried)} gaits keeps every limit."}


def _broke_off(error: Exception) -> Json:
    return {"state": "failed", "sentence": f"The search broke off ({error!r}); this is a bug."}
